"""The judge in a simulation: mutants of a small unit, judged by its own bench and by ones of no use."""

from dataclasses import replace
from pathlib import Path

import pytest

from verif.env import run
from verif.mutation import qualify as qualification
from verif.mutation import record
from verif.mutation.judge import JudgeError
from verif.mutation.netlist import NetlistError
from verif.mutation.qualify import Plan, known, qualify
from verif.mutation.record import Result, Status, Verdict

_UNIT = "colour_add"


@pytest.fixture(scope="module")
def result() -> Result:
    """Of the unit's own bench."""
    return qualify(Plan(_UNIT, mutants=20))


def test_the_units_own_bench_kills_its_mutants(result: Result) -> None:
    assert len(result.mutants) == 20
    assert result.good


def test_every_mutant_names_its_line_and_every_killed_one_its_test(result: Result) -> None:
    assert all(one.mutant.source.startswith("hdl/") and one.mutant.text for one in result.mutants)
    assert all(one.test for one in result.mutants if one.status is not Status.SURVIVED)


def test_a_blind_bench_leaves_survivors_and_the_solver_shows_them() -> None:
    blind = qualify(Plan(_UNIT, mutants=12, bench="verif.mutation.tests.blind_bench", again=False))
    assert blind.killed == 0
    assert blind.count(Verdict.SHOWN) >= 8
    assert all(one.witness for one in blind.mutants if one.verdict is Verdict.SHOWN)
    assert not blind.good


def test_a_bench_that_fails_without_a_mutant_judges_nothing() -> None:
    with pytest.raises(JudgeError, match="without a mutant, nothing_is_right"):
        qualify(Plan(_UNIT, mutants=4, bench="verif.mutation.tests.failing_bench"))


def test_mutants_are_judged_wherever_a_regression_keeps_its_runs(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setenv(run.RUNS, str(tmp_path))
    few = qualify(Plan(_UNIT, mutants=3, again=False))
    assert [path.name for path in tmp_path.iterdir()] == [f"mutation-{_UNIT}-default-3-1"]
    assert [one.mutant.number for one in few.mutants] == [1, 2, 3]


def test_a_setting_about_no_port_is_refused_by_name(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    settings = tmp_path / "settings.toml"
    settings.write_text(f'[{_UNIT}]\nonly_with = {{ out = "out_vald" }}\n')
    monkeypatch.setattr(qualification, "SETTINGS", settings)
    with pytest.raises(NetlistError, match=r"settings\.toml: colour_add: only_with: out_vald is no port"):
        qualify(Plan(_UNIT, mutants=12, bench="verif.mutation.tests.blind_bench", again=False))


def test_a_result_is_known_until_something_that_it_depends_on_changes(
    result: Result, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(record, "read", lambda _: result)
    assert known(Plan(_UNIT, mutants=20)) is result
    assert known(Plan(_UNIT, mutants=21)) is None
    changed = replace(result, inputs={**result.inputs, "hdl/shade/colour_add.v": "another"})
    monkeypatch.setattr(record, "read", lambda _: changed)
    assert known(Plan(_UNIT, mutants=20)) is None


def test_results_depend_on_the_design_the_bench_and_the_model(result: Result) -> None:
    needed = {
        "hdl/shade/colour_add.v",
        f"verif/units/{_UNIT}/bench.py",
        "verif/env/pipelined.py",
        "models/fixed.py",
    }
    assert needed <= result.inputs.keys()


def test_a_result_is_read_as_it_was_written(
    result: Result, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(record, "FOLDER", tmp_path)
    record.write(result)
    assert record.read(_UNIT) == result
