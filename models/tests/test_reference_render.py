"""The vectorised renderer draws what a textbook recursion draws, pixel for pixel."""

import time
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from models.limits import MIN_WEIGHT
from models.reference.render import render, to_rgb888
from models.scene.frame import FrameError
from models.scene.load import load
from models.scene.strategies import is_drawable
from models.scene.types import BLACK, Camera, Light, Material, Scene, Sphere, Triangle, Vec3, View
from models.tests.scalar_renderer import ScalarRenderer

ONE = 1024
SCENES = Path(__file__).parent.parent / "scenes"
CAMERA = Camera((0, 0, 8 * ONE), (0, ONE, 0), (0, 0, 0))
ROUNDING = 1e-6


def points(reach: int) -> st.SearchStrategy[Vec3]:
    component = st.integers(-reach * ONE, reach * ONE)
    return st.tuples(component, component, component)


def colours(most: int) -> st.SearchStrategy[Vec3]:
    component = st.integers(0, most)
    return st.tuples(component, component, component)


materials = st.builds(
    Material, colours(ONE), colours(ONE), colours(ONE), colours(ONE), colours(ONE), st.integers(0, 15)
)
spheres = st.builds(Sphere, materials, points(3), st.integers(4, 24))
triangles = st.builds(Triangle, materials, st.tuples(points(4), points(4), points(4)))
drawn_scenes = st.builds(
    Scene,
    camera=st.builds(Camera, points(9), points(1), points(1)).map(
        lambda camera: camera if is_drawable(camera) else CAMERA
    ),
    lights=st.lists(st.builds(Light, points(9), colours(ONE)), max_size=2).map(tuple),
    spheres=st.lists(spheres, max_size=3).map(tuple),
    triangles=st.lists(triangles, max_size=3).map(tuple),
    ambient=colours(ONE),
    background=colours(ONE),
)


def compare_with_recursion(scene: Scene, view: View, depth: int, min_weight: float) -> int:
    """Compare all pixels whose decisions are not within rounding; how many were compared."""
    got = render(scene, view, max_depth=depth, min_weight=min_weight)
    compared = 0
    for y in range(view.height):
        for x in range(view.width):
            oracle = ScalarRenderer(scene, view, depth, min_weight)
            rgb, hit = oracle.pixel(x, y)
            if oracle.margin > ROUNDING:
                compared += 1
                assert got.hit[y, x] == hit
                np.testing.assert_allclose(got.rgb[y, x], rgb, atol=1)
    return compared


@settings(max_examples=50, deadline=None)
@given(drawn_scenes, st.integers(1, 4), st.sampled_from([float(MIN_WEIGHT), 0.3]))
def test_every_pixel_is_that_of_a_scalar_recursion(scene: Scene, depth: int, min_weight: float) -> None:
    compare_with_recursion(scene, View(5, 4, 0.6, 0.5), depth, min_weight)


def crowded_scene(rng: np.random.Generator) -> Scene:
    """Three spheres and four triangles around the middle, of random materials, and two lights."""

    def vector(low: float, high: float) -> Vec3:
        x, y, z = (int(raw) for raw in rng.integers(int(low * ONE), int(high * ONE), 3))
        return (x, y, z)

    def material() -> Material:
        a, d, s, r, t = (vector(0, 1) for _ in range(5))
        return Material(a, d, s, r, t, int(rng.integers(16)))

    return Scene(
        camera=Camera(vector(4, 7), vector(0.5, 1), vector(-1, 1)),
        lights=tuple(Light(vector(-8, 8), vector(0, 1)) for _ in range(2)),
        spheres=tuple(Sphere(material(), vector(-3, 3), int(rng.integers(4, 20))) for _ in range(3)),
        triangles=tuple(
            Triangle(material(), (vector(-4, 4), vector(-4, 4), vector(-4, 4))) for _ in range(4)
        ),
        ambient=vector(0, 1),
        background=vector(0, 1),
    )


@pytest.mark.parametrize("seed", range(12))
def test_every_pixel_of_a_crowded_scene_is_that_of_a_scalar_recursion(seed: int) -> None:
    scene = crowded_scene(np.random.default_rng(seed))
    assert compare_with_recursion(scene, View(8, 6, 0.6, 0.5), 4, float(MIN_WEIGHT)) > 40


@pytest.mark.parametrize("name", ["one_sphere", "three_spheres", "glass", "mirrors", "tetrahedron"])
def test_pixels_of_the_projects_scenes_are_those_of_a_scalar_recursion(name: str) -> None:
    scene = load(SCENES / f"{name}.toml").scene
    assert compare_with_recursion(scene, View.book(18, 12), 5, float(MIN_WEIGHT)) > 150


def ahead(material: Material, radius: int = 16, background: Vec3 = BLACK) -> Scene:
    return Scene(CAMERA, (), (Sphere(material, (0, 0, 0), radius),), (), (ONE, ONE, ONE), background)


def test_a_ray_that_hits_nothing_shows_the_background() -> None:
    scene = replace(ahead(Material(BLACK, BLACK, BLACK)), spheres=(), background=(512, 2048, 1024))
    got = render(scene, View.book(3, 2))
    assert got.rgb.tolist() == [[[127, 255, 255]] * 3] * 2
    assert (got.hit == -1).all()


def test_objects_are_numbered_spheres_first() -> None:
    grey = Material(BLACK, BLACK, BLACK)
    wall = Triangle(grey, ((-99 * ONE, -99 * ONE, -ONE), (99 * ONE, -99 * ONE, -ONE), (0, 99 * ONE, -ONE)))
    got = render(replace(ahead(grey), triangles=(wall,)), View.book(33, 33))
    assert got.hit.dtype == np.int32
    assert got.hit[16, 16] == 0
    assert got.hit[0, 0] == 1


def test_a_mirror_adds_what_it_sees_by_its_reflection() -> None:
    mirror = Material((256, 0, 0), BLACK, BLACK, reflection=(512, ONE, 256))
    scene = ahead(mirror, background=(ONE, 512, 0))
    got = render(scene, View.book(1, 1))
    assert got.rgb[0, 0].tolist() == [int(0.75 * 255), 127, 0]
    assert render(scene, View.book(1, 1), max_depth=1).rgb[0, 0].tolist() == [63, 0, 0]


def test_secondary_rays_stop_at_the_smallest_weight() -> None:
    mirror = Material(BLACK, BLACK, BLACK, reflection=(4, 3, 0))
    scene = ahead(mirror, background=(500 * ONE,) * 3)
    assert render(scene, View.book(1, 1)).rgb[0, 0].tolist() == [255, 255, 0], "one channel is enough"
    scene = ahead(replace(mirror, reflection=(3, 3, 3)), background=(500 * ONE,) * 3)
    assert render(scene, View.book(1, 1)).rgb[0, 0].tolist() == [0, 0, 0]


def test_a_glass_sphere_of_index_one_is_a_filter_crossed_twice() -> None:
    glass = Material(BLACK, BLACK, BLACK, transparency=(512, ONE, 256), index=0)
    got = render(ahead(glass, background=(ONE, ONE, ONE)), View.book(9, 9))
    assert got.rgb[4, 4].tolist() == [63, 255, 15]
    assert got.rgb[0, 0].tolist() == [255, 255, 255]


def test_a_glass_ball_turns_the_picture_behind_it_over() -> None:
    glass = Material(BLACK, BLACK, BLACK, transparency=(ONE, ONE, ONE), index=4)
    bright = Material((ONE, ONE, ONE), BLACK, BLACK)
    y = 5 * ONE
    sky = Triangle(bright, ((-200 * ONE, y, -40 * ONE), (200 * ONE, y, -40 * ONE), (0, 200 * ONE, -40 * ONE)))
    got = render(replace(ahead(glass), triangles=(sky,)), View.book(65, 65)).rgb[:, 32, 0]
    assert got[10] == 255, "beside the ball the sky is above, down to row 26"
    assert got[60] == 0
    assert got[24] == 0, "through the ball it is below"
    assert got[40] == 255


def test_colours_are_truncated_and_clamped() -> None:
    colour = np.array([[0.0, 0.999, 1.0], [1.5, 1e9, 1 / 255], [0.5, 254.999 / 255, 0.003]])
    assert to_rgb888(colour).tolist() == [[0, 254, 255], [255, 255, 1], [127, 254, 0]]


@pytest.mark.parametrize(
    "rows", [slice(0, 1), slice(5, 9), slice(10, None), slice(None, None, 3), slice(7, 7)]
)
def test_rows_are_the_rows_of_the_whole_picture(rows: slice) -> None:
    file = load(SCENES / "three_spheres.toml")
    whole = render(file.scene, file.view_for(20, 13))
    some = render(file.scene, file.view_for(20, 13), rows=rows)
    np.testing.assert_array_equal(some.rgb, whole.rgb[rows])
    np.testing.assert_array_equal(some.hit, whole.hit[rows])


def test_pictures_larger_than_one_batch_of_rays_are_seamless() -> None:
    file = load(SCENES / "one_sphere.toml")
    view = file.view_for(400, 300)
    whole = render(file.scene, view)
    rows = [render(file.scene, view, rows=slice(row, row + 1)).rgb for row in range(0, 300, 37)]
    np.testing.assert_array_equal(np.concatenate(rows), whole.rgb[::37])


def test_a_frame_that_the_core_refuses_is_not_rendered() -> None:
    scene = replace(ahead(Material(BLACK, BLACK, BLACK)), camera=replace(CAMERA, center=CAMERA.position))
    with pytest.raises(FrameError):
        render(scene, View.book(2, 2))
    with pytest.raises(ValueError, match="leaves no primary ray"):
        render(ahead(Material(BLACK, BLACK, BLACK)), View.book(2, 2), max_depth=0)


def test_an_empty_scene_is_all_background() -> None:
    scene = Scene(CAMERA, (Light((0, 0, 0), BLACK),), (), (), BLACK, (ONE, 0, 0))
    assert (render(scene, View.book(4, 4)).rgb == [255, 0, 0]).all()


@pytest.mark.parametrize(("name", "limit"), [("one_sphere", 2.0), ("three_spheres", 10.0)])
def test_the_books_timing_scenes_take_seconds_at_most(name: str, limit: float) -> None:
    file = load(SCENES / f"{name}.toml")
    start = time.process_time()
    render(file.scene, View.book(512, 512))
    assert time.process_time() - start < limit
