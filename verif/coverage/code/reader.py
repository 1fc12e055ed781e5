"""Reads what a run on Verilator left: the lines of `coverage.dat`, each of them exactly.

A line is ``C '<\\x01key\\x02value...>' count`` with the keys f (file), l (line), n (column), t (type),
o (comment), S (lines that are hit with the point) and h (instance). Only the design counts: testbenches,
harnesses and changed copies of a file lie outside `hdl/`.

What is called `unused_...` is no design either: nothing reads it, and it tells lint that something is left
open on purpose. In ``wire unused_x = &{1'b0, x};`` the expression is as little of it.
"""

import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path

from verif.coverage.code.points import CodeCoverage, Hits, Kind, Point, digest_of
from verif.env import sources

FILE = "coverage.dat"
"""Of a run's folder."""

_LINE = re.compile(r"C '(?P<keys>[^']*(?:'[^' ][^']*)*)' (?P<count>\d+)")
_SINK = re.compile(r"^\s*wire\s+unused_\w+\s*=\s*&\{1'b0\b[^;]*;", re.MULTILINE)
_ITERATION = re.compile(r"\[\d+\](?=\.)")
_INDEX_WIDTH = re.compile(r"\[\d+(:0)?\](?=( \+ \d+)?\+:)")


class CoverageError(ValueError):
    """A file is not what Verilator writes; the text names file and line."""


def _plain(kind: Kind, comment: str) -> str:
    """The comment without what differs between replicas of the same text.

    Iterations of a generate loop are replicas as instances are. Verilator cuts the index of a selection to
    the width that the parameters ask for, and says so.
    """
    if kind is Kind.TOGGLE:
        return _ITERATION.sub("", comment)
    return _INDEX_WIDTH.sub("", comment) if kind is Kind.EXPRESSION else comment


def _span(text: str) -> frozenset[int]:
    """The lines of `4-6,9`."""
    lines: set[int] = set()
    for part in filter(None, text.split(",")):
        first, _, last = part.partition("-")
        lines.update(range(int(first), int(last or first) + 1))
    return frozenset(lines)


def sinks(text: str) -> frozenset[int]:
    """The lines of a file's sinks of unused bits, from 1."""
    lines: set[int] = set()
    for found in _SINK.finditer(text):
        first = text.count("\n", 0, found.end() - len(found.group().lstrip())) + 1
        lines.update(range(first, first + found.group().lstrip().count("\n") + 1))
    return frozenset(lines)


def _unused(point: Point) -> bool:
    return point.kind is Kind.TOGGLE and point.what.rpartition(".")[2].startswith("unused_")


@cache
def _sinks_of(file: str) -> frozenset[int]:
    return sinks((sources.ROOT / file).read_text())


def _entries(path: Path) -> Iterator[tuple[dict[str, str], int]]:
    for number, line in enumerate(path.read_text().splitlines(), 1):
        if line.startswith("#"):
            continue
        found = _LINE.fullmatch(line)
        if found is None:
            raise CoverageError(f"{path}, line {number}: is no coverage point of Verilator's")
        pairs = (pair.partition("\x02") for pair in found["keys"].split("\x01")[1:])
        yield {key: value for key, _, value in pairs}, int(found["count"])


def read(path: Path, test: str) -> CodeCoverage:
    """The points of the design in one file, hit by the run called ``test``.

    Raises CoverageError where the file is missing or something else.
    """
    if not path.exists():
        raise CoverageError(f"{path}: does not exist; was the build made with coverage?")
    root = f"{sources.HDL}/"
    points: dict[Point, Hits] = {}
    try:
        for keys, count in _entries(path):
            if keys["f"].startswith(root):
                file = str(Path(keys["f"]).relative_to(sources.ROOT))
                kind = Kind(keys["t"])
                point = Point(file, int(keys["l"]), int(keys["n"]), kind, _plain(kind, keys["o"]))
                if point.line in _sinks_of(file) or _unused(point):
                    continue
                hits = Hits(count, frozenset({test} if count else ()), _span(keys.get("S", "")))
                points[point] = points[point] + hits if point in points else hits
    except (KeyError, ValueError) as error:
        if isinstance(error, CoverageError):
            raise
        raise CoverageError(f"{path}: holds a point that is not understood: {error!r}") from error
    digests = {file: digest_of(file) or "" for file in {point.file for point in points}}
    return CodeCoverage(points, frozenset({test}), digests)
