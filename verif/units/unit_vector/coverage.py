"""What must have been seen of the unit vector of any vector: octants, axes, lengths, shifts, components."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from models.fixed import Raw
from verif.env.coverage.classes import all_lanes, any_lane, operand
from verif.env.coverage.directions import axes, octants
from verif.env.coverage.points import Coverage, Holds, Samples
from verif.env.coverage.sieve import Sieve
from verif.env.coverage.signs import by_sign
from verif.env.unit import Parameters
from verif.units.unit_vector.unit import FMTS, UNIT

SIEVE = Sieve(UNIT)
ONE = FMTS.unit.one


def _shift(least: float, most: float) -> Holds:
    """Of vectors that are not zero, as shares of the largest shift."""

    def holds(p: Parameters, s: Samples) -> NDArray[np.bool_]:
        share = s["shift"] / (p["IN_W"] - 1)
        return np.asarray((share >= least) & (share <= most) & (s["degenerate"] == 0))

    return holds


SHIFTS = SIEVE.point(
    "shift",
    "how far a vector is shifted: none of the longest ones, most of those of 0 and -1",
    {
        "none": _shift(0, 0),
        "little": _shift(0.01, 0.3),
        "half": _shift(0.4, 0.6),
        "much": _shift(0.7, 0.99),
        "most": _shift(1, 1),
    },
)


def _lost(p: Parameters, s: Samples) -> Raw:
    """Bits of the vector that the mantissa has no place for."""
    return np.maximum(p["IN_W"] - FMTS.mantissa.width - s["shift"], 0)


def _floored(sign: int) -> Holds:
    def holds(p: Parameters, s: Samples) -> NDArray[np.bool_]:
        lost = _lost(p, s)
        return any_lane((s["vector"] & ((1 << lost) - 1) != 0) & (np.sign(s["vector"]) == sign))

    return holds


MANTISSA = SIEVE.point(
    "mantissa",
    "what is floored before the division",
    {
        "positive_floored": _floored(1),
        "negative_floored": _floored(-1),
        "nothing": lambda p, s: (_lost(p, s) > 0) & all_lanes(s["vector"] & ((1 << _lost(p, s)) - 1) == 0),
        "just_fits": lambda p, s: s["shift"] == p["IN_W"] - FMTS.mantissa.width,
        "zeros_appended": lambda p, s: (
            (s["shift"] > p["IN_W"] - FMTS.mantissa.width) & (s["degenerate"] == 0)
        ),
    },
)


def _component(sign: int, matches: Callable[[Raw], NDArray[np.bool_]]) -> Holds:
    """Of the magnitude of a component of the result whose vector's component has a sign."""

    def holds(_p: Parameters, s: Samples) -> NDArray[np.bool_]:
        return any_lane(matches(np.abs(s["unit"])) & (np.sign(s["vector"]) == sign))

    return holds


COMPONENTS = SIEVE.point(
    "unit",
    "sizes of the result's components",
    by_sign(
        _component,
        {
            "vanishes": lambda size: size == 0,
            "one_step": lambda size: size == 1,
            "step_below_one": lambda size: size == ONE - 1,
            "one": lambda size: size == ONE,
        },
    ),
)

LENGTHS = SIEVE.point(
    "length",
    "the norm of the shifted vector",
    {
        "degenerate": lambda _p, s: s["degenerate"] == 1,
        "least": lambda _p, s: s["norm"] == ONE,
        "twice_the_least": lambda _p, s: s["norm"] == 2 * ONE,
        "most": lambda _p, s: s["norm"] > 3.4 * ONE,
        "all_minus_one": lambda _p, s: all_lanes(s["vector"] == -1),
        "one_step_long": lambda _p, s: (s["vector"] ** 2).sum(axis=0) == 1,
    },
)

COVERAGE = Coverage(
    (
        operand(UNIT.inputs, "vector"),
        axes(UNIT, "vector"),
        octants(UNIT, "vector"),
        SHIFTS,
        MANTISSA,
        COMPONENTS,
        LENGTHS,
    )
)
