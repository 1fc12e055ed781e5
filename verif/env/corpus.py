"""Failing examples that were shrunk: small files that a bench replays before it draws anything.

`verif/units/<unit>/corpus/` and `verif/core/corpus/` hold one JSON file an example: which property, in which
parameter set, what was drawn, and why it is kept. A property that fails leaves its smallest example in
the folder of the run, `corpus/<digest>.json`; copying it beside the bench keeps it.
"""

import hashlib
import json
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from verif.env import codec, sources

NAME = "corpus"
"""Of the folder, beside a bench and in a run."""

_KEYS = ("property", "set", "why", "values")


class CorpusError(ValueError):
    """A file of a corpus is of no use; the text names it, what is wrong, and what to do."""


@dataclass(frozen=True)
class Entry:
    """One example. test: the property, a cocotb test by its name; parameter_set: of the unit, or build of the
    core; values: what was drawn, in order; why: what it once showed."""

    test: str
    parameter_set: str
    values: tuple[Any, ...]
    why: str

    @property
    def digest(self) -> str:
        """Names the file: the same example is the same file."""
        what = [self.test, self.parameter_set, codec.encode(self.values)]
        return hashlib.sha256(json.dumps(what).encode()).hexdigest()[:12]

    def text(self) -> str:
        """The file: a line a key, a line a value. Raises CodecError where a value has no JSON."""
        head = [f'  "{key}": {json.dumps(value)},' for key, value in self._head()]
        values = ",\n".join(f"    {json.dumps(codec.encode(value))}" for value in self.values)
        return "\n".join(["{", *head, '  "values": [', values, "  ]", "}", ""])

    def _head(self) -> list[tuple[str, str]]:
        return [("property", self.test), ("set", self.parameter_set), ("why", self.why)]


def folder(module: str) -> Path:
    """The corpus of a bench by the name of its module: beside the bench."""
    return sources.ROOT.joinpath(*module.split(".")[:-1], NAME)


def files(where: Path) -> tuple[Path, ...]:
    """The examples of a corpus; none where there is no such folder."""
    return tuple(sorted(where.glob("*.json")))


def read(path: Path) -> Entry:
    """One example. Raises CorpusError with a sentence where it cannot be used."""
    try:
        found = json.loads(path.read_text())
        missing = [key for key in _KEYS if key not in found]
        if missing:
            raise CorpusError(f"{path}: no {' and no '.join(missing)}; write it as {Entry.__module__} does")
        values = tuple(codec.decode(value) for value in found["values"])
    except (json.JSONDecodeError, codec.CodecError, TypeError) as error:
        raise CorpusError(
            f"{path}: {error}; mend the file, or delete it if nothing draws this any more"
        ) from error
    return Entry(found["property"], found["set"], values, found["why"])


def select(where: Path, name: str, parameter_set: str) -> list[tuple[Path, Entry]]:
    """The examples of one property in one parameter set. Raises CorpusError where any file is broken."""
    entries = [(path, read(path)) for path in files(where)]
    return [(path, one) for path, one in entries if (one.test, one.parameter_set) == (name, parameter_set)]


def keep(entry: Entry, where: Path) -> Path:
    """Writes an example into a folder; its file. Raises CodecError where a value has no JSON."""
    text = entry.text()
    where.mkdir(parents=True, exist_ok=True)
    path = where / f"{entry.digest}.json"
    path.write_text(text)
    return path


def check(where: Path, properties: Sequence[str], parameter_sets: Sequence[str]) -> None:
    """Raises CorpusError where an example is of no property, or of no parameter set, that there is."""
    for path in files(where):
        entry = read(path)
        if entry.test not in properties:
            raise CorpusError(f"{path}: there is no property {entry.test}; rename it, or delete the file")
        if entry.parameter_set not in parameter_sets:
            known = ", ".join(parameter_sets)
            raise CorpusError(
                f"{path}: there is no set {entry.parameter_set}, only {known}; or delete the file"
            )
