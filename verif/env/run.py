"""Runs a cocotb bench on a build and judges the run: silence is never a pass."""

import json
import shutil
import xml.etree.ElementTree as ElementTree
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from verif.env import corpus, sources
from verif.env.build import CACHE, Build, ensure, make_runner
from verif.env.simulators import Simulator

# cocotbext-axi 0.1.28, the last there is, serves cocotb 1 and 2 and so calls what 2.1 deprecates: Task.kill,
# Edge, setimmediatevalue, Event.data. Its modules alone are exempt, each by name: PYTHONWARNINGS takes whole
# names only, and in what we write a deprecation stays an error.
_DEPRECATING = tuple(f"cocotbext.axi.{name}" for name in ("stream", "axis", "axil_master", "reset"))
_WARNINGS = ",".join(["error", *(f"ignore::DeprecationWarning:{module}" for module in _DEPRECATING)])


@dataclass(frozen=True)
class Outcome:
    """What one simulation did: tests by name with their failure text, or None where they passed."""

    directory: Path
    exit_ok: bool
    tests: Mapping[str, str | None]

    @property
    def passed(self) -> bool:
        """Exit code 0, at least one test, none failed."""
        return self.exit_ok and bool(self.tests) and not any(self.tests.values())

    def complaint(self) -> str:
        """What went wrong, in a few lines."""
        failed = [f"{name}: {text}" for name, text in self.tests.items() if text]
        if not failed:
            ran = "no test ran" if not self.tests else "the simulator did not exit with 0"
            failed = [ran, *self._log_tail()]
        return "\n".join([*failed, f"log: {self.directory / 'sim.log'}"])

    def _log_tail(self) -> list[str]:
        log = self.directory / "sim.log"
        return log.read_text().splitlines()[-20:] if log.exists() else []


def _results(path: Path) -> dict[str, str | None]:
    if not path.exists():
        return {}
    cases = ElementTree.parse(path).getroot().iter("testcase")
    return {case.get("name", "?"): _failure(case) for case in cases}


def _failure(case: ElementTree.Element) -> str | None:
    for kind in ("failure", "error", "skipped"):
        found = case.find(kind)
        if found is not None:
            return f"{kind} {found.get('error_msg') or found.get('message') or ''} {found.text or ''}".strip()
    return None


def run(
    build: Build,
    module: str,
    name: str,
    *,
    seed: int,
    settings: Mapping[str, object],
    tests: str | None = None,
) -> Outcome:
    """Builds, then runs the cocotb tests of ``module`` in ``build/runs/<name>``.

    ``settings`` reaches the bench as JSON (see `verif.env.context`); ``tests`` selects by name.
    """
    binary = ensure(build)
    directory = CACHE / "runs" / name
    shutil.rmtree(directory, ignore_errors=True)
    directory.mkdir(parents=True)
    (directory / "settings.json").write_text(json.dumps({"corpus": str(corpus.folder(module)), **settings}))
    engine = make_runner(build)
    results = directory / "results.xml"
    exit_ok = True
    try:
        engine.test(
            test_module=module,
            hdl_toplevel=build.top,
            hdl_toplevel_lang="verilog",
            build_dir=binary,
            test_dir=directory,
            results_xml=str(results),
            seed=seed,
            testcase=tests,
            waves=build.waves,
            plusargs=_plusargs(build, directory, seed),
            extra_env=_environment(directory),
            log_file=directory / "sim.log",
        )
    except (RuntimeError, SystemExit):
        exit_ok = False
    return Outcome(directory, exit_ok, _results(results))


def _plusargs(build: Build, directory: Path, seed: int) -> list[str]:
    if build.simulator is Simulator.VERILATOR:
        # Where coverage counts, all begins at 0: what a bit is compared with is a register too, and one that
        # began at random would show a toggle that never was.
        reset = 0 if build.coverage else 2
        return [f"+verilator+rand+reset+{reset}", f"+verilator+seed+{seed % (1 << 31) or 1}"]
    return [f"+dumpfile_path={directory / 'dump.fst'}"] if build.waves else []


def _environment(directory: Path) -> dict[str, str]:
    return {
        "PYTHONPATH": str(sources.ROOT),
        "PYTHONWARNINGS": _WARNINGS,
        "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1",
        "COCOTB_ANSI_OUTPUT": "0",
        "RAYTRACER_RUN": str(directory),
        "OMP_NUM_THREADS": "1",
    }
