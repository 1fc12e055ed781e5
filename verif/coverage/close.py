"""Closes functional coverage: a unit from an empty database until every bin is hit, and the same at random.

A unit is closed on one parameter set after the other, for as long as there are holes. Undirected random
stimulus then gets the same sets with a multiple of the same clocks, so that the two curves can be compared.
"""

import json
import time
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from verif.coverage.designs import Design
from verif.coverage.exclusions import Exclusion, of_unit
from verif.env.build import CACHE
from verif.env.coverage import database
from verif.env.coverage.database import Record

FOLDER = CACHE / "coverage" / "closure"
"""A file a unit."""

_TIMES = 10
"""Undirected stimulus gets so many times the clocks that closure took."""
_LEAST_CLOCKS = 20_000
"""And at least so many a parameter set: a closure of a few hundred clocks is within one portion's noise."""
_ENOUGH_CLOCKS = 500_000
"""Beyond these it gets no more than closure had."""

Curve = tuple[tuple[int, int], ...]


class ClosureError(RuntimeError):
    """A portion of stimulus failed: not a hole but a bug. The text is the bench's complaint."""


@dataclass(frozen=True)
class Closed:
    """What became of one unit.

    hits: by bin. recipes: by bin, the name of what reaches it. excluded: reasons by bin. directed,
    undirected: (clocks, bins hit), over all parameter sets one behind the other; sets: which were needed.
    """

    unit: str
    hits: Mapping[str, int]
    recipes: Mapping[str, str]
    excluded: Mapping[str, str]
    directed: Curve
    undirected: Curve
    clocks: int
    undirected_clocks: int
    seconds: float
    sets: tuple[str, ...] = field(default=())

    @property
    def holes(self) -> tuple[str, ...]:
        """Bins that are neither hit nor excluded."""
        return tuple(name for name, hits in self.hits.items() if not hits and name not in self.excluded)

    @property
    def bins(self) -> int:
        """Bins that are not excluded."""
        return len(self.hits) - len(self.excluded)

    @property
    def random_bins(self) -> int:
        """Bins that undirected stimulus hit in all its clocks."""
        return self.undirected[-1][1] if self.undirected else 0

    @property
    def factor(self) -> tuple[float, bool]:
        """Clocks of undirected stimulus over those of closure until all bins were hit; whether that is only
        a lower bound, since undirected stimulus never hit them all.
        """
        reached = [clocks for clocks, bins in self.undirected if bins >= self.bins]
        clocks = reached[0] if reached else self.undirected_clocks
        needed = self.directed[-1][0] if self.directed else self.clocks
        return clocks / max(1, needed), not reached

    def write(self) -> Path:
        """The unit's file."""
        FOLDER.mkdir(parents=True, exist_ok=True)
        path = FOLDER / f"{self.unit}.json"
        path.write_text(json.dumps(asdict(self)))
        return path


def read(path: Path) -> Closed:
    """What `Closed.write` wrote."""
    found: dict[str, Any] = json.loads(path.read_text())
    for name in ("directed", "undirected"):
        found[name] = tuple((int(clock), int(bins)) for clock, bins in found[name])
    return Closed(**{**found, "sets": tuple(found["sets"])})


@dataclass
class _Sum:
    """Runs one behind the other, as one curve. excluded: bins that count in no curve."""

    hits: dict[str, int]
    excluded: Collection[str]
    curve: list[tuple[int, int]] = field(default_factory=list)
    clocks: int = 0

    def known(self) -> list[str]:
        """Bins that the next run need not go after."""
        return [name for name, hits in self.hits.items() if hits or name in self.excluded]

    def add(self, record: Record) -> None:
        """Counts one more run, which knew of those before."""
        self.curve += [(self.clocks + clock, bins - len(self.excluded)) for clock, bins in record.curve]
        for name, hits in record.hits.items():
            self.hits[name] += hits
        self.clocks += record.clocks


def close(design: Design, *, seed: int, seconds: float, compare: bool, tell: Callable[[str], None]) -> Closed:
    """Closes one design's coverage. Raises ClosureError where a portion of stimulus fails."""
    start = time.monotonic()
    bins = dict(design.coverage.bins())
    excluded = _excluded(design, bins)
    directed, undirected = (_Sum(dict.fromkeys(bins, 0), excluded) for _ in range(2))
    used: list[tuple[str, int]] = []
    for parameter_set in design.sets:
        left = seconds - (time.monotonic() - start)
        known = directed.known()
        if len(known) == len(bins) or left <= 0:
            break
        tell(f"{design.name}: {len(bins) - len(known)} bins to go, {parameter_set}")
        record = _run(design, parameter_set, seed, known, {"mode": "directed", "seconds": left})
        directed.add(record)
        used.append((parameter_set, record.clocks))
    took = time.monotonic() - start
    for parameter_set, clocks in used if compare else ():
        budget = max(clocks, min(_TIMES * clocks, _ENOUGH_CLOCKS), _LEAST_CLOCKS)
        tell(f"{design.name}: {budget} clocks at random, {parameter_set}")
        how = {"mode": "undirected", "clocks": budget}
        undirected.add(_run(design, parameter_set, seed, undirected.known(), how))
    stale = [name for name in excluded if directed.hits[name] or undirected.hits[name]]
    if stale:
        raise ClosureError(f"{design.exclusions}: excludes {', '.join(stale)}, which was hit; take it out")
    return Closed(
        design.name,
        directed.hits,
        {name: found.recipe.name for name, found in bins.items()},
        {name: found.reason for name, found in excluded.items()},
        tuple(directed.curve),
        tuple(undirected.curve),
        directed.clocks,
        undirected.clocks,
        took,
        tuple(name for name, _ in used),
    )


def _excluded(design: Design, bins: Mapping[str, Any]) -> dict[str, Exclusion]:
    return {found.what: found for found in of_unit(design.exclusions, bins)}


def _run(
    design: Design, parameter_set: str, seed: int, known: Sequence[str], how: Mapping[str, Any]
) -> Record:
    outcome = design.run(parameter_set, seed, known, how)
    records = database.of_run(outcome.directory)
    if not outcome.passed or len(records) != 1:
        raise ClosureError(f"{design.name}, {parameter_set}: {outcome.complaint()}")
    return records[0]
