"""Starts rays where a trace unit is free, takes its results, and holds all outputs to the model."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import cycle
from typing import Any

from models.latency import LATENCY
from verif.env.block import Block, same
from verif.env.fields import split
from verif.env.pipelined import Mismatch
from verif.units.trace_unit import unit
from verif.units.trace_unit.frames import Job, Table
from verif.units.trace_unit.model import Model

IDLE = (0,)
"""Waits of rays that come as soon as they may."""


@dataclass(frozen=True)
class Manners:
    """Of all around the unit; each list is taken over and over.

    waits: clocks before each ray. hits, terms: whether a result of this kind may be taken, clock by clock.
    """

    waits: Sequence[int] = IDLE
    hits: Sequence[bool] = (True,)
    terms: Sequence[bool] = (True,)

    @property
    def clocks(self) -> int:
        """What a ray may take beside its tests."""
        return max(self.waits) + len(self.hits) + len(self.terms) + 4


class TraceBench(Block):
    """Starts rays where the unit is free, takes results, and compares all outputs at every clock."""

    def __init__(self, dut: Any, parameters: Mapping[str, int]) -> None:
        super().__init__(
            dut,
            idle=("table_valid", "ray_valid", "shadow_valid", "hit_ready", "term_ready"),
            carried={
                "table_valid": ("table_index", "table_geometry"),
                "ray_valid": ("ray",),
                "shadow_valid": ("shadow",),
            },
        )
        self.set(table_index=0, table_geometry=0, objects=0, ray=0, shadow=0)
        self.parameters = parameters
        self.model = Model(parameters)
        self.checked = 0

    async def restart(self) -> None:
        """Reset, whatever is in flight."""
        await self.reset()
        self.model = Model(self.parameters)

    async def load(self, table: Table) -> None:
        """Writes a frame's table; nothing is in flight."""
        for index, row in enumerate(table.rows):
            await self.clock(table_valid=1, table_index=index, table_geometry=row)
        self.set(table_valid=0, objects=table.number)

    async def step(self, job: Job | None = None, take_hit: bool = True, take_term: bool = True) -> None:
        """One clock, all outputs checked."""
        self.set(ray_valid=0, shadow_valid=0, hit_ready=int(take_hit), term_ready=int(take_term))
        if job is not None and job.shadow:
            self.set(shadow_valid=1, shadow=job.word)
        elif job is not None:
            self.set(ray_valid=1, ray=job.word)
        await self.clock()
        self._check("ray_free", self.model.free(False))
        self._check("shadow_free", self.model.free(True))
        self._check("tested", self.model.tested())
        self._result(False, "hit")
        self._result(True, "term")
        self.model.clock(job, {False: take_hit, True: take_term})

    def _check(self, name: str, expected: bool) -> None:
        same(f"{name} at clock {self.now}", int(expected), self.read(name))

    def _result(self, shadow: bool, name: str) -> None:
        job = self.model.offered(shadow)
        self._check(f"{name}_valid", job is not None)
        if job is not None:
            self.checked += 1
            got = self.read(name)
            if (got ^ job.result) >> job.open_bits:
                ports = unit.term(self.parameters) if shadow else unit.hit(self.parameters)
                expected, found = (split(ports, [word]) for word in (job.result, got))
                wrong = [port.name for port in ports if (expected[port.name] != found[port.name]).any()]
                raise Mismatch(f"{name} at clock {self.now}, {wrong}: expected {expected}, got {found}")
            if self.signals is not None:
                self._cover(job)

    def _cover(self, job: Job) -> None:
        """What a result, the model's, is a case of."""
        if job.shadow:
            left = split(unit.term(self.parameters), [job.result])["sum"].any()
            self.covered(f"light.{'some' if left else 'nothing'}")
            return
        hit = split(unit.hit(self.parameters), [job.result])
        if not hit["hit"][0]:
            self.covered("ray.nothing")
            return
        # Only a sphere has an offset or a chord.
        ball = hit["offset"].any() or hit["half_chord"].any()
        self.covered("ray.sphere" if ball else "ray.triangle")
        self.covered("ray.glass" if hit["glass"][0] else "ray.opaque")
        if hit["leaving"][0]:
            self.covered("ray.leaving")
        if split(unit.ray(self.parameters), [job.word])["owned"][0]:
            self.covered("ray.starts_on_one")

    async def play(self, jobs: Sequence[Job], manners: Manners = Manners(), most: int | None = None) -> int:
        """Starts rays as soon as the unit is free, until the last one has started, or for so many clocks; the
        number of rays that have started."""
        waits, hits, terms = cycle(manners.waits), cycle((*manners.hits, True)), cycle((*manners.terms, True))
        started, wait = 0, next(waits)
        # Where there is no room, a ray waits for one that has just started.
        turns = 2 + len(jobs) // self.parameters["ROOM"]
        limit = sum(len(job.tests) + manners.clocks for job in jobs)
        limit += turns * LATENCY["trace_unit"](self.parameters)
        for _ in range(limit if most is None else most):
            if started == len(jobs):
                return started
            wait -= 1
            goes = wait < 0 and self.model.free(jobs[started].shadow)
            await self.step(jobs[started] if goes else None, next(hits), next(terms))
            if goes:
                started, wait = started + 1, next(waits)
        if most is None:
            raise Mismatch(f"{started} of {len(jobs)} rays have started after {limit} clocks")
        return started

    async def drain(self, manners: Manners = Manners()) -> None:
        """All results come, and then nothing."""
        hits, terms = cycle((*manners.hits, True)), cycle((*manners.terms, True))
        while not self.model.at_rest:
            await self.step(None, next(hits), next(terms))
        for _ in range(4):
            await self.step()

    async def frame(self, table: Table, jobs: Sequence[Job], manners: Manners = Manners()) -> None:
        """A whole frame."""
        await self.load(table)
        await self.play(jobs, manners)
        await self.drain(manners)
