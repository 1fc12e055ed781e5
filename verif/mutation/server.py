"""Cocotb module that judges mutants: the simulation forks a child for each, in which a unit's own bench runs.

Start-up and imports are paid once. The first test forks, at simulation time 0; a child sets the port that
chooses its mutant and goes on to the bench's tests, unchanged and in their order, until one fails, in a
folder of its own. Its exit code is what it found. The parent writes `judged.jsonl`, a line a mutant, then
`files.json`, and ends.

What it is told (`extra` of the settings): bench: module; select: name of the port; mutants: their numbers;
jobs: children at a time; folder: for these files.
"""

import importlib
import json
import os
import shutil
import signal
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NoReturn

import cocotb
from cocotb.regression import Test, TestGenerator

from verif.env import context, sources
from verif.mutation.protocol import CRASHED, FILES, JUDGED, SURVIVED, TIMED_OUT

_SURVIVED_CODE, _FIRST_CODE = 99, 100
"""Exit codes: no test failed; the test of this index did."""

_UNIT_SECONDS = 600.0
"""Processor time that the unit itself may take."""

_SLOWER, _AT_LEAST = 3.0, 2.0
"""A mutant may take so many times the processor time of the unit itself, and so many seconds more."""


def _generated(bench: str) -> Iterator[Test]:
    for found in vars(importlib.import_module(bench)).values():
        if isinstance(found, TestGenerator):
            yield from found.generate_tests()
        elif isinstance(found, Test):
            yield found


def _ending_at_failure(test: Test, index: int) -> Any:
    """The same test, after whose failure the process is over."""

    async def body(dut: Any) -> None:
        try:
            await test.func(dut, *test.args, **test.kwargs)
        # A task that fails beside the test cancels it: that is a failure too.
        except BaseException:
            os._exit(_FIRST_CODE + index)

    body.__name__ = body.__qualname__ = test.name
    return cocotb.test()(body)


def _judge_all(names: list[str]) -> int:
    """In the parent does not return; in a child, the mutant that it is to judge."""
    run = context.read()
    waiting: list[int] = list(run.extra["mutants"])
    jobs: int = run.extra["jobs"]
    children: dict[int, int] = {}
    limit = _UNIT_SECONDS
    folder = Path(run.extra["folder"])
    with (folder / JUDGED).open("w") as output:
        # The unit itself first and alone: its time is the measure of the others'.
        if not (child := os.fork()):
            _become_child(0, limit)
            return 0
        children[child] = 0
        while children:
            done, status, usage = os.wait4(-1, 0)
            mutant, seconds = children.pop(done), usage.ru_utime + usage.ru_stime
            shutil.rmtree(_folder(mutant), ignore_errors=True)
            test = _told(status, names)
            line = {"mutant": mutant, "test": test, "seconds": round(seconds, 3)}
            print(json.dumps(line), file=output, flush=True)
            if mutant == 0:
                limit = _SLOWER * seconds + _AT_LEAST
                waiting = waiting if test == SURVIVED else []
            while waiting and len(children) < jobs:
                mutant = waiting.pop(0)
                if not (child := os.fork()):
                    _become_child(mutant, limit)
                    return mutant
                children[child] = mutant
    (folder / FILES).write_text(json.dumps(_imported()))
    os._exit(0)


def _folder(mutant: int) -> Path:
    return context.read().directory / f"mutant-{mutant}"


def _become_child(mutant: int, limit: float) -> None:
    _folder(mutant).mkdir(exist_ok=True)
    os.chdir(_folder(mutant))
    silent = os.open(os.devnull, os.O_WRONLY)
    os.dup2(silent, 1)
    os.dup2(silent, 2)
    # Processor time, so that a busy machine kills nobody; real time for one that sleeps.
    signal.signal(signal.SIGPROF, signal.SIG_DFL)
    signal.signal(signal.SIGALRM, signal.SIG_DFL)
    signal.setitimer(signal.ITIMER_PROF, limit)
    signal.setitimer(signal.ITIMER_REAL, 10 * limit)


def _told(status: int, names: list[str]) -> str:
    if os.WIFSIGNALED(status):
        return TIMED_OUT if os.WTERMSIG(status) in (signal.SIGPROF, signal.SIGALRM) else CRASHED
    code = os.WEXITSTATUS(status)
    if code == _SURVIVED_CODE:
        return SURVIVED
    return names[code - _FIRST_CODE] if code >= _FIRST_CODE else CRASHED


def _imported() -> list[str]:
    """Files of the project that the verdicts depend on."""
    files = (getattr(module, "__file__", None) for module in tuple(sys.modules.values()))
    found = {Path(file) for file in files if file}
    inside = (path for path in found if path.is_relative_to(sources.ROOT))
    return sorted(sources.relative(path for path in inside if ".venv" not in path.parts))


async def _survived(_: Any) -> NoReturn:
    os._exit(_SURVIVED_CODE)


def _tests() -> dict[str, Any]:
    """The choice of a mutant, the bench's tests, the end."""
    bench = context.read().extra["bench"]
    generated = list(_generated(bench))
    names = [test.name for test in generated]

    async def choose(dut: Any) -> None:
        extra = context.read().extra
        getattr(dut, extra["select"]).value = _judge_all(names)

    made = {f"test_{index}": _ending_at_failure(test, index) for index, test in enumerate(generated)}
    return {"choose": cocotb.test()(choose), **made, "survived": cocotb.test()(_survived)}


globals().update(_tests())
