"""Scene types hold what the packed frame can hold, and name the field that cannot."""

import math
from dataclasses import replace
from pathlib import Path

import pytest

from models.scene.types import BLACK, Camera, Light, Material, Scene, SceneFile, Sphere, Triangle, View

MATERIAL = Material((0, 0, 0), (1024, 0, 0), (524287, 0, 0), index=15)
CAMERA = Camera((0, 0, 0), (0, 1, 0), (0, 0, 1))
SCENE = Scene(CAMERA, (), (), (), BLACK, BLACK)


@pytest.mark.parametrize(
    ("build", "field"),
    [
        (lambda: replace(MATERIAL, diffuse=(0, -1, 0)), "material.diffuse.y"),
        (lambda: replace(MATERIAL, transparency=(0, 0, 524288)), "material.transparency.z"),
        (lambda: replace(MATERIAL, index=16), "material.index"),
        (lambda: replace(MATERIAL, ambient=(0, 0)), "material.ambient"),  # type: ignore[arg-type]
        (lambda: replace(MATERIAL, ambient=(0, 0, 0.5)), "material.ambient.z"),  # type: ignore[arg-type]
        (lambda: replace(MATERIAL, index=True), "material.index"),
        (lambda: Light((262144, 0, 0), BLACK), "light.position.x"),
        (lambda: Light(BLACK, (-1, 0, 0)), "light.intensity.x"),
        (lambda: Sphere(MATERIAL, (0, -262145, 0), 1), "sphere.center.y"),
        (lambda: Sphere(MATERIAL, BLACK, 32), "sphere.radius"),
        (lambda: Triangle(MATERIAL, (BLACK, (0, 0, 262144), BLACK)), "triangle.vertices[1].z"),
        (lambda: Triangle(MATERIAL, (BLACK, BLACK)), "triangle.vertices"),  # type: ignore[arg-type]
        (lambda: Camera(BLACK, (0, 0, -262145), BLACK), "camera.up.z"),
        (lambda: replace(SCENE, background=(-1, 0, 0)), "scene.background.x"),
    ],
)
def test_a_value_outside_its_format_names_its_field(build: object, field: str) -> None:
    with pytest.raises(ValueError) as refused:
        build()  # type: ignore[operator]
    assert str(refused.value).startswith(f"{field}: ")


def test_object_numbers_count_spheres_first() -> None:
    sphere, triangle = Sphere(MATERIAL, BLACK, 1), Triangle(MATERIAL, (BLACK, BLACK, BLACK))
    scene = replace(SCENE, spheres=(sphere,), triangles=(triangle, triangle))
    assert scene.objects == (sphere, triangle, triangle)


@pytest.mark.parametrize(("index", "n"), [(0, 1.0), (4, 1.5), (11, 2.375), (15, 2.875)])
def test_the_index_encodes_the_refractive_index(index: int, n: float) -> None:
    assert replace(MATERIAL, index=index).refractive_index == n


def test_the_books_view_has_half_an_angle_of_thirty_degrees_across() -> None:
    view = View.book(640, 480)
    assert view.tan_h == pytest.approx(1 / math.sqrt(3))
    assert view.tan_v == pytest.approx(math.tan(math.radians(22.5)))
    assert View.book(512, 512).tan_v == pytest.approx(view.tan_h)


def test_an_angle_of_view_is_full_and_vertical_and_keeps_pixels_square() -> None:
    view = View.square(800, 400, 90)
    assert view.tan_v == pytest.approx(1)
    assert view.tan_h == pytest.approx(2)


@pytest.mark.parametrize(
    "build",
    [
        lambda: View.book(0, 1),
        lambda: View.book(100, 300),
        lambda: View.square(1, 1, 180),
        lambda: View.square(1, 1, math.nan),
        lambda: View(1, 1, math.inf, 1.0),
        lambda: View(1, -1, 1.0, 1.0),
        lambda: View(1, 1, 1.0, 0.0),
    ],
)
def test_a_view_without_a_picture_is_refused(build: object) -> None:
    with pytest.raises(ValueError, match="view"):
        build()  # type: ignore[operator]


def test_another_size_keeps_the_files_angle_or_else_the_books_rule() -> None:
    angled = SceneFile(SCENE, View.square(512, 512, 45), (), Path("x.nff"), square_pixels=True)
    wide = angled.view_for(1024, 512)
    assert wide.tan_v == pytest.approx(math.tan(math.radians(22.5)))
    assert wide.tan_h == pytest.approx(2 * wide.tan_v)
    for view in (None, View.book(64, 64)):
        assert SceneFile(SCENE, view, (), Path("x.toml")).view_for(640, 480) == View.book(640, 480)
