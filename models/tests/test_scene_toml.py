"""Scene files in TOML say a scene exactly; what they cannot say is refused with its line and a remedy."""

import math
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from models.scene.errors import SceneError
from models.scene.frame import Capacity
from models.scene.strategies import scenes
from models.scene.toml import parse
from models.scene.toml_writer import to_toml
from models.scene.types import BLACK, Scene, View

PATH = Path("models/scenes/x.toml")
TEXT = """\
title = "A title"
notes = "one\\ntwo"
ambient = [0, 0.25, 1]
background = [0.5, 0.0001, 0.0005]
[camera]
position = [0, 0, 5]
up = [0, 1, 0]
center = [0, 0, 0]
[materials.glass]
ambient = [0, 0, 0]
diffuse = [0.1, 0.1, 0.1]
specular = [1, 1, 1]
transparency = [
    0.9, 0.8,
    0.7,
]
n = 1.5
[[lights]]
position = [1, 2, 3]
intensity = [511.9990234375, 0, 1]
[[spheres]]
material = "glass"
center = [-256, 255.9990234375, 0]
radius = 0.125
[[spheres]]
material = { ambient = [0, 0, 0], diffuse = [1, 1, 1], specular = [0, 0, 0], index = 15 }
center = [1, 1, 1]
radius = 3.875
[[triangles]]
material = "glass"
vertices = [
    [0, 0, 0],
    [1, 0, 0],
    [0, 1, 0.00048828125],
]
[view]
width = 64
height = 48
angle = 90
"""


def test_a_file_is_read_in_full() -> None:
    read = parse(TEXT, PATH)
    scene = read.scene
    assert (read.title, read.notes, read.path) == ("A title", ("one", "two"), PATH)
    assert scene.ambient == (0, 256, 1024)
    assert scene.background == (512, 0, 1), "rounded to the nearest step"
    assert scene.camera.position == (0, 0, 5120)
    assert scene.lights[0].intensity == (524287, 0, 1024)
    glass, plain = scene.spheres
    assert glass.material.transparency == (922, 819, 717)
    assert (glass.material.index, glass.material.reflection) == (4, BLACK)
    assert (glass.center, glass.radius) == ((-262144, 262143, 0), 1)
    assert (plain.material.index, plain.radius) == (15, 31)
    assert scene.triangles[0].material == glass.material
    assert scene.triangles[0].vertices[2] == (0, 1024, 1), "halves go up"
    assert read.view == View.square(64, 48, 90)
    assert read.square_pixels


def test_without_an_angle_the_view_is_the_books() -> None:
    read = parse(TEXT.replace("angle = 90\n", ""), PATH)
    assert read.view == View.book(64, 48)
    assert not read.square_pixels
    assert parse(TEXT[: TEXT.index("[view]")], PATH).view is None


def test_the_refusal_is_one_line_with_file_line_field_and_remedy() -> None:
    with pytest.raises(SceneError) as refused:
        parse(TEXT.replace("radius = 3.875", "radius = 4.2"), PATH)
    assert str(refused.value) == (
        "models/scenes/x.toml:28: spheres[1].radius: 4.2 is above 3.875, the largest radius; "
        "scale the scene down"
    )


INLINE = "material = { ambient = [0, 0, 0], diffuse = [1, 1, 1], specular = [0, 0, 0], index = 15 }"


@pytest.mark.parametrize(
    ("old", "new", "line", "field", "problem"),
    [
        ("radius = 0.125", "radius = 0.3", 24, "spheres[0].radius", "nearest radius is 0.25"),
        ("radius = 0.125", "radius = 0", 24, "spheres[0].radius", "below 0.125"),
        ("radius = 0.125", "radius = 1e300", 24, "spheres[0].radius", "above 3.875"),
        ("radius = 0.125", "radius = nan", 24, "spheres[0].radius", "nan is not a finite number"),
        ("radius = 0.125", "radius = true", 24, "spheres[0].radius", "a boolean, not a number"),
        ("radius = 0.125", "", 21, "spheres[0].radius", "is missing"),
        ("radius = 0.125", "radios = 1", 24, "spheres[0].radios", "known are material, center, radius"),
        ("[-256, ", "[-256.001, ", 23, "spheres[0].center[0]", "below -256, the smallest coordinate"),
        ("255.9990234375", "256", 23, "spheres[0].center[1]", "256 is above 255.9990234"),
        ("255.9990234375", "inf", 23, "spheres[0].center[1]", "inf is not a finite"),
        ("255.9990234375", "1" + "0" * 400, 23, "spheres[0].center[1]", "an integer of 401 digits"),
        ("255.9990234375", '"1"', 23, "spheres[0].center[1]", "a text, not a number"),
        ("center = [-256, ", "center = [", 23, "spheres[0].center", "not an array of three numbers"),
        ('"glass"\ncenter', '"glas"\ncenter', 22, "spheres[0].material", "[materials] (glass)"),
        ('"glass"\ncenter', "3\ncenter", 22, "spheres[0].material", "an integer, not a table"),
        (INLINE, "", 25, "spheres[1].material", "is missing"),
        ("index = 15", "index = 16", 26, "spheres[1].material.index", "16 is not from 0 to 15"),
        ("index = 15", "index = 1.0", 26, "spheres[1].material.index", "a number, not an integer"),
        ("index = 15", "index = 1, n = 1", 26, "spheres[1].material.n", "beside index"),
        ("n = 1.5", "n = 0.9", 17, "materials.glass.n", "not a refractive index from 1 to 2.875"),
        ("    0.7,\n", "    -0.7,\n", 15, "materials.glass.transparency[2]", "below 0, the smallest colour"),
        ("specular = [1, 1, 1]\n", "", 9, "materials.glass.specular", "is missing"),
        ("[511.9990234375", "[512", 20, "lights[0].intensity[0]", "above 511.9990234"),
        ("[1, 0, 0],\n", "[1, 0, 300],\n", 33, "triangles[0].vertices[1][2]", "above 255.99"),
        ("    [1, 0, 0],\n", "", 31, "triangles[0].vertices", "not an array of three points"),
        ("ambient = [0, 0.25, 1]", "", None, "ambient", "is missing"),
        ("[camera]", "[camerra]", 5, "camerra", "is not known here; known are camera, ambient"),
        ("up = [0, 1, 0]", "up = [0, 0, 1]", 7, "camera.up", "parallel to the direction of view"),
        ("center = [0, 0, 0]", "center = [0, 0, 5]", 8, "camera.center", "camera's own position"),
        ("[[lights]]", "[lights]", 18, "lights", "write [[lights]]"),
        ("[materials.glass]", "[[materials]]", 9, "materials", "an array, not a table"),
        ("title = ", "title = 1 #", 1, "title", "an integer, not a text"),
        ("width = 64", "width = 0", 37, "view.width", "0 is not from 1 to 4096"),
        ("width = 64", "width = 64.0", 37, "view.width", "not an integer"),
        ("angle = 90", "angle = 180", 39, "view.angle", "180 is not between 0 and 180 degrees"),
        ("width = 64\nheight = 48\nangle = 90", "width = 1\nheight = 3", 36, "view", "too high"),
        ("angle = 90", "angle = 1979-05-27", 39, "view.angle", "a date or time, not a number"),
        ("[view]", "[view", 36, "", "is not TOML"),
        ("radius = 0.125", "radius = 1\nradius = 1", 25, "", "cannot overwrite a value"),
        ("angle = 90\n", 'angle = """', 39, "", "is not TOML"),
    ],
)
def test_a_fault_names_its_line_and_field(old: str, new: str, line: int, field: str, problem: str) -> None:
    assert old in TEXT
    with pytest.raises(SceneError) as refused:
        parse(TEXT.replace(old, new, 1), PATH)
    assert (refused.value.line, refused.value.field) == (line, field)
    assert problem in refused.value.problem
    assert "\n" not in str(refused.value)


@settings(max_examples=40, deadline=None)
@given(scenes(Capacity(2, 2, 3)), st.sampled_from([None, View.book(30, 20), View.square(40, 30, 33.3)]))
def test_a_written_scene_reads_back_as_itself(scene: Scene, view: View | None) -> None:
    read = parse(to_toml(scene, view, title='a "b" \\ \x7f \u00e9', notes=("1", "2")), PATH)
    assert read.scene == scene
    assert (read.title, read.notes) == ('a "b" \\ \x7f \u00e9', ("1", "2"))
    if view is None:
        assert read.view is None
    else:
        assert read.view is not None
        assert (read.view.width, read.view.height) == (view.width, view.height)
        assert math.isclose(read.view.tan_v, view.tan_v)
        assert math.isclose(read.view.tan_h, view.tan_h)


def test_each_material_is_written_once() -> None:
    assert to_toml(parse(TEXT, PATH).scene).count("[materials.") == 2


def test_a_view_that_no_file_can_say_is_refused() -> None:
    with pytest.raises(ValueError, match="neither square pixels nor the book's"):
        to_toml(parse(TEXT, PATH).scene, View(10, 10, 0.5, 0.25))


def test_pictures_higher_than_the_books_view_allows_are_written_by_their_angle() -> None:
    text = to_toml(parse(TEXT, PATH).scene, View.square(10, 40, 60))
    assert parse(text, PATH).square_pixels
