"""Rays hit spheres and triangles where geometry says, and slip through no edge."""

import math
from itertools import permutations

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from numpy.typing import ArrayLike

from models.limits import INFINITY, T_MIN
from models.reference.intersect import Shape, SphereShape, TriangleShape, nearest
from models.reference.vectors import Floats, normalise
from models.scene.types import BLACK, Material, Sphere, Triangle, Vec3

ONE = 1024
ANY = Material(BLACK, BLACK, BLACK)
UNIT = SphereShape.of(Sphere(ANY, (0, 0, 0), 8))
FACE = TriangleShape.of(Triangle(ANY, ((0, 0, 0), (4 * ONE, 0, 0), (0, 4 * ONE, 0))))


def vector(*components: float) -> Floats:
    return np.array(components, dtype=np.float64)[:, None]


def distance(shape: Shape, origin: ArrayLike, direction: ArrayLike) -> float:
    rays = (np.array(values, dtype=np.float64)[:, None] for values in (origin, direction))
    at, way = rays
    return float(shape.distance(at, normalise(way))[0])


@pytest.mark.parametrize(
    ("origin", "direction", "expected"),
    [
        ((0, 0, 5), (0, 0, -1), 4.0),
        ((0, 0, 5), (0, 0, 1), math.inf),
        ((0, 0, 0), (1, 2, 3), 1.0),
        ((0, 0, 0.5), (0, 0, 1), 0.5),
        ((0, 0, 0.5), (0, 0, -1), 1.5),
        ((0, 1, 5), (0, 0, -1), 5.0),
        ((0, 1.0001, 5), (0, 0, -1), math.inf),
        ((0, 0.6, 5), (0, 0, -1), 4.2),
        ((3, 4, 0), (-3, -4, 0), 4.0),
    ],
)
def test_a_ray_hits_a_sphere_at_the_textbook_distance(
    origin: ArrayLike, direction: ArrayLike, expected: float
) -> None:
    assert distance(UNIT, origin, direction) == pytest.approx(expected)


def test_a_ray_that_starts_on_a_sphere_hits_its_far_side_or_nothing() -> None:
    assert distance(UNIT, (0, 0, 1), (0, 0, -1)) == 2.0
    assert distance(UNIT, (0, 0, 1), (0, 0, 1)) == math.inf


@pytest.mark.parametrize(
    ("before", "expected"), [(0.0, float(T_MIN)), (1 / 1024, 2 + float(T_MIN) - 1 / 1024)]
)
def test_hits_nearer_than_t_min_do_not_count(before: float, expected: float) -> None:
    origin = (0, 0, 1 + float(T_MIN) - before)
    assert distance(UNIT, origin, (0, 0, -1)) == expected


def test_hits_at_infinity_do_not_count() -> None:
    at_infinity = float(INFINITY)
    assert distance(FACE, (1, 1, at_infinity), (0, 0, -1)) == math.inf
    assert distance(FACE, (1, 1, at_infinity - 1 / 1024), (0, 0, -1)) == at_infinity - 1 / 1024


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
        (2.0001, 2, False),
        (-0.0001, 1, False),
        (1, -0.0001, False),
        (4.0001, 0, False),
    ],
)
def test_edges_and_corners_belong_to_a_triangle_and_both_sides_are_hit(x: float, y: float, hit: bool) -> None:
    for side in (1, -1):
        found = distance(FACE, (x, y, 3 * side), (0, 0, -side))
        assert found == (3.0 if hit else math.inf)


def test_a_slanted_ray_hits_a_triangle_at_the_textbook_distance() -> None:
    assert distance(FACE, (1, 1, 3), (1, -0.5, -3)) == pytest.approx(math.sqrt(10.25))


def test_rays_along_a_triangles_plane_miss() -> None:
    assert distance(FACE, (-1, 1, 0), (1, 0, 0)) == math.inf
    assert distance(FACE, (-1, 1, 1), (1, 0, 0)) == math.inf
    assert distance(FACE, (1, 1, -1), (0, 0, -1)) == math.inf


@pytest.mark.parametrize("end", [(0, 0, 0), (ONE, ONE, 0), (2 * ONE, 2 * ONE, 0)])
def test_a_triangle_without_area_is_never_hit(end: Vec3) -> None:
    shape = TriangleShape.of(Triangle(ANY, ((0, 0, 0), (ONE, ONE, 0), end)))
    assert shape.is_degenerate
    for x in (0.0, 0.5, 1.0):
        assert distance(shape, (x, x, 3), (0, 0, -1)) == math.inf


def test_normals_are_of_unit_length_and_point_outward() -> None:
    np.testing.assert_allclose(UNIT.normal(vector(0, 0.6, 0.8)), vector(0, 0.6, 0.8))
    np.testing.assert_array_equal(FACE.normal(vector(1, 1, 0)), vector(0, 0, 1))


def test_of_equal_distances_the_lowest_object_number_counts() -> None:
    origin, direction = vector(1, 1, 3), vector(0, 0, -1)
    t, number = nearest((UNIT, FACE, FACE), origin, direction)
    assert (t[0], number[0]) == (3.0, 1)
    t, number = nearest((FACE, UNIT), vector(9, 9, 9), direction)
    assert (t[0], number[0]) == (math.inf, -1)


raw_points = st.tuples(*[st.integers(-8 * ONE, 8 * ONE)] * 3)


@settings(deadline=None)
@given(raw_points, raw_points, st.floats(0, 1), raw_points, st.sampled_from(list(permutations(range(3)))))
def test_no_ray_passes_between_two_triangles_that_share_an_edge(
    start: Vec3, end: Vec3, share: float, eye: Vec3, order: tuple[int, int, int]
) -> None:
    """Rays at and around the shared edge, whatever the order of the corners, hit one of the two."""
    far: tuple[Vec3, Vec3] = ((99 * ONE, 1, 2), (-99 * ONE, -3, 5))
    first, second = (
        TriangleShape.of(Triangle(ANY, (corners[order[0]], corners[order[1]], corners[order[2]])))
        for corners in ((start, end, corner) for corner in far)
    )
    a, b = (np.array(point, dtype=np.float64) / ONE for point in (start, end))
    origin = np.array(eye, dtype=np.float64) / ONE + [0.0, 0.0, 64.0]
    target = a + (0.1 + 0.8 * share) * (b - a)
    sides = [np.dot(np.cross(b - a, np.array(corner) / ONE - a), target - origin) for corner in far]
    # The rays see the two side by side, neither of them edge-on nor folded over the other.
    assume(sides[0] * sides[1] < 0 and min(abs(side) for side in sides) > 1.0)
    ways = np.repeat((target - origin)[:, None], 17, axis=1)
    ways[0] += np.arange(-8, 9) * 2.0**-46
    rays, direction = np.broadcast_to(origin[:, None], ways.shape), normalise(ways)
    either = np.minimum(first.distance(rays, direction), second.distance(rays, direction))
    assert np.isfinite(either).all()


def test_a_closed_solid_has_no_gap_at_its_edges_and_corners() -> None:
    points: list[Vec3] = [(ONE, ONE, ONE), (ONE, -ONE, -ONE), (-ONE, ONE, -ONE), (-ONE, -ONE, ONE)]
    solid = tuple(
        TriangleShape.of(Triangle(ANY, tuple(p for q, p in enumerate(points) if q != left)))  # type: ignore[arg-type]
        for left in range(4)
    )
    corners = np.array(points, dtype=np.float64).T / ONE
    share = np.linspace(0, 1, 1001)
    targets = np.concatenate(
        [
            np.outer(corners[:, p], share) + np.outer(corners[:, q], 1 - share)
            for p in range(4)
            for q in range(p)
        ],
        axis=1,
    )
    # From the middle of the solid every ray must hit, those through edges and corners too.
    for origin in (vector(0, 0, 0), vector(0.1, -0.2, 0.05)):
        direction = normalise(targets - origin)
        t, _ = nearest(solid, np.broadcast_to(origin, direction.shape), direction)
        assert np.isfinite(t).all()
