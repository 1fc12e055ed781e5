"""Explanations of survivors: complete, and never longer than they are true."""

import datetime
from pathlib import Path

import pytest

from verif.mutation.explained import FILE, ExplanationError, Explanations
from verif.mutation.record import Judged, Mutant, Result, Status, Verdict

_DAY = datetime.date(2026, 1, 1)
_TEXT = """
[[survivor]]
unit = "fifo"
line = "assign full = 1'b0;"
reason = "no consumer looks at it"
owner = "flow"
review = 2027-01-01
"""


def _result(status: Status = Status.SURVIVED) -> Result:
    mutant = Mutant(1, "inv", "A[0] of $and", "hdl/flow/fifo.v:1", "assign full = 1'b0;")
    verdict = Verdict.SHOWN if status is Status.SURVIVED else None
    return Result("fifo", "default", (Judged(mutant, status, verdict=verdict),), 0.0)


def _read(tmp_path: Path, text: str) -> Explanations:
    file = tmp_path / "explained.toml"
    file.write_text(text)
    return Explanations.read(file)


def test_a_survivor_is_explained_by_unit_and_line(tmp_path: Path) -> None:
    result = _result()
    found = _read(tmp_path, _TEXT)
    assert found.of("fifo", result.survivors[0]) == "no consumer looks at it"
    assert found.of("merge", result.survivors[0]) == ""
    assert found.stale([result], _DAY) == []


def test_a_place_narrows_an_explanation(tmp_path: Path) -> None:
    found = _read(tmp_path, _TEXT + 'place = "B[0]"\n')
    assert found.of("fifo", _result().survivors[0]) == ""


def test_an_explanation_of_a_killed_mutant_is_stale(tmp_path: Path) -> None:
    (line,) = _read(tmp_path, _TEXT).stale([_result(Status.KILLED)], _DAY)
    assert "no mutant survives there" in line


def test_an_explanation_is_reviewed_in_time(tmp_path: Path) -> None:
    (line,) = _read(tmp_path, _TEXT).stale([_result()], datetime.date(2027, 1, 2))
    assert "to be reviewed since 2027-01-01" in line


@pytest.mark.parametrize("key", ["unit", "line", "reason", "owner", "review"])
def test_an_explanation_says_everything(tmp_path: Path, key: str) -> None:
    lines = [line for line in _TEXT.splitlines() if not line.startswith(key)]
    with pytest.raises(ExplanationError, match=f"has no {key}"):
        _read(tmp_path, "\n".join(lines))


def test_the_projects_own_explanations_can_be_read() -> None:
    assert all(entry.reason for entry in Explanations.read(FILE).entries)
