"""Counts the bins that a run hits; plain Python, so that it counts for a model as well as in a simulator.

Samples are kept until there are enough for one evaluation of all bins, for a property's examples are small.
"""

from collections.abc import Callable, Iterable

import numpy as np

from verif.env.coverage.database import Record
from verif.env.coverage.points import Coverage, Recipe, Samples
from verif.env.fields import concatenate, count
from verif.env.unit import Parameters

_ENOUGH = 8192
"""Columns that are evaluated together."""


class Collector:
    """Hits of one unit's bins, and how they grew over the clocks.

    known: bins that other runs have hit; they count as hit in the curve, and nobody goes after them again.
    pull: called before a flush, to add samples that are still somewhere else.
    """

    def __init__(self, coverage: Coverage, parameters: Parameters, known: Iterable[str] = ()) -> None:
        self.coverage = coverage
        self.hits = {name: 0 for name, _ in coverage.bins()}
        self.curve: list[tuple[int, int]] = []
        self._known = frozenset(known)
        self._parameters = parameters
        self._predicates = [(name, found.holds) for name, found in coverage.bins() if found.holds is not None]
        self._waiting: list[Samples] = []
        self._columns = 0
        self.pull: Callable[[], None] = lambda: None

    def add(self, samples: Samples, clock: int) -> None:
        """Samples up to a clock, ``(n,)`` or ``(lanes, n)`` each."""
        self._waiting.append(samples)
        self._columns += count(samples)
        if self._columns >= _ENOUGH:
            self.flush(clock)

    def tell(self, name: str, clock: int, times: int = 1) -> None:
        """A bin, `point.bin`, that the bench itself has seen hit. Raises KeyError where there is none."""
        self.hits[name] += times
        self._note(clock)

    def flush(self, clock: int) -> None:
        """Evaluates the samples that wait."""
        self.pull()
        if self._waiting:
            samples = self.coverage.seen(self._parameters, concatenate(self._waiting))
            self._waiting, self._columns = [], 0
            for name, holds in self._predicates:
                self.hits[name] += int(np.count_nonzero(holds(self._parameters, samples)))
        self._note(clock)

    def _note(self, clock: int) -> None:
        reached = sum(bool(hits) or name in self._known for name, hits in self.hits.items())
        if not self.curve or self.curve[-1][1] != reached:
            self.curve.append((clock, reached))

    def holes(self) -> dict[str, Recipe]:
        """Bins that neither this nor a run before has hit, with their recipes."""
        return {
            name: found.recipe
            for name, found in self.coverage.bins()
            if not self.hits[name] and name not in self._known
        }

    def record(self, unit: str, parameter_set: str, test: str, clocks: int) -> Record:
        """What was counted in so many clocks; `flush` first."""
        return Record(unit, parameter_set, test, dict(self.hits), tuple(self.curve), clocks)
