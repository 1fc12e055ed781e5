"""The whole core: its benches on every build, and every scene of the project as a picture."""

import zlib
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from types import MappingProxyType

import pytest

from models.core import render
from verif.core.builds import core_build, stepped_build
from verif.env import sources, units
from verif.env.build import CACHE, Build
from verif.env.run import run
from verif.env.simulators import MissingTool, Simulator, version
from verif.render.compare import Expected, Summary, expect, summarise
from verif.render.job import Job, request
from verif.render.simulate import Drawn, simulate

SCENES = tuple(sorted((sources.ROOT / "models" / "scenes").iterdir()))


@dataclass(frozen=True)
class Design:
    """A core to be tested: a named build and what differs from it; stepped: for benches that look at every
    clock."""

    build: str = "default"
    simulator: Simulator = Simulator.VERILATOR
    changes: Mapping[str, int] = field(default_factory=dict)
    stepped: bool = False

    def __str__(self) -> str:
        words = [self.build, *(str(value) for value in self.changes.values()), str(self.simulator)]
        return "-".join(words)

    def made(self, waves: bool) -> Build:
        """How it is built."""
        builder = stepped_build if self.stepped else core_build
        return builder(self.build, self.simulator, waves, self.changes)


@dataclass(frozen=True)
class Case:
    """One run of one of the core's benches.

    share: of the usual number of Hypothesis examples, and most_examples a property. scenes: drawn single
    frames. most_pixels: of the drawn pictures; rate_size: side of the square whose clocks are counted.
    tests: those that run, all where there are none.
    """

    bench: str
    design: Design
    share: float = 1.0
    scenes: int = 0
    most_pixels: int = 48
    rate_size: int = 128
    tests: tuple[str, ...] = ()

    def __str__(self) -> str:
        return f"{self.bench}-{self.design}"

    def seed(self, root: int) -> int:
        """Of its own: no two runs draw the same scenes."""
        return root + zlib.crc32(str(self).encode()) % 1000

    def examples(self, usual: int) -> int:
        """Hypothesis examples a property."""
        return max(1, round(usual * self.share))


_DEFAULT = Design()
_BOOK = Design("book")
_WIDE = Design("wide")
_STEPPED = Design(stepped=True)
_ONE = Design(changes={"UNITS": 1, "PIXELS_IN_FLIGHT": 4, "LEVEL_ROOM": 4}, stepped=True)
_THREE = Design(changes={"UNITS": 3, "PIXELS_IN_FLIGHT": 16, "LEVEL_ROOM": 4}, stepped=True)
# Icarus simulates about 300 clocks of the core in a second, and a frame takes 600 and more.
_ICARUS = Design(simulator=Simulator.ICARUS, stepped=True)

_NO_MARGIN = (
    "every_drawn_scene_is_exact_in_every_pixel_hit_and_counter",
    "a_light_at_the_hit_point_is_left_out_and_counted",
    "triangles_without_area_are_left_out_and_counted",
)

_CASES = (
    Case("pictures", _DEFAULT, scenes=400),
    Case("frames", _DEFAULT),
    Case("faults", _DEFAULT),
    Case("rooms", _DEFAULT, share=0.5),
    Case("rate", _DEFAULT),
    Case("streams", _STEPPED),
    Case("pictures", _ONE, scenes=150),
    Case("frames", _ONE, share=0.5),
    Case("faults", _ONE, share=0.5),
    Case("rooms", _ONE, share=0.5),
    Case("streams", _ONE, share=0.5),
    Case("pictures", _THREE, scenes=150),
    Case("rooms", _THREE, share=0.5),
    Case("streams", _THREE, share=0.5),
    Case("pictures", _BOOK, scenes=100, tests=_NO_MARGIN),
    Case("pictures", _WIDE, scenes=30, share=0.2, most_pixels=4),
    Case("rooms", _WIDE, share=0.1),
    Case("pictures", _ICARUS, share=0.02, scenes=10, most_pixels=2, tests=_NO_MARGIN),
    Case("faults", _ICARUS, share=0.02, most_pixels=2, tests=("reset_at_any_clock_leaves_a_core_as_new",)),
    Case("streams", _ICARUS, share=0.02, most_pixels=12),
)


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    """A test for each run and for each scene."""
    wanted = metafunc.config.option.sim
    if "case" in metafunc.fixturenames:
        cases = [case for case in _CASES if wanted in (None, str(case.design.simulator))]
        metafunc.parametrize("case", cases, ids=str)
    if "scene" in metafunc.fixturenames:
        metafunc.parametrize("scene", SCENES, ids=lambda path: path.stem)


def _need(simulator: Simulator, config: pytest.Config) -> None:
    """Skips where a simulator is not there, unless it was asked for."""
    try:
        version(simulator)
    except MissingTool as missing:
        if config.option.sim is not None or simulator is Simulator.VERILATOR:
            pytest.fail(str(missing), pytrace=False)
        pytest.skip(str(missing))


def test_core(case: Case, pytestconfig: pytest.Config) -> None:
    """The bench passes."""
    option = pytestconfig.option
    design = case.design
    _need(design.simulator, pytestconfig)
    build = design.made(option.waves)
    database = None if units.in_ci() else str(CACHE / "hypothesis" / f"core-{case}")
    outcome = run(
        build,
        f"verif.core.{case.bench}",
        f"core-{case}",
        seed=case.seed(option.seed),
        settings={
            "parameters": dict(build.parameters),
            "examples": case.examples(option.examples),
            "database": database,
            "extra": {
                "build": design.build,
                "simulator": design.simulator,
                "stepped": design.stepped,
                "most_pixels": case.most_pixels,
                "scenes": case.scenes,
                "rate_size": case.rate_size,
            },
        },
        tests=",".join(case.tests) or None,
    )
    if not outcome.passed:
        again = f"python -m pytest 'verif/test_core.py::test_core[{case}]' --seed {option.seed}"
        if option.examples != units.EXAMPLES:
            again += f" --examples {option.examples}"
        pytest.fail(f"{outcome.complaint()}\nrepeat with: {again}", pytrace=False)
    assert not case.tests or set(outcome.tests) == set(case.tests), f"only {list(outcome.tests)} ran"


def _job(scene: Path, simulator: Simulator, size: str | None = None, build: str | None = None) -> Job:
    out = CACHE / "pictures" / f"{scene.stem}-{simulator}"
    return request(str(scene), size, str(out), simulator, build)


def _drawn(job: Job) -> tuple[Summary, Drawn, Expected]:
    expected = expect(job)
    build = core_build(job.build, job.simulator)
    name = f"picture-{job.name}-{job.view.width}x{job.view.height}-{job.build}-{job.simulator}"
    drawn = simulate(
        build, job.frame, job.registers, name, job.out, clocks_per_pixel=expected.clocks_per_pixel
    )
    summary = summarise(job, drawn, expected)
    print(summary)
    assert summary.mismatched_pixels == 0
    assert drawn.counts == expected.model.counts
    assert drawn.degenerate == expected.model.degenerate
    return summary, drawn, expected


_RATES: Mapping[str, tuple[float, float]] = MappingProxyType(
    {"one_sphere": (1.1, 0.0), "three_spheres": (12.0, 0.8)}
)
"""Most clocks a pixel, and least tests a trace unit's clock, of the scenes whose speed is promised."""


def test_every_scene_is_exact_at_its_full_size(scene: Path, pytestconfig: pytest.Config) -> None:
    """No pixel, hit or counter differs from the bit-exact model's; the picture is near the reference."""
    if pytestconfig.option.sim == Simulator.ICARUS:
        pytest.skip("Icarus takes hours for pictures of full size")
    summary, _, _ = _drawn(_job(scene, Simulator.VERILATOR))
    assert summary.hit_mismatch_percent <= 0.05
    assert summary.psnr_db is None or summary.psnr_db >= 40
    most, least = _RATES.get(scene.stem, (float("inf"), 0.0))
    assert summary.cycles_per_pixel <= most
    assert summary.utilisation >= least


def test_the_book_s_fraction_bits_are_exact_too(pytestconfig: pytest.Config) -> None:
    """Ten fraction bits everywhere: another picture, and the model's in every pixel."""
    if pytestconfig.option.sim == Simulator.ICARUS:
        pytest.skip("Icarus takes hours for pictures of full size")
    scene = next(path for path in SCENES if path.stem == "mirrors")
    summary, _, _ = _drawn(_job(scene, Simulator.VERILATOR, build="book"))
    assert summary.psnr_db is not None and 20 < summary.psnr_db < 45


_SIZES = ("64x48", "32x24", "16x12", "8x6", "4x3")
_MOST_CLOCKS = 4000
"""Of a picture on Icarus: more would take it longer than some ten seconds."""


def _size(scene: Path) -> str:
    """The first size of which Icarus draws the scene in time."""
    for size in _SIZES[:-1]:
        job = _job(scene, Simulator.VERILATOR, size)
        counts = render(job.file.scene, job.registers, job.formats).counts
        if counts.tests / job.core.units + counts.primary_rays <= _MOST_CLOCKS:
            return size
    return _SIZES[-1]


def test_both_simulators_draw_the_same_picture_in_the_same_clocks(
    scene: Path, pytestconfig: pytest.Config
) -> None:
    """No pixel of a small picture differs from the model, on neither; `--sim` draws it on one alone."""
    wanted = pytestconfig.option.sim
    simulators = tuple(Simulator) if wanted is None else (Simulator(wanted),)
    for simulator in simulators:
        _need(simulator, pytestconfig)
    size = _size(scene)
    cycles = {_drawn(_job(scene, simulator, size))[0].cycles for simulator in simulators}
    assert len(cycles) == 1, "the simulators count other clocks"


def test_scenes_are_drawn_with_the_first_build_that_holds_them() -> None:
    """The wide build is needed, and no more than needed."""
    builds = {path.stem: _job(path, Simulator.VERILATOR).build for path in SCENES}
    wide = {name for name, build in builds.items() if build == "wide"}
    assert wide == {"spheres_wide"}
    assert set(builds.values()) == {"default", "wide"}
