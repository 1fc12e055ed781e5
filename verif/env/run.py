"""Runs a cocotb bench on a build and judges the run: silence is never a pass.

A run leaves `settings.json`, `sim.log`, `results.xml` and `outcome.json` in a folder of its own. Two
variables of the environment say where that is and how much simulated time it has (`verif.env.limit`).
"""

import json
import os
import re
import shutil
import time
import xml.etree.ElementTree as ElementTree
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from pathlib import Path

from verif.env import corpus, limit, sources
from verif.env.build import CACHE, Build, ensure, make_runner
from verif.env.simulators import Simulator

# cocotbext-axi 0.1.28, the last there is, serves cocotb 1 and 2 and so calls what 2.1 deprecates: Task.kill,
# Edge, setimmediatevalue, Event.data. Its modules alone are exempt, each by name: PYTHONWARNINGS takes whole
# names only, and in what we write a deprecation stays an error.
_DEPRECATING = tuple(f"cocotbext.axi.{name}" for name in ("stream", "axis", "axil_master", "reset"))
_WARNINGS = ",".join(["error", *(f"ignore::DeprecationWarning:{module}" for module in _DEPRECATING)])

# cocotb rewrites the assertions of every module that the simulator imports, Hypothesis and NumPy too, which
# takes two seconds a run. Ours are enough.
_REWRITTEN = "verif/*"

RUNS = "RAYTRACER_RUNS"
"""Variable with the folder that holds the runs' folders; without it `build/runs`."""

OUTCOME = "outcome.json"

_DURATION = "sim_time_duration"
"""Property of a test in cocotb's results: nanoseconds, as `sim_time_unit` beside it says."""

_RETURN_CODE = re.compile(r"return code: (-?\d+)")


@dataclass(frozen=True)
class Outcome:
    """What one simulation did: tests by name with their failure text, or None where they passed.

    module: the bench; simulated_ns: of each test; seconds: of the whole simulation; signal: that ended it,
    or 0; limit: a sentence where the limit of simulated time stopped it.
    """

    directory: Path
    exit_ok: bool
    tests: Mapping[str, str | None]
    module: str = ""
    simulated_ns: Mapping[str, float] = field(default_factory=dict)
    seconds: float = 0.0
    signal: int = 0
    limit: str = ""

    @property
    def passed(self) -> bool:
        """Exit code 0, at least one test, none failed."""
        return self.exit_ok and bool(self.tests) and not any(self.tests.values())

    def complaint(self) -> str:
        """What went wrong, in a few lines."""
        failed = [f"{name}: {text}" for name, text in self.tests.items() if text]
        if not failed:
            failed = [self._ended(), *self._log_tail()]
        return "\n".join([*failed, f"log: {self.directory / 'sim.log'}"])

    def _ended(self) -> str:
        if self.limit or self.signal:
            return self.limit or f"the simulator was ended by signal {self.signal}"
        return "the simulator did not exit with 0" if self.tests else "no test ran"

    def _log_tail(self) -> list[str]:
        log = self.directory / "sim.log"
        return log.read_text().splitlines()[-20:] if log.exists() else []

    def save(self) -> None:
        """Leaves all this as `outcome.json` in the run's folder."""
        (self.directory / OUTCOME).write_text(json.dumps({**asdict(self), "directory": self.directory.name}))


def _cases(path: Path) -> dict[str, ElementTree.Element]:
    if not path.exists():
        return {}
    return {case.get("name", "?"): case for case in ElementTree.parse(path).getroot().iter("testcase")}


def _simulated(case: ElementTree.Element) -> float:
    values = (found.get("value") for found in case.iter("property") if found.get("name") == _DURATION)
    return float(next(values, None) or 0.0)


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
    directory = Path(os.environ.get(RUNS) or CACHE / "runs") / name
    shutil.rmtree(directory, ignore_errors=True)
    directory.mkdir(parents=True)
    (directory / "settings.json").write_text(json.dumps({"corpus": str(corpus.folder(module)), **settings}))
    engine = make_runner(build)
    results = directory / "results.xml"
    code, start = 0, time.monotonic()
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
    except (RuntimeError, SystemExit) as error:
        code = _code(error)
    cases, mark = _cases(results), directory / limit.MARK
    outcome = Outcome(
        directory,
        exit_ok=code == 0,
        tests={test: _failure(case) for test, case in cases.items()},
        module=module,
        simulated_ns={test: _simulated(case) for test, case in cases.items()},
        seconds=time.monotonic() - start,
        signal=max(0, -code),
        limit=mark.read_text() if mark.exists() else "",
    )
    outcome.save()
    return outcome


def _code(error: BaseException) -> int:
    """The exit code that cocotb's runner complains of; below 0 it is a signal."""
    found = _RETURN_CODE.search(str(error))
    return int(found[1]) if found else 1


def _plusargs(build: Build, directory: Path, seed: int) -> list[str]:
    if build.simulator is Simulator.VERILATOR:
        # Where coverage counts, all begins at 0: what a bit is compared with is a register too, and one that
        # began at random would show a toggle that never was.
        reset = 0 if build.coverage else 2
        return [f"+verilator+rand+reset+{reset}", f"+verilator+seed+{seed % (1 << 31) or 1}"]
    return [f"+dumpfile_path={directory / 'dump.fst'}"] if build.waves else []


def _environment(directory: Path) -> dict[str, str]:
    limited = {"PYGPI_USERS": ",".join(limit.USERS)} if os.environ.get(limit.NANOSECONDS) else {}
    return {
        **limited,
        "COCOTB_REWRITE_ASSERTION_FILES": _REWRITTEN,
        "PYTHONPATH": str(sources.ROOT),
        "PYTHONWARNINGS": _WARNINGS,
        "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1",
        # Trio's, which a run would import for nothing.
        "HYPOTHESIS_NO_PLUGINS": "1",
        "COCOTB_ANSI_OUTPUT": "0",
        "RAYTRACER_RUN": str(directory),
        "OMP_NUM_THREADS": "1",
    }
