"""Phong's terms, shadows, mirrors and refraction have their textbook values."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from models.reference.intersect import shapes
from models.reference.refract import transmitted
from models.reference.shade import Hits, Materials, hits, local_colour
from models.reference.vectors import Floats, normalise
from models.scene.types import BLACK, Camera, Light, Material, Scene, Sphere, Triangle, Vec3

ONE = 1024
WHITE: Vec3 = (ONE, ONE, ONE)
CAMERA = Camera((0, 0, 8 * ONE), (0, ONE, 0), (0, 0, 0))
MATT = Material(ambient=BLACK, diffuse=(ONE, ONE // 2, 0), specular=BLACK)
FLOOR = ((-99 * ONE, 0, -99 * ONE), (0, 0, 99 * ONE), (99 * ONE, 0, -99 * ONE))


def floor(material: Material) -> Triangle:
    """A triangle in the plane y = 0 whose normal is +y."""
    return Triangle(material, FLOOR)


def scene_of(material: Material, *lights: Light, spheres: tuple[Sphere, ...] = ()) -> Scene:
    return Scene(CAMERA, lights, spheres, (floor(material),), BLACK, BLACK)


def colour_at_origin(scene: Scene, incoming: tuple[float, float, float] = (0, -1, 0)) -> list[float]:
    """Local colour where a ray comes down to the floor at the origin."""
    direction = normalise(np.array(incoming, dtype=np.float64)[:, None])
    number = np.array([len(scene.spheres)])
    at = hits(shapes(scene), -direction, direction, np.array([1.0]), number)
    return [float(c) for c in local_colour(scene, shapes(scene), Materials.of(scene), at)[:, 0]]


def hit(incoming: Floats, normal: Floats, leaving: bool = False) -> Hits:
    reflected = incoming - 2 * float((normal * incoming).sum()) * normal
    return Hits(normal * 0, normal, incoming, reflected, np.array([0]), np.array([leaving]))


def test_ambient_light_is_multiplied_by_the_ambient_coefficient() -> None:
    material = replace(MATT, ambient=(ONE, 512, 256))
    scene = replace(scene_of(material), ambient=(512, 512, 512))
    assert colour_at_origin(scene) == [0.5, 0.25, 0.125]


@pytest.mark.parametrize("degrees", [0, 30, 45, 60, 80])
def test_diffuse_light_falls_with_the_cosine(degrees: float) -> None:
    position = (
        round(100 * ONE * math.sin(math.radians(degrees))),
        round(100 * ONE * math.cos(math.radians(degrees))),
        0,
    )
    colour = colour_at_origin(scene_of(MATT, Light(position, WHITE)))
    cosine = math.cos(math.radians(degrees))
    assert colour == pytest.approx([cosine, cosine / 2, 0], abs=1e-4)


def test_a_light_behind_the_surface_or_on_it_adds_nothing() -> None:
    for position in ((0, -5 * ONE, 0), (5 * ONE, 0, 0), (0, 0, 0)):
        assert colour_at_origin(scene_of(MATT, Light(position, WHITE))) == [0, 0, 0]


def test_both_sides_of_a_triangle_are_lit_where_they_are_seen() -> None:
    scene = scene_of(MATT, Light((0, -5 * ONE, 0), WHITE))
    assert colour_at_origin(scene, (0, 1, 0)) == [1, 0.5, 0]


@pytest.mark.parametrize("degrees", [0, 5, 10, 20])
def test_the_highlight_is_the_sixteenth_power_of_the_cosine_to_the_mirrored_ray(degrees: float) -> None:
    shiny = Material(BLACK, BLACK, specular=(ONE, 0, 512))
    position = (
        round(100 * ONE * math.sin(math.radians(degrees))),
        round(100 * ONE * math.cos(math.radians(degrees))),
        0,
    )
    red, green, blue = colour_at_origin(scene_of(shiny, Light(position, (ONE, ONE, 2 * ONE))))
    expected = math.cos(math.radians(degrees)) ** 16
    assert (red, green, blue) == pytest.approx((expected, 0, expected), abs=1e-4)


def test_no_highlight_where_the_mirrored_ray_points_away_from_the_light() -> None:
    shiny = Material(BLACK, BLACK, specular=WHITE)
    light = Light((-100 * ONE, 10 * ONE, 0), WHITE)
    assert colour_at_origin(scene_of(shiny, light), (1, -0.1, 0)) == [0, 0, 0]


def test_lights_add_up() -> None:
    lights = (Light((0, 5 * ONE, 0), (ONE, 0, 0)), Light((0, 7 * ONE, 0), (ONE, ONE, 0)))
    assert colour_at_origin(scene_of(MATT, *lights)) == [2, 0.5, 0]


def filters(transparency: Vec3, y: int) -> Sphere:
    return Sphere(Material(BLACK, BLACK, BLACK, transparency=transparency), (0, y, 0), 8)


def test_an_opaque_object_between_point_and_light_shades_it() -> None:
    light = Light((0, 9 * ONE, 0), WHITE)
    assert colour_at_origin(scene_of(MATT, light, spheres=(filters(BLACK, 4 * ONE),))) == [0, 0, 0]


def test_an_object_behind_the_light_does_not_shade() -> None:
    light = Light((0, 2 * ONE, 0), WHITE)
    assert colour_at_origin(scene_of(MATT, light, spheres=(filters(BLACK, 4 * ONE),))) == [1, 0.5, 0]


def test_transparent_objects_filter_each_channel_once_per_object() -> None:
    light = Light((0, 9 * ONE, 0), WHITE)
    one = (filters((512, 256, 0), 4 * ONE),)
    assert colour_at_origin(scene_of(MATT, light, spheres=one)) == [0.5, 0.125, 0]
    two = (*one, filters((512, ONE, 0), 7 * ONE))
    assert colour_at_origin(scene_of(MATT, light, spheres=two)) == [0.25, 0.125, 0]


def test_a_light_inside_a_glass_sphere_is_filtered_by_it() -> None:
    light = Light((0, 4 * ONE, 0), WHITE)
    assert colour_at_origin(scene_of(MATT, light, spheres=(filters((512, 512, 0), 4 * ONE),))) == [
        0.5,
        0.25,
        0,
    ]


def test_a_mirror_turns_a_ray_at_45_degrees_by_90_degrees() -> None:
    scene = scene_of(MATT)
    incoming = normalise(np.array([[1.0], [-1.0], [0.0]]))
    at = hits(shapes(scene), -incoming, incoming, np.array([1.0]), np.array([0]))
    np.testing.assert_allclose(at.reflected, normalise(np.array([[1.0], [1.0], [0.0]])))
    np.testing.assert_array_equal(at.normal, [[0.0], [1.0], [0.0]])
    assert not at.leaving[0]


def test_normals_are_turned_toward_the_viewer_inside_a_sphere() -> None:
    scene = Scene(CAMERA, (), (filters(BLACK, 0),), (), BLACK, BLACK)
    at = hits(
        shapes(scene), np.zeros((3, 1)), np.array([[0.0], [0.0], [1.0]]), np.array([1.0]), np.array([0])
    )
    np.testing.assert_array_equal(at.normal, [[0.0], [0.0], [-1.0]])
    assert at.leaving[0]


def angle_to(direction: Floats, axis: tuple[float, float, float]) -> float:
    return math.degrees(math.acos(float(direction[:, 0] @ np.array(axis))))


UP = np.array([[0.0], [1.0], [0.0]])


def coming_down(degrees: float) -> Floats:
    angle = math.radians(degrees)
    return np.array([[math.sin(angle)], [-math.cos(angle)], [0.0]])


def test_45_degrees_into_glass_become_28_1_degrees() -> None:
    inside = transmitted(hit(coming_down(45), UP), np.array([1.5]))
    assert angle_to(inside, (0, -1, 0)) == pytest.approx(28.1255, abs=1e-4)
    assert inside[0, 0] > 0, "on the far side of the normal"


@given(st.floats(0, 89), st.sampled_from([1.0, 1.125, 1.5, 2.875]))
def test_refraction_in_follows_snells_law_and_back_out_restores_the_ray(degrees: float, n: float) -> None:
    incoming = coming_down(degrees)
    inside = transmitted(hit(incoming, UP), np.array([n]))
    assert math.sin(math.radians(degrees)) == pytest.approx(n * float(inside[0, 0]), abs=1e-9)
    outside = transmitted(hit(inside, UP, leaving=True), np.array([n]))
    np.testing.assert_allclose(outside, incoming, atol=1e-9)


def test_beyond_the_critical_angle_the_transmitted_ray_is_the_reflected_one() -> None:
    critical = math.degrees(math.asin(1 / 1.5))
    assert critical == pytest.approx(41.8103, abs=1e-4)
    for degrees in (critical + 0.01, 60, 89):
        at = hit(coming_down(degrees), UP, leaving=True)
        np.testing.assert_allclose(transmitted(at, np.array([1.5])), at.reflected)
    grazing = transmitted(hit(coming_down(critical - 0.01), UP, leaving=True), np.array([1.5]))
    assert 88 < angle_to(grazing, (0, -1, 0)) < 90
