"""What must have been seen of the unit vector: axes, octants, the norm's remainder, truncated components."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from models.fixed import Raw
from verif.env.coverage.classes import all_lanes, any_lane
from verif.env.coverage.points import Coverage, Holds, Samples
from verif.env.coverage.rounding import remainders
from verif.env.coverage.sieve import Sieve
from verif.env.coverage.signs import by_sign
from verif.env.unit import Parameters
from verif.units.norm.coverage import square, vector_points
from verif.units.normalise.unit import UNIT
from verif.units.sqrt.coverage import remainder_cases

SIEVE = Sieve(UNIT)


def _norm_and_rest(p: Parameters, s: Samples) -> tuple[Raw, Raw]:
    return s["norm"], square(p, s) - s["norm"] ** 2


def _division(p: Parameters, s: Samples) -> tuple[Raw, Raw]:
    return np.abs(s["a"]) << (p["OUT_FRAC"] + p["GUARD"]), s["norm"]


def _component(sign: int, matches: Callable[[Raw, int], NDArray[np.bool_]]) -> Holds:
    """Of the magnitude of a component of the result, and 1; of components of a sign."""

    def holds(p: Parameters, s: Samples) -> NDArray[np.bool_]:
        return any_lane(matches(np.abs(s["unit"]), 1 << p["OUT_FRAC"]) & (np.sign(s["a"]) == sign))

    return holds


UNIT_COMPONENT = SIEVE.point(
    "unit",
    "sizes of the result's components",
    by_sign(
        _component,
        {
            "truncated_to_zero": lambda size, _one: size == 0,
            "one_step": lambda size, _one: size == 1,
            "half": lambda size, one: size == one // 2,
            "step_below_one": lambda size, one: size == one - 1,
            "one": lambda size, one: size == one,
        },
    ),
)


def _whole(_p: Parameters, s: Samples) -> NDArray[np.bool_]:
    """A norm that is a power of two, so that nothing is cut off."""
    return np.asarray((s["norm"] & (s["norm"] - 1) == 0) & (s["norm"] > 1) & (s["degenerate"] == 0))


KINDS = SIEVE.point(
    "kinds",
    "vectors that are special to a division by their norm",
    {
        "degenerate": lambda _p, s: s["degenerate"] == 1,
        "norm_is_a_power_of_two": _whole,
        "components_differ_in_sign": lambda _p, s: any_lane(s["unit"] > 0) & any_lane(s["unit"] < 0),
        "two_components_vanish": lambda _p, s: (
            all_lanes(s["a"] != 0) & (np.count_nonzero(s["unit"], axis=0) == 1)
        ),
    },
)

COVERAGE = Coverage(
    (
        *vector_points(UNIT, SIEVE),
        SIEVE.point("norm", "what the norm's root leaves", remainder_cases(_norm_and_rest)),
        remainders(SIEVE, "remainder", _division),
        UNIT_COMPONENT,
        KINDS,
    )
)
