"""Reads plans and the specification from TOML. What cannot be read is a PlanError of one sentence."""

import tomllib
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from verif.env.sources import ROOT
from verif.plan.records import Kind, NamedTest, Plan, PlanError, Promise, Rule, Specification

PLAN, SPECIFICATION = "plan.toml", Path("verif/plan/specification.toml")
FOLDERS = ("verif", "regressions")
"""Where plans are looked for."""

_BENCH = "bench"
"""Module of a folder that holds the tests whose entry names no other."""


def _tables(root: Path, file: Path, *kinds: str) -> Iterator[tuple[str, str, Mapping[str, Any]]]:
    """Kind, place and fields of each table of a file that holds arrays of tables of these kinds only."""
    try:
        content = tomllib.loads((root / file).read_text())
    except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
        raise PlanError(f"{file}: cannot be read: {error}; correct the file") from error
    for key, tables in content.items():
        if key not in kinds or not isinstance(tables, list):
            wanted = " or ".join(f"[[{kind}]]" for kind in kinds)
            raise PlanError(f"{file}: {key}: is no table of a plan; write {wanted}")
        for number, table in enumerate(tables, 1):
            yield key, f"{file}: {table.get('id', f'{key} {number}')}", table


def _known(place: str, table: Mapping[str, Any], fields: Sequence[str]) -> None:
    for name in table:
        if name not in fields:
            raise PlanError(f"{place}: {name}: there is no such field; use {', '.join(fields)}")


def _text(place: str, table: Mapping[str, Any], name: str) -> str:
    value = table.get(name)
    if not isinstance(value, str) or not value.strip():
        raise PlanError(f"{place}: {name}: is missing or no text; write it in quotes")
    return " ".join(value.split())


def _texts(place: str, table: Mapping[str, Any], name: str) -> tuple[str, ...]:
    value = table.get(name, [])
    if not isinstance(value, list) or not all(isinstance(item, str) and item for item in value):
        raise PlanError(f'{place}: {name}: is no list of texts; write ["..."]')
    return tuple(value)


def named_test(entry: str, folder: Path) -> NamedTest:
    """The test that an entry means in the plan of a folder.

    `name` is one of its `bench.py`, `module::name` one of another bench, `path/test_file.py::name` of pytest.
    """
    where, _, name = entry.rpartition("::")
    if where.endswith(".py"):
        return NamedTest(where, name)
    return NamedTest(".".join((*folder.parts, where or _BENCH)), name)


def _promise(place: str, table: Mapping[str, Any], folder: Path) -> Promise:
    _known(place, table, ("id", "what", "tests", "covers", "rules"))
    return Promise(
        _text(place, table, "id"),
        _text(place, table, "what"),
        tuple(named_test(entry, folder) for entry in _texts(place, table, "tests")),
        _texts(place, table, "covers"),
        _texts(place, table, "rules"),
    )


def read_plan(root: Path, file: Path) -> Plan:
    """One plan; ``file`` from the project's root. Raises PlanError."""
    folder = file.parent
    tables = _tables(root, file, "promise")
    return Plan(folder.name, file, tuple(_promise(place, table, folder) for _, place, table in tables))


def read_plans(root: Path = ROOT) -> tuple[Plan, ...]:
    """Every plan of the project, by file. Raises PlanError."""
    files = sorted(path.relative_to(root) for folder in FOLDERS for path in (root / folder).rglob(PLAN))
    return tuple(read_plan(root, file) for file in files)


def read_specification(root: Path = ROOT, file: Path = SPECIFICATION) -> Specification:
    """The rules and faults. Raises PlanError."""
    rules = []
    for kind, place, table in _tables(root, file, *Kind):
        _known(place, table, ("id", "section", "text"))
        texts = (_text(place, table, name) for name in ("id", "section", "text"))
        rule_id, section, text = texts
        rules.append(Rule(rule_id, Kind(kind), section, text))
    return Specification(file, tuple(rules))
