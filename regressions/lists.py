"""The lists: which tests, how often, how long. Each is a TOML file in `regressions/lists/`.

    about = "what it is for"
    [[entry]]
    name = "units"              # unique in the list
    kind = "unit"               # unit, core, pytest or module
    tests = ["div*"]            # what of that kind; `*` and `?` match
    sets = ["*"]                # parameter sets of a unit
    builds = ["default"]        # builds of the core
    simulators = ["verilator"]
    seeds = 2                   # runs of each test, each with a seed of its own
    examples = 50               # Hypothesis examples a property
    operands = 5000             # of a fast stream
    wall_minutes = 10           # limits of one run
    simulated_ms = 50
    each = true                 # of `pytest`: every test is a run of its own

`tests` are units of `verif/units`; cases of `verif/core/cases.py`; files, folders or tests that pytest takes;
or a module that Python runs with its arguments, as `verif.mutation {unit}`, which is run for each unit.
`except` takes some of them out.
"""

import tomllib
from dataclasses import MISSING, dataclass, fields
from enum import StrEnum
from pathlib import Path
from typing import Any

from verif.env.simulators import Simulator

LISTS = Path(__file__).parent / "lists"

MOST_SEEDS = 10_000


class Kind(StrEnum):
    """What an entry's tests are."""

    UNIT = "unit"
    CORE = "core"
    PYTEST = "pytest"
    MODULE = "module"


class ListError(ValueError):
    """A wrong list or choice; the text is the whole message."""


@dataclass(frozen=True)
class Entry:
    """Tests that are run alike, see above. operands and simulated_ms: None for the bench's own, no limit."""

    name: str
    kind: Kind
    tests: tuple[str, ...]
    without: tuple[str, ...] = ()
    sets: tuple[str, ...] = ("*",)
    builds: tuple[str, ...] = ("*",)
    simulators: tuple[Simulator, ...] = tuple(Simulator)
    seeds: int = 1
    examples: int | None = None
    operands: int | None = None
    wall_minutes: float = 10.0
    simulated_ms: float | None = None
    each: bool = False


@dataclass(frozen=True)
class RunList:
    """A list by its name. path: relative to the project, for messages."""

    name: str
    path: str
    about: str
    entries: tuple[Entry, ...]


_OF_KINDS = {
    "sets": (Kind.UNIT,),
    "builds": (Kind.CORE,),
    "simulators": (Kind.UNIT, Kind.CORE),
    "examples": (Kind.UNIT, Kind.CORE),
    "operands": (Kind.UNIT,),
    "each": (Kind.PYTEST,),
    "simulated_ms": (Kind.UNIT, Kind.CORE, Kind.PYTEST),
}
"""Fields that only some kinds have."""

_LOWEST = {"seeds": 1, "examples": 1, "operands": 1, "wall_minutes": 0, "simulated_ms": 0}


def names() -> tuple[str, ...]:
    """The lists there are."""
    return tuple(sorted(path.stem for path in LISTS.glob("*.toml")))


def load(name: str) -> RunList:
    """A list by its name, or by the path of a file elsewhere. Raises ListError."""
    path = Path(name) if name.endswith(".toml") else LISTS / f"{name}.toml"
    if not path.is_file():
        raise ListError(f"LIST={name}: there is no such list; choose one of {', '.join(names())}")
    try:
        table = tomllib.loads(path.read_text())
    except tomllib.TOMLDecodeError as error:
        raise ListError(f"{path}: is not TOML: {error}") from None
    for key in sorted(table.keys() - {"about", "entry"}):
        raise ListError(f"{path}: {key} is no field of a list; it has about and entry")
    if not isinstance(table.get("about"), str):
        raise ListError(f"{path}: about is missing; say in a sentence what the list is for")
    entries = table.get("entry")
    if not isinstance(entries, list) or not entries:
        raise ListError(f"{path}: holds no [[entry]]; a list of nothing would always pass")
    return RunList(
        path.stem,
        str(path),
        table["about"],
        _distinct(path, tuple(_entry(path, *e) for e in enumerate(entries))),
    )


def _distinct(path: Path, entries: tuple[Entry, ...]) -> tuple[Entry, ...]:
    found = [entry.name for entry in entries]
    for name in found:
        if found.count(name) > 1:
            raise ListError(f"{path}: entry {name}: name is there twice; choose another")
    return entries


def _entry(path: Path, number: int, table: dict[str, Any]) -> Entry:
    at = f"{path}: entry {table.get('name', number + 1)}"
    known = {"except" if field.name == "without" else field.name: field for field in fields(Entry)}
    for key in sorted(table.keys() - known.keys()):
        raise ListError(f"{at}: {key} is no field; choose of {', '.join(known)}")
    for key, field in known.items():
        if field.default is MISSING and key not in table:
            raise ListError(f"{at}: {key} is missing")
    values = {known[key].name: _value(f"{at}: {key}", key, value) for key, value in table.items()}
    entry = Entry(**values)
    for key, kinds in _OF_KINDS.items():
        if key in table and entry.kind not in kinds:
            raise ListError(f"{at}: {key} is not for kind {entry.kind}; leave it out")
    return entry


def _value(at: str, key: str, value: Any) -> Any:
    if key == "name":
        if not isinstance(value, str) or not value.replace("_", "").isalnum():
            raise ListError(f"{at} is {value!r}; use letters, digits and _")
        return value
    if key == "kind":
        return _member(at, value, Kind)
    if key == "each":
        if not isinstance(value, bool):
            raise ListError(f"{at} is {value!r}; write true or false")
        return value
    if key in _LOWEST:
        return _number(at, key, value)
    if not isinstance(value, list) or not value or not all(isinstance(item, str) and item for item in value):
        raise ListError(f"{at} is {value!r}; write a list of texts")
    return tuple(_member(at, item, Simulator) if key == "simulators" else item for item in value)


def _member(at: str, value: Any, form: type[StrEnum]) -> StrEnum:
    if value not in list(form):
        raise ListError(f"{at} is {value!r}; choose one of {', '.join(form)}")
    return form(value)


def _number(at: str, key: str, value: Any) -> int | float:
    whole = key in ("seeds", "examples", "operands")
    if type(value) not in ((int,) if whole else (int, float)):
        raise ListError(f"{at} is {value!r}; write a {'whole ' if whole else ''}number")
    least = _LOWEST[key]
    if value < least or (value == least and not whole):
        raise ListError(f"{at} is {value}; write {'at least' if whole else 'more than'} {least}")
    if key == "seeds" and value > MOST_SEEDS:
        raise ListError(f"{at} is {value}; write at most {MOST_SEEDS}")
    found: int | float = value
    return found
