"""What must have been seen of the length of a vector: axes, the root's remainder, lengths at their limits."""

import numpy as np
from numpy.typing import NDArray

from models.fixed import Raw
from verif.env.coverage.classes import all_lanes, any_lane, operand, port
from verif.env.coverage.directions import axes, octants
from verif.env.coverage.points import Coverage, Holds, Point, Samples
from verif.env.coverage.sieve import Sieve
from verif.env.unit import ArithmeticUnit, Parameters
from verif.units.norm.unit import UNIT, vector
from verif.units.sqrt.coverage import remainder_cases

SIEVE = Sieve(UNIT)


def square(p: Parameters, s: Samples) -> Raw:
    """The radicand of vectors `a`."""
    return np.asarray((s["a"] * s["a"]).sum(axis=0) << (2 * p["GUARD"]))


def _root_and_rest(p: Parameters, s: Samples) -> tuple[Raw, Raw]:
    return s["length"], square(p, s) - s["length"] ** 2


def _component(limit: str) -> Holds:
    """All three components at a limit."""

    def holds(p: Parameters, s: Samples) -> NDArray[np.bool_]:
        return all_lanes(s["a"] == getattr(port(vector, p, "a"), limit))

    return holds


def shapes(sieve: Sieve) -> Point:
    """Vectors whose squares add up to little or much, or of which one counts alone."""
    return sieve.point(
        "shapes",
        "how a vector's components stand to each other",
        {
            "one_step": lambda _p, s: (s["a"] ** 2).sum(axis=0) == 1,
            "all_one_step": lambda _p, s: all_lanes(np.abs(s["a"]) == 1),
            "all_lowest": _component("low"),
            "all_highest": _component("high"),
            "all_alike": lambda _p, s: (np.ptp(np.abs(s["a"]), axis=0) == 0) & all_lanes(np.abs(s["a"]) > 1),
            "one_step_beside_a_long_one": lambda p, s: (
                any_lane(np.abs(s["a"]) == 1) & any_lane(np.abs(s["a"]) > port(vector, p, "a").high // 2)
            ),
        },
    )


def vector_points(unit: ArithmeticUnit, sieve: Sieve) -> tuple[Point, ...]:
    """Of what has a length, for both units that take one."""
    return (operand(vector, "a"), axes(unit, "a"), octants(unit, "a"), shapes(sieve))


def _guard_bits(p: Parameters, s: Samples) -> Raw:
    return s["length"] & ((1 << p["GUARD"]) - 1)


LENGTH = SIEVE.point(
    "length",
    "sizes of the length, which may need a bit more than a component",
    {
        "no_longer_than_a_component": lambda p, s: (
            (s["length"] <= port(vector, p, "a").high << p["GUARD"]) & (s["length"] > 1)
        ),
        "longer_than_a_component": lambda p, s: s["length"] > -port(vector, p, "a").low << p["GUARD"],
        "of_the_lowest_component": lambda p, s: s["length"] == -port(vector, p, "a").low << p["GUARD"],
        "guard_bits_zero": lambda p, s: (p["GUARD"] > 0) & (_guard_bits(p, s) == 0) & (s["length"] > 0),
        "guard_bits_set": lambda p, s: (p["GUARD"] > 0) & (_guard_bits(p, s) > 0),
    },
)

COVERAGE = Coverage(
    (
        *vector_points(UNIT, SIEVE),
        SIEVE.point("remainder", "what the root leaves of the sum", remainder_cases(_root_and_rest)),
        LENGTH,
    )
)
