"""The nearest hit and the light that is left, against one ray and one object at a time."""

from dataclasses import replace
from fractions import Fraction
from math import floor

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from models.core import Objects
from models.core.objects import Flat, column
from models.core.trace import MISS, Nearest, attenuate, nearest
from models.fixed import Raw
from models.formats import BUILDS, formats
from models.limits import INFINITY
from models.reference.intersect import nearest as ideal_nearest
from models.reference.intersect import shapes
from models.scene.types import BLACK, Camera, Material, Scene, Sphere, Triangle, Vec3

ONE = 1024
FMTS = formats(BUILDS["default"])
SHIFT = FMTS.point.frac_bits - FMTS.coord.frac_bits
FARTHEST = int(INFINITY * FMTS.point.one)
CAMERA = Camera((0, 0, 8 * ONE), (0, ONE, 0), (0, 0, 0))
MATT = Material((ONE, 512, 256), (ONE, ONE, ONE), BLACK)
DOWN = (0, 0, -FMTS.unit.one)


def glass(transparency: Vec3) -> Material:
    return replace(MATT, transparency=transparency)


def ball(place: Vec3, radius: int = 8, transparency: Vec3 = BLACK) -> Sphere:
    return Sphere(glass(transparency), place, radius)


def face(height: int, transparency: Vec3 = BLACK) -> Triangle:
    """A large triangle across the z axis whose normal is +z."""
    corners = ((-9 * ONE, -9 * ONE, height), (9 * ONE, -9 * ONE, height), (0, 9 * ONE, height))
    return Triangle(glass(transparency), corners)


NOWHERE = Triangle(MATT, ((-ONE, 0, 0), (0, 0, 0), (ONE, 0, 0)))
"""Without area, on the ray's way."""


def scene_of(*things: Sphere | Triangle, ambient: Vec3 = (ONE, ONE, ONE)) -> Scene:
    spheres = tuple(thing for thing in things if isinstance(thing, Sphere))
    triangles = tuple(thing for thing in things if isinstance(thing, Triangle))
    return Scene(CAMERA, (), spheres, triangles, ambient, BLACK)


def objects_of(*things: Sphere | Triangle, ambient: Vec3 = (ONE, ONE, ONE)) -> Objects:
    return Objects.of(scene_of(*things, ambient=ambient), FMTS)


def down(objects: Objects, height: int = 5 * ONE, own: int = MISS) -> tuple[Nearest, int]:
    """One ray down the z axis."""
    origin = column((0, 0, height << SHIFT))
    return nearest(objects, origin, column(DOWN), np.array([own]), FMTS)


def distance(found: Nearest) -> float:
    return float(FMTS.point.to_float(found.distance)[0])


def test_spheres_come_first_in_the_order_of_the_numbers() -> None:
    objects = objects_of(face(0), ball((0, 0, 0)), face(ONE), ball((ONE, 0, 0)))
    assert objects.triangle.tolist() == [False, False, True, True]
    assert objects.center.T.tolist() == [[0, 0, 0], [ONE, 0, 0], [0, 0, 0], [0, 0, 0]]
    assert objects.normal.T.tolist() == [[0, 0, 0], [0, 0, 0], *(2 * [[0, 0, FMTS.unit.one]])]


def test_the_ambient_term_is_the_product_of_light_and_coefficient() -> None:
    objects = objects_of(ball((0, 0, 0)), face(0), ambient=(512, ONE, 2 * ONE))
    shade = FMTS.shade.one
    assert objects.ambient.T.tolist() == 2 * [[shade // 2, shade // 2, shade // 2]]


def test_the_nearest_of_several_objects_is_hit() -> None:
    found, tests = down(objects_of(ball((0, 0, 0)), ball((0, 0, 3 * ONE)), face(-ONE)))
    assert (found.number[0], distance(found), tests) == (1, 1.0, 3)
    found, _ = down(objects_of(ball((0, 0, 0)), face(4 * ONE)))
    assert (found.number[0], distance(found)) == (1, 1.0)


def test_of_equal_distances_the_lowest_number_counts() -> None:
    found, _ = down(objects_of(face(ONE), face(ONE), ball((0, 0, 0)), ball((0, 0, 0))))
    assert (found.number[0], distance(found)) == (0, 4.0)
    found, _ = down(objects_of(ball((9 * ONE, 0, 0)), face(0), face(0)))
    assert found.number[0] == 1


def test_a_ray_that_hits_nothing_says_so() -> None:
    found, tests = down(objects_of(ball((9 * ONE, 0, 0)), face(6 * ONE)))
    assert (found.number[0], tests) == (MISS, 2)
    found, tests = down(objects_of())
    assert (found.number[0], tests) == (MISS, 0)


def test_a_triangle_without_area_is_counted_and_never_tested() -> None:
    objects = objects_of(NOWHERE, face(-ONE), NOWHERE)
    found, tests = down(objects)
    assert (objects.degenerate, found.number[0], tests) == (2, 1, 1)


def test_a_ray_does_not_meet_the_triangle_that_it_starts_on_but_its_sphere_it_does() -> None:
    objects = objects_of(ball((0, 0, 4 * ONE)), face(3 * ONE), face(0))
    found, tests = down(objects, own=1)
    assert (found.number[0], distance(found), found.leaving[0], tests) == (0, 2.0, 1, 2)
    found, tests = down(objects_of(face(3 * ONE), face(0)), own=0)
    assert (found.number[0], tests) == (1, 1)


def test_what_a_sphere_says_of_its_chord_comes_along_and_a_triangle_says_nothing() -> None:
    found, _ = down(objects_of(ball((512, 0, 0))))
    assert found.offset[:, 0].tolist() == [512 << SHIFT, 0, 0]
    assert FMTS.half_chord.to_float(found.half_chord)[0] == pytest.approx(0.75**0.5, abs=2**-14)
    found, _ = down(objects_of(ball((9 * ONE, 0, 0)), face(0)))
    assert (found.offset == 0).all()
    assert found.half_chord[0] == 0


def shadow(objects: Objects, colour: Vec3, length: float, own: int = MISS) -> tuple[list[int], int]:
    """What is left of a light's colour over some way down the z axis from 5."""
    limit = np.array([int(length * FMTS.point.one)])
    origin = column((0, 0, 5 * ONE << SHIFT))
    left, _, tests = attenuate(objects, origin, column(DOWN), limit, np.array([own]), column(colour), FMTS)
    return left[:, 0].tolist(), tests


def test_the_objects_on_the_way_to_a_light_are_counted() -> None:
    objects = objects_of(ball((0, 0, 0)), face(3 * ONE))
    ways = np.array([1, 4, 9]) * FMTS.point.one
    origin, down = (np.repeat(column(vector), 3, axis=1) for vector in ((0, 0, 5 * ONE << SHIFT), DOWN))
    _, met, _ = attenuate(objects, origin, down, ways, np.full(3, MISS), np.full((3, 3), 4096), FMTS)
    assert met.tolist() == [0, 1, 2]


def test_an_opaque_object_on_the_way_leaves_nothing_and_one_behind_the_light_everything() -> None:
    objects = objects_of(ball((0, 0, 0)))
    assert shadow(objects, (4096, 2048, 100), 9.0) == ([0, 0, 0], 1)
    assert shadow(objects, (4096, 2048, 100), 4.0) == ([4096, 2048, 100], 1)


def test_each_object_filters_the_colour_once_floored_every_time() -> None:
    objects = objects_of(ball((0, 0, 0), 8, (512, ONE, 2 * ONE)), face(3 * ONE, (512, 341, 256)))
    filters = [
        (Fraction(1, 2), Fraction(1, 2)),
        (Fraction(1), Fraction(341, 1024)),
        (Fraction(2), Fraction(1, 4)),
    ]
    expected = [floor(floor(c * a) * b) for c, (a, b) in zip((4095, 1001, 4095), filters, strict=True)]
    assert shadow(objects, (4095, 1001, 4095), 9.0) == (expected, 2)


def test_a_filter_saturates() -> None:
    objects = objects_of(ball((0, 0, 0), 8, (2 * ONE, 2 * ONE, ONE)))
    most = FMTS.shade.max
    assert shadow(objects, (most, most // 2, most), 9.0)[0] == [most, most - 1, most]


def test_the_triangle_that_is_lit_does_not_shade_itself() -> None:
    objects = objects_of(face(3 * ONE), face(ONE, (512, 512, 512)))
    assert shadow(objects, (4096, 4096, 4096), 9.0, own=0) == ([2048, 2048, 2048], 1)
    assert shadow(objects, (4096, 4096, 4096), 9.0) == ([0, 0, 0], 2)


def crowd(generator: np.random.Generator) -> Scene:
    """Spheres and triangles around the origin, some without area, some twice."""

    def place() -> Vec3:
        x, y, z = (int(part) for part in generator.integers(-5 * ONE, 5 * ONE, 3))
        return (x, y, z)

    def colour() -> Vec3:
        r, g, b = (int(part) for part in generator.integers(0, ONE, 3))
        return (r, g, b)

    spheres = [ball(place(), int(generator.integers(1, 32)), colour()) for _ in range(4)]
    triangles = [Triangle(glass(colour()), (place(), place(), place())) for _ in range(6)]
    return scene_of(*spheres, spheres[0], *triangles, NOWHERE, triangles[0])


def rays_into(generator: np.random.Generator, count: int) -> tuple[Raw, Raw]:
    origin = generator.integers(-9 * ONE, 9 * ONE, (3, count)) << SHIFT
    target = generator.integers(-4 * ONE, 4 * ONE, (3, count)) << SHIFT
    way = (target - origin).astype(np.float64)
    direction = way / np.maximum(np.sqrt((way * way).sum(axis=0)), 1) * FMTS.unit.one
    return origin, np.asarray(direction, dtype=np.int64)


@settings(max_examples=20)
@given(st.integers(0, 2**32))
def test_many_rays_find_what_each_finds_alone(seed: int) -> None:
    """`nearest` and `attenuate` are a plain loop over objects, for every ray."""
    generator = np.random.default_rng(seed)
    objects, count = Objects.of(crowd(generator), FMTS), 25
    origin, direction = rays_into(generator, count)
    own = generator.integers(0, len(objects.shapes), count)
    own = np.where(objects.triangle[own], own, MISS)
    limit = generator.integers(0, 12 * FMTS.point.one, count)
    colour = generator.integers(0, FMTS.shade.one, (3, count))
    best, tests = nearest(objects, origin, direction, own, FMTS)
    left, _, shadow_tests = attenuate(objects, origin, direction, limit, own, colour, FMTS)
    done = 0
    for ray in range(count):
        at, way = origin[:, [ray]], direction[:, [ray]]
        answers, rest = [], [int(channel) for channel in colour[:, ray]]
        for number, shape in enumerate(objects.shapes):
            if number == own[ray] or (isinstance(shape, Flat) and shape.dead):
                continue
            done += 1
            found = shape.test(at, way, FARTHEST, FMTS)
            if found.hit[0]:
                answers.append((int(found.distance[0]), number, int(found.leaving[0])))
            if shape.test(at, way, int(limit[ray]), FMTS).hit[0]:
                share = objects.transparency[:, number]
                rest = [channel * int(part) // ONE for channel, part in zip(rest, share, strict=True)]
        assert left[:, ray].tolist() == rest
        assert best.number[ray] == (min(answers)[1] if answers else MISS)
        if answers:
            assert (best.distance[ray], best.number[ray], best.leaving[ray]) == min(answers)
    assert tests == shadow_tests == done


@pytest.mark.parametrize("seed", range(4))
def test_all_but_a_few_rays_hit_what_they_hit_in_float64(seed: int) -> None:
    """The few pass an edge, or two objects at about the same distance."""
    generator = np.random.default_rng(seed)
    scene = crowd(generator)
    origin, direction = rays_into(generator, 5000)
    found, _ = nearest(Objects.of(scene, FMTS), origin, direction, np.full(5000, MISS), FMTS)
    way = FMTS.unit.to_float(direction)
    ideal, number = ideal_nearest(
        shapes(scene), FMTS.point.to_float(origin), way / np.sqrt((way * way).sum(axis=0))
    )
    same = found.number == number
    assert same.mean() >= 0.998
    hit = same & (number != MISS)
    assert hit.mean() > 0.3
    off = np.abs(FMTS.point.to_float(found.distance[hit]) - ideal[hit])
    assert np.quantile(off, 0.99) <= 2**-8
