"""Tests of cover points as they are declared: classes, crosses, recipes, rounding."""

import numpy as np
import pytest

from models.fixed import Raw
from verif.env.coverage import classes
from verif.env.coverage.directions import octants
from verif.env.coverage.points import Bin, Coverage, Point, Recipe, Samples, cross
from verif.env.coverage.rounding import Floored, remainders
from verif.env.coverage.sieve import Sieve
from verif.env.fields import Field, Operands
from verif.env.unit import Parameters, PipelinedUnit

P: Parameters = {}


def _ports(_p: Parameters) -> tuple[Field, ...]:
    return (Field("a", 8), Field("b", 8), Field("v", 8, lanes=3))


def _halved(_p: Parameters, operands: Operands) -> Operands:
    """A quarter of a, held in four bits."""
    return {"half": np.clip(operands["a"] >> 2, -8, 7)}


UNIT = PipelinedUnit(
    "half", inputs=_ports, outputs=lambda _p: (Field("half", 4),), model=_halved, parameters={}
)
SIEVE = Sieve(UNIT)


def _samples(**values: list[int]) -> Samples:
    return {name: np.array(column, dtype=np.int64) for name, column in values.items()}


def _held(point: Point, samples: Samples) -> list[list[str]]:
    """Names of the bins that each column hits."""
    size = next(iter(samples.values())).shape[-1]
    hit: list[list[str]] = [[] for _ in range(size)]
    for found in point.bins:
        assert found.holds is not None
        for column in np.flatnonzero(found.holds(P, samples)):
            hit[column].append(found.name)
    return hit


def _drawn(recipe: Recipe, size: int = 50) -> Operands:
    assert recipe.shape is not None
    generator = np.random.default_rng(1)
    start = {
        field.name: generator.integers(-9, 9, (field.lanes, size) if field.lanes > 1 else size)
        for field in _ports(P)
    }
    return recipe.shape(P, generator, start)


def test_every_number_is_in_one_class() -> None:
    every = {"a": np.arange(-128, 128)}
    assert {len(names) for names in _held(classes.operand(_ports, "a"), every)} == {1}


def test_classes_are_the_numbers_that_they_are_called_after() -> None:
    wanted = {
        0: "zero",
        1: "one",
        -1: "minus_one",
        127: "highest",
        126: "just_below_highest",
        -128: "lowest",
        -127: "just_above_lowest",
        64: "power_of_two",
        -64: "minus_power_of_two",
        3: "other_positive",
        -3: "other_negative",
    }
    assert _held(classes.operand(_ports, "a"), _samples(a=list(wanted))) == [
        [name] for name in wanted.values()
    ]


def test_every_class_is_drawn() -> None:
    point = classes.operand(_ports, "a")
    assert all(
        any(found.name in names for names in _held(point, _drawn(found.recipe))) for found in point.bins
    )


def test_a_class_holds_where_any_lane_is_in_it() -> None:
    samples = {"v": np.array([[0, 5], [5, 5], [5, 5]])}
    assert _held(classes.operand(_ports, "v"), samples) == [["zero", "other_positive"], ["other_positive"]]


def test_a_class_is_put_into_one_lane_and_the_others_stay() -> None:
    values = _drawn(classes.operand(_ports, "v").bins[2].recipe)["v"]
    assert ((values == 127).sum(axis=0) == 1).all()


def test_a_sign_is_that_of_all_lanes() -> None:
    samples = {"v": np.array([[1, 1, 0], [1, -1, 0], [1, 1, 0]])}
    assert _held(classes.sign(_ports, "v"), samples) == [["positive"], [], ["zero"]]


def test_a_sign_may_be_that_of_one_lane() -> None:
    samples = {"v": np.array([[1], [-1], [1]])}
    assert _held(classes.sign(_ports, "v", lane=1), samples) == [["negative"]]


def test_a_clock_before_the_first_is_unknown() -> None:
    assert classes.before(np.array([4, 5, 6])).tolist() == [-1, 4, 5]


def test_a_cross_has_every_bin_of_one_with_every_bin_of_the_other() -> None:
    both = cross(classes.sign(_ports, "a"), classes.sign(_ports, "b"))
    assert len({found.name for found in both.bins}) == len(both.bins) == 9


def test_a_crossed_bin_holds_where_both_hold() -> None:
    both = cross(classes.sign(_ports, "a"), classes.sign(_ports, "b"))
    samples = _samples(a=[1, -1, 0], b=[-1, -1, 1])
    assert _held(both, samples) == [
        ["positive_and_negative"],
        ["negative_and_negative"],
        ["zero_and_positive"],
    ]


def test_a_crossed_bin_is_drawn_by_both_recipes() -> None:
    both = cross(classes.sign(_ports, "a"), classes.sign(_ports, "b"))
    assert all(all(found.name in names for names in _held(both, _drawn(found.recipe))) for found in both.bins)


def test_bins_that_exclude_each_other_are_left_out_of_a_cross() -> None:
    both = cross(
        classes.sign(_ports, "a"),
        classes.sign(_ports, "b"),
        leave_out=lambda first, second: first == second,
    )
    assert not {f"{name}_and_{name}" for name in ("negative", "zero", "positive")} & {
        found.name for found in both.bins
    }


def test_what_the_bench_tells_of_cannot_be_crossed() -> None:
    told = classes.told("reset", "", {"busy": "reset while busy"})
    with pytest.raises(ValueError, match="busy"):
        cross(told, classes.sign(_ports, "a"), recipe=Recipe("any"))


def test_recipes_of_a_scenario_cannot_be_joined() -> None:
    with pytest.raises(ValueError, match="stalls and idles"):
        Recipe("stalls").then(Recipe("idles"))


def test_two_bins_of_one_name_are_refused() -> None:
    point = Point("p", "", (Bin("twice", Recipe("r")), Bin("twice", Recipe("r"))))
    with pytest.raises(ValueError, match=r"p\.twice"):
        Coverage((point,))


def test_a_port_that_there_is_not_is_refused() -> None:
    with pytest.raises(KeyError, match="no port is called c"):
        classes.port(_ports, P, "c")


def _quarter(_p: Parameters, samples: Samples) -> Raw:
    return samples["a"]


QUARTER = Floored(SIEVE, "half", _quarter, lambda _p: 2)


def test_limits_are_told_from_their_neighbours_on_both_sides() -> None:
    exact = [4 * value for value in (6, 7, 8, 9, 20, -7, -8, -9, -10, -20)]
    assert _held(QUARTER.limits(), _samples(a=exact)) == [
        ["next_to_highest"],
        ["highest"],
        ["just_above"],
        ["above"],
        ["above_next_bit_agrees"],
        ["next_to_lowest"],
        ["lowest"],
        ["just_below"],
        ["below"],
        ["below_next_bit_agrees"],
    ]


def test_a_residue_is_that_of_the_floor() -> None:
    assert _held(QUARTER.residue(), _samples(a=[8, 9, 10, 11, -8, -7, -6, -5])) == [
        [f"{name}_{sign}"] for sign in ("positive", "negative") for name in ("none", "least", "half", "most")
    ]


def test_less_than_a_step_is_no_residue_but_a_bin_of_its_own() -> None:
    hit = [set(names) for names in _held(QUARTER.residue(), _samples(a=[0, 1, -1]))]
    assert hit == [set(), {"less_than_a_step_positive"}, {"less_than_a_step_negative"}]


def test_remainders_are_told_apart() -> None:
    point = remainders(SIEVE, "rest", lambda _p, s: (s["a"], s["b"]))
    dividends, divisors = [12, 13, 15, 17, 5, 6, 12], [6, 6, 6, 6, 6, 6, 0]
    assert _held(point, _samples(a=dividends, b=divisors)) == [
        ["none"],
        ["least"],
        ["half"],
        ["most"],
        ["all_of_it"],
        ["quotient_of_one"],
        [],
    ]


def test_a_sieve_keeps_what_reaches_the_bin() -> None:
    found = SIEVE.bin("half", "highest", lambda _p, s: s["half"] == 7)
    assert (_drawn(found.recipe)["a"] >= 28).all()


def test_a_sieve_through_which_nothing_passes_still_gives_operands() -> None:
    found = SIEVE.bin("half", "never", lambda _p, s: s["half"] > 7)
    assert _drawn(found.recipe)["a"].size > 0


def test_a_unit_without_directed_operands_has_no_sieve_for_them() -> None:
    with pytest.raises(ValueError, match="half has no directed operands"):
        SIEVE.directed("some")


def test_a_vector_is_turned_into_each_octant() -> None:
    point = octants(UNIT, "v")
    assert all(
        all(names == [found.name] for names in _held(point, _drawn(found.recipe))) for found in point.bins
    )
    assert len(point.bins) == 8
