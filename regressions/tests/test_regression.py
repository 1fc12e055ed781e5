"""Whole regressions: the record is there however they end, and what failed can be run again."""

import os
import signal
from collections.abc import Sequence
from pathlib import Path
from threading import Timer

import pytest

from regressions import record, regression, sections
from regressions.__main__ import main
from regressions.__main__ import run_order as run
from regressions.record import Record, Result, Status
from regressions.regression import Order
from regressions.tests.planned import of_python

_FAILING = "raise SystemExit('sum is 3')"


@pytest.fixture(autouse=True)
def _apart(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Regressions in a folder of the test's, without what others measured."""
    monkeypatch.setattr(regression, "FOLDER", tmp_path)
    monkeypatch.setattr(sections, "added", lambda found, _root: found)


def _order(planned: Sequence[Result], jobs: int = 2) -> Order:
    return Order("tried", 1, tuple(planned), jobs)


def _latest(tmp_path: Path) -> Record:
    return record.read(tmp_path / "latest" / "record.json")


def test_a_regression_that_passes_ends_with_0_and_leaves_record_summary_and_junit(tmp_path: Path) -> None:
    """In the order of the plan, each run in a folder of its own."""
    planned = [of_python(name, f"print('{name}')") for name in ("a", "b", "c")]
    assert run(_order(planned)) == 0
    found = _latest(tmp_path)
    assert [result.id for result in found.results] == ["a", "b", "c"]
    assert len({result.folder for result in found.results}) == 3
    assert found.seed == 1 and found.tools["cocotb"]
    assert not found.interrupted
    files = {path.name for path in (tmp_path / "latest").iterdir()}
    assert {"record.json", "summary.md", "junit.xml"} <= files


def test_one_failure_ends_with_1_and_its_command_is_shown(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Equal failures are one bucket."""
    planned = [of_python("a", "pass"), of_python("b", _FAILING), of_python("c", _FAILING)]
    assert run(_order(planned)) == 1
    told = capsys.readouterr()
    assert "2 x sum is #\n    python -c b" in told.out
    assert "3/3 done" in told.err
    (bucket,) = _latest(tmp_path).buckets
    assert bucket.results == ("b", "c")


def test_ctrl_c_leaves_a_record_of_what_ran_and_what_did_not(tmp_path: Path) -> None:
    """The run of that moment and all after it have not run."""
    planned = [of_python("a", "pass"), *(of_python(name, "import time; time.sleep(600)") for name in "bc")]
    Timer(3.0, os.kill, (os.getpid(), signal.SIGINT)).start()
    assert run(_order(planned, jobs=1)) == 1
    found = _latest(tmp_path)
    assert found.interrupted
    assert [result.status for result in found.results] == [Status.PASSED, Status.NOT_RUN, Status.NOT_RUN]
    assert all("interrupted" in result.message for result in found.results[1:])


def test_failed_runs_are_run_again_with_their_seeds(tmp_path: Path) -> None:
    """And only they; a run is chosen by its name too."""
    assert run(_order([of_python("a", "pass"), of_python("b", _FAILING)])) == 1
    first = _latest(tmp_path)
    assert main(["rerun", "--failed"]) == 1
    again = _latest(tmp_path)
    assert [(result.id, result.seed) for result in again.results] == [("b", first.results[1].seed)]
    assert again.id != first.id and again.list == "tried-again"
    assert main(["rerun", "a", "--of", first.id]) == 0
    assert main(["rerun", "--failed"]) == 0


def test_the_summary_of_a_regression_is_shown(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """With its verdict as exit code."""
    run(_order([of_python("a", _FAILING)]))
    assert main(["show"]) == 1
    assert "# tried: failed" in capsys.readouterr().out


def test_a_run_whose_build_fails_has_not_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The others have; the message is the compiler's."""
    monkeypatch.setattr(
        regression, "without_build", lambda *_arguments: {"a": "add_sub does not build for icarus"}
    )
    assert run(_order([of_python("a", "pass"), of_python("b", "pass")])) == 1
    first, second = _latest(tmp_path).results
    assert (first.status, first.message) == (Status.NOT_RUN, "add_sub does not build for icarus")
    assert second.status is Status.PASSED


def test_a_section_that_cannot_be_made_is_a_note(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What ran is not lost for it."""

    def broken(_record: Record, _root: Path) -> Record:
        raise ZeroDivisionError("no bins")

    monkeypatch.undo()
    monkeypatch.setattr(regression, "FOLDER", tmp_path)
    monkeypatch.setattr(sections, "_SECTIONS", (broken,))
    assert run(_order([of_python("a", "pass")])) == 0
    (note,) = _latest(tmp_path).notes
    assert "no bins" in note


@pytest.mark.parametrize("words", [["list"], ["list", "smoke"]])
def test_lists_and_their_runs_are_listed(words: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    """By name, and by id."""
    assert main(words) == 0
    told = capsys.readouterr().out
    assert ("nightly" if len(words) == 1 else "units.sqrt-default-verilator.0") in told
