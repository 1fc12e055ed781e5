"""The whole core: its benches on every build, and every scene of the project as a picture."""

from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType

import pytest

from models.core import render
from verif.core.builds import core_build
from verif.core.cases import CASES, Case, simulate
from verif.core.job import Job, request
from verif.env import sources, units
from verif.env.build import CACHE
from verif.env.simulators import MissingTool, Simulator, version
from verif.render.compare import Expected, Summary, expect, summarise
from verif.render.simulate import Drawn
from verif.render.simulate import simulate as draw

SCENES = tuple(sorted((sources.ROOT / "models" / "scenes").iterdir()))


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    """A test for each run and for each scene."""
    wanted = metafunc.config.option.sim
    if "case" in metafunc.fixturenames:
        cases = [case for case in CASES if wanted in (None, str(case.design.simulator))]
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
    _need(case.design.simulator, pytestconfig)
    outcome = simulate(
        case,
        seed=option.seed,
        examples=option.examples,
        waves=option.waves,
        coverage=option.code_coverage and case.design.simulator is Simulator.VERILATOR,
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
    drawn = draw(build, job.frame, job.registers, name, job.out, clocks_per_pixel=expected.clocks_per_pixel)
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
