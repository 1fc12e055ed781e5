"""What must have been seen of light behind an object: colours, shares, limit, residue, channels apart."""

import numpy as np
from numpy.typing import NDArray

from models.fixed import Raw
from models.header import selected
from verif.env.coverage.classes import all_lanes, any_lane, operand
from verif.env.coverage.points import Coverage, Holds, Samples
from verif.env.coverage.rounding import Floored, lanes_apart
from verif.env.coverage.sieve import Sieve
from verif.env.unit import Parameters
from verif.units.dim.unit import UNIT

SIEVE = Sieve(UNIT)


def _exact(_p: Parameters, s: Samples) -> Raw:
    return np.asarray(s["colour"] * s["share"])


DIMMED = Floored(SIEVE, "dimmed", _exact, lambda p: selected(p).coeff.frac_bits)


def _shares(least: float, most: float, beside: int = 0) -> Holds:
    """A channel that has light and whose share is in a range, in ones and steps."""

    def holds(p: Parameters, s: Samples) -> NDArray[np.bool_]:
        one = selected(p).coeff.one
        inside = (s["share"] >= least * one + beside) & (s["share"] <= most * one + beside)
        return any_lane(inside & (s["colour"] > 0))

    return holds


def _apart(p: Parameters, s: Samples) -> NDArray[np.bool_]:
    one = selected(p).coeff.one
    lit = all_lanes(s["colour"] > 0)
    return np.asarray(lit & any_lane(s["share"] == 0) & any_lane(s["share"] == one))


SHARES = SIEVE.point(
    "shares",
    "how much of a channel's light passes",
    {
        "nothing": _shares(0, 0),
        "half": _shares(0.5, 0.5),
        "all_but_a_step": _shares(1, 1, -1),
        "all": _shares(1, 1),
        "a_step_more_than_all": _shares(1, 1, 1),
        "channels_differ": _apart,
        "all_black": lambda _p, s: all_lanes(s["colour"] == 0) & all_lanes(s["share"] > 0),
        "each_its_own": lambda _p, s: (
            (np.diff(np.sort(s["share"], axis=0), axis=0) > 0).all(axis=0) & all_lanes(s["dimmed"] > 0)
        ),
    },
)

COVERAGE = Coverage(
    (
        operand(UNIT.inputs, "colour", signed=False),
        operand(UNIT.inputs, "share", signed=False),
        SHARES,
        DIMMED.limits(negative=False),
        DIMMED.residue(negative=False),
        lanes_apart(SIEVE, "dimmed", signed=False),
    )
)
