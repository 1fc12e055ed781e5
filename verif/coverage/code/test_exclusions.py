"""Exclusions leave out what they name and nothing else, and a stale one is told in a sentence."""

import datetime
from dataclasses import replace
from pathlib import Path

import pytest

from verif.coverage.code.exclusions import Exclusion, ExclusionError, Review, apply, design_texts, read
from verif.coverage.code.points import CodeCoverage, Hits, Kind, Point

_TODAY = datetime.date(2030, 1, 1)
_FILE = "hdl/a.v"
_TEXTS = {_FILE: ["wire [3:0] q = {1'b0, x};", "if (a && b) y <= 1'b1;", "wire [1:0] p, r;"]}

_TOP_BIT = Exclusion(
    _FILE,
    "q = {1'b0",
    (Kind.TOGGLE,),
    "constant",
    "me",
    datetime.date(2031, 1, 1),
    signal="q",
    bits=((3, 3),),
)


def _toggle(name: str, edge: str, line: int = 1) -> Point:
    return Point(_FILE, line, 5, Kind.TOGGLE, f"{name}:{edge}")


def _both(name: str, rises: int = 0, falls: int = 0, line: int = 1) -> dict[Point, Hits]:
    return {_toggle(name, "0->1", line): Hits(rises), _toggle(name, "1->0", line): Hits(falls)}


def _expression(what: str, count: int) -> dict[Point, Hits]:
    return {Point(_FILE, 2, 5, Kind.EXPRESSION, what): Hits(count)}


def _apply(exclusion: Exclusion, *points: dict[Point, Hits], whole: bool = True) -> Review:
    coverage = CodeCoverage({point: hits for some in points for point, hits in some.items()})
    return apply([exclusion], coverage, texts=_TEXTS, whole=whole, today=_TODAY)


def test_the_named_bit_is_left_out_and_no_other() -> None:
    review = _apply(_TOP_BIT, _both("q[3]"), _both("q[2]"), _both("p[3]", line=3))
    assert set(review.excluded) == set(_both("q[3]"))
    assert set(review.holes) == {*_both("q[2]"), *_both("p[3]", line=3)}
    assert not review.problems


def test_lines_are_found_by_their_text_wherever_they_are() -> None:
    texts = {_FILE: ["// one more line", *_TEXTS[_FILE]]}
    coverage = CodeCoverage(_both("q[3]", line=2))
    review = apply([_TOP_BIT], coverage, texts=texts, today=_TODAY)
    assert len(review.excluded) == 2
    assert not review.problems


def test_a_constant_one_that_rises_once_may_be_left_out() -> None:
    review = _apply(_TOP_BIT, _both("q[3]", rises=1))
    assert set(review.excluded) == {_toggle("q[3]", "1->0")}
    assert not review.problems


def test_a_pattern_means_many_files() -> None:
    assert len(_apply(replace(_TOP_BIT, file="hdl/**/*.v"), _both("q[3]")).excluded) == 2


def test_of_an_expression_what_is_left_is_left_out() -> None:
    exclusion = replace(_TOP_BIT, code="if (a", kinds=(Kind.EXPRESSION,), signal=None, bits=())
    review = _apply(exclusion, _expression("(a==1) => 1", 3), _expression("(a==0) => 0", 0))
    assert [point.what for point in review.excluded] == ["(a==0) => 0"]
    assert not review.problems


@pytest.mark.parametrize(
    ("exclusion", "points", "problem"),
    [
        (replace(_TOP_BIT, file="hdl/gone.v"), _both("q[3]"), "there is no such file"),
        (replace(_TOP_BIT, code="q = 4'd0"), _both("q[3]"), "no line holds this code"),
        (_TOP_BIT, _both("q[2]"), "there is no such point"),
        (_TOP_BIT, _both("q[3]", 1, 1), "all that it leaves out was hit"),
        (replace(_TOP_BIT, bits=((3, 2),)), {**_both("q[3]"), **_both("q[2]", 1, 1)}, r"q\[2\] was hit"),
        (replace(_TOP_BIT, review=datetime.date(2029, 12, 31)), _both("q[3]"), "reviewed by 2029-12-31"),
        (
            replace(_TOP_BIT, code="if", kinds=(Kind.EXPRESSION,), signal=None, bits=(), what="(a"),
            {**_expression("(a==1) => 1", 3), **_expression("(a==0) => 0", 0)},
            r"\(a==1\) => 1 was hit",
        ),
    ],
)
def test_a_stale_exclusion_is_told(exclusion: Exclusion, points: dict[Point, Hits], problem: str) -> None:
    review = _apply(exclusion, points)
    assert len(review.problems) == 1
    with pytest.raises(AssertionError, match=problem):
        raise AssertionError(review.problems[0])


def test_where_not_everything_was_run_an_exclusion_may_match_nothing() -> None:
    assert not _apply(_TOP_BIT, _both("q[2]"), whole=False).problems


_GOOD = {
    "types": '["toggle"]',
    "reason": '"constant"',
    "owner": '"me"',
    "review": "2031-01-01",
}
_PLACE = {"file": '"hdl/a.v"', "code": '"q ="', "signal": '"q"', "bits": '"3:2,0"'}


def _written(folder: Path, **changes: str | None) -> Path:
    changed = {**_GOOD, **{name: value for name, value in changes.items() if name not in _PLACE}}
    place = {name: changes.get(name, value) for name, value in _PLACE.items()}
    entry, places = (
        [f"{name} = {value}" for name, value in of.items() if value is not None] for of in (changed, place)
    )
    path = folder / "exclusions.toml"
    path.write_text("\n".join(["[[exclude]]", *entry, f"places = [{{ {', '.join(places)} }}]", ""]))
    return path


def test_an_entry_is_read(tmp_path: Path) -> None:
    (found,) = read(_written(tmp_path))
    assert found == replace(_TOP_BIT, code="q =", bits=((3, 2), (0, 0)))


@pytest.mark.parametrize(
    ("changes", "problem"),
    [
        ({"reason": None}, "has no reason"),
        ({"owner": '""'}, "has no owner"),
        ({"review": '"soon"'}, "is no date"),
        ({"types": '["fsm"]'}, "choose of line, branch, expr, toggle"),
        ({"bits": '"high"'}, "is not like"),
        ({"signal": None}, "name it in signal"),
        ({"line": "7"}, "line is no field"),
        ({"file": "hdl"}, "cannot be read"),
    ],
)
def test_a_wrong_entry_is_refused_with_file_field_and_remedy(
    changes: dict[str, str | None], problem: str, tmp_path: Path
) -> None:
    with pytest.raises(ExclusionError, match=rf"exclusions\.toml.*{problem}"):
        read(_written(tmp_path, **changes))


def test_the_code_that_the_project_leaves_out_is_in_the_design() -> None:
    texts = design_texts()
    for exclusion in read():
        lines = [line for file in texts if exclusion.concerns(file) for line in texts[file]]
        assert any(exclusion.code in line for line in lines), str(exclusion)
