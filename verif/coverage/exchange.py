"""Functional coverage as cocotb-coverage keeps it, so that its tools, and others that read its files, can.

    python -m verif.coverage.exchange [coverage.xml | coverage.yml]

writes what `make close` left. Cover points become `CoverPoint`s of its database, `top.<unit>.<point>`. Bins
are evaluated on whole columns of samples before (`verif.env.coverage`), not by its decorators, which call
Python for each operand: here each bin that was hit is sampled once, and its count is then set.
"""

import sys
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

from cocotb_coverage.coverage import CoverPoint, coverage_db

from verif.coverage.close import FOLDER, read
from verif.env.build import CACHE

_USUAL = CACHE / "coverage" / "coverage.xml"


def _by_point(hits: Mapping[str, int]) -> dict[str, dict[str, int]]:
    points: dict[str, dict[str, int]] = {}
    for name, number in hits.items():
        point, _, found = name.partition(".")
        points.setdefault(point, {})[found] = number
    return points


def _record(name: str, bins: Mapping[str, int]) -> None:
    point = CoverPoint(name, bins=list(bins))
    sample = point(lambda _found: None)
    for found, number in bins.items():
        if number:
            sample(found)
            point.detailed_coverage[found] = number


def export(units: Iterable[tuple[str, Mapping[str, int]]], path: Path) -> None:
    """Hits by unit and bin into a file, XML or, by its name, YAML. To be called once in a process, whose
    database of cocotb-coverage this fills.
    """
    for unit, hits in units:
        for point, bins in _by_point(hits).items():
            _record(f"top.{unit}.{point}", bins)
    path.parent.mkdir(parents=True, exist_ok=True)
    if path.suffix in (".yml", ".yaml"):
        coverage_db.export_to_yaml(str(path))
    else:
        coverage_db.export_to_xml(str(path))


def main(words: Sequence[str]) -> int:
    """Writes the file and says where; 2 where nothing has been closed."""
    path = Path(words[0]) if words else _USUAL
    closed = [read(file) for file in sorted(FOLDER.glob("*.json"))]
    if not closed:
        print(f"{FOLDER}: holds no closed unit; run `make close` first", file=sys.stderr)
        return 2
    export(((one.unit, one.hits) for one in closed), path)
    print(path)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
