"""The record of one regression: all that its reports are drawn from.

One frozen data model. Paths are relative to the project's root, so that a record made on one machine reads
the same on another. What a section has not measured is an empty tuple, never a made-up number.
"""

import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from pathlib import Path

from regressions.json_form import FormError, decode, dumps
from verif.plan.join import Standing

SCHEMA = 1
"""Version of the record's form: changes whenever a reader of the old form would go wrong."""


class Status(StrEnum):
    """How a run ended.

    killed: by a signal that the regression did not send, as when memory runs out; timed_out: by one of its
    limits; not_run: its build failed, or the regression was interrupted before its end.
    """

    PASSED = "passed"
    FAILED = "failed"
    TIMED_OUT = "timed_out"
    KILLED = "killed"
    NOT_RUN = "not_run"


@dataclass(frozen=True)
class Check:
    """One test inside a run: a cocotb test, or a test of pytest's where no simulator ran.

    where: a cocotb test's module, or the file of one of pytest's. message: why it failed; empty where it
    passed. A skipped test has a reason and checked nothing.
    """

    name: str
    where: str = ""
    message: str = ""
    skipped: str = ""
    simulated_ns: float = 0.0


@dataclass(frozen=True)
class Result:
    """One run: one test with one seed. Planned runs are results too, that have not run.

    id: unique in the regression and a folder's name. entry: of the list. kind: `unit`, `core`, `pytest` or
    `module`. test: what the run is of, without the seed, as `sqrt-narrow-verilator`. index: number of the
    seed among those of the test. arguments: of Python, which start it. command: shows the run again in a
    fresh clone. folder: all that the run wrote. unit, simulator, parameter_set, build: empty where there is
    none. wall_limit, simulated_limit: seconds and simulated nanoseconds, 0 for none. waves: recorded signals
    of a repetition, where one was made.
    """

    id: str
    entry: str
    kind: str
    test: str
    index: int
    seed: int
    status: Status
    seconds: float
    command: str
    folder: str
    arguments: tuple[str, ...] = ()
    wall_limit: float = 0.0
    simulated_limit: float = 0.0
    simulated_ns: float = 0.0
    message: str = ""
    unit: str = ""
    simulator: str = ""
    parameter_set: str = ""
    build: str = ""
    checks: tuple[Check, ...] = ()
    waves: str = ""


@dataclass(frozen=True)
class Bucket:
    """Failures that say the same but for numbers. message: normalised; example: the first one in full;
    results: ids, the first is the one that command and waves are of."""

    message: str
    example: str
    results: tuple[str, ...]
    command: str
    waves: str = ""


@dataclass(frozen=True)
class Bin:
    """One bin of functional coverage over all runs. recipe: the strategy that reaches it; excluded: why it
    need not be hit, empty where it must; by: hits of each result, by id."""

    name: str
    hits: int
    recipe: str = ""
    excluded: str = ""
    by: Mapping[str, int] = field(default_factory=dict)


@dataclass(frozen=True)
class Point:
    """A cover point. Its bins' full names are `<unit>.<point>.<bin>`."""

    name: str
    doc: str
    bins: tuple[Bin, ...]


@dataclass(frozen=True)
class Unit:
    """Functional coverage of a unit, of the core (`core`) or of the video block (`video`)."""

    name: str
    points: tuple[Point, ...]


@dataclass(frozen=True)
class Curve:
    """Bins hit as clocks go by. strategy: `closure`, `random`, or the id of a result; bins: how many there
    are, less the excluded; steps: (clocks so far, bins hit so far), growing."""

    unit: str
    strategy: str
    bins: int
    steps: tuple[tuple[int, int], ...]


class CodeKind(StrEnum):
    """What kind of code a coverage point is on."""

    LINE = "line"
    BRANCH = "branch"
    EXPRESSION = "expression"
    TOGGLE = "toggle"


@dataclass(frozen=True)
class CodePoint:
    """One point of code coverage. line, column: from 1, where it begins; name: branch, term of an expression,
    or bit and direction; lines: that are hit with it; excluded: why it need not be hit; by: runs that hit it,
    as places in `Record.code_runs`."""

    line: int
    column: int
    kind: CodeKind
    name: str
    hits: int
    lines: tuple[int, ...] = ()
    excluded: str = ""
    by: tuple[int, ...] = ()


@dataclass(frozen=True)
class File:
    """Code coverage of one source file, points by line."""

    path: str
    points: tuple[CodePoint, ...]


@dataclass(frozen=True)
class Mutant:
    """A mutant that no test killed. verdict: `survived` or `undecided`; change: what it changes; shown_by:
    operand that would have shown it, where a solver gave one; reason: why it is accepted, if it is."""

    number: int
    file: str
    line: int
    change: str
    verdict: str
    shown_by: str = ""
    reason: str = ""


@dataclass(frozen=True)
class Mutation:
    """Qualification of a unit's bench by mutants: counts, and each that is neither killed nor equivalent."""

    unit: str
    mutants: int
    killed: int
    equivalent: int
    undecided: int
    survivors: tuple[Mutant, ...] = ()

    @property
    def score(self) -> float | None:
        """Killed per mutant not proven equivalent, 0 to 1; None where there is none."""
        judged = self.mutants - self.equivalent
        return self.killed / judged if judged else None


@dataclass(frozen=True)
class Promise:
    """A promise of the verification plan joined with what ran. unit: the folder of the plan; tests: names
    with the worst status of their runs; points: names of cover points, with bins hit and needed; standing:
    whether it holds."""

    unit: str
    name: str
    what: str
    file: str
    tests: Mapping[str, Status] = field(default_factory=dict)
    points: Mapping[str, tuple[int, int]] = field(default_factory=dict)
    standing: Standing = Standing.NOT_RUN


@dataclass(frozen=True)
class Rule:
    """An entry of the specification. kind: `rule` or `fault`; section: where the text is; promises: names of
    those that fulfil it; standing: the worst of theirs."""

    name: str
    kind: str
    section: str
    text: str
    promises: tuple[str, ...]
    standing: Standing


@dataclass(frozen=True)
class Record:
    """A regression. id: its folder's name below `build/regressions/`; list: its name; seed: root of all
    seeds; dirty: the tree differs from the revision; tools: versions by name; started: UTC, ISO 8601;
    code_runs: names of the runs that collected code coverage;
    interrupted: it was stopped before its end; notes: what a section could not measure, and why."""

    id: str
    list: str
    seed: int
    revision: str
    dirty: bool
    tools: Mapping[str, str]
    started: str
    seconds: float
    jobs: int
    results: tuple[Result, ...]
    interrupted: bool = False
    buckets: tuple[Bucket, ...] = ()
    coverage: tuple[Unit, ...] = ()
    curves: tuple[Curve, ...] = ()
    code: tuple[File, ...] = ()
    code_runs: tuple[str, ...] = ()
    mutation: tuple[Mutation, ...] = ()
    plan: tuple[Promise, ...] = ()
    rules: tuple[Rule, ...] = ()
    notes: tuple[str, ...] = ()

    @property
    def passed(self) -> bool:
        """There are results, and each passed."""
        return bool(self.results) and all(result.status is Status.PASSED for result in self.results)

    def counts(self) -> dict[Status, int]:
        """How many results ended each way."""
        ends = [result.status for result in self.results]
        return {status: ends.count(status) for status in Status}


class RecordError(ValueError):
    """A file that is no record of this version; the text is the whole message."""


def write(record: Record, path: Path) -> None:
    """Writes the record as JSON, whole or not at all."""
    path.parent.mkdir(parents=True, exist_ok=True)
    fresh = path.with_name(f".{path.name}.new")
    fresh.write_text(dumps(record, schema=SCHEMA) + "\n")
    fresh.replace(path)


def read(path: Path) -> Record:
    """The record in a file. Raises RecordError."""
    if not path.is_file():
        raise RecordError(f"{path}: there is no such record; `python -m regressions run smoke` makes one")
    try:
        value = json.loads(path.read_text())
    except ValueError as error:
        raise RecordError(f"{path}: is not JSON ({error}); run the regression again") from None
    schema = value.pop("schema", None) if isinstance(value, dict) else None
    if schema != SCHEMA:
        raise RecordError(f"{path}: schema {schema} is not {SCHEMA}; run the regression again")
    try:
        return decode(Record, value)
    except FormError as error:
        raise RecordError(f"{path}: {error}; run the regression again") from None
