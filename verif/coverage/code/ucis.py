"""UCIS 1.0 interchange XML (Accellera, June 2012), for tools of coverage.

Every point is there, exclusions with their reason, and each bin names the tests that hit it. One instance
stands for all instances of a module, since they are merged.
"""

import datetime
import xml.etree.ElementTree as ElementTree
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path

from verif.coverage.code.exclusions import Review, Toggle
from verif.coverage.code.points import Hits, Kind, Point
from verif.env.simulators import Simulator, version

NAMESPACE = "UCIS"
_WRITER = "verif.coverage.code"

Element = ElementTree.Element


@dataclass(frozen=True)
class _Writer:
    """What the elements refer to: exclusions, and the numbers of files and tests."""

    review: Review
    files: Mapping[str, int]
    tests: Mapping[str, int]

    def bin(self, parent: Element, name: str, point: Point) -> None:
        """A bin with its count and tests."""
        hits = self.review.coverage.points[point]
        attributes = {}
        if point in self.review.excluded:
            attributes = {"excluded": "true", "excludedReason": self.review.excluded[point].reason}
        element = ElementTree.SubElement(parent, name, attributes)
        contents = ElementTree.SubElement(element, "contents", coverageCount=str(hits.count))
        for test in sorted(hits.tests):
            ElementTree.SubElement(contents, "historyNodeId").text = str(self.tests[test])

    def place(self, parent: Element, point: Point, name: str = "id", count: int = 1) -> None:
        """Where a statement begins; count tells apart those of one line."""
        place = {"file": str(self.files[point.file]), "line": str(point.line), "inlineCount": str(count)}
        ElementTree.SubElement(parent, name, place)

    def toggles(self, instance: Element, points: Iterable[Point]) -> None:
        """toggleCoverage: an object a signal, two bins a bit."""
        section = ElementTree.SubElement(instance, "toggleCoverage")
        taken = sorted(
            (p.line, p.column, Toggle.of(p.what).signal, Toggle.of(p.what).bit or 0, p) for p in points
        )
        for (_, _, signal), of_signal in groupby(taken, lambda found: found[:3]):
            bits = list(of_signal)
            thing = ElementTree.SubElement(section, "toggleObject", name=signal, key=_key(bits[0][4], signal))
            self.place(thing, bits[0][4])
            for index, of_bit in groupby(bits, lambda found: found[3]):
                edges = [found[4] for found in of_bit]
                name = edges[0].what.rpartition(":")[0]
                bit = ElementTree.SubElement(thing, "toggleBit", name=name, key=str(index))
                for point in edges:
                    start, _, end = Toggle.of(point.what).edge.partition("->")
                    edge = ElementTree.SubElement(bit, "toggle", {"from": start, "to": end})
                    self.bin(edge, "bin", point)

    def statements(self, instance: Element, points: Iterable[Point]) -> None:
        """blockCoverage: a statement a line point."""
        section = ElementTree.SubElement(instance, "blockCoverage")
        for _, of_line in groupby(points, lambda point: point.line):
            for count, point in enumerate(of_line, 1):
                statement = ElementTree.SubElement(section, "statement")
                self.place(statement, point, count=count)
                self.bin(statement, "bin", point)

    def expressions(self, instance: Element, points: Iterable[Point]) -> None:
        """conditionCoverage: an expression a place, a bin for each of its permutations."""
        section = ElementTree.SubElement(instance, "conditionCoverage")
        for _, of_place in groupby(points, lambda point: (point.line, point.column)):
            rows = list(of_place)
            text = f"{rows[0].line}.{rows[0].column}"
            attributes = {
                "name": text,
                "key": _key(rows[0], text),
                "exprString": text,
                "index": "0",
                "width": "1",
            }
            expression = ElementTree.SubElement(section, "expr", attributes)
            self.place(expression, rows[0])
            for point in rows:
                ElementTree.SubElement(expression, "subExpr").text = point.what
            for point in rows:
                self.bin(expression, "bin", point)

    def branches(self, instance: Element, points: Iterable[Point]) -> None:
        """branchCoverage: a statement a line with decisions, its branches below it."""
        section = ElementTree.SubElement(instance, "branchCoverage")
        for _, of_line in groupby(points, lambda point: point.line):
            branches = list(of_line)
            statement = ElementTree.SubElement(section, "statement", statementType="if")
            self.place(statement, branches[0])
            for count, point in enumerate(branches, 1):
                branch = ElementTree.SubElement(statement, "branch")
                self.place(branch, point, count=count)
                self.bin(branch, "branchBin", point)


def _key(point: Point, name: str) -> str:
    return f"{point.file}:{point.line}:{name}"


def _instance(writer: _Writer, parent: Element, file: str, points: Mapping[Point, Hits]) -> None:
    name = Path(file).stem
    instance = ElementTree.SubElement(parent, "instanceCoverages", name=name, key=file, moduleName=name)
    writer.place(instance, Point(file, 1, 1, Kind.LINE, ""))
    sections = (
        (Kind.TOGGLE, writer.toggles),
        (Kind.LINE, writer.statements),
        (Kind.EXPRESSION, writer.expressions),
        (Kind.BRANCH, writer.branches),
    )
    for kind, write in sections:
        found = [point for point in points if point.kind is kind]
        if found:
            write(instance, found)


def export(review: Review, written: datetime.datetime) -> str:
    """The XML of a reviewed coverage; written: when, as its readers want to know."""
    when = written.isoformat(timespec="seconds")
    of_files = review.coverage.of_files()
    files = {file: number for number, file in enumerate(of_files, 1)}
    tests = {test: number for number, test in enumerate(sorted(review.coverage.tests))}
    root = ElementTree.Element(
        "UCIS", xmlns=NAMESPACE, ucisVersion="1.0", writtenBy=_WRITER, writtenTime=when
    )
    for file, number in files.items():
        ElementTree.SubElement(root, "sourceFiles", fileName=file, id=str(number))
    for test, number in tests.items():
        ElementTree.SubElement(
            root,
            "historyNodes",
            {
                **{"historyNodeId": str(number), "logicalName": test, "kind": "TEST", "testStatus": "true"},
                **{"date": when, "toolCategory": "UCIS:Simulator", "ucisVersion": "1.0"},
                **{"vendorId": "Verilator", "vendorTool": "verilator"},
                "vendorToolVersion": version(Simulator.VERILATOR).split()[-1],
            },
        )
    for file, points in of_files.items():
        _instance(_Writer(review, files, tests), root, file, points)
    ElementTree.indent(root, " ")
    return ElementTree.tostring(root, encoding="unicode", xml_declaration=True) + "\n"
