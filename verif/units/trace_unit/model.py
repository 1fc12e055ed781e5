"""What a trace unit must do, clock by clock."""

from collections import deque
from collections.abc import Mapping

from models.latency import LATENCY
from verif.env.unit import Parameters
from verif.units.trace_unit.frames import Job

_KINDS = (False, True)


class Model:
    """What the unit must do, clock by clock: a ray is taken, its tests follow, its result comes and waits."""

    def __init__(self, p: Parameters) -> None:
        self._latency, self._room = LATENCY["trace_unit"](p), p["ROOM"]
        self._ends = 0
        self._tests: deque[tuple[int, bool]] = deque()
        self.results: dict[bool, deque[tuple[int, Job]]] = {kind: deque() for kind in _KINDS}
        self.now = 0

    @property
    def at_rest(self) -> bool:
        """Nothing is in it."""
        return not self._tests and not any(self.results.values())

    def free(self, shadow: bool) -> bool:
        """Whether a ray of this kind may come in the next clock."""
        return self.now >= self._ends and len(self.results[shadow]) < self._room

    def tested(self) -> bool:
        """Whether a test counts in the next clock."""
        return bool(self._tests) and self._tests[0] == (self.now, True)

    def offered(self, shadow: bool) -> Job | None:
        """The result of this kind that the next clock shows."""
        results = self.results[shadow]
        return results[0][1] if results and results[0][0] <= self.now else None

    def clock(self, job: Job | None, takes: Mapping[bool, bool]) -> None:
        """A clock passes: a ray comes or not, results are taken or not."""
        for shadow, take in takes.items():
            if take and self.offered(shadow) is not None:
                self.results[shadow].popleft()
        if self._tests and self._tests[0][0] == self.now:
            self._tests.popleft()
        if job is not None:
            self._ends = self.now + len(job.tests)
            row = self.now + 2
            self._tests += [(row + number, counts) for number, counts in enumerate(job.tests)]
            self.results[job.shadow].append((self._ends + self._latency, job))
        self.now += 1
