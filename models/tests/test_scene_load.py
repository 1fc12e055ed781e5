"""Scene files of all forms are read by their suffix; what is none is refused in one line."""

from pathlib import Path

import pytest

from models.cores import CORES
from models.limits import Fault
from models.scene.errors import SceneError
from models.scene.frame import CounterWidths, Frame, check, pack
from models.scene.load import load

SCENES = sorted((Path(__file__).parent.parent / "scenes").glob("*.toml"))
ONE_SPHERE = ("one_sphere", "crescent", "close_up", "inside", "far", "tilted")


@pytest.mark.parametrize("path", SCENES, ids=lambda path: path.stem)
def test_the_projects_scenes_fit_the_core_that_their_name_says(path: Path) -> None:
    file = load(path)
    counters = CORES["wide" if path.stem.endswith("_wide") else "default"].counters
    assert check(pack(file.scene, counters).words, counters) is Fault.NONE
    assert file.title
    assert file.notes
    assert file.view is not None


@pytest.mark.parametrize("name", ONE_SPHERE)
def test_the_one_sphere_scenes_have_one_light_and_no_secondary_rays(name: str) -> None:
    (path,) = (path for path in SCENES if path.stem == name)
    scene = load(path).scene
    assert (len(scene.spheres), len(scene.lights), len(scene.triangles)) == (1, 1, 0)
    material = scene.spheres[0].material
    assert material.reflection == material.transparency == (0, 0, 0)


def test_the_books_second_timing_scene_is_there() -> None:
    (path,) = (path for path in SCENES if path.stem == "three_spheres")
    scene = load(path).scene
    assert (len(scene.spheres), len(scene.triangles), len(scene.lights)) == (3, 2, 3)


@pytest.mark.parametrize("path", SCENES, ids=lambda path: path.stem)
def test_a_packed_frame_in_a_hex_file_is_the_same_scene(path: Path, tmp_path: Path) -> None:
    scene = load(path).scene
    counters = CounterWidths(5, 7, 6)
    (tmp_path / "frame.HEX").write_text(pack(scene, counters).to_hex(path.name), encoding="utf-8")
    read = load(tmp_path / "frame.HEX", counters)
    assert read.scene == scene
    assert read.view is None


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        ("none.toml", None, "does not exist; check the name and the working directory"),
        ("scene.txt", b"", "is not a scene file by its suffix; scenes end in .toml, .nff, .hex"),
        ("scene.toml", b"\xff\xfe\x00", "is not a text file; save it as UTF-8"),
        ("scene.nff", b"v\0", "is not a text file: it contains NUL characters"),
        ("scene.toml", b"", "camera: is missing"),
        ("scene.nff", b"", "v: is missing; a viewpoint is needed"),
        ("scene.hex", b"", "camera.position.x: needs 19 bits, the frame ends after 0; the core refuses"),
        ("scene.hex", b"// x\nwhat\n", "'what' is not a word of up to 8 hex digits"),
    ],
)
def test_what_is_no_scene_is_refused_in_one_line(
    tmp_path: Path, name: str, content: bytes | None, message: str
) -> None:
    path = tmp_path / name
    if content is not None:
        path.write_bytes(content)
    with pytest.raises(SceneError) as refused:
        load(str(path))
    assert str(refused.value).startswith(str(path))
    assert message in str(refused.value)
    assert "\n" not in str(refused.value)


def test_a_directory_is_no_scene(tmp_path: Path) -> None:
    (tmp_path / "scene.toml").mkdir()
    with pytest.raises(SceneError, match="is a directory"):
        load(tmp_path / "scene.toml")


def test_a_faulty_frame_is_refused_with_its_code(tmp_path: Path) -> None:
    frame = pack(load(SCENES[0]).scene)
    path = tmp_path / "long.hex"
    path.write_text(Frame((*frame.words, 0)).to_hex(), encoding="utf-8")
    with pytest.raises(SceneError, match="FRAME_LONG"):
        load(path)


def test_line_ends_and_byte_order_marks_of_other_systems_are_read(tmp_path: Path) -> None:
    path = tmp_path / "dos.toml"
    text = SCENES[0].read_text(encoding="utf-8")
    path.write_bytes(b"\xef\xbb\xbf" + text.replace("\n", "\r\n").encode())
    assert load(path).scene == load(SCENES[0]).scene
    path.write_bytes(text.replace("radius = ", "radius = 9").replace("\n", "\r\n").encode())
    with pytest.raises(SceneError) as refused:
        load(path)
    assert refused.value.line == text[: text.index("radius = ")].count("\n") + 1
