"""Runs one run in a process group and a folder of its own, inside its limits."""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from threading import Event

from regressions.lists import Kind
from regressions.outcome import LOG, PYTEST, RUNS, Ended, judged
from regressions.record import Result, Status
from verif.env import limit, run, sources
from verif.env.build import CACHE

_POLL_SECONDS = 0.05
_GRACE_SECONDS = 3.0

_STEERING = ("WAVES", "SIM", "SEED", "UNIT", "GUI", "PYTEST_ADDOPTS", "COCOTB_TEST_FILTER", "COCOTB_TESTCASE")
"""Variables that would make a run another one than its command says."""


def execute(planned: Result, folder: Path, stop: Event, *, waves: bool = False) -> Result:
    """Runs it; the result. ``stop`` ends it early, as not run."""
    folder.mkdir(parents=True)
    with (folder / LOG).open("w") as log:
        process = subprocess.Popen(
            [sys.executable, *_arguments(planned, folder, waves)],
            cwd=sources.ROOT,
            env=_environment(planned, folder),
            stdin=subprocess.DEVNULL,
            stdout=log,
            stderr=subprocess.STDOUT,
            start_new_session=True,
        )
        ended = _ended(process, planned.wall_limit, stop)
    named = replace(planned, folder=os.path.relpath(folder, sources.ROOT))
    return judged(named, folder, ended)


def _arguments(planned: Result, folder: Path, waves: bool) -> tuple[str, ...]:
    if planned.kind == Kind.MODULE:
        return planned.arguments
    options = (
        "-o",
        f"cache_dir={folder / 'pytest'}",
        f"--junitxml={folder / PYTEST}",
        *(("--waves",) if waves else ()),
    )
    return (*planned.arguments, *options)


def _environment(planned: Result, folder: Path) -> Mapping[str, str]:
    """The machine's, less what steers runs, with this run's folders and limits."""
    found = {key: value for key, value in os.environ.items() if key not in (*_STEERING, limit.NANOSECONDS)}
    found |= {
        run.RUNS: str(folder / RUNS),
        "HYPOTHESIS_STORAGE_DIRECTORY": str(CACHE / "hypothesis"),
        "PYTHONPYCACHEPREFIX": str(CACHE / "pycache"),
    }
    if planned.kind in (Kind.UNIT, Kind.CORE):
        # The seed alone decides, not examples that failed on this machine before. Pytest only starts the
        # simulator there: its plugins would take a third of a short run.
        found |= {"CI": "1", "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1"}
    if planned.simulated_limit:
        found[limit.NANOSECONDS] = str(planned.simulated_limit)
    return found


def _ended(process: subprocess.Popen[bytes], seconds: float, stop: Event) -> Ended:
    start = time.monotonic()
    stopped: tuple[Status, str] | None = None
    while process.poll() is None:
        elapsed = time.monotonic() - start
        if stop.is_set():
            stopped = Status.NOT_RUN, "interrupted before its end"
        elif elapsed > seconds:
            stopped = Status.TIMED_OUT, f"{seconds:g} s of wall-clock time are over"
        if stopped:
            _end(process)
            break
        time.sleep(_POLL_SECONDS)
    return Ended(process.returncode, time.monotonic() - start, stopped)


def _end(process: subprocess.Popen[bytes]) -> None:
    """Ends the process and all that it started, first with a request, then without."""
    for request in (signal.SIGTERM, signal.SIGKILL):
        try:
            os.killpg(process.pid, request)
        except ProcessLookupError:
            break
        try:
            process.wait(_GRACE_SECONDS)
        except subprocess.TimeoutExpired:
            continue
    process.wait()
