"""What must have been seen of the transmitted direction: angles, all ratios, the critical angle, limits."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from models.core.refract import radicand
from models.fixed import Raw
from models.header import selected
from models.scene.types import INDEX
from verif.env.coverage.classes import all_lanes, any_lane
from verif.env.coverage.directions import octants
from verif.env.coverage.points import Coverage, Holds, Samples
from verif.env.coverage.sieve import Sieve
from verif.env.unit import Parameters
from verif.units.refract.unit import UNIT

SIEVE = Sieve(UNIT)
RAYS = SIEVE.directed("rays at surfaces")


def _ratio(leaving: int, index: int) -> Holds:
    def holds(_p: Parameters, s: Samples) -> NDArray[np.bool_]:
        return np.asarray((s["leaving"] == leaving) & (s["index"] == index) & (s["total"] == 0))

    return holds


RATIOS = RAYS.point(
    "ratio",
    "each row of the tables of refractive indices, of rays that pass",
    {
        f"{'leaving' if leaving else 'entering'}_{index}": _ratio(leaving, index)
        for leaving in (0, 1)
        for index in range(INDEX.max + 1)
    },
)


def _angle(matches: Callable[[Raw, int], NDArray[np.bool_]]) -> Holds:
    """Of the cosine N.V, and 1."""

    def holds(p: Parameters, s: Samples) -> NDArray[np.bool_]:
        return matches(s["cosine"], selected(p).unit.one)

    return holds


ANGLES = SIEVE.point(
    "angle",
    "how the ray meets the surface; beyond 0 and -1 the cosine is held",
    {
        "beyond_head_on": _angle(lambda cosine, one: cosine < -one),
        "head_on": _angle(lambda cosine, one: cosine == -one),
        "slanted": _angle(lambda cosine, one: (cosine > -0.9 * one) & (cosine < -0.1 * one)),
        "grazing": _angle(lambda cosine, one: (cosine < 0) & (cosine > -0.01 * one)),
        "along_the_surface": _angle(lambda cosine, _one: cosine == 0),
        "from_behind": _angle(lambda cosine, _one: cosine > 0),
    },
)


def _under_root(matches: Callable[[Raw, int], NDArray[np.bool_]]) -> Holds:
    """Of the radicand of leaving rays, and 1."""

    def holds(p: Parameters, s: Samples) -> NDArray[np.bool_]:
        fmts, leaving = selected(p), s["leaving"] == 1
        found = radicand(s["cosine"], s["index"], leaving, fmts)
        return np.asarray(matches(found, 1 << 2 * fmts.gain.frac_bits) & leaving)

    return holds


RADICANDS = RAYS.point(
    "radicand",
    "what the root is taken of where the ray leaves: reflection is total where it is negative",
    {
        "far_below_zero": _under_root(lambda found, one: found < -one),
        "just_below_zero": _under_root(lambda found, one: (found < 0) & (found > -one >> 10)),
        "zero": _under_root(lambda found, _one: found == 0),
        "just_above_zero": _under_root(lambda found, one: (found > 0) & (found < one >> 10)),
        "between": _under_root(lambda found, one: (found > one >> 3) & (found < 7 * one >> 3)),
        "one": _under_root(lambda found, one: found == one),
    },
)

WAYS = RAYS.point(
    "way",
    "how the ray goes on",
    {
        "enters": lambda _p, s: (s["leaving"] == 0) & (s["index"] > 0),
        "leaves": lambda _p, s: (s["leaving"] == 1) & (s["total"] == 0) & (s["index"] > 0),
        "total_reflection": lambda _p, s: s["total"] == 1,
        "straight_through_the_same_index": lambda _p, s: (
            all_lanes(s["transmitted"] == s["direction"]) & (s["index"] == 0)
        ),
        "straight_through_glass": lambda _p, s: (
            all_lanes(s["transmitted"] == s["direction"]) & (s["index"] > 0)
        ),
        "same_index_along_the_surface": lambda _p, s: (s["index"] == 0) & (s["cosine"] == 0),
        "enters_along_the_surface": lambda _p, s: (s["leaving"] == 0) & (s["cosine"] == 0) & (s["index"] > 0),
        "totally_reflected_along_the_surface": lambda _p, s: (s["total"] == 1) & (s["cosine"] == 0),
    },
)


def _limit(limit: str, total: int) -> Holds:
    def holds(p: Parameters, s: Samples) -> NDArray[np.bool_]:
        most = getattr(selected(p).unit, limit)
        return any_lane(s["transmitted"] == most) & (s["total"] == total)

    return holds


LIMITS = SIEVE.point(
    "limits",
    "components at a limit: held where the ray passes, those of R where it is totally reflected",
    {
        f"{name}_{side}": _limit(limit, total)
        for name, limit in (("highest", "max"), ("lowest", "min"))
        for side, total in (("passes", 0), ("total", 1))
    },
)

COVERAGE = Coverage((RATIOS, ANGLES, RADICANDS, WAYS, LIMITS, octants(UNIT, "direction")))
