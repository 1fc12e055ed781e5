"""`make render` as its user meets it: files, figures, refusals, and what it says of a wrong pixel."""

import json
import os
import re
import subprocess
import sys
from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from pathlib import Path

import pytest

from models import images
from models.cores import CORES
from models.scene.frame import pack
from models.scene.load import load
from verif.core.builds import core_build
from verif.env import sources
from verif.env.build import Build
from verif.env.simulators import MissingTool, Simulator, version
from verif.render import __main__ as command
from verif.render.compare import Summary

SCENES = sources.ROOT / "models" / "scenes"
FILES = {"rtl.png", "model.png", "reference.png", "difference.png", "frame.hex", "summary.json"}

NFF = """\
b 0.1 0.2 0.3
v
from 0 0 5
at 0 0 0
up 0 1 0
angle 40
hither 1
resolution 20 10
l 3 4 5
f 0.5 0.75 0.25 0.5 0 20 0 0
s 0 0 0 1
"""

THIRD_PARTY = """\
# as other programs write them: comments, blank lines, two lights, polygons of any number of corners

v
from 2.1 1.3 1.7
at 0 0 0
up 0 0 1
angle 45
hither 0.01
resolution 24 18
b 0.078 0.361 0.753
l 4 3 2 0.8 0.8 0.8
l 1 -4 4
f 1 0.75 0.33 0.8 0 0 0 0
p 4
12 12 -0.5
-12 12 -0.5
-12 -12 -0.5
12 -12 -0.5
f 1 0.9 0.7 0.5 0.5 30.0827 0 0
s 0 0 0 0.5
s 0.272166 0.272166 0.544331 0.166667
f 0.2 0.4 0.6 0.3 0.1 20 0.6 1.5
s 0.643951 0.172546 0 0.166667
pp 3
0.4 0.4 0.5 0 0 1
0.9 0.2 0.4 0 0 1
0.5 0.9 0.6 0 0 1
"""
"""In the way of the Standard Procedural Databases."""

MORE_SPHERES = THIRD_PARTY + "".join(f"s {x} -0.5 0.2 0.125\n" for x in (-0.5, 0, 0.5))
"""More than the default build holds."""


def _crowd(spheres: int) -> str:
    """More spheres than any build holds."""
    return THIRD_PARTY + "".join(f"s {number / 16} -1 0 0.125\n" for number in range(spheres))


@dataclass(frozen=True)
class Answer:
    """How a command ended: exit code, standard output and standard error."""

    code: int
    out: str
    err: str


def _render(*words: str, environment: Mapping[str, str] | None = None) -> Answer:
    done = subprocess.run(
        [sys.executable, "-m", "verif.render", *words],
        cwd=sources.ROOT,
        env={**os.environ, **(environment or {})},
        capture_output=True,
        text=True,
        check=False,
        timeout=600,
    )
    return Answer(done.returncode, done.stdout, done.stderr)


@pytest.fixture
def scene(tmp_path: Path) -> Path:
    """A copy of a scene under a name of its own: runs are called after their scenes."""
    path = tmp_path / f"{tmp_path.name}.toml"
    path.write_text((SCENES / "one_sphere.toml").read_text())
    return path


def _drawn(out: Path, width: int, height: int) -> dict[str, object]:
    """The summary of a folder of pictures that are what they should be."""
    assert {path.name for path in out.iterdir()} == FILES
    rtl = images.load_png(out / "rtl.png")
    assert rtl.shape == (height, width, 3)
    assert (rtl == images.load_png(out / "model.png")).all()
    summary: dict[str, object] = json.loads((out / "summary.json").read_text())
    assert set(summary) == {field.name for field in fields(Summary)}
    assert (summary["width"], summary["height"], summary["pixels"]) == (width, height, width * height)
    assert summary["mismatched_pixels"] == 0
    _counted(summary)
    return summary


def _counted(summary: Mapping[str, object]) -> None:
    """The counters fit to each other and to the model's."""
    names = ("pixels", "primary_rays", "secondary_rays", "shadow_rays", "tests", "units", "cycles", "depth")
    pixels, primary, secondary, shadow, tests, units, cycles, depth = (int(str(summary[n])) for n in names)
    assert primary == pixels
    assert 0 <= secondary <= pixels * (2**depth - 2)
    assert tests <= units * cycles
    assert (tests > 0) >= (secondary + shadow > 0)
    # From the first word to the last pixel are more clocks than the core counts of the frame itself.
    useful = float(str(summary["utilisation"]))
    assert tests / (units * cycles) <= useful <= 1


def test_a_picture_is_drawn_with_all_its_files_and_figures(scene: Path, tmp_path: Path) -> None:
    """Exit code 0, every file, and the same figures in the table and in the summary."""
    out = tmp_path / "deep" / "out"
    answer = _render("--scene", str(scene), "--size", "32x24", "--out", str(out))
    assert answer.code == 0, answer.err
    summary = _drawn(out, 32, 24)
    assert summary["scene"] == str(scene)
    assert summary["build"] == "default"
    assert str(summary["simulator"]).startswith("verilator")
    assert summary["cycles_per_pixel"] == float(str(summary["cycles"])) / (32 * 24)
    assert (summary["depth"], summary["secondary_rays"], summary["units"]) == (5, 0, CORES["default"].units)
    assert 0 < int(str(summary["shadow_rays"])) < 768
    assert (summary["lights_at_point"], summary["degenerate_triangles"]) == (0, 0)
    assert float(str(summary["psnr_db"])) > 50
    assert "0 of 768 pixels differ" in answer.out
    assert f"768 primary, 0 secondary, {summary['shadow_rays']} shadow" in answer.out
    assert f"{summary['tests']}, " in answer.out
    assert str(out / "rtl.png") in answer.out
    frame = pack(load(scene).scene)
    assert load(out / "frame.hex").scene == load(scene).scene
    assert (out / "frame.hex").read_text().count("\n") > len(frame.words)
    assert list(out.parent.iterdir()) == [out], "something was left beside the folder"


def test_a_second_picture_replaces_the_first_ones_files(scene: Path, tmp_path: Path) -> None:
    """The folder may be there, with other files in it."""
    out = tmp_path / "out"
    for size, width in (("4x3", 4), ("5x2", 5)):
        assert _render("--scene", str(scene), "--size", size, "--out", str(out)).code == 0
        assert _drawn(out, width, 3 if width == 4 else 2)


@pytest.mark.parametrize("suffix", ["hex", "nff"])
def test_other_forms_of_a_scene_are_drawn_too(suffix: str, tmp_path: Path) -> None:
    """A packed frame in the size asked for, an NFF scene in its own size."""
    path, out = tmp_path / f"{tmp_path.name}.{suffix}", tmp_path / "out"
    packed = pack(load(SCENES / "one_sphere.toml").scene).to_hex()
    path.write_text(packed if suffix == "hex" else NFF)
    size = ("--size", "20x10") if suffix == "hex" else ()
    answer = _render("--scene", str(path), *size, "--out", str(out))
    assert answer.code == 0, answer.err
    _drawn(out, 20, 10)


def test_a_third_party_scene_is_drawn_as_it_is(tmp_path: Path) -> None:
    """Spheres, polygons, mirrors and glass, scaled onto the core's grid, which is told."""
    path, out = tmp_path / f"{tmp_path.name}.nff", tmp_path / "out"
    path.write_text(THIRD_PARTY)
    answer = _render("--scene", str(path), "--out", str(out))
    assert answer.code == 0, answer.err
    summary = _drawn(out, 24, 18)
    assert summary["build"] == "default"
    assert int(str(summary["secondary_rays"])) > 0 < int(str(summary["shadow_rays"]))
    assert re.search(r"note: scaled by [\d.]+, ", answer.err), answer.err


def test_a_scene_of_many_objects_is_drawn_with_the_wide_build(tmp_path: Path) -> None:
    """Nobody has to ask for it; the frame that is left has the wide build's counters."""
    path, out = tmp_path / f"{tmp_path.name}.nff", tmp_path / "out"
    path.write_text(MORE_SPHERES)
    answer = _render("--scene", str(path), "--size", "8x6", "--out", str(out))
    assert answer.code == 0, answer.err
    assert _drawn(out, 8, 6)["build"] == "wide"
    counters = CORES["wide"].counters
    assert load(out / "frame.hex", counters).scene == load(path).scene
    again = tmp_path / "again"
    words = ("--scene", str(out / "frame.hex"), "--size", "8x6", "--build", "wide")
    answer = _render(*words, "--out", str(again))
    assert answer.code == 0, answer.err
    assert _drawn(again, 8, 6)["build"] == "wide"


def test_depth_is_that_of_the_deepest_ray(tmp_path: Path) -> None:
    """Without mirrors at depth 1, with some of them at depth 2, with more at 5, the default."""
    scene = SCENES / "three_spheres.toml"
    secondary: list[int] = []
    for depth in (("--depth", "1"), ("--depth", "2"), ()):
        out = tmp_path / f"out{len(secondary)}"
        answer = _render("--scene", str(scene), "--size", "12x9", "--out", str(out), *depth)
        assert answer.code == 0, answer.err
        summary = _drawn(out, 12, 9)
        assert summary["depth"] == int(depth[1] if depth else 5)
        secondary.append(int(str(summary["secondary_rays"])))
    assert secondary[0] == 0 < secondary[1] < secondary[2]


def test_a_pixel_is_explained_event_by_event_and_no_picture_is_written(tmp_path: Path) -> None:
    """One line an event, the hit first and the sum last, none of them marked."""
    out, scene = tmp_path / "out", SCENES / "three_spheres.toml"
    words = ("--scene", str(scene), "--size", "16x16", "--out", str(out), "--pixel", "8,8")
    answer = _render(*words)
    assert answer.code == 0, answer.err
    first, *events = answer.out.splitlines()
    assert first == f"pixel 8,8 of {scene}, build default:"
    kinds = [line.split()[0] for line in events]
    assert kinds[0] == "hit" and kinds[-1] == "pixel"
    assert {"child", "local", "light", "left"} <= set(kinds)
    assert "only in" not in answer.out
    assert not out.exists()


_BAD_SCENES = {
    "missing.toml": (None, r"missing\.toml: does not exist"),
    "scene.txt": ("", r"scene\.txt: is not a scene file"),
    "typo.toml": ("ambient = [0, 0, 0]\nbackgruond = [0, 0, 0]\n", r"typo\.toml:2: backgruond: "),
    "broken.toml": ("ambient = [0, 0\n[camera]\n", r"broken\.toml:\d+: "),
    "cone.nff": (f"{NFF}c\n0 0 0 1\n1 1 1 1\n", r"cone\.nff:12: c: "),
    "word.hex": ("00000000\nnothex\n", r"word\.hex:2: 'nothex' is not a word"),
    "short.hex": ("00000000\n", r"short\.hex: .*FRAME_SHORT"),
}


@pytest.mark.parametrize("name", _BAD_SCENES)
def test_a_bad_scene_is_refused_with_its_file_line_and_field(name: str, tmp_path: Path) -> None:
    """Exit code 2 and one sentence, and nothing is written."""
    text, expected = _BAD_SCENES[name]
    if text is not None:
        (tmp_path / name).write_text(text)
    _is_refused(_render("--scene", str(tmp_path / name), "--out", str(tmp_path / "out")), expected)
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    ("text", "build", "expected"),
    [
        (MORE_SPHERES, "default", r"the build default draws: it holds 6 spheres \(at most 3\); .*BUILD=wide"),
        (MORE_SPHERES, "book", r"the build book draws: it holds 6 spheres \(at most 3\); .*BUILD=wide"),
        (_crowd(70), None, r"the build wide draws: it holds 73 spheres \(at most 63\); draw a smaller scene"),
        (
            _crowd(70),
            "default",
            r"the build default draws: it holds 73 spheres \(at most 3\); draw a smaller scene",
        ),
    ],
    ids=["default", "book", "any", "all"],
)
def test_a_scene_of_more_objects_than_the_core_holds_is_refused(
    text: str, build: str | None, expected: str, tmp_path: Path
) -> None:
    """The sentence says what is too much and what to do."""
    path = tmp_path / "crowded.nff"
    path.write_text(text)
    words = ("--build", build) if build else ()
    answer = _render("--scene", str(path), "--out", str(tmp_path / "out"), *words)
    _is_refused(answer, rf"crowded\.nff: is more than {expected}")
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    ("option", "value", "expected"),
    [
        ("--size", "640", "SIZE=640: "),
        ("--size", "0x5", "SIZE=0x5: width and height are 1 to 4095"),
        ("--size", "4096x1", "SIZE=4096x1: width and height are 1 to 4095"),
        ("--size", "1x1000", "SIZE=1x1000: .*choose another size"),
        ("--sim", "vcs", "SIM=vcs: there is no such simulator; choose one of verilator, icarus"),
        ("--build", "vast", "BUILD=vast: there is no such build; choose one of default, book, wide"),
        ("--depth", "0", "DEPTH=0: is not 1 to 5"),
        ("--depth", "6", "DEPTH=6: is not 1 to 5"),
        ("--depth", "deep", "DEPTH=deep: is not 1 to 5"),
        ("--pixel", "5", "PIXEL=5: is not two numbers"),
        ("--pixel", "-1,5", "PIXEL=-1,5: is not two numbers"),
        ("--pixel", "512,0", "PIXEL=512,0: is outside the picture of 512 x 512"),
    ],
)
def test_a_bad_request_is_refused_in_one_sentence(
    option: str, value: str, expected: str, tmp_path: Path
) -> None:
    """Exit code 2, the variable of `make render` by name, and nothing is written."""
    out = tmp_path / "out"
    scene = SCENES / "one_sphere.toml"
    _is_refused(_render("--scene", str(scene), "--out", str(out), f"{option}={value}"), expected)
    assert not out.exists()


def test_a_file_in_place_of_the_folder_is_refused_and_left_alone(tmp_path: Path) -> None:
    """What is there stays as it is."""
    out = tmp_path / "out"
    out.write_text("precious")
    _is_refused(_render("--scene", str(SCENES / "one_sphere.toml"), "--out", str(out)), "OUT=.* is a file")
    assert out.read_text() == "precious"


def test_a_missing_simulator_is_told_in_one_sentence(tmp_path: Path) -> None:
    """PATH has no iverilog: the sentence says so and what to do."""
    answer = _render("--sim", "icarus", "--out", str(tmp_path / "out"), environment={"PATH": str(tmp_path)})
    _is_refused(answer, "`iverilog` is not on PATH: install Icarus Verilog")
    assert not (tmp_path / "out").exists()


def _is_refused(answer: Answer, expected: str) -> None:
    assert answer.code == 2, answer
    assert answer.out == ""
    assert answer.err.count("\n") == 1, f"not one line: {answer.err}"
    assert re.search(expected, answer.err), f"{answer.err!r} does not say {expected!r}"


def _quickest() -> Simulator:
    """The simulator that builds the core sooner: pictures of a few pixels are over soon on each."""
    try:
        version(Simulator.ICARUS)
    except MissingTool:
        return Simulator.VERILATOR
    return Simulator.ICARUS


def _changed_core(monkeypatch: pytest.MonkeyPatch, file: str, old: str, new: str) -> None:
    """The command draws, from here on, with a core in which one line of Verilog is another."""
    path = sources.HDL / file
    text = path.read_text()
    assert text.count(old) == 1
    replacements = {path: text.replace(old, new)}

    def build(name: str, simulator: Simulator, waves: bool = False) -> Build:
        return replace(core_build(name, simulator, waves), replacements=replacements)

    monkeypatch.setattr(command, "core_build", build)


def _main(monkeypatch: pytest.MonkeyPatch, *words: str) -> int:
    monkeypatch.setattr(sys, "argv", ["make render", *words])
    return command.main()


def test_a_wrong_pixel_is_shown_with_the_event_where_it_goes_wrong(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Wrong mirrored directions in the core: exit code 1, the events marked, the command to see it again."""
    _changed_core(monkeypatch, "shade/reflect.v", "- {n[W-1], n, 1'b0}", "+ {n[W-1], n, 1'b0}")
    out, simulator, scene = tmp_path / "out", _quickest(), SCENES / "three_spheres.toml"
    words = ("--scene", str(scene), "--size", "7x5", "--out", str(out), "--sim", simulator, "--depth", "2")
    assert _main(monkeypatch, *words) == 1
    said = capsys.readouterr().out

    wrong = (images.load_png(out / "rtl.png") != images.load_png(out / "model.png")).any(axis=-1)
    summary = json.loads((out / "summary.json").read_text())
    assert summary["mismatched_pixels"] == wrong.sum() > 0
    y, x = (int(place[0]) for place in wrong.nonzero())
    assert f"first wrong pixel {x},{y}: RTL [" in said
    only_model, only_rtl = (
        [line.split()[0] for line in said.splitlines() if line.endswith(f"<- only in the {side}")]
        for side in ("model", "RTL")
    )
    # The first hit itself is right; the ray that leaves it, and the sum, are not.
    assert {"child", "pixel"} <= set(only_model), said
    assert {"child", "pixel"} <= set(only_rtl), said
    assert re.search(r"^hit +depth 1 [^<]*$", said, re.MULTILINE), said
    again = f"again: make render SCENE={scene} SIZE=7x5 SIM={simulator} BUILD=default DEPTH=2 PIXEL={x},{y}"
    assert again in said

    assert _main(monkeypatch, *words, "--pixel", f"{x},{y}") == 1
    assert "<- only in the RTL" in capsys.readouterr().out


def test_a_core_that_does_not_build_ends_the_command_and_writes_nothing(
    scene: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Exit code 1, and the log by name."""
    _changed_core(monkeypatch, "control.v", "assign swap         = ", "assign nothing      = ")
    out = tmp_path / "out"
    assert (
        _main(monkeypatch, "--scene", str(scene), "--size", "2x2", "--out", str(out), "--sim", _quickest())
        == 1
    )
    said = capsys.readouterr().err
    assert "does not build" in said
    assert "build.log" in said
    assert not out.exists()
