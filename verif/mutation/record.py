"""What became of a unit's mutants: `build/mutation/<unit>.json`, and how good that makes its bench."""

import dataclasses
import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from pathlib import Path
from typing import Any

from verif.env.build import CACHE

FOLDER = CACHE / "mutation"
"""Where the results lie, a file a unit."""

SCORE, UNDECIDED = 0.99, 0.02
"""A bench is good enough from this score on, with at most this share of its mutants undecided."""

_FORMAT = 1
"""Of the JSON; a file of another number counts as absent."""


class Status(StrEnum):
    """What the bench said of a mutant."""

    KILLED = "killed"
    TIMED_OUT = "timed_out"
    SURVIVED = "survived"


class Verdict(StrEnum):
    """What the solver said of a survivor. `undecided` never counts as equivalent."""

    EQUIVALENT = "equivalent"
    SHOWN = "shown"
    UNDECIDED = "undecided"


Clock = Mapping[str, int]
"""Inputs in one clock by the name of the port, as unsigned numbers."""


@dataclass(frozen=True)
class Mutant:
    """One fault: yosys' ``mode`` (inv, const0, const1, cnot0, cnot1) at one bit of one cell.

    number: from 1, value of the selecting port; place: cell type's port and bit; source: `file:line` of the
    Verilog, and text: that line.
    """

    number: int
    mode: str
    place: str
    source: str
    text: str


@dataclass(frozen=True)
class Judged:
    """A mutant with its status. test: the one that failed; seconds: of the judge. Of a survivor: verdict;
    why: how it was reached; witness: inputs, clock by clock from reset, after which the outputs differ."""

    mutant: Mutant
    status: Status
    test: str = ""
    seconds: float = 0.0
    verdict: Verdict | None = None
    why: str = ""
    witness: tuple[Clock, ...] = ()


@dataclass(frozen=True)
class Result:
    """All mutants of a unit. inputs: digest of every file that the result depends on; settings: seed and
    effort."""

    unit: str
    parameter_set: str
    mutants: tuple[Judged, ...]
    seconds: float
    inputs: Mapping[str, str] = field(default_factory=dict)
    settings: Mapping[str, int | str] = field(default_factory=dict)

    def count(self, *wanted: Status | Verdict) -> int:
        """Mutants of which one of these was said."""
        return sum(one.status in wanted or one.verdict in wanted for one in self.mutants)

    @property
    def killed(self) -> int:
        """Mutants that the bench noticed: a test failed, or never ended."""
        return self.count(Status.KILLED, Status.TIMED_OUT)

    @property
    def score(self) -> float:
        """Killed per mutant that is not proven equivalent, 0 to 1; 0 where there is none."""
        judged = len(self.mutants) - self.count(Verdict.EQUIVALENT)
        return self.killed / judged if judged else 0.0

    @property
    def undecided(self) -> float:
        """Share of the mutants of which neither bench nor solver knows anything."""
        return self.count(Verdict.UNDECIDED) / len(self.mutants) if self.mutants else 0.0

    @property
    def good(self) -> bool:
        """The bench is good enough."""
        return self.score >= SCORE and self.undecided <= UNDECIDED

    @property
    def survivors(self) -> tuple[Judged, ...]:
        """Mutants that nobody noticed and nobody proved equivalent."""
        return tuple(
            one
            for one in self.mutants
            if one.status is Status.SURVIVED and one.verdict is not Verdict.EQUIVALENT
        )


def path(unit: str) -> Path:
    """The file of a unit's result."""
    return FOLDER / f"{unit}.json"


def write(result: Result) -> None:
    """Writes the file."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    content = {"format": _FORMAT, **dataclasses.asdict(result)}
    path(result.unit).write_text(json.dumps(content, indent=1) + "\n")


def read(unit: str) -> Result | None:
    """What was written last; None where nothing was, or by another version."""
    file = path(unit)
    found = json.loads(file.read_text()) if file.exists() else {}
    if found.pop("format", None) != _FORMAT:
        return None
    mutants = tuple(map(_judged, found.pop("mutants")))
    return Result(mutants=mutants, **found)


def _judged(found: dict[str, Any]) -> Judged:
    verdict = found["verdict"]
    changes = {
        "mutant": Mutant(**found["mutant"]),
        "status": Status(found["status"]),
        "verdict": None if verdict is None else Verdict(verdict),
        "witness": tuple(found["witness"]),
    }
    return Judged(**{**found, **changes})
