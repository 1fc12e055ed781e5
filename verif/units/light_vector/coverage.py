"""What must have been seen of the way to a light: octants, distances up to infinity, a light at the point."""

from collections.abc import Callable

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

from models.fixed import Raw
from models.limits import INFINITY
from verif.env import vectors
from verif.env.coverage.classes import all_lanes, any_lane, operand
from verif.env.coverage.directions import axis_cases, octant_cases
from verif.env.coverage.points import Coverage, Holds, Samples
from verif.env.coverage.sieve import Sieve
from verif.env.fields import Operands
from verif.env.unit import Parameters
from verif.units.light_vector.unit import FMTS, UNIT

SIEVE = Sieve(UNIT)
FAR = int(INFINITY * FMTS.point.one)
SHIFT = FMTS.point.frac_bits - FMTS.coord.frac_bits


def _beside_infinity(_p: Parameters, generator: Generator, size: int) -> Operands:
    """Lights along an axis, or anywhere, whose distance is infinity but for a few steps."""
    unit = vectors.directions(generator, size)
    length = FAR + generator.integers(-3, 4, size)
    reach = np.rint(unit * length).astype(np.int64)
    light = FMTS.coord.saturate((reach >> SHIFT) // 2)
    return {"light": light, "point": FMTS.point.saturate((light << SHIFT) - reach)}


def _reach(s: Samples) -> Raw:
    """Light minus point, exact."""
    return np.asarray((s["light"] << SHIFT) - s["point"])


def _distance(s: Samples) -> NDArray[np.float64]:
    return np.sqrt((_reach(s).astype(np.float64) ** 2).sum(axis=0))


DISTANCES = SIEVE.point(
    "distance",
    "how far the light is",
    {
        "at_the_point": lambda _p, s: s["degenerate"] == 1,
        "one_step": lambda _p, s: (_reach(s) ** 2).sum(axis=0) == 1,
        "a_few_steps": lambda _p, s: (s["limit"] > 1) & (s["limit"] < 8),
        "less_than_one": lambda _p, s: (s["limit"] > 8) & (s["limit"] < FMTS.point.one),
        "near": lambda _p, s: (s["limit"] > FMTS.point.one) & (s["limit"] < 16 * FMTS.point.one),
        "far": lambda _p, s: (s["limit"] > 16 * FMTS.point.one) & (s["limit"] < FAR),
        "far_beyond_infinity": lambda _p, s: _distance(s) > 1.5 * FAR,
        "farthest": lambda _p, s: (_distance(s) > 3.0 * FAR) & (s["limit"] == FAR),
    },
)

INFINITE = SIEVE.of("lights beside infinity", _beside_infinity).point(
    "infinity",
    "distances at infinity, which is the most",
    {
        "last_below": lambda _p, s: (s["limit"] < FAR) & (_distance(s) > FAR - 2),
        "just_there": lambda _p, s: (s["limit"] == FAR) & (np.abs(_distance(s) - FAR) < 1),
        "held": lambda _p, s: (s["limit"] == FAR) & (_distance(s) > FAR + 1) & (_distance(s) < FAR + 4),
    },
)


def _component(matches: Callable[[Raw, Raw], NDArray[np.bool_]]) -> Holds:
    """Of a component of the exact way, and of the result."""

    def holds(_p: Parameters, s: Samples) -> NDArray[np.bool_]:
        return any_lane(matches(_reach(s), s["direction"]))

    return holds


COMPONENTS = SIEVE.point(
    "direction",
    "sizes of the direction's components",
    {
        "one": _component(lambda _reach, direction: direction == FMTS.unit.one),
        "minus_one": _component(lambda _reach, direction: direction == -FMTS.unit.one),
        "positive_vanishes": _component(lambda reach, direction: (reach > 0) & (direction == 0)),
        "negative_vanishes": _component(lambda reach, direction: (reach < 0) & (direction == 0)),
        "needs_the_bit_that_the_difference_is_wider": _component(
            lambda reach, _direction: np.abs(reach) > FMTS.point.max
        ),
        "all_alike": lambda _p, s: (
            (np.ptp(np.abs(s["direction"]), axis=0) == 0) & all_lanes(s["direction"] != 0)
        ),
    },
)


COVERAGE = Coverage(
    (
        operand(UNIT.inputs, "point"),
        operand(UNIT.inputs, "light"),
        SIEVE.point("octants", "octants that the light is in", octant_cases(_reach)),
        SIEVE.point("axes", "axes and planes that the light is on", axis_cases(_reach)),
        DISTANCES,
        INFINITE,
        COMPONENTS,
    )
)
