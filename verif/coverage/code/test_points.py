"""Code coverage as data: merging is the same in any order, and JSON keeps all."""

from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from verif.coverage.code.points import CodeCoverage, Hits, Kind, Point, digest_of, from_json, merge, to_json

_FILES = ("hdl/arith/sqrt.v", "hdl/arith/div.v")
_TESTS = ("sqrt-default", "sqrt-narrow", "core")

_points = st.builds(
    Point,
    file=st.sampled_from(_FILES),
    line=st.integers(1, 4),
    column=st.integers(1, 2),
    kind=st.sampled_from(list(Kind)),
    what=st.sampled_from(["if", "a==1 => 0", "q[3]:0->1"]),
)


@st.composite
def _coverages(draw: st.DrawFn) -> CodeCoverage:
    tests = draw(st.frozensets(st.sampled_from(_TESTS), min_size=1))
    hits = st.builds(
        Hits,
        count=st.integers(0, 5),
        tests=st.frozensets(st.sampled_from(sorted(tests))),
        lines=st.frozensets(st.integers(1, 9)),
    )
    points = draw(st.dictionaries(_points, hits, max_size=6))
    return CodeCoverage(points, tests, {point.file: f"digest of {point.file}" for point in points})


@given(_coverages(), _coverages())
def test_merging_is_the_same_in_either_order(one: CodeCoverage, other: CodeCoverage) -> None:
    assert merge([one, other]) == merge([other, one])


@given(_coverages(), _coverages(), _coverages())
def test_merging_is_the_same_in_any_grouping(a: CodeCoverage, b: CodeCoverage, c: CodeCoverage) -> None:
    assert merge([merge([a, b]), c]) == merge([a, merge([b, c])]) == merge([a, b, c])


@given(_coverages())
def test_merging_with_nothing_changes_nothing(coverage: CodeCoverage) -> None:
    assert merge([coverage, CodeCoverage()]) == coverage


@given(_coverages())
def test_json_keeps_everything(coverage: CodeCoverage) -> None:
    assert from_json(to_json(coverage)) == coverage


def _one(count: int, test: str, kind: Kind = Kind.LINE, lines: frozenset[int] = frozenset()) -> CodeCoverage:
    point = Point(_FILES[0], 3, 1, kind, "block")
    hits = Hits(count, frozenset({test} if count else ()), lines)
    return CodeCoverage({point: hits}, frozenset({test}), {_FILES[0]: "same"})


def test_hits_add_up_and_points_are_united() -> None:
    extra = Point(_FILES[1], 1, 1, Kind.BRANCH, "if")
    other = replace(_one(2, "b"), points={**_one(2, "b").points, extra: Hits(0)})
    merged = merge([_one(3, "a"), other])
    assert [hits.count for hits in merged.points.values()] == [5, 0]
    assert merged.points[extra] == Hits(0)


def test_a_line_knows_the_tests_that_hit_it() -> None:
    lines = frozenset({3, 4})
    merged = merge([_one(3, "a", lines=lines), _one(0, "b", lines=lines), _one(1, "c", lines=lines)])
    found = merged.of_lines(_FILES[0])
    assert list(found) == [3, 4]
    assert found[4] == Hits(4, frozenset({"a", "c"}))


def test_toggles_say_nothing_of_a_line() -> None:
    assert _one(3, "a", Kind.TOGGLE).of_lines(_FILES[0]) == {}


def test_runs_on_different_texts_of_a_file_are_not_merged() -> None:
    changed = replace(_one(1, "b"), digests={_FILES[0]: "other"})
    with pytest.raises(ValueError, match=r"hdl/arith/sqrt\.v: changed between runs"):
        merge([_one(1, "a"), changed])


def test_points_of_a_text_that_has_changed_count_no_longer() -> None:
    old = _one(1, "a")
    new = replace(old, digests={_FILES[0]: digest_of(_FILES[0]) or ""})
    assert not old.current().points
    assert new.current() == new


@pytest.mark.parametrize("text", ["", "[]", '{"format":0}', '{"format":1,"tests":[],"files":{"a":{}}}'])
def test_what_is_no_code_coverage_is_refused(text: str) -> None:
    with pytest.raises(ValueError, match=r"."):
        from_json(text)
