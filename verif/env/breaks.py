"""Proves that the benches can fail: changes one line of the design and runs the bench that must notice.

    python -m verif.env.breaks [unit ...] [--sim verilator] [--keep]

Each unit names its breaks (`verif.env.unit.Break`), and `core` is the whole core with its own. The change
goes into the sources of one build, never into the tree. Exit code 1 where a break is not caught. `--keep`
shrinks what a property drew when it noticed, and puts it into the bench's corpus.
"""

import argparse
import importlib
import json
import sys
import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Protocol

from verif.env import corpus, sources, units
from verif.env.build import BuildError
from verif.env.run import Outcome
from verif.env.simulators import Simulator
from verif.env.unit import Break

_LARGER = {"core": "verif.core.breaks"}
"""What is broken beside units, and the module whose SUBJECT it is."""

_EFFORT = units.Effort(examples=30, operands=5_000)
_SEED = 1


class UselessBreak(ValueError):
    """A break does not apply to the design as it is; the text says which and why."""


@dataclass(frozen=True)
class Verdict:
    """What became of one break: the tests that failed, none where nobody noticed, in which folder."""

    unit: str
    change: Break
    failed: tuple[str, ...]
    seconds: float
    directory: Path


def changed(change: Break) -> dict[Path, str]:
    """The changed file. Raises UselessBreak where the text to change is not there exactly once."""
    path = sources.HDL / change.file
    text = path.read_text()
    if text.count(change.old) != 1:
        raise UselessBreak(f"{change.file} holds {change.old!r} {text.count(change.old)} times, not once")
    return {path: text.replace(change.old, change.new)}


class Subject(Protocol):
    """Something whose lines are changed one by one."""

    @property
    def name(self) -> str:
        """What the table calls it."""

    @property
    def breaks(self) -> Sequence[Break]:
        """The lines."""

    def run(
        self,
        change: Break,
        replacements: Mapping[Path, str],
        run_name: str,
        simulator: Simulator,
        shrink: bool,
    ) -> Outcome:
        """Runs the bench that must notice on the changed design."""


@dataclass(frozen=True)
class _UnitSubject:
    """A unit and its bench."""

    name: str

    @property
    def breaks(self) -> Sequence[Break]:
        return units.find(self.name).breaks

    def run(
        self,
        change: Break,
        replacements: Mapping[Path, str],
        run_name: str,
        simulator: Simulator,
        shrink: bool,
    ) -> Outcome:
        return units.simulate(
            self.name,
            simulator,
            change.set,
            seed=_SEED,
            effort=_EFFORT,
            replacements=replacements,
            run_name=run_name,
            shrink=shrink,
        )


def names() -> tuple[str, ...]:
    """All there is to break."""
    return (*units.names(), *_LARGER)


def subject(name: str) -> Subject:
    """What is called so. Raises KeyError where nothing is."""
    if name not in _LARGER:
        return _UnitSubject(name)
    found: Subject = importlib.import_module(_LARGER[name]).SUBJECT
    return found


def judge(what: Subject, number: int, change: Break, simulator: Simulator, shrink: bool = False) -> Verdict:
    """Runs the bench on the changed design; shrink: what a property drew when it noticed.

    Raises UselessBreak where the changed design does not build: a compiler's refusal proves nothing.
    """
    start = time.monotonic()
    name = what.name
    try:
        outcome = what.run(change, changed(change), f"break-{name}-{number}-{simulator}", simulator, shrink)
    except BuildError as error:
        raise UselessBreak(f"{name}, break {number}: {error}") from error
    failed = tuple(test for test, text in outcome.tests.items() if text)
    if not outcome.passed and not failed:
        raise UselessBreak(f"{name}, break {number}: {outcome.complaint()}")
    return Verdict(name, change, failed, time.monotonic() - start, outcome.directory)


def verdicts(wanted: Sequence[str], simulator: Simulator, shrink: bool = False) -> Iterator[Verdict]:
    """One of each break of each unit."""
    for what in map(subject, wanted):
        for number, change in enumerate(what.breaks):
            yield judge(what, number, change, simulator, shrink)


def keep(verdict: Verdict) -> Path | None:
    """Puts the shortest example that was shrunk into the corpus of its bench; None where there is none, as
    where the corpus noticed."""
    shrunk = sorted(corpus.files(verdict.directory / corpus.NAME), key=lambda path: path.stat().st_size)
    if not shrunk:
        return None
    change = verdict.change
    why = f"shrunk where {change.file} had {change.new!r} for {change.old!r}"
    where = json.loads((verdict.directory / "settings.json").read_text())["corpus"]
    return corpus.keep(replace(corpus.read(shrunk[0]), why=why), Path(where))


def row(verdict: Verdict) -> str:
    """A line of the table."""
    result = f"caught by {len(verdict.failed)}" if verdict.failed else "NOT CAUGHT"
    change = f"{verdict.change.file}: {verdict.change.old} -> {verdict.change.new}"
    return f"{verdict.unit:14} {result:12} {verdict.seconds:5.1f} s  {change}"


def main(arguments: Sequence[str]) -> int:
    """Prints the table as it grows; 0 where every break was caught."""
    parser = argparse.ArgumentParser(description="Change the design, and see that the benches notice.")
    parser.add_argument("units", nargs="*", help="units; default: all that have breaks")
    parser.add_argument("--sim", type=Simulator, choices=list(Simulator), default=Simulator.VERILATOR)
    parser.add_argument("--keep", action="store_true", help="shrink, and put examples into the corpus")
    options = parser.parse_args(arguments)
    missed = caught = 0
    for verdict in verdicts(options.units or names(), options.sim, options.keep):
        print(row(verdict), flush=True)
        if options.keep and (kept := keep(verdict)):
            print(f"kept {kept}", flush=True)
        caught += bool(verdict.failed)
        missed += not verdict.failed
    print(f"{caught} caught, {missed} not caught")
    return 1 if missed or not caught else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
