"""The whole core: its bench on every build, and every scene of the project that fits it, as a picture."""

from dataclasses import dataclass
from functools import cache
from pathlib import Path

import pytest

from models.scene.errors import SceneError
from models.scene.frame import pack
from verif.core.builds import core_build, stepped_build
from verif.env import sources, units
from verif.env.build import CACHE
from verif.env.run import run
from verif.env.simulators import MissingTool, Simulator, version
from verif.render.compare import Summary, expect, summarise
from verif.render.job import Job, request
from verif.render.simulate import simulate

SCENES = sources.ROOT / "models" / "scenes"

_SLOTS_TESTS = (
    "every_drawn_scene_is_exact_in_every_pixel_and_hit",
    "waiting_on_either_side_neither_loses_nor_changes_a_pixel",
    "reset_at_any_clock_leaves_a_core_as_new",
    "fewer_slots_than_clocks_of_latency_cost_time_and_no_pixel",
)


@dataclass(frozen=True)
class Case:
    """One run of the core's bench.

    slots: pixels in flight, None for the usual number. share: of the usual number of examples, and
    most_examples a property. most_pixels: of the drawn pictures; rate_size: side of the square whose clocks
    are counted. tests: those that run, all where there are none.
    """

    build: str
    simulator: Simulator
    slots: int | None = None
    share: float = 1.0
    most_examples: int | None = None
    most_pixels: int = 144
    rate_size: int = 128
    tests: tuple[str, ...] = ()

    def __str__(self) -> str:
        slots = "" if self.slots is None else f"-{self.slots}-slots"
        return f"{self.build}{slots}-{self.simulator}"

    def examples(self, usual: int) -> int:
        """Hypothesis examples a property."""
        wanted = max(1, round(usual * self.share))
        return wanted if self.most_examples is None else min(wanted, self.most_examples)


# Icarus simulates about 1,000 clocks of the core in a second, and a frame takes 600 and one a pixel.
_CASES = (
    Case("default", Simulator.VERILATOR),
    Case("default", Simulator.ICARUS, most_examples=3, most_pixels=12, rate_size=8),
    Case("book", Simulator.VERILATOR, share=0.3),
    Case("default", Simulator.VERILATOR, slots=16, share=0.3, tests=_SLOTS_TESTS),
)


@cache
def _scenes() -> tuple[Path, ...]:
    """The scenes that fit the core, found by asking for their pictures."""

    def fits(path: Path) -> bool:
        try:
            _job(path, "64x48", Simulator.VERILATOR)
        except SceneError:
            return False
        return True

    return tuple(path for path in sorted(SCENES.iterdir()) if fits(path))


def _job(scene: Path, size: str, simulator: Simulator) -> Job:
    out = CACHE / "pictures" / f"{scene.stem}-{simulator}"
    return request(str(scene), size, str(out), simulator, "default", None)


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    """A test for each run and for each scene."""
    wanted = metafunc.config.option.sim
    if "case" in metafunc.fixturenames:
        cases = [case for case in _CASES if wanted in (None, str(case.simulator))]
        metafunc.parametrize("case", cases, ids=str)
    if "scene" in metafunc.fixturenames:
        if not _scenes():
            raise pytest.UsageError(f"no scene in {SCENES} fits the core")
        metafunc.parametrize("scene", _scenes(), ids=lambda path: path.stem)


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
    _need(case.simulator, pytestconfig)
    build = stepped_build(case.build, case.simulator, option.waves, case.slots)
    database = None if units.in_ci() else str(CACHE / "hypothesis" / f"core-{case}")
    outcome = run(
        build,
        "verif.core.bench",
        f"core-{case}",
        seed=option.seed,
        settings={
            "parameters": dict(build.parameters),
            "examples": case.examples(option.examples),
            "database": database,
            "extra": {
                "build": case.build,
                "simulator": case.simulator,
                "most_pixels": case.most_pixels,
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


def _drawn(scene: Path, size: str, simulator: Simulator) -> Summary:
    job = _job(scene, size, simulator)
    build = core_build(job.build, job.simulator)
    name = f"picture-{scene.stem}-{size}-{simulator}"
    drawn = simulate(build, pack(job.file.scene), job.registers, name, job.out)
    return summarise(job, drawn, expect(job))


def test_a_picture_of_512_x_512_is_exact_and_takes_about_a_clock_a_pixel(
    scene: Path, pytestconfig: pytest.Config
) -> None:
    """No pixel differs from the bit-exact model, and the picture is as close to the reference as promised."""
    if pytestconfig.option.sim == Simulator.ICARUS:
        pytest.skip("Icarus takes minutes for a picture of 512 x 512")
    summary = _drawn(scene, "512x512", Simulator.VERILATOR)
    print(summary)
    assert summary.mismatched_pixels == 0
    assert summary.cycles_per_pixel <= 1.1
    assert summary.hit_mismatch_percent <= 0.02
    assert summary.psnr_db is None or summary.psnr_db >= 50


def test_both_simulators_draw_the_same_picture_in_the_same_clocks(
    scene: Path, pytestconfig: pytest.Config
) -> None:
    """No pixel of a small picture differs from the model, on neither; `--sim` draws it on one alone."""
    wanted = pytestconfig.option.sim
    simulators = tuple(Simulator) if wanted is None else (Simulator(wanted),)
    for simulator in simulators:
        _need(simulator, pytestconfig)
    summaries = [_drawn(scene, "64x48", simulator) for simulator in simulators]
    assert [summary.mismatched_pixels for summary in summaries] == [0] * len(simulators)
    assert len({summary.cycles for summary in summaries}) == 1, "the simulators count other clocks"
