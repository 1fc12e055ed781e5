"""What runs leave of functional coverage: a JSON file a test, read and merged here.

Hits of one test of one run are a `Record`. Merging adds hits, and is the same in any order.
"""

import json
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

FOLDER = "coverage"
"""Of a run's folder."""


@dataclass(frozen=True)
class Record:
    """hits: times each bin was hit, by `point.bin`. curve: (clock, bins hit so far), where that changed.
    clocks: how long the test ran.
    """

    unit: str
    parameter_set: str
    test: str
    hits: Mapping[str, int]
    curve: tuple[tuple[int, int], ...] = ()
    clocks: int = 0

    def write(self, run_directory: Path) -> Path:
        """The file, in the run's folder."""
        path = run_directory / FOLDER / f"{self.test}.json"
        path.parent.mkdir(exist_ok=True)
        path.write_text(json.dumps(vars(self)))
        return path


def read(path: Path) -> Record:
    """One file. Raises ValueError with its name where it is none of ours."""
    try:
        found: dict[str, Any] = json.loads(path.read_text())
        curve = tuple((int(clock), int(bins)) for clock, bins in found.pop("curve"))
        return Record(**found, curve=curve)
    except (ValueError, TypeError, KeyError) as error:
        raise ValueError(f"{path}: is no record of functional coverage ({error}); delete it") from error


def of_run(run_directory: Path) -> list[Record]:
    """All that one run left, in the order of the tests' names."""
    return [read(path) for path in sorted((run_directory / FOLDER).glob("*.json"))]


def merged(records: Iterable[Record]) -> dict[str, dict[str, int]]:
    """Hits by unit and bin."""
    total: dict[str, dict[str, int]] = {}
    for record in records:
        hits = total.setdefault(record.unit, {})
        for name, number in record.hits.items():
            hits[name] = hits.get(name, 0) + number
    return total
