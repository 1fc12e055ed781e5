"""The default screen, 640 x 480 at 60 Hz, and `make video`: what is seen is what was sent, in the mode."""

import json
import math
import re
import subprocess
import sys
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from models.core import registers, render
from models.formats import BUILDS, formats
from models.images import load_png, save_png
from models.scene.load import load
from models.video import STORE, VGA, screen
from verif.env import sources
from verif.env.simulators import Simulator
from verif.video.film import sheet, show, times_ms
from verif.video.orbit import orbit

_SCENES = sources.ROOT / "models" / "scenes"


@dataclass(frozen=True)
class Answer:
    """What the command said."""

    code: int
    out: str
    err: str


def _video(*words: str) -> Answer:
    command = [sys.executable, "-m", "verif.video", *words]
    done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=sources.ROOT)
    return Answer(done.returncode, done.stdout, done.stderr)


@pytest.fixture
def verilator(pytestconfig: pytest.Config) -> None:
    """The default screen is Verilator's: Icarus takes most of a minute for each frame."""
    if pytestconfig.option.sim == Simulator.ICARUS:
        pytest.skip("Icarus takes most of a minute for a frame of 640 x 480")


@pytest.mark.usefixtures("verilator")
def test_the_default_screen_shows_each_picture_whole_at_24_a_second(pytestconfig: pytest.Config) -> None:
    """The bench holds every frame to the model and every figure to the mode; here is what comes out of it."""
    generator = np.random.default_rng(pytestconfig.option.seed)
    pictures = generator.integers(0, 256, (4, STORE.height, STORE.width, 3), dtype=np.uint8)
    film = show(pictures, 24, "video-default")
    assert not film.pictures[0].any()
    assert [np.array_equal(a, screen(b)) for a, b in zip(film.shown, pictures, strict=True)] == [True] * 4
    # 59.94 / 24 is a little less than two and a half.
    counts = film.refreshes[1:-1].tolist()
    assert sorted(counts) == [2, 2, 3] or sorted(counts) == [2, 3, 3]
    assert all(a != b for a, b in pairwise(counts))
    times = times_ms(film, 24)
    assert sum(times) == pytest.approx(4000 / 24, abs=1000 / VGA.refresh_hz)


@pytest.mark.usefixtures("verilator")
@pytest.mark.parametrize("core", ["model", "rtl"])
def test_the_command_leaves_the_film_of_a_scene(core: str, tmp_path: Path) -> None:
    """Each seen picture is the model's, whoever draws it, as the screen shows it; the films have them all."""
    scene, out = _SCENES / "one_sphere.toml", tmp_path / "film"
    answer = _video("--scene", str(scene), "--core", core, "--frames", "3", "--out", str(out))
    assert answer.code == 0, answer
    assert "seen      3 of 3 pictures" in answer.out
    file, fmts = load(scene), formats(BUILDS["default"])
    size = registers(file.view_for(STORE.width, STORE.height), fmts)
    wanted = [screen(render(turned, size, fmts).rgb) for turned in orbit(file.scene, 3)]
    for number, picture in enumerate(wanted):
        assert np.array_equal(load_png(out / f"frame-{number:03}.png"), picture)
    with Image.open(out / "animation.png") as film:
        assert film.n_frames == 3  # type: ignore[attr-defined]
        for number, picture in enumerate(wanted):
            film.seek(number)
            assert np.array_equal(np.asarray(film.convert("RGB")), picture)
    assert np.array_equal(load_png(out / "sheet.png"), sheet(np.stack(wanted)))
    with Image.open(out / "animation.gif") as film:
        assert film.n_frames == 3  # type: ignore[attr-defined]
        assert film.size == VGA.size
    summary = json.loads((out / "summary.json").read_text())
    assert summary["wrong_frames"] == 0
    assert summary["pictures_seen"] == 3
    assert summary["drawn_by"] == core


@pytest.mark.usefixtures("verilator")
def test_the_command_shows_pictures_that_are_given_cut_and_in_the_middle(tmp_path: Path) -> None:
    """Wider than what is stored, and lower; files of an older film are not left among the new ones."""
    out = tmp_path / "film"
    pictures = np.random.default_rng(1).integers(0, 256, (2, 100, 330, 3), dtype=np.uint8)
    for number, picture in enumerate(pictures):
        save_png(tmp_path / "given" / f"{number}.png", picture)
    save_png(out / "frame-002.png", pictures[0])
    answer = _video("--pictures", str(tmp_path / "given"), "--rate", "30", "--out", str(out))
    assert answer.code == 0, answer
    assert [path.name for path in sorted(out.glob("frame-*"))] == ["frame-000.png", "frame-001.png"]
    for number, picture in enumerate(pictures):
        assert np.array_equal(load_png(out / f"frame-{number:03}.png"), screen(picture))


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        (("--scene", "nothing.toml"), "nothing.toml.* does not exist"),
        (("--frames", "0"), "FRAMES=0: is 1 to 1000"),
        (("--frames", "many"), "FRAMES=many: is not a number"),
        (("--rate", "61"), "RATE=61: is 1 to 59.94"),
        (("--pictures", "models"), "PICTURES=models: holds no .png file"),
        (("--pictures", "models", "--scene", "a.toml"), "SCENE and PICTURES: name one of them"),
        (("--pictures", "models", "--core", "rtl"), "CORE and PICTURES: name one of them"),
        (("--core", "c"), "CORE=c: is model or rtl"),
        (("--out", "Makefile"), "OUT=Makefile: is a file"),
    ],
)
def test_a_wrong_request_is_one_sentence(words: tuple[str, ...], expected: str) -> None:
    answer = _video(*words)
    assert (answer.code, answer.out, answer.err.count("\n")) == (2, "", 1), answer
    assert re.search(expected, answer.err), answer.err


def test_the_still_of_the_page_is_what_is_seen() -> None:
    """`make video CORE=rtl FRAMES=12 RATE=12` leaves it as sheet.png."""
    file, fmts = load(_SCENES / "three_spheres.toml"), formats(BUILDS["default"])
    size = registers(file.view_for(STORE.width, STORE.height), fmts)
    seen = np.stack([screen(render(turned, size, fmts).rgb) for turned in orbit(file.scene, 4)])
    assert np.array_equal(load_png(sources.HDL / "pictures" / "orbit.png"), sheet(seen))


def test_the_camera_goes_once_around_at_the_same_distance() -> None:
    scene = load(_SCENES / "three_spheres.toml").scene
    scenes = orbit(scene, 8)
    assert scenes[0] == scene
    center, up = np.array(scene.camera.center), np.array(scene.camera.up)
    arms = [np.array(turned.camera.position) - center for turned in scenes]
    for arm, following in zip(arms, [*arms[1:], arms[0]], strict=True):
        assert np.linalg.norm(arm) == pytest.approx(np.linalg.norm(arms[0]), abs=1)
        assert arm @ up == pytest.approx(arms[0] @ up, rel=1e-3)
        flat, next_flat = arm - up * (arm @ up) / (up @ up), following - up * (following @ up) / (up @ up)
        cosine = flat @ next_flat / np.linalg.norm(flat) / np.linalg.norm(next_flat)
        assert math.degrees(math.acos(cosine)) == pytest.approx(45, abs=0.1)
