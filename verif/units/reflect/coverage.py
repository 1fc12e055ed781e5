"""What must have been seen of the mirrored direction: angles, octants, limits and residues of both."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from models.arith import exact_dot, vec_scale
from models.fixed import Raw
from models.header import selected
from verif.env.coverage.classes import all_lanes, any_lane
from verif.env.coverage.directions import octants
from verif.env.coverage.points import Coverage, Holds, Samples
from verif.env.coverage.rounding import ONE_BIT_WIDER, Floored, lanes_apart
from verif.env.coverage.sieve import Sieve
from verif.env.unit import Parameters
from verif.units.reflect.unit import UNIT

SIEVE = Sieve(UNIT)
RAYS = SIEVE.directed("unit vectors at all angles")


def _cosine(_p: Parameters, s: Samples) -> Raw:
    return exact_dot(s["normal"], s["direction"])


def _along(p: Parameters, s: Samples) -> Raw:
    """(N.V) N, floored."""
    unit = selected(p).unit
    return vec_scale(s["cosine"], s["normal"], unit, unit, unit)


COSINE = Floored(SIEVE, "cosine", _cosine, lambda p: selected(p).unit.frac_bits)
MIRRORED = Floored(SIEVE, "mirrored", lambda p, s: s["direction"] - 2 * _along(p, s), lambda _p: 0)


def _angle(matches: Callable[[Raw, int], NDArray[np.bool_]]) -> Holds:
    """Of the cosine as it comes out, and 1."""

    def holds(p: Parameters, s: Samples) -> NDArray[np.bool_]:
        return matches(s["cosine"], selected(p).unit.one)

    return holds


ANGLES = RAYS.point(
    "angle",
    "how the direction stands to the surface",
    {
        "head_on": _angle(lambda cosine, one: cosine == -one),
        "almost_head_on": _angle(lambda cosine, one: (cosine > -one) & (cosine < -0.99 * one)),
        "slanted": _angle(lambda cosine, one: (cosine > -0.9 * one) & (cosine < -0.1 * one)),
        "grazing": _angle(lambda cosine, one: (cosine < 0) & (cosine > -0.01 * one)),
        "one_step_of_cosine": _angle(lambda cosine, _one: cosine == -1),
        "along_the_surface": _angle(lambda cosine, _one: cosine == 0),
        "from_behind": _angle(lambda cosine, one: (cosine > 0) & (cosine < one)),
        "straight_from_behind": _angle(lambda cosine, one: cosine == one),
    },
)

MIRROR = RAYS.point(
    "mirror",
    "what becomes of the direction",
    {
        "goes_on_as_it_was": lambda _p, s: all_lanes(s["mirrored"] == s["direction"]) & (s["cosine"] == 0),
        "goes_back": lambda _p, s: (
            all_lanes(s["mirrored"] == -s["direction"]) & any_lane(s["direction"] != 0)
        ),
        "one_component_turned": lambda _p, s: (
            ((s["mirrored"] == -s["direction"]) & (s["direction"] != 0)).sum(axis=0) == 1
        ),
        "product_floored_to_minus_one": lambda p, s: any_lane(
            (_along(p, s) == -1) & (s["cosine"] != 0) & (s["normal"] != 0)
        ),
    },
)

COVERAGE = Coverage(
    (
        octants(UNIT, "normal"),
        ANGLES,
        MIRROR,
        COSINE.limits(leave_out=ONE_BIT_WIDER),
        COSINE.residue(),
        MIRRORED.limits(),
        lanes_apart(SIEVE, "mirrored"),
    )
)
