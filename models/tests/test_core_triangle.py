"""The bit-exact ray-triangle test: textbook cases, exact rationals, and no gap between triangles."""

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise, permutations, product

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from numpy.random import Generator
from numpy.typing import NDArray

from models.core import TriangleHit, triangle_intersect
from models.core.setup import triangle_normals
from models.fixed import Raw
from models.formats import BUILDS, Formats, formats
from models.limits import INFINITY, T_MIN
from models.scene.types import Vec3
from models.tests.arith_oracles import floored, raws, value, vectors

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
Corners = tuple[Raw, Raw, Raw]

DEFAULT = formats(BUILDS["default"])
EVERY_BUILD = [formats(knobs) for knobs in BUILDS.values()]
ONE = 1024
FACE: tuple[Vec3, Vec3, Vec3] = ((0, 0, 0), (4 * ONE, 0, 0), (0, 4 * ONE, 0))


def columns(*vectors: Sequence[float]) -> Raw:
    """Vectors as columns (3, n)."""
    return np.array(vectors, dtype=np.int64).T


def unit_raw(way: Floats, fmts: Formats) -> Raw:
    """Directions (3, n) of any length as raw unit vectors, truncated as the core's are."""
    steps = way / np.sqrt((way * way).sum(axis=0)) * fmts.unit.one
    return np.asarray(np.trunc(steps), dtype=np.int64)


def met(corners: Corners, origin: Floats, way: Floats, fmts: Formats, limit: Raw | int) -> TriangleHit:
    """Rays from places, in numbers, against triangles with their own normals."""
    start = np.rint(origin * fmts.point.one).astype(np.int64)
    normal = triangle_normals(*corners, fmts).normal
    return triangle_intersect(start, unit_raw(way, fmts), corners, normal, limit, fmts)


def shot(corners: Sequence[Vec3], origin: Sequence[float], way: Sequence[float]) -> float | None:
    """Distance at which one ray hits one triangle of the default build, None where it misses."""
    a, b, c = (columns(corner) for corner in corners)
    start, direction = (np.array([values], dtype=np.float64).T for values in (origin, way))
    found = met((a, b, c), start, direction, DEFAULT, int(INFINITY * DEFAULT.point.one))
    return float(DEFAULT.point.to_float(found.distance)[0]) if found.hit[0] else None


@pytest.mark.parametrize(
    ("x", "y", "hit"),
    [
        (1, 1, True),
        (0, 0, True),
        (4, 0, True),
        (0, 4, True),
        (2, 2, True),
        (2, 0, True),
        (0, 2, True),
        (2 + 1 / 1024, 2, False),
        (-1 / 1024, 1, False),
        (1, -1 / 1024, False),
        (4 + 1 / 1024, 0, False),
        (9, 9, False),
    ],
)
def test_edges_and_corners_belong_to_a_triangle_and_both_sides_are_hit(x: float, y: float, hit: bool) -> None:
    for corners, side in product(permutations(FACE), (1, -1)):
        assert shot(corners, (x, y, 3 * side), (0, 0, -side)) == (3.0 if hit else None)


def test_a_slanted_ray_hits_at_the_textbook_distance() -> None:
    assert shot(FACE, (1, 1, 3), (1, -0.5, -3)) == pytest.approx(10.25**0.5, abs=2**-13)


def test_rays_along_a_triangles_plane_and_triangles_behind_are_missed() -> None:
    assert shot(FACE, (-1, 1, 0), (1, 0, 0)) is None
    assert shot(FACE, (-1, 1, 1), (1, 0, 0)) is None
    assert shot(FACE, (1, 1, -1), (0, 0, -1)) is None


def test_a_hit_counts_from_the_smallest_distance_to_infinity() -> None:
    step = 2.0**-DEFAULT.point.frac_bits
    assert shot(FACE, (1, 1, float(T_MIN)), (0, 0, -1)) == float(T_MIN)
    assert shot(FACE, (1, 1, float(T_MIN) - step), (0, 0, -1)) is None
    assert shot(FACE, (1, 1, float(INFINITY)), (0, 0, -1)) is None
    assert shot(FACE, (1, 1, float(INFINITY) - 2**-8), (0, 0, -1)) == pytest.approx(
        float(INFINITY), abs=2**-7
    )


def test_the_back_of_a_triangle_is_where_the_ray_goes_the_way_of_its_normal() -> None:
    corners = columns(FACE[0]), columns(FACE[1]), columns(FACE[2])
    origin, way = np.array([[1.0], [1.0], [3.0]]), np.array([[0.0], [0.0], [-1.0]])
    assert not met(corners, origin, way, DEFAULT, DEFAULT.point.max).leaving[0]
    assert met(corners, -origin + [[2], [2], [0]], -way, DEFAULT, DEFAULT.point.max).leaving[0]


@pytest.mark.parametrize("end", [(0, 0, 0), (ONE, ONE, 0), (2 * ONE, 2 * ONE, 0)])
def test_a_triangle_without_area_is_never_hit(end: Vec3) -> None:
    for x in (0.0, 0.5, 1.0):
        assert shot(((0, 0, 0), (ONE, ONE, 0), end), (x, x, 3), (0, 0, -1)) is None


@dataclass(frozen=True)
class Answer:
    """What exact rationals say; the distance where the plane is met before `DISTANCE_INT` runs out."""

    inside: bool
    hit: bool
    leaving: bool
    distance: int


def mantissa(reach: list[Fraction], fmts: Formats) -> tuple[list[Fraction], Fraction]:
    """A vector over the smallest power of two that makes it a mantissa, floored, and that power."""
    scale = Fraction(1, fmts.reach.one)
    while not all(-scale <= part < scale for part in reach):
        scale *= 2
    return [Fraction(floored(part / scale, fmts.mantissa), fmts.mantissa.one) for part in reach], scale


def in_rationals(
    origin: Vec3, direction: Vec3, corners: Sequence[Vec3], normal: Vec3, limit: int, fmts: Formats
) -> Answer:
    """The rule of the unit's header, one ray at a time."""
    start = [value(part, fmts.point) for part in origin]
    way = [value(part, fmts.unit) for part in direction]
    square = [value(part, fmts.unit) for part in normal]
    seen = [
        mantissa([value(part, fmts.coord) - o for part, o in zip(corner, start, strict=True)], fmts)
        for corner in corners
    ]
    last = max(range(3), key=lambda axis: (abs(way[axis]), -axis))
    moved = [
        [
            floored(way[last] * place[(last + k) % 3] - way[(last + k) % 3] * place[last], fmts.unit)
            for k in (1, 2)
        ]
        for place, _ in seen
    ]
    areas = [a[0] * b[1] - a[1] * b[0] for a, b in pairwise([*moved, moved[0]])]
    inside = any(areas) and not (min(areas) < 0 < max(areas))
    place, scale = seen[0]
    behind = dot(place, square) * scale
    facing = dot(way, square)
    plane = value(floored(abs(behind), fmts.plane), fmts.plane)
    across = value(floored(abs(facing), fmts.facing), fmts.facing)
    if not across or plane / across >= 256:
        return Answer(inside, False, facing > 0, 0)
    distance = int(plane / across * fmts.point.one)
    counts = int(T_MIN * fmts.point.one) <= distance < limit
    return Answer(inside, inside and counts and behind * facing > 0, facing > 0, distance)


@settings(max_examples=400)
@given(st.sampled_from(EVERY_BUILD), st.data())
def test_any_operands_give_what_exact_rationals_give(fmts: Formats, data: st.DataObject) -> None:
    point, unit, coord = vectors(fmts.point), vectors(fmts.unit), vectors(fmts.coord)
    origin, direction, normal = data.draw(point), data.draw(unit), data.draw(unit)
    corners = [data.draw(coord) for _ in range(3)]
    limit = data.draw(raws(fmts.point))
    a, b, c = (columns(corner) for corner in corners)
    found = triangle_intersect(columns(origin), columns(direction), (a, b, c), columns(normal), limit, fmts)
    expected = in_rationals(origin, direction, corners, normal, limit, fmts)
    parts = [bool(found.inside[0]), bool(found.hit[0]), bool(found.leaving[0]), int(found.distance[0])]
    assert Answer(*parts) == expected  # type: ignore[arg-type]


near_zero = st.tuples(*[st.integers(-8 * ONE, 8 * ONE)] * 3)


@settings(max_examples=300)
@given(st.sampled_from(EVERY_BUILD), st.tuples(near_zero, near_zero, near_zero), near_zero, st.data())
def test_a_ray_through_the_inside_hits_at_the_exact_distance(
    fmts: Formats, corners: tuple[Vec3, Vec3, Vec3], eye: Vec3, data: st.DataObject
) -> None:
    """Cramer's rule in rationals; triangles neither small nor thin, seen from well off their planes."""
    weights = data.draw(st.tuples(*[st.integers(1, 4)] * 3))
    a, b, c = ([value(part, fmts.coord) for part in corner] for corner in corners)
    plane = cross(minus(b, a), minus(c, a))
    size = float(dot(plane, plane)) ** 0.5
    longest = max(float(dot(side, side)) ** 0.5 for side in (minus(b, a), minus(c, b), minus(a, c)))
    assume(size > 0.2 * longest**2 and longest > 4)
    total = sum(weights)
    target = [
        sum(w * p for w, p in zip(weights, parts, strict=True)) / total for parts in zip(a, b, c, strict=True)
    ]
    origin = columns([part << (fmts.point.frac_bits - fmts.coord.frac_bits) for part in eye])
    start = [value(part, fmts.coord) for part in eye]
    length = float(dot(minus(target, start), minus(target, start))) ** 0.5
    slope = abs(float(dot(plane, minus(target, start)))) / size / max(length, 1.0)
    assume(length > 1 and slope > 0.3)
    way = unit_raw(np.array([[float(part)] for part in minus(target, start)]), fmts)
    exact = [value(int(part), fmts.unit) for part in way[:, 0]]
    expected = dot(plane, minus(a, start)) / dot(plane, exact)
    p, q, r = (columns(corner) for corner in corners)
    normal = triangle_normals(p, q, r, fmts).normal
    found = triangle_intersect(origin, way, (p, q, r), normal, fmts.point.max, fmts)
    assert found.hit[0]
    # Mantissas and normals are off by a few steps of a unit, over up to 32 units of length.
    steps = 32 * 8 / 0.3 * fmts.point.one / fmts.unit.one
    assert abs(int(found.distance[0]) - expected * fmts.point.one) <= steps


def minus(a: Sequence[Fraction], b: Sequence[Fraction]) -> list[Fraction]:
    return [p - q for p, q in zip(a, b, strict=True)]


def dot(a: Sequence[Fraction], b: Sequence[Fraction]) -> Fraction:
    return sum((p * q for p, q in zip(a, b, strict=True)), Fraction(0))


def cross(a: Sequence[Fraction], b: Sequence[Fraction]) -> list[Fraction]:
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


@dataclass(frozen=True)
class Mesh:
    """Corners (points, 3) in `coord`, triangles by the numbers of their corners, the way around them all."""

    corners: Raw
    triangles: tuple[tuple[int, int, int], ...]
    rim: tuple[int, ...]


def fan(corners: Raw) -> Mesh:
    """Around corner 0; every other triangle the other way round, each begun at another corner."""
    ring = range(1, len(corners))
    spokes = list(pairwise([*ring, 1]))
    turned = [
        (0, a, b) if k % 3 == 0 else (b, a, 0) if k % 3 == 1 else (a, 0, b) for k, (a, b) in enumerate(spokes)
    ]
    return Mesh(corners, tuple(turned), tuple(ring))


def pair(corners: Raw) -> Mesh:
    """To both sides of the edge from corner 0 to corner 1."""
    return Mesh(corners, ((0, 1, 2), (3, 1, 0)), (0, 2, 1, 3))


@st.composite
def meshes(draw: st.DrawFn) -> Mesh:
    """Fans and pairs of many sizes in any place, flat or bent, in the plane of any two axes."""
    size = 1 << draw(st.integers(3, 17))
    spokes = draw(st.integers(3, 8))
    part = st.integers(size // 8, size)
    bend = st.integers(-size // 4, size // 4) | st.just(0)
    flat: list[tuple[float, float]]
    if draw(st.booleans()):
        angles = [2 * np.pi * (k + draw(st.floats(-0.2, 0.2))) / spokes for k in range(spokes)]
        reach = [draw(part) for _ in angles]
        flat = [(0, 0), *((r * np.cos(w), r * np.sin(w)) for r, w in zip(reach, angles, strict=True))]
        make = fan
    else:
        flat = [(-draw(part), 0), (draw(part), 0), (draw(bend), draw(part)), (draw(bend), -draw(part))]
        make = pair
    place = np.rint([(x, y, draw(bend)) for x, y in flat]).astype(np.int64)
    where = [draw(st.integers(-100 * ONE, 100 * ONE) | st.just(0)) for _ in range(3)]
    turned = place[:, draw(st.permutations(range(3)))] + where
    return make(DEFAULT.coord.saturate(turned))


def rays_at(mesh: Mesh, generator: Generator, fmts: Formats, count: int) -> tuple[Raw, Raw]:
    """Origins in `point` and directions in `unit` of rays at what the triangles share, and just beside it."""
    corner = mesh.corners.T / DEFAULT.coord.one
    ends = generator.choice([1, 2, len(mesh.corners) - 1] if len(mesh.triangles) > 2 else [1], count)
    share = generator.random(count) * generator.choice([0.0, 1.0, 1.0], count)
    target = corner[:, [0]] + share * (corner[:, ends] - corner[:, [0]])
    direction = unit_raw(generator.standard_normal((3, count)), fmts)
    ahead = 2.0 ** generator.uniform(-3, 7.5, count)
    start = np.rint((target - direction / fmts.unit.one * ahead) * fmts.point.one).astype(np.int64)
    start += generator.integers(-2, 2, (3, count), endpoint=True) * generator.choice([0, 1], count)
    return fmts.point.saturate(start), direction


def around(mesh: Mesh, origin: Raw, direction: Raw, fmts: Formats) -> Bools:
    """Rays that pass within the rim, further from it than its corners may be off.

    A corner is off by half a dozen steps of its mantissa, which has a width of w bits: by no more than
    16 * 2**(2 - w) of its distance.
    """
    way = direction / np.sqrt((direction.astype(np.float64) ** 2).sum(axis=0))
    places, errors = [], []
    for number in mesh.rim:
        reach = mesh.corners[number][:, None] / fmts.coord.one - origin / fmts.point.one
        places.append(reach - (reach * way).sum(axis=0) * way)
        errors.append(np.abs(reach).max(axis=0) * 2.0 ** (6 - fmts.mantissa.width))
    angle = np.zeros(way.shape[1])
    clear = np.ones(way.shape[1], dtype=np.bool_)
    for (a, a_off), (b, b_off) in pairwise([*zip(places, errors, strict=True), (places[0], errors[0])]):
        angle += np.arctan2((np.cross(a, b, axis=0) * way).sum(axis=0), (a * b).sum(axis=0))
        side = b - a
        share = np.clip(-(a * side).sum(axis=0) / np.maximum((side * side).sum(axis=0), 1e-30), 0, 1)
        nearest = a + share * side
        clear &= np.sqrt((nearest * nearest).sum(axis=0)) > np.maximum(a_off, b_off)
    return np.asarray(clear & (np.abs(angle) > np.pi))


@pytest.mark.parametrize("fmts", EVERY_BUILD, ids=list(BUILDS))
@settings(max_examples=100)
@given(meshes(), st.integers(0, 2**32))
def test_no_ray_passes_between_triangles_that_share_edges_or_a_corner(
    fmts: Formats, mesh: Mesh, seed: int
) -> None:
    origin, direction = rays_at(mesh, np.random.default_rng(seed), fmts, 2000)
    within = around(mesh, origin, direction, fmts)
    inside = np.zeros_like(within)
    for triangle in mesh.triangles:
        a, b, c = (mesh.corners[number][:, None] for number in triangle)
        normal = triangle_normals(a, b, c, fmts).normal
        inside |= triangle_intersect(origin, direction, (a, b, c), normal, fmts.point.max, fmts).inside
    missed = np.flatnonzero(within & ~inside)
    assert not missed.size, f"from {origin[:, missed[0]]} along {direction[:, missed[0]]}"


def test_most_rays_of_the_property_above_are_within() -> None:
    ring = [(round(5 * ONE * np.cos(w)), round(5 * ONE * np.sin(w)), 0) for w in np.arange(0, 6.28, 1.25)]
    square = [(-5 * ONE, 0, 0), (5 * ONE, 0, 0), (0, 5 * ONE, 0), (0, -5 * ONE, 0)]
    for mesh in (fan(np.array([(0, 0, 0), *ring])), pair(np.array(square))):
        for fmts in EVERY_BUILD:
            rays = rays_at(mesh, np.random.default_rng(1), fmts, 2000)
            assert around(mesh, *rays, fmts).mean() > 0.3


CUBE = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
SIDES = (
    (0, 1, 3),
    (0, 3, 2),
    (4, 6, 7),
    (4, 7, 5),
    (0, 4, 5),
    (0, 5, 1),
    (2, 3, 7),
    (2, 7, 6),
    (0, 2, 6),
    (0, 6, 4),
    (1, 5, 7),
    (1, 7, 3),
)


@pytest.mark.parametrize("fmts", EVERY_BUILD, ids=list(BUILDS))
@settings(max_examples=40)
@given(st.integers(2 * ONE, 60 * ONE), near_zero, st.integers(0, 2**32))
def test_no_ray_leaves_a_closed_box(fmts: Formats, size: int, place: Vec3, seed: int) -> None:
    """From inside, at its corners, at points of its edges, the diagonals of its sides and anywhere."""
    corner = CUBE * size + np.array(place)
    generator = np.random.default_rng(seed)
    count = 1000
    origin = np.array(place)[:, None] + generator.integers(-size // 2, size // 2, (3, count))
    a, b = (corner[generator.integers(0, 8, count)].T for _ in range(2))
    target = a + (b - a) * generator.random(count) * generator.choice([0, 1, 1], count)
    anywhere = generator.standard_normal((3, count))
    way = np.where(generator.random(count) < 0.2, anywhere, target - origin)
    start = origin << (fmts.point.frac_bits - fmts.coord.frac_bits)
    direction = unit_raw(way, fmts)
    hit = np.zeros(count, dtype=np.bool_)
    for side in SIDES:
        p, q, r = (corner[number][:, None] for number in side)
        normal = triangle_normals(p, q, r, fmts).normal
        hit |= triangle_intersect(start, direction, (p, q, r), normal, fmts.point.max, fmts).hit
    assert hit.all()


@pytest.mark.parametrize("fmts", EVERY_BUILD, ids=list(BUILDS))
@settings(max_examples=100)
@given(
    st.integers(0, 2**32),
    st.integers(1, 64),
    st.sampled_from((1, 5, 20, 60, 130, 250)),
    st.permutations(range(3)),
)
def test_a_triangle_too_small_to_be_seen_is_not_hit_from_elsewhere(
    fmts: Formats, seed: int, size: int, away: int, axes: list[int]
) -> None:
    """Its corners may be one to the core: a point, which must not be met by each ray of its plane."""
    generator, count = np.random.default_rng(seed), 500
    middle = np.concatenate(
        [generator.integers(-20 * ONE, 20 * ONE, (2, count)), np.full((1, count), away * ONE)]
    )
    corner = [
        fmts.coord.saturate(middle + generator.integers(-size, size, (3, count), endpoint=True))[axes]
        for _ in range(3)
    ]
    way = np.concatenate([generator.uniform(-0.5, 0.5, (2, count)), np.ones((1, count))])[axes]
    direction = unit_raw(way, fmts)
    found = met((corner[0], corner[1], corner[2]), np.zeros((3, count)), way, fmts, fmts.point.max)
    unit = direction / np.sqrt((direction.astype(np.float64) ** 2).sum(axis=0))
    reach = corner[0] / fmts.coord.one
    lateral = reach - (reach * unit).sum(axis=0) * unit
    distance = np.sqrt((lateral * lateral).sum(axis=0))
    within = 4 * size / fmts.coord.one + np.abs(reach).max(axis=0) * 2.0 ** (6 - fmts.mantissa.width)
    assert not (found.inside & (distance > within)).any()
