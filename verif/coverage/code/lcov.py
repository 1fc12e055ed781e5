"""LCOV tracefile, for viewers of source lines.

It loses much: lines and branches alone, without columns; a line's count is that of its most hit point; a line
with a hole beside a hit is hit; what is excluded is left out. The JSON is the truth.
"""

from collections.abc import Iterator

from verif.coverage.code.exclusions import Review
from verif.coverage.code.points import CodeCoverage, Hits, Kind, Point


def _branches(points: dict[Point, Hits]) -> Iterator[str]:
    """One decision a block: the branches that begin at one place of a line are of one."""
    number: dict[int, int] = {}
    found = hit = 0
    for point, hits in points.items():
        if point.kind is Kind.BRANCH:
            branch = number.get(point.line, 0)
            number[point.line] = branch + 1
            found, hit = found + 1, hit + bool(hits.count)
            yield f"BRDA:{point.line},0,{branch},{hits.count}"
    yield f"BRF:{found}"
    yield f"BRH:{hit}"


def _record(coverage: CodeCoverage, file: str, points: dict[Point, Hits]) -> Iterator[str]:
    yield f"SF:{file}"
    yield from _branches(points)
    lines = coverage.of_lines(file)
    yield from (f"DA:{line},{hits.count}" for line, hits in lines.items())
    yield f"LF:{len(lines)}"
    yield f"LH:{sum(hits.count > 0 for hits in lines.values())}"
    yield "end_of_record"


def export(review: Review) -> str:
    """The tracefile of a reviewed coverage; paths are as seen from the root of the project."""
    kept = {point: hits for point, hits in review.coverage.points.items() if point not in review.excluded}
    coverage = CodeCoverage(kept, review.coverage.tests, review.coverage.digests)
    lines = ["TN:"]
    for file, points in coverage.of_files().items():
        lines += _record(coverage, file, points)
    return "\n".join(lines) + "\n"
