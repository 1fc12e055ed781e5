"""Tests of the store of pending rays: the bench is the rest of the tracer, a model says what must go when.

The model is the header's rules on plain queues, at every clock. That these rules have neither overflow nor
deadlock is not assumed: the model refuses a child without a place, and a frame that stands still fails.
"""

from collections import deque
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import count, cycle
from typing import Any, TypeVar

import cocotb
import numpy as np
from hypothesis import strategies as st

from verif.env import context
from verif.env.block import Block, holds, same
from verif.env.pipelined import Mismatch

_Piece = TypeVar("_Piece")

_WAITING = 2
"""Rays that wait at the output at most."""
_MOST_PRIMARIES = 6
"""Of a drawn frame: the largest tree has 127 rays."""


@dataclass(frozen=True)
class Frame:
    """What holds still: depth, children of a ray at most, and how many primary rays there are."""

    max_depth: int
    branches: int
    primaries: int


@dataclass(frozen=True)
class Manners:
    """Of all around the store; each list is taken over and over.

    asks: clocks before each primary ray. splits: what becomes of each ray, see `Tracer`. delays: clocks
    from a ray to its answers. picks: which answer comes next of those that are due, oldest first.
    stalls: clocks without ray_ready before each ray.
    """

    asks: Sequence[int] = (0,)
    splits: Sequence[int] = (0,)
    delays: Sequence[int] = (1,)
    picks: Sequence[int] = (0,)
    stalls: Sequence[int] = (0,)

    @property
    def patience(self) -> int:
        """Clocks in which something must happen."""
        return max(self.asks) + max(self.delays) + max(self.stalls) + 8


@dataclass(frozen=True)
class Ray:
    """A ray and its depth."""

    depth: int
    data: int


@dataclass(frozen=True)
class Settle:
    """Places that are given back."""

    depth: int
    places: int


@dataclass(frozen=True)
class Clock:
    """Inputs of one clock: what is offered, and whether a ray is taken."""

    primary: int | None
    child: Ray | None
    settle: Settle | None
    take: bool


class Store:
    """The rules of the header on plain queues."""

    def __init__(self, depths: int, room: int) -> None:
        self._room = room
        self.levels: dict[int, deque[int]] = {depth: deque() for depth in range(2, depths + 1)}
        self._free = dict.fromkeys(self.levels, room)
        self.waiting: deque[Ray] = deque()
        self.peaks = dict.fromkeys(self.levels, 0)
        self.scarcest = dict(self._free)

    @property
    def idle(self) -> bool:
        """Nothing stored, nothing at the output."""
        return not self.waiting and not any(self.levels.values())

    @property
    def at_rest(self) -> bool:
        """Idle, and all places are free."""
        return self.idle and all(free == self._room for free in self._free.values())

    def _may(self, frame: Frame, depth: int) -> bool:
        return depth >= frame.max_depth or self._free[depth + 1] >= frame.branches

    def goes(self, frame: Frame) -> int:
        """The depth from which a ray goes in this clock; 1: a primary ray may; 0: none."""
        if len(self.waiting) >= _WAITING:
            return 0
        for depth in sorted(self.levels, reverse=True):
            if self.levels[depth] and self._may(frame, depth):
                return depth
        return int(self._may(frame, 1))

    def clock(self, frame: Frame, inputs: Clock) -> Ray | None:
        """The end of a clock; the ray that was taken in it."""
        goes = self.goes(frame)
        taken = self.waiting.popleft() if self.waiting and inputs.take else None
        if goes > 1:
            self._free[goes] += 1
            self._go(frame, Ray(goes, self.levels[goes].popleft()))
        elif goes and inputs.primary is not None:
            self._go(frame, Ray(1, inputs.primary))
        if inputs.child is not None:
            self._store(inputs.child)
        if inputs.settle is not None:
            self._free[inputs.settle.depth] += inputs.settle.places
        return taken

    def _go(self, frame: Frame, ray: Ray) -> None:
        self.waiting.append(ray)
        if ray.depth < frame.max_depth:
            deeper = ray.depth + 1
            self._free[deeper] -= frame.branches
            self.scarcest[deeper] = min(self.scarcest[deeper], self._free[deeper])

    def _store(self, child: Ray) -> None:
        level = self.levels[child.depth]
        level.append(child.data)
        self.peaks[child.depth] = max(self.peaks[child.depth], len(level))
        if len(level) + self._free[child.depth] > self._room:
            raise Mismatch(f"a child of depth {child.depth} without a place")


class Tracer:
    """All around the store: offers primary rays, takes rays, answers them after a while.

    A split of 0 to 2 is the number of children, if there may be so many, and the rest is settled a place
    at a time; 3 to 5 are the same with one settle, be it of no place.
    """

    def __init__(self, frame: Frame, manners: Manners, numbers: Iterator[int]) -> None:
        self.frame, self.manners = frame, manners
        self._numbers = numbers
        self._asks, self._splits = cycle(manners.asks), cycle(manners.splits)
        self._delays, self._picks = cycle(manners.delays), cycle(manners.picks)
        self._stalls = cycle(manners.stalls)
        self._ask, self._stall = next(self._asks), next(self._stalls)
        self._children: list[tuple[int, Ray]] = []
        self._settles: list[tuple[int, Settle]] = []
        self._primary: int | None = None
        self.to_offer = frame.primaries
        self.given = self.taken = 0

    @property
    def owes(self) -> bool:
        """Whether a ray that was taken is not answered in full."""
        return bool(self._children or self._settles)

    @property
    def done(self) -> bool:
        """Every ray has been traced."""
        return not self.to_offer and not self.owes and self.given == self.taken

    def inputs(self, now: int, answer: bool = True, take: bool = True) -> Clock:
        """Of this clock. ``answer``, ``take``: whether it may."""
        if self._primary is None and self.to_offer and self._ask <= 0:
            self._primary = next(self._numbers)
        self._ask -= 1
        ready = take and self._stall <= 0
        self._stall -= 1
        if not answer:
            return Clock(self._primary, None, None, ready)
        return Clock(self._primary, self._due(self._children, now), self._due(self._settles, now), ready)

    def _due(self, pieces: list[tuple[int, _Piece]], now: int) -> _Piece | None:
        due = [index for index, (when, _) in enumerate(pieces) if when <= now]
        return pieces.pop(due[next(self._picks) % len(due)])[1] if due else None

    def saw(self, now: int, inputs: Clock, accepted: bool, taken: Ray | None) -> None:
        """What came of the clock."""
        self.given += inputs.child is not None
        if accepted:
            self.given += 1
            self.to_offer -= 1
            self._primary = None
            self._ask = next(self._asks)
        if taken is not None:
            self.taken += 1
            self._stall = next(self._stalls)
            if taken.depth < self.frame.max_depth:
                self._answer(now + next(self._delays), taken.depth + 1)

    def _answer(self, when: int, depth: int) -> None:
        split, branches = next(self._splits), self.frame.branches
        children = min(split % 3, branches)
        rest = branches - children
        self._children += [(when, Ray(depth, next(self._numbers))) for _ in range(children)]
        self._settles += [(when, Settle(depth, places)) for places in ([rest] if split >= 3 else [1] * rest)]


class StoreBench(Block):
    """Drives the store with a tracer, and compares all outputs with the model at every clock."""

    def __init__(self, dut: Any, parameters: Mapping[str, int]) -> None:
        super().__init__(
            dut,
            idle=("primary_valid", "child_valid", "settle_valid", "ray_ready"),
            carried={
                "primary_valid": ("primary",),
                "child_valid": ("child", "child_depth"),
                "settle_valid": ("settle_depth", "settle_count"),
            },
        )
        self.depths, self.room = parameters["MAX_DEPTH"], parameters["LEVEL_ROOM"]
        self._width = parameters["RAY_W"]
        self.set(primary=0, child=0, child_depth=0, settle_depth=0, settle_count=0, max_depth=1, branches=0)
        self.store = Store(self.depths, self.room)
        generator = context.read().generator(0)
        self.numbers: Iterator[int] = (
            int.from_bytes(generator.bytes((self._width + 7) // 8)) >> -self._width % 8 for _ in count()
        )

    async def restart(self) -> None:
        """Reset, whatever is stored, reserved or waiting."""
        await self.reset()
        self.store = Store(self.depths, self.room)

    def begin(self, frame: Frame, manners: Manners) -> Tracer:
        """The settings of a frame, and what plays it."""
        self.set(max_depth=frame.max_depth, branches=frame.branches)
        return Tracer(frame, manners, self.numbers)

    def _drive(self, inputs: Clock) -> None:
        self.set(primary_valid=int(inputs.primary is not None), child_valid=int(inputs.child is not None))
        self.set(settle_valid=int(inputs.settle is not None), ray_ready=int(inputs.take))
        if inputs.primary is not None:
            self.set(primary=inputs.primary)
        if inputs.child is not None:
            self.set(child=inputs.child.data, child_depth=inputs.child.depth)
        if inputs.settle is not None:
            self.set(settle_depth=inputs.settle.depth, settle_count=inputs.settle.places)

    async def step(self, tracer: Tracer, answer: bool = True, take: bool = True) -> bool:
        """One clock, all outputs checked; whether anything happened in it."""
        inputs = tracer.inputs(self.now + 1, answer, take)
        self._drive(inputs)
        await self.clock()
        ready = self.store.goes(tracer.frame) == 1
        same(f"primary_ready at clock {self.now}", int(ready), self.read("primary_ready"))
        same(f"idle at clock {self.now}", int(self.store.idle), self.read("idle"))
        same(f"ray_valid at clock {self.now}", int(bool(self.store.waiting)), self.read("ray_valid"))
        if self.store.waiting:
            ray = self.store.waiting[0]
            same(f"ray_depth at clock {self.now}", ray.depth, self.read("ray_depth"))
            same(f"ray at clock {self.now}", hex(ray.data), hex(self.read("ray")))
        taken = self.store.clock(tracer.frame, inputs)
        accepted = ready and inputs.primary is not None
        tracer.saw(self.now, inputs, accepted, taken)
        answered = inputs.child is not None or inputs.settle is not None
        return accepted or answered or taken is not None

    async def play(self, tracer: Tracer, most: int | None = None) -> None:
        """Until every ray has been traced, or for so many clocks."""
        quiet = 0
        for _ in count() if most is None else range(most):
            if tracer.done:
                return
            quiet = 0 if await self.step(tracer) else quiet + 1
            if quiet > tracer.manners.patience:
                raise Mismatch(f"deadlock: nothing happened in {quiet} clocks, {tracer.taken} rays traced")

    async def frame(self, frame: Frame, manners: Manners) -> Tracer:
        """A whole frame; after it the store is as after reset."""
        tracer = self.begin(frame, manners)
        await self.play(tracer)
        for _ in range(3):
            await self.step(tracer)
        same("store at rest", True, self.store.at_rest)
        same("rays traced", tracer.given, tracer.taken)
        return tracer


def _frames(bench: StoreBench) -> st.SearchStrategy[Frame]:
    return st.builds(Frame, st.integers(1, bench.depths), st.integers(0, 2), st.integers(1, _MOST_PRIMARIES))


def _manners() -> st.SearchStrategy[Manners]:
    waits = st.lists(st.sampled_from([0, 0, 0, 1, 2, 9, 40]), min_size=1, max_size=6)
    splits = st.lists(st.integers(0, 5), min_size=1, max_size=6)
    delays = st.lists(st.sampled_from([1, 1, 2, 5, 30]), min_size=1, max_size=4)
    picks = st.just([0]) | st.lists(st.integers(0, 20), min_size=1, max_size=6)
    return st.builds(Manners, waits, splits, delays, picks, waits)


async def _bench(dut: Any) -> tuple[StoreBench, context.Context]:
    run = context.read()
    bench = StoreBench(dut, run.parameters)
    await bench.restart()
    return bench, run


@cocotb.test()
async def every_ray_comes_once_the_deepest_first(dut: Any) -> None:
    """Drawn trees, answers in any order, stalls; one frame behind the other, of other depths."""
    bench, run = await _bench(dut)

    async def example(first: Frame, second: Frame, manners: Manners, others: Manners) -> None:
        await bench.restart()
        await bench.frame(first, manners)
        await bench.frame(second, others)

    await holds(run, example, _frames(bench), _frames(bench), _manners(), _manners(), cost=2)


@cocotb.test()
async def a_long_run_loses_no_ray(dut: Any) -> None:
    """Volume: seeded frames of many rays, with fast and slow answers and takers by turns."""
    bench, run = await _bench(dut)
    generator = run.generator(1)

    def waits(least: int) -> list[int]:
        longest = int(generator.choice([1, 1, 4, 20]))
        return [int(wait) + least for wait in generator.integers(0, longest, size=20)]

    clocks, rays = bench.now + run.operands // 5, 0
    while bench.now < clocks:
        splits = generator.choice(6, size=50, p=np.array([1, 2, 4, 1, 2, 4]) / 14)
        picks = generator.integers(0, int(generator.choice([1, 100])), size=20)
        manners = Manners(waits(0), splits.tolist(), waits(1), picks.tolist(), waits(0))
        depth, branches = int(generator.integers(1, bench.depths + 1)), int(generator.choice([0, 1, 2, 2]))
        tracer = await bench.frame(Frame(depth, branches, max(4, 600 >> depth)), manners)
        rays += tracer.taken
    bench.log.info("%d rays checked", rays)


async def _flood(bench: StoreBench, depth: int, primaries: int, branches: int = 2) -> None:
    """All children that a ray may have. All that can go goes, unanswered; then all answers come to a taker
    that stalls."""
    tracer = bench.begin(Frame(depth, branches, primaries), Manners(splits=(branches,)))
    while not tracer.done:
        before = tracer.taken, tracer.given
        while await bench.step(tracer, answer=False) or bench.store.waiting:
            pass
        while tracer.owes:
            await bench.step(tracer, take=False)
        if before == (tracer.taken, tracer.given):
            raise Mismatch(f"deadlock with {tracer.taken} rays traced")
    same("rays traced", primaries * sum(branches**deeper for deeper in range(depth)), tracer.taken)


@cocotb.test()
async def the_worst_trees_fill_every_level_and_none_overflows(dut: Any) -> None:
    """Trees of the largest depth, then of each smaller one."""
    bench, _ = await _bench(dut)
    primaries = bench.room // 2 + 8
    await _flood(bench, bench.depths, primaries)
    # The first two that come go to the output, unless rays of the next depth have no place.
    for depth, most in bench.store.peaks.items():
        assert bench.room - _WAITING <= most <= bench.room, (
            f"at most {most} rays of depth {depth} were stored"
        )
    if bench.depths >= 3:
        same("most rays stored of a depth", bench.room, max(bench.store.peaks.values()))
    for depth in range(bench.depths - 1, 0, -1):
        await _flood(bench, depth, primaries)


@cocotb.test()
async def chains_fill_every_level_to_its_last_place(dut: Any) -> None:
    """One child a ray, so that every number of free places comes up, none and one too."""
    bench, _ = await _bench(dut)
    for depth in range(bench.depths, 0, -1):
        await _flood(bench, depth, 2 * bench.room + 8, branches=1)
        if depth > 1:
            same(f"fewest free places of depth {depth}", 0, bench.store.scarcest[depth])


@cocotb.test()
async def rays_of_any_bits_come_as_they_went(dut: Any) -> None:
    """All bits of a ray are 0 but a number in its low byte, then all are 1, then every other one."""
    bench, run = await _bench(dut)
    ones = (1 << run.parameters["RAY_W"]) - 1
    for stripes in (0, ones, ones // 3, ones - ones // 3):
        bench.numbers = (stripes ^ number % 256 for number in count())
        await _flood(bench, bench.depths, _MOST_PRIMARIES)


@cocotb.test()
async def reset_at_any_moment_empties_it(dut: Any) -> None:
    """What was stored, reserved or waiting is forgotten; the next frame is whole."""
    bench, run = await _bench(dut)

    async def example(before: Frame, clocks: int, after: Frame, manners: Manners, others: Manners) -> None:
        await bench.play(bench.begin(before, manners), clocks)
        await bench.restart()
        await bench.frame(after, others)

    moments = st.integers(0, 20) | st.integers(0, 300)
    await holds(run, example, _frames(bench), moments, _frames(bench), _manners(), _manners(), cost=2)


@cocotb.test()
async def rate_is_one_ray_a_clock_where_nothing_limits_it(dut: Any) -> None:
    """Primary rays alone; such that are settled, or have a child, as late as the room allows."""
    bench, _ = await _bench(dut)
    primaries, behind = 300, 4

    async def clocks_of(frame: Frame, manners: Manners) -> tuple[int, int]:
        tracer, start = bench.begin(frame, manners), bench.now
        await bench.play(tracer)
        return bench.now - start, tracer.taken

    async def at_full_rate(what: str, frame: Frame, manners: Manners) -> None:
        clocks, rays = await clocks_of(frame, manners)
        most = rays + max(manners.delays) + behind
        assert clocks <= most, f"{what}: {clocks} clocks for {rays} rays, more than {most}"

    await at_full_rate("no branches", Frame(bench.depths, 0, primaries), Manners())
    await at_full_rate("depth 1", Frame(1, 2, primaries), Manners())
    if bench.depths == 1:
        return
    late = bench.room // 2 - 2
    if late >= 1:
        await at_full_rate("settled", Frame(2, 2, primaries), Manners(splits=(3,), delays=(late,)))
        await at_full_rate("one child", Frame(2, 2, primaries), Manners(splits=(4,), delays=(late,)))
        await at_full_rate("two children", Frame(2, 2, primaries), Manners(splits=(5,), delays=(1,)))
