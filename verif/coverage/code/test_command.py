"""The command: what it shows of what was kept, and how it ends."""

from pathlib import Path

import pytest

from verif.coverage.code import __main__ as command
from verif.coverage.code import collect, exclusions
from verif.coverage.code.points import CodeCoverage, Hits, Kind, Point, digest_of
from verif.env.simulators import mended_counters

_FILE = "hdl/arith/sqrt.v"
_LINE = 1 + exclusions.design_texts()[_FILE].index("            wire [k:0] r;")


@pytest.fixture(autouse=True)
def _folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(collect, "FOLDER", tmp_path)
    monkeypatch.setattr(collect, "MERGED", tmp_path / "code.json")
    monkeypatch.setattr(collect, "_RUNS", tmp_path / "code")
    monkeypatch.setattr(exclusions, "FILE", tmp_path / "exclusions.toml")
    exclusions.FILE.write_text("")


def _keep(name: str, rises: int, falls: int) -> None:
    edges = {"0->1": rises, "1->0": falls}
    points = {
        Point(_FILE, _LINE, 24, Kind.TOGGLE, f"r[0]:{edge}"): Hits(count, frozenset({name} if count else ()))
        for edge, count in edges.items()
    }
    collect.keep(name, CodeCoverage(points, frozenset({name}), {_FILE: digest_of(_FILE) or ""}))


def test_a_hole_is_exit_code_1_and_shown_with_its_line(capsys: pytest.CaptureFixture[str]) -> None:
    _keep("sqrt-narrow", 3, 0)
    assert command.main(["report"]) == 1
    *_, total, last = capsys.readouterr().out.splitlines()
    assert total == "1 of 2 points, 0 excluded (0.00 %): 50.00 %"
    assert last == "not hit: 1 points, which `report --holes` lists"
    command.main(["report", "--holes", "sqrt"])
    assert capsys.readouterr().out.splitlines() == [
        f"{_FILE}:{_LINE}: wire [k:0] r;",
        "    toggle r[0] 1->0",
    ]


def test_what_one_run_misses_another_may_hit() -> None:
    _keep("sqrt-narrow", 3, 0)
    _keep("sqrt-default", 0, 1)
    assert command.main(["report"]) == 0


def test_a_run_that_is_kept_again_replaces_what_it_hit() -> None:
    _keep("sqrt-narrow", 3, 1)
    _keep("sqrt-narrow", 3, 0)
    assert command.main(["report"]) == 1


def test_a_stale_exclusion_is_exit_code_1(capsys: pytest.CaptureFixture[str]) -> None:
    _keep("sqrt-narrow", 3, 1)
    exclusions.FILE.write_text(
        '[[exclude]]\nreason = "none"\nowner = "me"\nreview = 2999-01-01\ntypes = ["toggle"]\n'
        f'places = [{{ file = "{_FILE}", code = "wire [k:0] r;" }}]\n'
    )
    assert command.main(["report"]) == 1
    assert "stale exclusion: hdl/arith/sqrt.v, `wire [k:0] r;`: all that it" in capsys.readouterr().err


def test_exports_are_written(tmp_path: Path) -> None:
    _keep("sqrt-narrow", 3, 1)
    info, xml = tmp_path / "code.info", tmp_path / "code.xml"
    assert command.main(["export", "--lcov", str(info), "--ucis", str(xml)]) == 0
    assert f"SF:{_FILE}" in info.read_text()
    assert f'fileName="{_FILE}"' in xml.read_text()


@pytest.mark.parametrize(
    ("words", "problem"),
    [
        (["report"], "holds no code coverage; run `collect` first"),
        (["collect", "--units", "root"], "--units root: no unit is called root"),
        (["report", "--holes", "nothing"], "--holes nothing: is no file of hdl/ and no module"),
    ],
)
def test_a_wrong_request_is_one_sentence_and_exit_code_2(
    words: list[str], problem: str, capsys: pytest.CaptureFixture[str]
) -> None:
    if "nothing" in words:
        _keep("sqrt-narrow", 3, 1)
    assert command.main(words) == 2
    error = capsys.readouterr().err
    assert problem in error
    assert error.count("\n") == 1


def _hit(coverage: CodeCoverage, signal: str, edge: str) -> bool:
    return any(hits.count for point, hits in coverage.points.items() if point.what == f"{signal}:{edge}")


def test_a_run_counts_in_the_design_and_is_kept() -> None:
    """On a real build: every kind of point, and the design alone."""
    assert collect.collect_one("counters-default").complaint == ""
    coverage = collect.merged()
    lines = coverage.of_lines("hdl/counters.v")
    assert all(hits.tests == {"counters-default"} for hits in lines.values() if hits.count)
    assert {point.kind for point in coverage.points} == set(Kind)
    assert {point.file for point in coverage.points} == {"hdl/counters.v"}
    assert all(_hit(coverage, "tests[31]", edge) for edge in ("0->1", "1->0"))


def test_toggles_of_a_wide_signal_count_for_their_own_bit_alone() -> None:
    """Tests of two trace units are 0 to 2 in a clock, all other events 0 or 1: 160 bits side by side."""
    collect.collect_one("counters-default")
    coverage = collect.merged()
    toggled = {bit for bit in range(160) if _hit(coverage, f"step[{bit}]", "0->1")}
    assert toggled == {0, 1, 32, 64, 96, 128}


def test_a_loop_over_the_bits_of_a_word_ends_with_the_word() -> None:
    """Verilator's own goes on into the words above, which is mended in the builds."""
    loops = [line for line in mended_counters().splitlines() if "j < " in line]
    assert loops
    assert all("j < VL_EDATASIZE" in line for line in loops)
