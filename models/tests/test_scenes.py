"""The project's scene files: the build that each fits, sizes a simulation can draw, and pictures worth it."""

from pathlib import Path

import numpy as np
import pytest

from models.reference import render
from models.scene.frame import Capacity, CounterWidths, Frame, pack, unpack
from models.scene.load import load

SCENES = sorted((Path(__file__).parent.parent / "scenes").glob("*.toml"))
WIDE = CounterWidths(lights=4, spheres=6, triangles=8)
LARGEST_SIDE = 512
SHOWPIECES = {
    "three_spheres",
    "mirrors",
    "glass",
    "shadows",
    "mesh",
    "tetrahedron",
    "room",
    "gem",
    "spheres_wide",
}


def counters_for(path: Path) -> CounterWidths:
    return WIDE if path.stem.endswith("_wide") else CounterWidths()


def test_the_showpieces_are_there() -> None:
    assert {path.stem for path in SCENES} >= SHOWPIECES


def test_the_wide_build_is_that_of_the_specification() -> None:
    assert WIDE.capacity == Capacity(lights=15, spheres=63, triangles=255)


@pytest.mark.parametrize("path", SCENES, ids=lambda path: path.stem)
def test_a_scene_fits_the_build_that_its_name_says(path: Path) -> None:
    scene = load(path).scene
    frame = pack(scene, counters_for(path))
    assert unpack(Frame.from_hex(frame.to_hex()), counters_for(path)) == scene
    if path.stem.endswith("_wide"):
        with pytest.raises(ValueError, match="more than"):
            pack(scene)


@pytest.mark.parametrize("path", SCENES, ids=lambda path: path.stem)
def test_a_scene_has_a_title_a_note_and_a_size_that_a_simulation_can_draw(path: Path) -> None:
    file = load(path)
    assert file.title and file.notes
    assert file.view is not None
    assert max(file.view.width, file.view.height) <= LARGEST_SIDE


@pytest.mark.parametrize("name", sorted(SHOWPIECES))
def test_a_showpiece_shows_something_and_is_hardly_overexposed(name: str) -> None:
    file = load(SCENES[0].with_name(f"{name}.toml"))
    assert file.view is not None
    got = render(file.scene, file.view_for(file.view.width // 8, file.view.height // 8))
    clamped = (got.rgb == 255).any(axis=2) & (got.hit >= 0)
    assert np.mean(clamped) < 0.05
    assert np.mean(got.hit >= 0) > 0.3
    assert len(np.unique(got.hit)) > len(file.scene.objects) / 2, "most objects are seen"
