"""Reading Verilator's file: every line exactly, replicas together, the design alone."""

from pathlib import Path

import pytest

from verif.coverage.code.points import CodeCoverage, Hits, Kind, Point
from verif.coverage.code.reader import CoverageError, read, sinks
from verif.env import sources

_SQRT = sources.HDL / "arith" / "sqrt.v"


def _line(
    kind: str, what: str, count: int, file: Path = _SQRT, instance: str = "top.a", span: str = ""
) -> str:
    keys = {
        "f": str(file),
        "l": "76",
        "n": "13",
        "t": kind,
        "page": "v/sqrt",
        "o": what,
        "S": span,
        "h": instance,
    }
    body = "".join(f"\x01{key}\x02{value}" for key, value in keys.items() if value)
    return f"C '{body}' {count}\n"


def _read(folder: Path, *lines: str) -> CodeCoverage:
    path = folder / "coverage.dat"
    path.write_text("# SystemC::Coverage-3\n" + "".join(lines))
    return read(path, "sqrt-default")


def _point(kind: Kind, what: str) -> Point:
    return Point("hdl/arith/sqrt.v", 76, 13, kind, what)


@pytest.mark.parametrize("kind", list(Kind))
def test_each_kind_is_read(kind: Kind, tmp_path: Path) -> None:
    what = "q[3]:0->1" if kind is Kind.TOGGLE else "(a==1 && b=='h2) => 1"
    found = _read(tmp_path, _line(kind, what, 7, span="76,78-79"))
    hits = Hits(7, frozenset({"sqrt-default"}), frozenset({76, 78, 79}))
    assert found.points == {_point(kind, what): hits}


def test_instances_count_together(tmp_path: Path) -> None:
    lines = (_line("branch", "if", 2), _line("branch", "if", 3, instance="top.b"))
    assert [hits.count for hits in _read(tmp_path, *lines).points.values()] == [5]


def test_iterations_of_a_generate_loop_count_together_and_elements_of_an_array_do_not(tmp_path: Path) -> None:
    names = ("g[1].q[0]:0->1", "g[2].q[0]:0->1", "word[1][0]:0->1", "word[2][0]:0->1")
    found = _read(tmp_path, *(_line("toggle", name, 1) for name in names))
    assert [point.what for point in found.points] == ["g.q[0]:0->1", "word[1][0]:0->1", "word[2][0]:0->1"]


def test_an_expression_is_the_same_at_every_width(tmp_path: Path) -> None:
    names = [f"(r[(S + 32'sh1)[{top}:0]{offset}+:1]==0) => 0" for top in (2, 4) for offset in ("", " + 1")]
    assert len(_read(tmp_path, *(_line("expr", name, 1) for name in names)).points) == 2


def test_a_test_that_hits_nothing_is_not_among_those_that_hit(tmp_path: Path) -> None:
    assert _read(tmp_path, _line("line", "block", 0)).points[_point(Kind.LINE, "block")] == Hits(0)


def test_testbenches_and_copies_are_not_the_design(tmp_path: Path) -> None:
    others = (sources.VERIF / "core" / "core_tb.v", sources.ROOT / "build" / "sim" / "x" / "harness.v")
    assert not _read(tmp_path, *(_line("line", "block", 1, file=file) for file in others)).points


def test_sinks_of_unused_bits_are_not_the_design() -> None:
    text = "wire a;\n\n wire unused_a = &{1'b0, a};\nwire unused_b =\n  &{1'b0,\n  b};\nwire unused_c = c;\n"
    assert sinks(text) == {3, 4, 5, 6}


def test_signals_that_nothing_reads_are_not_the_design(tmp_path: Path) -> None:
    names = ("unused_valid:0->1", "g[1].unused_rest[3]:1->0", "used:0->1")
    found = _read(tmp_path, *(_line("toggle", name, 0) for name in names))
    assert [point.what for point in found.points] == ["used:0->1"]


def test_points_of_a_sink_are_not_read(tmp_path: Path) -> None:
    text = _SQRT.with_name("sqrt_step.v").read_text()
    (number,) = sinks(text)
    assert "unused_top" in text.splitlines()[number - 1]
    line = _line("toggle", "unused_top:0->1", 0, file=_SQRT.with_name("sqrt_step.v"))
    assert not _read(tmp_path, line.replace("\x0276", f"\x02{number}")).points


@pytest.mark.parametrize("text", ["C 'nonsense\n", "hello\n", "C '\x01t\x02line' 3\n", _line("fsm", "a", 1)])
def test_another_text_is_refused_with_its_file(text: str, tmp_path: Path) -> None:
    with pytest.raises(CoverageError, match=r"coverage\.dat"):
        _read(tmp_path, text)


def test_a_missing_file_is_refused_with_the_likely_cause(tmp_path: Path) -> None:
    with pytest.raises(CoverageError, match="was the build made with coverage"):
        read(tmp_path / "coverage.dat", "a")
