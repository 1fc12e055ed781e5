"""What must have been seen of hit point and normal: both kinds, both sides, limits, what is floored."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from models.fixed import Raw
from models.header import selected
from models.limits import INFINITY, T_MIN
from verif.env.coverage.classes import all_lanes, any_lane
from verif.env.coverage.directions import octants
from verif.env.coverage.points import Coverage, Holds, Samples
from verif.env.coverage.sieve import Sieve
from verif.env.coverage.signs import by_sign
from verif.env.unit import Parameters
from verif.units.surface.unit import UNIT, inv_radius, inverse

SIEVE = Sieve(UNIT)
HITS = SIEVE.directed("hits")


def _kind(triangle: int, leaving: int) -> Holds:
    def holds(_p: Parameters, s: Samples) -> NDArray[np.bool_]:
        return np.asarray((s["triangle"] == triangle) & (s["leaving"] == leaving))

    return holds


KINDS = {
    "sphere_from_outside": _kind(0, 0),
    "sphere_from_inside": _kind(0, 1),
    "front_of_triangle": _kind(1, 0),
    "back_of_triangle": _kind(1, 1),
}


def _with(kind: str, matches: Callable[[Parameters, Samples], NDArray[np.bool_]]) -> Holds:
    def holds(p: Parameters, s: Samples) -> NDArray[np.bool_]:
        return np.asarray(KINDS[kind](p, s) & matches(p, s))

    return holds


def _of_triangles(matches: Callable[[Parameters, Samples], NDArray[np.bool_]]) -> Holds:
    return lambda p, s: np.asarray((s["triangle"] == 1) & matches(p, s))


def _of_spheres(matches: Callable[[Parameters, Samples], NDArray[np.bool_]]) -> Holds:
    return lambda p, s: np.asarray((s["triangle"] == 0) & matches(p, s))


def _along(_p: Parameters, s: Samples) -> Raw:
    """t I of triangles and h I of spheres, exact."""
    return np.asarray(np.where(s["triangle"] == 1, s["distance"], s["half_chord"]) * s["direction"])


def _residue(sign: int, matches: Callable[[Raw, int], NDArray[np.bool_]]) -> Holds:
    """Of what the floor drops of t I or h I, and the most that it can be."""

    def holds(p: Parameters, s: Samples) -> NDArray[np.bool_]:
        mask, along = selected(p).unit.one - 1, _along(p, s)
        return any_lane(matches(along & mask, mask) & (np.sign(along) == sign))

    return holds


ALONG = SIEVE.point(
    "along",
    "what is floored of the way along the ray",
    by_sign(
        _residue,
        {
            "nothing": lambda rest, _most: rest == 0,
            "least": lambda rest, _most: rest == 1,
            "most": lambda rest, most: rest == most,
        },
    ),
)


def _held(kind: str, limit: str) -> Holds:
    """A component of the point at a limit."""
    return _with(kind, lambda p, s: any_lane(s["point"] == getattr(selected(p).point, limit)))


def _center_held(sign: int) -> Holds:
    """A center seen from the hit point is further away than any sphere is large."""

    def holds(p: Parameters, s: Samples) -> NDArray[np.bool_]:
        fmts = selected(p)
        step = _along(p, s) >> fmts.unit.frac_bits
        seen = s["offset"] + np.where(s["leaving"] == 1, -step, step)
        return any_lane(sign * seen > fmts.offset.max)

    return _of_spheres(holds)


POINTS = SIEVE.point(
    "point",
    "what is held within its range: components of a triangle's point, of a sphere's center seen from it",
    {
        **{
            f"{kind}_{name}": _held(kind, limit)
            for kind in ("front_of_triangle", "back_of_triangle")
            for name, limit in (("highest", "max"), ("lowest", "min"))
        },
        "center_highest": _center_held(1),
        "center_lowest": _center_held(-1),
    },
)


def _radius(radius: int) -> Holds:
    def holds(p: Parameters, s: Samples) -> NDArray[np.bool_]:
        fmts = selected(p)
        return np.asarray(inv_radius(s["shape"], fmts) == inverse(np.array(radius), fmts))

    return _of_spheres(holds)


SPHERES = SIEVE.point(
    "sphere",
    "chords and radii",
    {
        "tangent": _of_spheres(lambda _p, s: s["half_chord"] == 0),
        "chord_of_a_step": _of_spheres(lambda _p, s: s["half_chord"] == 1),
        "through_the_center": _of_spheres(lambda _p, s: all_lanes(s["offset"] == 0)),
        "past_the_center": _of_spheres(lambda _p, s: any_lane(s["offset"] != 0) & (s["half_chord"] > 0)),
        "smallest_radius": _radius(1),
        "radius_of_one": _radius(8),
        "largest_radius": _radius(31),
        "radius_that_has_no_exact_inverse": _radius(3),
    },
)

NORMALS = SIEVE.point(
    "normal",
    "normals as they come out",
    {
        "triangle_turned": _with(
            "back_of_triangle",
            lambda _p, s: all_lanes(s["normal"] == -s["shape"]) & any_lane(s["shape"] != 0),
        ),
        "triangle_as_it_is": _with("front_of_triangle", lambda _p, s: all_lanes(s["normal"] == s["shape"])),
        "triangle_lowest_turned_and_held": _with(
            "back_of_triangle",
            lambda p, s: any_lane(
                (s["shape"] == selected(p).unit.min) & (s["normal"] == selected(p).unit.max)
            ),
        ),
        "sphere_held_at_highest": _of_spheres(lambda p, s: any_lane(s["normal"] == selected(p).unit.max)),
        "sphere_held_at_lowest": _of_spheres(lambda p, s: any_lane(s["normal"] == selected(p).unit.min)),
        "sphere_one": _of_spheres(lambda p, s: any_lane(s["normal"] == selected(p).unit.one)),
        "sphere_minus_one": _of_spheres(lambda p, s: any_lane(s["normal"] == -selected(p).unit.one)),
        "sphere_floored_to_minus_one_step": _of_spheres(lambda _p, s: any_lane(s["normal"] == -1)),
    },
)


def _distance(matches: Callable[[Raw, int, int], NDArray[np.bool_]]) -> Holds:
    """Of a triangle's distance, the smallest and infinity."""

    def holds(p: Parameters, s: Samples) -> NDArray[np.bool_]:
        one = selected(p).point.one
        return np.asarray(matches(s["distance"], int(T_MIN * one), int(INFINITY * one)))

    return _of_triangles(holds)


DISTANCES = HITS.point(
    "distance",
    "how far a triangle is",
    {
        "smallest": _distance(lambda distance, least, _most: distance == least),
        "near": _distance(lambda distance, least, _most: (distance > least) & (distance < 512 * least)),
        "far": _distance(lambda distance, least, most: (distance > 4096 * least) & (distance < most)),
        "infinity": _distance(lambda distance, _least, most: distance == most),
    },
)

COVERAGE = Coverage(
    (
        HITS.point("kind", "which side of what", KINDS),
        DISTANCES,
        SPHERES,
        NORMALS,
        POINTS,
        ALONG,
        octants(UNIT, "direction"),
    )
)
