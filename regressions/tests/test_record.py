"""The record: nothing is lost on its way through JSON, and no other file passes for one."""

import json
from dataclasses import replace
from pathlib import Path

import pytest

from regressions import record
from regressions.record import RecordError
from regressions.tests.whole import RECORD


def test_a_record_is_the_same_after_json(tmp_path: Path) -> None:
    """With every section filled."""
    record.write(RECORD, tmp_path / "record.json")
    assert record.read(tmp_path / "record.json") == RECORD


def test_a_record_names_nothing_of_one_machine(tmp_path: Path) -> None:
    """Paths are relative to the project."""
    assert not any(result.folder.startswith("/") for result in RECORD.results)


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"schema": 0}, "schema 0 is not 1"),
        ({"seed": "1"}, r"record.seed: is not of type int"),
        ({"results": {}}, r"record.results: is not a list"),
        ({"results": [{}]}, r"record.results\[0\].arguments|record.results\[0\].command: is missing"),
        ({"plans": []}, r"record.plans: is no field of Record"),
        (
            {"coverage": [{"name": "a", "points": [{"name": 1}]}]},
            r"record.coverage\[0\].points\[0\].bins: is missing",
        ),
    ],
)
def test_what_is_no_record_is_refused_with_its_place(
    tmp_path: Path, change: dict[str, object], sentence: str
) -> None:
    """And with what to do."""
    path = tmp_path / "record.json"
    record.write(RECORD, path)
    path.write_text(json.dumps({**json.loads(path.read_text()), **change}))
    with pytest.raises(RecordError, match=f"{sentence}.*run the regression again"):
        record.read(path)


@pytest.mark.parametrize("text", ["", "[]", "{"])
def test_other_files_are_refused(tmp_path: Path, text: str) -> None:
    """They are no JSON, or no record."""
    (tmp_path / "record.json").write_text(text)
    with pytest.raises(RecordError, match="run the regression again"):
        record.read(tmp_path / "record.json")


def test_nothing_and_anything_but_passed_is_no_pass() -> None:
    """A regression of no runs has not passed."""
    assert not RECORD.passed
    assert not replace(RECORD, results=()).passed
    assert replace(RECORD, results=RECORD.results[:1]).passed
