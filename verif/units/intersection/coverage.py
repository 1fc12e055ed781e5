"""What must have been seen of a ray against an object: how it passes spheres and triangles, how far away."""

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

from models.arith import exact_dot
from models.core import sphere_intersect
from models.core.setup import triangle_normals
from models.core.triangle import dominant_axis, edge_areas
from models.fixed import Raw
from models.formats import Formats
from models.header import selected
from models.limits import INFINITY, T_MIN
from verif.env.coverage.classes import all_lanes, any_lane, before
from verif.env.coverage.flow import IDLE
from verif.env.coverage.points import Bin, Coverage, Holds, Point, Recipe, Samples
from verif.env.coverage.sieve import Sieve
from verif.env.fields import Operands, count, select
from verif.env.unit import Parameters
from verif.units.intersection import rays
from verif.units.intersection.unit import UNIT, alternating, corners, radius_sq

Found = NDArray[np.bool_]


def _stages(p: Parameters, s: Samples) -> Samples:
    """Of all tests as if they were of a sphere, and as if they were of a triangle.

    near, far: the chord's ends, -1 where there is none. areas (3, n): of the edges. zeros: areas that are 0
    where the ray passes within, -1 where it does not. facing: N.I, exact; across: its magnitude, truncated.
    """
    fmts = selected(p)
    ray: dict[str, Any] = {name: s[name] for name in ("origin", "direction")}
    ball = sphere_intersect(
        **ray, limit=s["limit"], center=corners(s)[0], radius_sq=radius_sq(s, fmts), fmts=fmts
    )
    meets = ball.discriminant >= 0
    areas = np.stack(edge_areas(**ray, corners=corners(s), fmts=fmts))
    within = all_lanes(areas >= 0) ^ all_lanes(areas <= 0)
    facing = exact_dot(s["direction"], s["shape"])
    return {
        "along": ball.along,
        "clipped": ball.offset,
        "discriminant": ball.discriminant,
        "near": np.where(meets, ball.along - ball.half_chord, -1),
        "far": np.where(meets, ball.along + ball.half_chord, -1),
        "areas": areas,
        "zeros": np.where(within, np.count_nonzero(areas == 0, axis=0), -1),
        "facing": facing,
        "across": fmts.facing.resize(np.abs(facing), 2 * fmts.unit.frac_bits),
    }


SIEVE = Sieve(UNIT, stages=_stages)
RAYS = SIEVE.directed("rays past spheres and triangles")


def _along_an_axis(generator: Generator, size: int, fmts: Formats) -> tuple[Raw, Raw]:
    """Directions (3, n) along an axis, and the axes' numbers."""
    axis = generator.integers(0, 3, size)
    sign = generator.choice([-1, 1], size)
    return (np.arange(3)[:, None] == axis) * sign * fmts.unit.one, axis


def _tangents(p: Parameters, generator: Generator, size: int) -> Operands:
    """Rays along an axis that pass a sphere at its radius, a step within it or a step beyond it."""
    fmts = selected(p)
    drawn = rays.past_spheres(generator, size, fmts)
    direction, axis = _along_an_axis(generator, size, fmts)
    radius = np.sqrt(radius_sq(drawn, fmts)).astype(np.int64)
    aside = (radius << (fmts.point.frac_bits - fmts.radius.frac_bits)) + generator.integers(-1, 2, size)
    lanes = np.arange(3)[:, None]
    center = corners(drawn)[0] >> 4
    away = (lanes == (axis + 1) % 3) * aside - (direction << 2 >> fmts.unit.frac_bits) * fmts.point.one
    origin = (center << (fmts.point.frac_bits - fmts.coord.frac_bits)) + away
    vertices = np.concatenate([center, *corners(drawn)[1:]])
    return {**drawn, "origin": origin, "direction": direction, "vertices": vertices}


def _on_a_grid(p: Parameters, generator: Generator, size: int) -> Operands:
    """Rays along an axis at triangles on a coarse grid: through corners and edges, beside them, edge on."""
    fmts = selected(p)
    direction, axis = _along_an_axis(generator, size, fmts)
    lanes, step = np.arange(3)[:, None], fmts.coord.one >> 2
    places = [generator.integers(-2, 3, (3, size)) for _ in range(3)]
    ahead = np.sign(direction) * generator.integers(3, 6, size)
    reach = [np.where(lanes == axis, place + ahead, place) * step for place in places]
    start = generator.integers(-8, 9, (3, size)) * fmts.coord.one
    first, second, third = (start + away for away in reach)
    return {
        "origin": start << (fmts.point.frac_bits - fmts.coord.frac_bits),
        "direction": direction,
        "limit": np.full(size, int(INFINITY * fmts.point.one)),
        "triangle": np.ones(size, dtype=np.int64),
        "shape": triangle_normals(first, second, third, fmts).normal,
        "vertices": np.concatenate([first, second, third]),
    }


TANGENTS = SIEVE.of("rays along an axis at a sphere's radius", _tangents)
GRID = SIEVE.of("rays along an axis at triangles on a grid", _on_a_grid)


def _sphere(matches: Callable[[Samples, Formats], Found]) -> Holds:
    def holds(p: Parameters, s: Samples) -> Found:
        return np.asarray((s["triangle"] == 0) & matches(s, selected(p)))

    return holds


def _hit(matches: Callable[[Samples, Formats], Found]) -> Holds:
    """Of a sphere that is hit."""
    return _sphere(lambda s, fmts: (s["hit"] == 1) & matches(s, fmts))


def _least(fmts: Formats) -> int:
    return int(T_MIN * fmts.point.one)


DISCRIMINANT = TANGENTS.point(
    "discriminant",
    "of a sphere: no hit where it is negative, a tangent where it is 0",
    {
        "just_negative": _sphere(
            lambda s, fmts: (s["discriminant"] < 0) & (s["discriminant"] > -8 * fmts.point.one)
        ),
        "zero": _sphere(lambda s, _fmts: s["discriminant"] == 0),
        "tangent_that_is_hit": _hit(lambda s, _fmts: s["discriminant"] == 0),
        "just_positive": _sphere(
            lambda s, fmts: (s["discriminant"] > 0) & (s["discriminant"] < 8 * fmts.point.one)
        ),
    },
)

SPHERES = RAYS.point(
    "sphere",
    "where a ray starts that passes a sphere, and how it meets it",
    {
        "beside": _sphere(lambda s, fmts: s["discriminant"] < -8 * fmts.point.one),
        "ahead": _hit(lambda s, fmts: s["near"] > _least(fmts)),
        "from_inside": _hit(lambda s, fmts: s["near"] < -_least(fmts)),
        "from_its_surface": _hit(lambda s, fmts: np.abs(s["near"]) < _least(fmts)),
        "behind": _sphere(lambda s, _fmts: (s["discriminant"] > 0) & (s["far"] < 0)),
        "through_the_center": _hit(lambda s, _fmts: all_lanes(s["clipped"] == 0)),
        "near_end_at_smallest": _hit(lambda s, fmts: s["near"] == _least(fmts)),
        "near_end_a_step_less": _sphere(lambda s, fmts: s["near"] == _least(fmts) - 1),
        "far_end_at_smallest": _hit(lambda s, fmts: s["far"] == _least(fmts)),
        "far_end_a_step_less": _sphere(lambda s, fmts: s["far"] == _least(fmts) - 1),
        "near_end_at_limit": _sphere(lambda s, fmts: (s["near"] == s["limit"]) & (s["near"] > _least(fmts))),
        "far_end_at_limit": _sphere(
            lambda s, fmts: (s["far"] == s["limit"]) & (s["near"] < _least(fmts)) & (s["far"] > _least(fmts))
        ),
        "a_step_before_limit": _hit(lambda s, _fmts: s["distance"] == s["limit"] - 1),
        "smallest_radius": _hit(lambda s, fmts: radius_sq(s, fmts) == 1),
        "largest_radius": _hit(lambda s, fmts: radius_sq(s, fmts) == fmts.radius.max**2),
    },
)


def _center_too_far(s: Samples, fmts: Formats) -> Found:
    center = corners(s)[0] << (fmts.point.frac_bits - fmts.coord.frac_bits)
    return any_lane(np.abs(center - s["origin"]) > fmts.point.max + 1)


HELD = SIEVE.point(
    "held",
    "stages of a sphere's test at their limits",
    {
        "center_too_far": _sphere(_center_too_far),
        "along_highest": _sphere(lambda s, fmts: s["along"] == fmts.point.max),
        "along_lowest": _sphere(lambda s, fmts: s["along"] == fmts.point.min),
        "offset_highest": _sphere(lambda s, fmts: any_lane(s["clipped"] == fmts.offset.max)),
        "offset_lowest": _sphere(lambda s, fmts: any_lane(s["clipped"] == fmts.offset.min)),
    },
)


def _triangle(matches: Callable[[Parameters, Samples], Found]) -> Holds:
    def holds(p: Parameters, s: Samples) -> Found:
        return np.asarray((s["triangle"] == 1) & matches(p, s))

    return holds


def _on(edge: int) -> Holds:
    return _triangle(lambda _p, s: (s["zeros"] == 1) & (s["areas"][edge] == 0) & (s["hit"] == 1))


def _at(corner: int) -> Holds:
    """The areas of both edges of a corner are zero."""
    return _triangle(lambda _p, s: (s["zeros"] == 2) & (s["areas"][(corner + 1) % 3] != 0) & (s["hit"] == 1))


def _around(sign: int) -> Holds:
    return _triangle(lambda _p, s: all_lanes(s["areas"] * sign > 0) & (s["hit"] == 1))


def _apart(s: Samples) -> Found:
    return any_lane(s["areas"] > 0) & any_lane(s["areas"] < 0)


PLACES = GRID.point(
    "place",
    "where a ray passes a triangle",
    {
        "within_one_way_round": _around(1),
        "within_the_other_way_round": _around(-1),
        "edge_ab": _on(0),
        "edge_bc": _on(1),
        "edge_ca": _on(2),
        "corner_a": _at(0),
        "corner_b": _at(1),
        "corner_c": _at(2),
        "on_the_line_of_an_edge": _triangle(lambda _p, s: _apart(s) & any_lane(s["areas"] == 0)),
        "outside": _triangle(lambda _p, s: _apart(s)),
        "seen_edge_on": _triangle(lambda _p, s: all_lanes(s["areas"] == 0) & any_lane(s["shape"] != 0)),
        "no_area": _triangle(lambda _p, s: all_lanes(s["shape"] == 0)),
    },
)


def _behind(p: Parameters, s: Samples) -> Found:
    """The plane lies behind the ray, whose line passes within the triangle."""
    fmts = selected(p)
    reach = (corners(s)[0] << (fmts.point.frac_bits - fmts.coord.frac_bits)) - s["origin"]
    against = np.sign(exact_dot(reach, s["shape"])) * np.sign(s["facing"]) < 0
    return np.asarray(against & (s["zeros"] == 0))


def _at_distance(offset: int, hit: int) -> Holds:
    """So many steps from the smallest distance."""

    def holds(p: Parameters, s: Samples) -> Found:
        return np.asarray(
            (s["distance"] == _least(selected(p)) + offset) & (s["hit"] == hit) & (s["zeros"] == 0)
        )

    return _triangle(holds)


def _before_limit(steps: int, hit: int) -> Holds:
    def holds(p: Parameters, s: Samples) -> Found:
        there = (s["distance"] == s["limit"] - steps) & (s["distance"] > _least(selected(p)))
        return np.asarray(there & (s["hit"] == hit) & (s["zeros"] == 0))

    return _triangle(holds)


TRIANGLES = RAYS.point(
    "triangle",
    "from where and how far away a ray meets a triangle's plane",
    {
        "front": _triangle(lambda _p, s: (s["hit"] == 1) & (s["leaving"] == 0)),
        "back": _triangle(lambda _p, s: (s["hit"] == 1) & (s["leaving"] == 1)),
        "behind": _triangle(_behind),
        "parallel": _triangle(lambda _p, s: (s["facing"] == 0) & any_lane(s["shape"] != 0)),
        "parallel_but_for_what_is_truncated": _triangle(lambda p, s: (s["facing"] != 0) & (s["across"] == 0)),
        "almost_parallel": _triangle(
            lambda p, s: (s["across"] > 0) & (s["across"] < selected(p).facing.one >> 8)
        ),
        "smallest_distance": _at_distance(0, 1),
        "a_step_less_than_smallest": _at_distance(-1, 0),
        "at_limit": _before_limit(0, 0),
        "a_step_before_limit": _before_limit(1, 1),
        "too_far": _triangle(
            lambda p, s: (s["distance"] == 0) & (s["zeros"] == 0) & (s["facing"] != 0) & ~_behind(p, s)
        ),
    },
)


def _longest(axis: int, sign: int) -> Holds:
    def holds(_p: Parameters, s: Samples) -> Found:
        along = dominant_axis(s["direction"]) == axis
        return np.asarray(along & (np.sign(s["direction"][axis]) == sign) & (s["hit"] == 1))

    return _triangle(holds)


def _equal(first: int, second: int) -> Holds:
    """Two components are the longest alike."""

    def holds(_p: Parameters, s: Samples) -> Found:
        size = np.abs(s["direction"])
        longest = size == size.max(axis=0)
        return np.asarray(longest[first] & longest[second] & (s["hit"] == 1))

    return _triangle(holds)


AXES = RAYS.point(
    "axis",
    "the longest component of a ray that hits a triangle, and components of equal length",
    {
        **{
            f"{name}_{'xyz'[axis]}": _longest(axis, sign)
            for axis in range(3)
            for name, sign in (("plus", 1), ("minus", -1))
        },
        "x_and_y": _equal(0, 1),
        "y_and_z": _equal(1, 2),
        "z_and_x": _equal(2, 0),
    },
)


def _turns(p: Parameters, generator: Generator, operands: Operands) -> Operands:
    """Spheres and triangles in turn, and then a run of each."""
    drawn = alternating(p, generator, 2 * count(operands))
    runs = [np.flatnonzero(drawn["triangle"] == kind)[:8] for kind in (1, 0)]
    return select(drawn, np.concatenate([np.arange(count(drawn)), *runs]))


def _after(kind: int, before_it: int) -> Holds:
    """In the very next clock."""

    def holds(_p: Parameters, s: Samples) -> Found:
        return np.asarray((s["triangle"] == kind) & (before(s["triangle"]) == before_it) & (s[IDLE] == 0))

    return holds


TURNS = Point(
    "turns",
    "kinds in clocks one after the other, which share multipliers",
    tuple(
        Bin(f"{names[1]}_after_{names[0]}", Recipe("kinds in turn", _turns), _after(kind, last))
        for (last, kind), names in {
            (0, 0): ("sphere", "sphere"),
            (0, 1): ("sphere", "triangle"),
            (1, 0): ("triangle", "sphere"),
            (1, 1): ("triangle", "triangle"),
        }.items()
    ),
)

COVERAGE = Coverage((DISCRIMINANT, SPHERES, HELD, PLACES, TRIANGLES, AXES, TURNS), stages=_stages)
