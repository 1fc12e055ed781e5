"""What other tools read: LCOV, and UCIS XML as its schema orders elements and attributes."""

import datetime
import xml.etree.ElementTree as ElementTree
from collections import Counter

import pytest

from verif.coverage.code import lcov, ucis
from verif.coverage.code.exclusions import Exclusion, Review
from verif.coverage.code.points import CodeCoverage, Hits, Kind, Point

_FILE = "hdl/arith/sqrt.v"
_WHEN = datetime.datetime(2030, 1, 2, 3, 4, 5, tzinfo=datetime.UTC)


def _hits(count: int, *lines: int) -> Hits:
    return Hits(count, frozenset({"one"} if count else ()), frozenset(lines))


_POINTS = {
    Point(_FILE, 3, 1, Kind.LINE, "block"): _hits(5, 3, 4),
    Point(_FILE, 5, 1, Kind.BRANCH, "if"): _hits(2, 5),
    Point(_FILE, 5, 2, Kind.BRANCH, "else"): _hits(0, 6),
    Point(_FILE, 5, 9, Kind.EXPRESSION, "(a==0) => 0"): _hits(0),
    Point(_FILE, 5, 9, Kind.EXPRESSION, "(a==1 && b<2) => 1"): _hits(2),
    Point(_FILE, 1, 9, Kind.TOGGLE, "q[1]:0->1"): _hits(1),
    Point(_FILE, 1, 9, Kind.TOGGLE, "q[1]:1->0"): _hits(0),
    Point(_FILE, 1, 9, Kind.TOGGLE, "q[0]:0->1"): _hits(1),
    Point(_FILE, 2, 9, Kind.TOGGLE, "clk:0->1"): _hits(9),
}
_LEFT_OUT = Point(_FILE, 5, 2, Kind.BRANCH, "else")
_EXCLUSION = Exclusion(_FILE, "x", (Kind.BRANCH,), "cannot be", "me", datetime.date(2031, 1, 1))


def _review(**excluded: Exclusion) -> Review:
    left_out = {_LEFT_OUT: _EXCLUSION} if excluded else {}
    return Review(CodeCoverage(_POINTS, frozenset({"one", "two"}), {_FILE: "d"}), left_out)


def test_lcov_has_lines_and_branches() -> None:
    lines = lcov.export(_review()).splitlines()
    assert f"SF:{_FILE}" in lines
    assert [line for line in lines if line.startswith("DA:")] == ["DA:3,5", "DA:4,5", "DA:5,2", "DA:6,0"]
    assert [line for line in lines if line.startswith("BRDA:")] == ["BRDA:5,0,0,2", "BRDA:5,0,1,0"]
    assert {"LF:4", "LH:3", "BRF:2", "BRH:1", "end_of_record"} <= set(lines)


def test_lcov_leaves_out_what_is_excluded() -> None:
    lines = lcov.export(_review(else_branch=_EXCLUSION)).splitlines()
    assert {"LF:3", "LH:3", "BRF:1", "BRH:1"} <= set(lines)


_BIN = ("contents",)
_CHILDREN = {
    "UCIS": ("sourceFiles", "historyNodes", "instanceCoverages"),
    "instanceCoverages": ("id", "toggleCoverage", "blockCoverage", "conditionCoverage", "branchCoverage"),
    "toggleCoverage": ("toggleObject",),
    "toggleObject": ("id", "toggleBit"),
    "toggleBit": ("toggle",),
    "toggle": ("bin",),
    "blockCoverage": ("statement",),
    "conditionCoverage": ("expr",),
    "expr": ("id", "subExpr", "bin"),
    "branchCoverage": ("statement",),
    "branch": ("id", "branchBin"),
    "bin": _BIN,
    "branchBin": _BIN,
    "contents": ("historyNodeId",),
}
"""Elements below each element, in the order that the schema of UCIS 1.0 asks for."""

_ATTRIBUTES = {
    "UCIS": {"ucisVersion", "writtenBy", "writtenTime"},
    "sourceFiles": {"fileName", "id"},
    "historyNodes": {
        *("historyNodeId", "logicalName", "testStatus", "date", "toolCategory"),
        *("ucisVersion", "vendorId", "vendorTool", "vendorToolVersion"),
    },
    "instanceCoverages": {"name", "key"},
    "id": {"file", "line", "inlineCount"},
    "toggleObject": {"name", "key"},
    "toggleBit": {"name", "key"},
    "toggle": {"from", "to"},
    "expr": {"name", "key", "exprString", "index", "width"},
    "contents": {"coverageCount"},
}
"""Attributes that the schema requires."""


def _name(element: ElementTree.Element) -> str:
    return element.tag.removeprefix(f"{{{ucis.NAMESPACE}}}")


def _xml(review: Review) -> ElementTree.Element:
    return ElementTree.fromstring(ucis.export(review, _WHEN))


def test_ucis_is_in_its_namespace() -> None:
    assert all(element.tag.startswith("{UCIS}") for element in _xml(_review()).iter())


def test_ucis_has_the_elements_of_the_schema_in_its_order() -> None:
    for element in _xml(_review()).iter():
        children = [_name(child) for child in element]
        if _name(element) == "statement":  # one name, of blocks and of branches
            assert children in (["id", "bin"], ["id", "branch", "branch"])
        else:
            order = _CHILDREN.get(_name(element), ())
            assert children == sorted(children, key=order.index)


def test_ucis_has_the_attributes_that_the_schema_requires() -> None:
    for element in _xml(_review()).iter():
        assert _ATTRIBUTES.get(_name(element), set()) <= element.attrib.keys()


def test_ucis_has_a_bin_for_each_point_with_its_count_and_tests() -> None:
    root = _xml(_review())
    bins = [element for element in root.iter() if _name(element) in ("bin", "branchBin")]
    counts = Counter(int(element[0].attrib["coverageCount"]) for element in bins)
    assert counts == Counter(hits.count for hits in _POINTS.values())
    numbers = {node.get("logicalName"): node.get("historyNodeId") for node in root.iter("{UCIS}historyNodes")}
    named = [child.text for element in bins for child in element[0]]
    assert named == [numbers["one"]] * sum(hits.count > 0 for hits in _POINTS.values())


def test_ucis_tells_why_a_point_is_left_out() -> None:
    left_out = [e for e in _xml(_review(x=_EXCLUSION)).iter() if e.get("excluded") == "true"]
    assert [element.get("excludedReason") for element in left_out] == ["cannot be"]


@pytest.mark.parametrize("export", [lcov.export, lambda review: ucis.export(review, _WHEN)])
def test_exports_of_nothing_have_no_file(export: object) -> None:
    assert callable(export)
    assert _FILE not in export(Review(CodeCoverage()))
