"""Code coverage as data: points of the design's text, how often each was hit and by which tests.

Instances of a module, iterations of a generate loop, parameter sets, builds and runs all count for the same
points: hits add up and points are united. Merging gives the same in any order and grouping.
"""

import hashlib
import json
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from pathlib import Path
from typing import Any

from verif.env import sources

_FORMAT = 1
"""Of the JSON; another number is refused."""


class Kind(StrEnum):
    """What a point is, by Verilator's names."""

    LINE = "line"
    BRANCH = "branch"
    EXPRESSION = "expr"
    TOGGLE = "toggle"


@dataclass(frozen=True, order=True)
class Point:
    """One thing that can be hit.

    file: as seen from the root of the project. line, column: from 1, where it begins. what: `if` or `else`
    of a branch, `a==1 => 1` of an expression, `signal[bit]:0->1` of a toggle.
    """

    file: str
    line: int
    column: int
    kind: Kind
    what: str


@dataclass(frozen=True)
class Hits:
    """count: times hit. tests: names of the runs that did. lines: those that are hit with the point."""

    count: int
    tests: frozenset[str] = frozenset()
    lines: frozenset[int] = frozenset()

    def __add__(self, other: "Hits") -> "Hits":
        return Hits(self.count + other.count, self.tests | other.tests, self.lines | other.lines)


@dataclass(frozen=True)
class CodeCoverage:
    """Points with their hits; tests: names of the runs; digests: of the text of each file."""

    points: Mapping[Point, Hits] = field(default_factory=dict)
    tests: frozenset[str] = frozenset()
    digests: Mapping[str, str] = field(default_factory=dict)

    def current(self) -> "CodeCoverage":
        """Without the files whose text is another one now: their points are nowhere."""
        same = {file: digest for file, digest in self.digests.items() if digest == digest_of(file)}
        points = {point: hits for point, hits in self.points.items() if point.file in same}
        return CodeCoverage(points, self.tests, same)

    def of_files(self) -> dict[str, dict[Point, Hits]]:
        """The points by file, in the order of the text."""
        found: dict[str, dict[Point, Hits]] = {}
        for point in sorted(self.points):
            found.setdefault(point.file, {})[point] = self.points[point]
        return found

    def of_lines(self, file: str) -> dict[int, Hits]:
        """Each line of a file under a line or branch point: most hits of such a point, and all tests."""
        found: dict[int, Hits] = {}
        for point, hits in self.points.items():
            if point.file == file and point.kind in (Kind.LINE, Kind.BRANCH):
                for line in hits.lines or {point.line}:
                    old = found.get(line, Hits(0))
                    found[line] = Hits(max(old.count, hits.count), old.tests | hits.tests)
        return dict(sorted(found.items()))


def digest_of(file: str) -> str | None:
    """Digest of a file's text, None where it is gone; file: as seen from the root of the project."""
    path = sources.ROOT / file
    return hashlib.sha256(path.read_bytes()).hexdigest()[:16] if path.exists() else None


def merge(coverages: Iterable[CodeCoverage]) -> CodeCoverage:
    """All together. Raises ValueError where a file is not the same text in all."""
    points: dict[Point, Hits] = {}
    tests: frozenset[str] = frozenset()
    digests: dict[str, str] = {}
    for coverage in coverages:
        tests |= coverage.tests
        for file, digest in coverage.digests.items():
            if digests.setdefault(file, digest) != digest:
                raise ValueError(f"{file}: changed between runs; collect code coverage anew")
        for point, hits in coverage.points.items():
            points[point] = points[point] + hits if point in points else hits
    return CodeCoverage(points, tests, digests)


def to_json(coverage: CodeCoverage) -> str:
    """Compact JSON: tests by number, points by file as [line, column, kind, what, count, tests, lines]."""
    tests = sorted(coverage.tests)
    number = {test: index for index, test in enumerate(tests)}
    files = {
        file: {
            "digest": coverage.digests.get(file, ""),
            "points": [
                [
                    *(point.line, point.column, point.kind, point.what, hits.count),
                    sorted(number[test] for test in hits.tests),
                    sorted(hits.lines),
                ]
                for point, hits in points.items()
            ],
        }
        for file, points in coverage.of_files().items()
    }
    return json.dumps({"format": _FORMAT, "tests": tests, "files": files}, separators=(",", ":"))


def from_json(text: str) -> CodeCoverage:
    """What `to_json` wrote. Raises ValueError where it is something else."""
    try:
        found: dict[str, Any] = json.loads(text)
        if found["format"] != _FORMAT:
            raise ValueError(f"format {found['format']}, not {_FORMAT}")
        tests: list[str] = found["tests"]
        points = {
            Point(file, line, column, Kind(kind), what): Hits(
                count, frozenset(tests[index] for index in indices), frozenset(lines)
            )
            for file, of_file in found["files"].items()
            for line, column, kind, what, count, indices, lines in of_file["points"]
        }
        digests = {file: of_file["digest"] for file, of_file in found["files"].items()}
        return CodeCoverage(points, frozenset(tests), digests)
    except (KeyError, TypeError, IndexError, AttributeError) as error:
        raise ValueError(f"is no code coverage: {error!r}") from error


def load(path: Path) -> CodeCoverage:
    """A file of code coverage. Raises ValueError with its name where it is none."""
    try:
        return from_json(path.read_text())
    except ValueError as error:
        raise ValueError(f"{path}: {error}; delete it and collect code coverage anew") from error
