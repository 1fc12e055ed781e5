"""Collects code coverage: runs benches on builds with coverage, keeps what each hit, and merges it.

Each run has a file of its own, so that one that is run again replaces what it hit before. What a run says of
a file of the design that has changed since counts no longer.
"""

import multiprocessing
import os
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import dataclass
from pathlib import Path

from verif.coverage.code import points, reader, runs
from verif.env.build import CACHE, BuildError

FOLDER = CACHE / "coverage"
MERGED = FOLDER / "code.json"
_RUNS = FOLDER / "code"
_QUIET_SECONDS = 10
"""Between two lines where the output is not a terminal."""


@dataclass(frozen=True)
class Collected:
    """One run: its name, how long it took, and what went wrong, if anything."""

    name: str
    seconds: float
    complaint: str = ""


def _file(name: str) -> Path:
    return _RUNS / f"{name}.json"


def keep(name: str, coverage: points.CodeCoverage) -> None:
    """Stores what a run hit, in place of what it hit before."""
    _RUNS.mkdir(parents=True, exist_ok=True)
    fresh = _file(name).with_suffix(f".{os.getpid()}")
    fresh.write_text(points.to_json(coverage))
    fresh.rename(_file(name))


def current(name: str) -> bool:
    """Whether what a run hit is kept, and of the design as it is."""
    if not _file(name).exists():
        return False
    kept = points.load(_file(name))
    return kept.current() == kept


def collect_one(name: str) -> Collected:
    """Runs and keeps; a run that fails keeps nothing."""
    start = time.monotonic()
    _file(name).unlink(missing_ok=True)
    try:
        outcome = runs.simulate(name)
    except BuildError as error:
        return Collected(name, time.monotonic() - start, str(error))
    complaint = "" if outcome.passed else outcome.complaint()
    if not complaint:
        keep(name, reader.read(outcome.directory / reader.FILE, name))
    return Collected(name, time.monotonic() - start, complaint)


def _each(names: Sequence[str], jobs: int) -> Iterator[Collected]:
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(jobs, mp_context=context) as pool:
        for done in as_completed([pool.submit(collect_one, name) for name in names]):
            yield done.result()


class _Line:
    """The line that says how far it is."""

    def __init__(self, number: int) -> None:
        self._number, self._done, self._last = number, 0, 0.0

    def update(self, collected: Collected) -> None:
        """After each run."""
        self._done += 1
        now = time.monotonic()
        text = f"  {self._done} of {self._number} runs, last {collected.name} ({collected.seconds:.0f} s)"
        if sys.stderr.isatty():
            print(f"\r{text:<79}", end="" if self._done < self._number else "\n", file=sys.stderr, flush=True)
        elif now - self._last > _QUIET_SECONDS or self._done == self._number:
            self._last = now
            print(text, file=sys.stderr, flush=True)


def collect(
    names: Sequence[str], jobs: int, each: Callable[[Collected], None] | None = None
) -> list[Collected]:
    """Runs all of them, ``jobs`` at a time; those that failed."""
    line = _Line(len(names))
    failed = []
    for collected in _each(names, jobs):
        line.update(collected)
        if each:
            each(collected)
        if collected.complaint:
            failed.append(collected)
    return failed


def merged() -> points.CodeCoverage:
    """All that was kept and still counts."""
    return points.merge(points.load(path).current() for path in sorted(_RUNS.glob("*.json")))


def write(coverage: points.CodeCoverage) -> None:
    """The merged file."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    MERGED.write_text(points.to_json(coverage))
