"""What a verification plan holds."""

from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path


class PlanError(ValueError):
    """A plan that cannot be read; the text names file, entry, field and remedy."""


@dataclass(frozen=True, order=True)
class NamedTest:
    """A test, whatever its parameters.

    where: of a cocotb test its bench's module (`verif.units.sqrt.bench`), of one of pytest its file from the
    project's root (`verif/test_core.py`). name: its function.
    """

    where: str
    name: str

    def __str__(self) -> str:
        return f"{self.where}::{self.name}"


@dataclass(frozen=True)
class Promise:
    """Something that the design, a model or the environment promises.

    what: one sentence. tests: all must pass. covers: functional cover points or bins, by full name, that must
    be hit. rules: ids of the rules and faults that it fulfils, or helps to.
    """

    id: str
    what: str
    tests: tuple[NamedTest, ...]
    covers: tuple[str, ...] = ()
    rules: tuple[str, ...] = ()


@dataclass(frozen=True)
class Plan:
    """The promises of one folder, by whose name it goes. file: where they stand, from the project's root."""

    name: str
    file: Path
    promises: tuple[Promise, ...]


class Kind(StrEnum):
    """What an entry of the specification is."""

    RULE = "rule"
    FAULT = "fault"


@dataclass(frozen=True)
class Rule:
    """An entry of the specification. section: of the project book, or the page that says so."""

    id: str
    kind: Kind
    section: str
    text: str


@dataclass(frozen=True)
class Specification:
    """Rules and faults, and the file they stand in, from the project's root."""

    file: Path
    rules: tuple[Rule, ...]
