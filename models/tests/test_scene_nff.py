"""NFF scenes come onto the core's grid by one factor; what the core cannot draw is refused by name."""

import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from models.images import psnr_db
from models.reference import Rendering, render
from models.scene.errors import SceneError
from models.scene.nff import parse
from models.scene.types import SceneFile, View

PATH = Path("balls.nff")
VIEW = """\
v
from 0 0 5
at 0 0 0
up 0 1 0
angle 60
hither 0.5
resolution 320 200
"""
FILL = "f 1 0.5 0.25 0.5 0.25 20 0.5 1.5\n"
TEXT = f"""\
# a comment
b 0.25 0.5 1
{VIEW}
l 1 2 3  # white
l 4 5 6 0.5 0.25 1
{FILL}s 0 0 0 1
s 1 0 0 0.5
p 4
0 0 0
1 0 0
1 1 0
0 1 0
f 0 0 1 1 0 100 0 0
pp 3
0 0 -1 0 0 1
1 0 -1 0 0 1
0 1 -1 0 0 1
"""


def read(text: str) -> SceneFile:
    return parse(text, PATH)


def test_a_file_is_read_in_full() -> None:
    file = read(TEXT)
    scene = file.scene
    assert file.notes == ("scaled by 1, without error",)
    assert file.view == View.square(320, 200, 60)
    assert file.square_pixels
    assert (scene.background, scene.ambient) == ((256, 512, 1024), (0, 0, 0))
    assert scene.camera.position == (0, 0, 5 * 1024)
    share = round(1024 * math.sqrt(2) / 2)
    assert [light.intensity for light in scene.lights] == [(share,) * 3, (512, 256, 1024)]
    material = scene.spheres[0].material
    assert material.diffuse == (512, 256, 128)
    assert material.specular == material.reflection == (256, 256, 256)
    assert (material.transparency, material.index) == ((512, 512, 512), 4)
    assert [sphere.radius for sphere in scene.spheres] == [8, 4]
    first, second, third = scene.triangles
    assert first.vertices == ((0, 0, 0), (1024, 0, 0), (1024, 1024, 0))
    assert second.vertices == ((0, 0, 0), (1024, 1024, 0), (0, 1024, 0))
    assert first.material == material
    assert third.material.diffuse == (0, 0, 1024)
    assert third.material.index == 0, "an opaque object needs no refractive index"


@pytest.mark.parametrize("count", [1, 3, 4])
def test_lights_without_a_colour_share_the_root_of_their_number(count: int) -> None:
    scene = read(VIEW + "l 1 1 1\n" * count).scene
    assert {light.intensity[0] for light in scene.lights} == {round(1024 / math.sqrt(count))}


def test_one_factor_brings_all_radii_onto_steps() -> None:
    third = 1 / 3
    text = VIEW + FILL + f"s 0 0 0 1\ns 1 0 0 {third}\ns 0 1 0 {third / 3}\n"
    file = read(text)
    radii = [sphere.radius for sphere in file.scene.spheres]
    assert radii[0] == 3 * radii[1] == 9 * radii[2]
    factor = float(file.notes[0].removeprefix("scaled by ").partition(",")[0])
    assert radii[0] / 8 == pytest.approx(factor)
    assert file.scene.camera.position[2] == pytest.approx(5 * factor * 1024, abs=0.5)


@settings(max_examples=50, deadline=None)
@given(st.floats(0.01, 30), st.lists(st.sampled_from([1, 2, 3, 4, 6, 8, 12]), min_size=1, max_size=3))
def test_scaling_keeps_the_picture(size: float, steps: list[int]) -> None:
    view = VIEW.replace("from 0 0 5", f"from 0 0 {5 * size}")
    spheres = "".join(f"s {n * size} 0 0 {step * size / 12}\n" for n, step in enumerate(steps))
    scene = read(view + f"l {size} 0 0\n" + FILL + spheres).scene
    factor = scene.camera.position[2] / (5 * 1024 * size)
    for number, (sphere, step) in enumerate(zip(scene.spheres, steps, strict=True)):
        assert sphere.radius / 8 == pytest.approx(step * size / 12 * factor, rel=1e-3)
        assert sphere.center[0] / 1024 == pytest.approx(number * size * factor, rel=1e-3)


def test_radii_that_no_factor_fits_exactly_report_the_worst_error() -> None:
    (note,) = read(VIEW + FILL.replace(" 0.5 1.5", " 0 1") + "s 0 0 0 1\ns 3 0 0 0.37\n").notes
    assert "worst error" in note
    error = float(note.partition("worst error ")[2].partition(" %")[0])
    assert 0 < error < 1


def test_of_equally_good_factors_the_one_nearest_to_one_is_taken() -> None:
    assert read(VIEW + FILL + "s 0 0 0 0.5\n").notes[0] == "scaled by 1, without error"
    assert read(VIEW + FILL + "p 3\n0 0 0\n1 0 0\n0 1 0\n").notes[0] == "scaled by 1, without error"


def test_an_up_between_two_steps_keeps_its_direction() -> None:
    up = read(VIEW.replace("up 0 1 0", "up 0.1 0.7 0.3")).scene.camera.up
    assert up[0] / up[1] == pytest.approx(1 / 7, rel=1e-4)
    assert up[2] / up[1] == pytest.approx(3 / 7, rel=1e-4)


def test_a_refractive_index_between_two_codes_is_remarked() -> None:
    file = read(VIEW + FILL.replace("1.5\n", "1.52\n") + "s 0 0 0 1\n")
    assert file.scene.spheres[0].material.index == 4
    assert file.notes[1] == "line 8: the refractive index 1.52 became 1.5"


@pytest.mark.parametrize(
    ("text", "line", "field", "problem"),
    [
        (VIEW + "c\n0 0 0 1\n0 0 1 1\n", 8, "c", "cones and cylinders are not drawn by the core"),
        (VIEW + "t 1\n", 8, "t", "triangular patches are not drawn"),
        (VIEW + "patch 1\n", 8, "patch", "patches are not drawn"),
        (VIEW + "q 1\n", 8, "q", "not an entity of NFF; known are v, b, l, f, s, p, pp"),
        ("b 0 0 0\n", None, "v", "is missing"),
        (VIEW + VIEW, 8, "v", "a second time"),
        (VIEW.replace("up 0 1 0", "up 0 1"), 4, "v.up", "takes 3 numbers, not 2"),
        (VIEW.replace("hither 0.5", "angle 3"), 6, "v.angle", "a second time"),
        (VIEW.replace("up 0 1 0\n", ""), 1, "v.up", "is missing"),
        (VIEW.replace("60", "180"), 5, "v.angle", "180 is not between 0 and 180 degrees"),
        (VIEW.replace("320", "0"), 7, "v.resolution", "whole pixels"),
        (VIEW.replace("up 0 1 0", "up 0 0 1"), None, "", "parallel to the direction of view"),
        (VIEW.replace("from 0 0 5", "from 0 0 0"), None, "", "camera's own position"),
        (VIEW + "b 0 0 -1\n", 8, "b", "-1 is below 0"),
        (VIEW + "b 0 0\n", 8, "b", "takes 3 numbers, not 2"),
        (VIEW + "l 1 2 3 4\n", 8, "l", "takes 3 or 6 numbers, not 4"),
        (VIEW + "l 1 x 3\n", 8, "l", "'x' is not a number"),
        (VIEW + "l 1 nan 3\n", 8, "l", "'nan' is not a finite number"),
        (VIEW + "s 0 0 0 1\n", 8, "s", "before the first f"),
        (VIEW + FILL + "s 0 0 0 0\n", 9, "s", "0 is not a radius"),
        (VIEW + FILL.replace("1.5\n", "0.5\n"), 8, "f.ior", "not a refractive index"),
        (VIEW + FILL.replace("0.25 20", "900 20"), 8, "f.Ks", "above 511.99"),
        (VIEW + FILL + "p 2\n", 9, "p", "2 is not a number of vertices"),
        (VIEW + FILL + "p 3\n0 0 0\n1 0 0\n", 11, "p", "ends after 2 of 3 vertices"),
        (VIEW + FILL + "p 3\n0 0 0\n1 0\n", 11, "p", "takes 3 numbers, not 2"),
        (VIEW + FILL + "pp 3\n0 0 0\n", 10, "pp", "takes 6 numbers, not 3"),
        (VIEW + FILL + "p 4\n2 0 0\n0.5 0.5 0\n0 2 0\n0 0 0\n", 9, "p", "is not convex"),
        (VIEW + FILL + "s 0 0 0 1\ns 3 0 0 0.01\n", None, "", "differ by more than 31 times"),
        (VIEW + FILL + "s 0 0 0 1\ns 9000 0 0 1\n", None, "", "too wide for its spheres"),
        (
            VIEW + FILL + "s 0 0 0 3.875\ns 9 0 0 0.1875\ns 18 0 0 0.17\n",
            None,
            "",
            "does not fit the core's radii and coordinates",
        ),
    ],
)
def test_what_the_core_cannot_draw_is_refused_by_line_and_name(
    text: str, line: int | None, field: str, problem: str
) -> None:
    with pytest.raises(SceneError) as refused:
        read(text)
    assert (refused.value.line, refused.value.field) == (line, field)
    assert problem in refused.value.problem


def test_a_dent_opposite_the_first_vertex_is_a_fan() -> None:
    text = VIEW + FILL + "p 4\n0 0 0\n2 0 0\n0.5 0.5 0\n0 2 0\n"
    assert len(read(text).scene.triangles) == 2


def test_the_factor_keeps_all_distances_below_infinity() -> None:
    far = 20.3
    text = VIEW + FILL + f"p 3\n{-far} 0 0\n{far} 0 0\n0 {far} 0\n"
    file = read(text)
    assert file.notes[0].startswith("scaled by 4, "), (
        "8 would keep the coordinates in range, but not the edge"
    )
    ((x0, _, _), (x1, _, _), _) = file.scene.triangles[0].vertices
    assert x1 - x0 < 256 * 1024


def picture(text: str, size: int = 64) -> Rendering:
    file = read(text)
    return render(file.scene, file.view_for(size, size))


def test_what_is_right_and_up_in_the_file_is_so_in_the_picture() -> None:
    """The right is the direction of view times up."""
    view = VIEW.replace("from 0 0 5", "from 0 -9 0").replace("up 0 1 0", "up 0 0 1")
    hit = picture(view + FILL + "s 2.5 0 2.5 1\ns 2.5 0 -2.5 0.5\ns -2.5 0 2.5 0.25\n").hit
    seen = [np.argwhere(hit == number).mean(axis=0) for number in range(3)]
    assert [[bool(row < 32), bool(column > 32)] for row, column in seen] == [
        [True, True],
        [False, True],
        [True, False],
    ]


@pytest.mark.parametrize("size", ["320 200", "64 64", "10 90"])
def test_the_angle_is_the_full_vertical_one(size: str) -> None:
    """A square 4 units high, 8 away, in a view of 10 units there: two fifths of the rows."""
    angle = math.degrees(2 * math.atan(5 / 8))
    view = VIEW.replace("from 0 0 5", "from 0 0 8").replace("60", f"{angle}").replace("320 200", size)
    file = read(view + FILL + "p 4\n-2 -2 0\n2 -2 0\n2 2 0\n-2 2 0\n")
    hit = render(file.scene, file.view_for(100, 50)).hit
    assert (hit >= 0).any(axis=1).sum() == 20
    assert (hit >= 0).any(axis=0).sum() == 20, "pixels are square"


def test_a_scene_of_thirds_looks_like_the_same_scene_of_whole_numbers() -> None:
    def text(unit: float) -> str:
        def point(*steps: float) -> str:
            return " ".join(str(step * unit) for step in steps)

        floor = "\n".join(point(x, -2, z) for x, z in ((-9, 9), (9, 9), (9, -9), (-9, -9)))
        return "\n".join(
            (
                f"b 0.2 0.3 0.5\n{VIEW.replace('from 0 0 5', f'from {point(12, 9, 21)}')}",
                f"l {point(-20, 30, 25)}\nl {point(30, 20, 10)}",
                f"f 1 0.8 0.6 0.7 0.2 20 0 1\np 4\n{floor}",
                f"{FILL}s {point(0, 0, 0, 2)}\ns {point(4, -1, 1, 1)}\ns {point(-3, -1, 3, 1)}\n",
            )
        )

    thirds, whole = picture(text(1 / 3)).rgb, picture(text(1.0)).rgb
    assert psnr_db(thirds, whole) > 45
    assert whole.std() > 20


def test_a_flake_of_balls_is_scaled_with_a_small_error() -> None:
    """A ball with balls of a third of its size around it, whose centers have roots in them."""
    ring = [(2 / 3 * math.cos(turn), 2 / 3 * math.sin(turn)) for turn in np.arange(6) * np.pi / 3 + 0.26]
    text = VIEW + FILL + "s 0 0 0 0.5\n" + "".join(f"s {x} {y} 1.1e-16 0.166667\n" for x, y in ring)
    file = read(text)
    assert [sphere.radius for sphere in file.scene.spheres] == [30, *[10] * 6]
    factor, _, error = file.notes[0].removeprefix("scaled by ").partition(", worst error ")
    assert float(factor) == pytest.approx(7.5, rel=1e-4)
    assert float(error.partition(" %")[0]) < 0.05
