"""Tests of the queue against a list, at every clock: what it accepts, its room, what it offers and when."""

from collections import deque
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain, repeat
from typing import Any

import cocotb
from hypothesis import strategies as st

from verif.env import context
from verif.env.block import Block, holds, same

_LATENCY = 2
_PART = 200
"""Clocks of the long run with one manner of both sides."""
_LONGEST = 64
"""Clocks that a drawn side waits or goes at most: others fill a deeper queue."""


@dataclass(frozen=True)
class Clock:
    """Inputs of one clock: whether an item is offered, which, and whether one is taken."""

    offer: bool
    data: int
    take: bool


class FifoBench(Block):
    """Both sides of the queue, and the list that it must be."""

    def __init__(self, dut: Any, parameters: Mapping[str, int]) -> None:
        super().__init__(dut, idle=("in_valid", "out_ready"), carried={"in_valid": ("in_data",)})
        self.set(in_data=0)
        self.width, self.depth = parameters["WIDTH"], parameters["DEPTH"]
        self._held: deque[tuple[int, int]] = deque()
        self.accepted = self.taken = 0

    async def restart(self) -> None:
        """Reset, whatever is held."""
        await self.reset()
        self._held.clear()
        self.accepted = self.taken = 0

    async def step(self, inputs: Clock) -> None:
        """One clock, all outputs checked; then what was accepted and taken happens."""
        data = inputs.data & ((1 << self.width) - 1)
        await self.clock(in_valid=int(inputs.offer), in_data=data, out_ready=int(inputs.take))
        room = self.depth - len(self._held)
        same(f"room at clock {self.now}", room, self.read("room"))
        same(f"in_ready at clock {self.now}", int(room > 0), self.read("in_ready"))
        offers = bool(self._held) and self.now - self._held[0][1] >= _LATENCY
        same(f"out_valid at clock {self.now}", int(offers), self.read("out_valid"))
        if offers:
            same(f"out_data at clock {self.now}", hex(self._held[0][0]), hex(self.read("out_data")))
        if offers and inputs.take:
            self._held.popleft()
            self.taken += 1
        if inputs.offer and room:
            self._held.append((data, self.now))
            self.accepted += 1

    async def steps(self, clocks: Sequence[Clock]) -> None:
        """Clocks one after the other."""
        for inputs in clocks:
            await self.step(inputs)

    async def drain(self) -> None:
        """All that is held comes, one a clock, and then nothing."""
        for _ in range(self.depth + _LATENCY + 2):
            await self.step(Clock(False, 0, True))
        same("items held in the end", 0, len(self._held))
        same("items taken", self.accepted, self.taken)


def _pattern(longest: int) -> st.SearchStrategy[list[bool]]:
    """So many clocks low, so many high, and so on: often long enough to fill and empty the queue."""
    runs = st.lists(st.integers(0, 3) | st.integers(0, longest), max_size=8)
    return runs.map(
        lambda lengths: [bool(number % 2) for number, length in enumerate(lengths) for _ in range(length)]
    )


def _clocks(bench: FifoBench) -> st.SearchStrategy[list[Clock]]:
    pattern = _pattern(min(2 * bench.depth, _LONGEST))
    data = st.lists(st.integers(0, (1 << bench.width) - 1), min_size=1, max_size=20)
    return st.builds(_together, pattern, pattern, data)


def _together(offers: list[bool], takes: list[bool], data: list[int]) -> list[Clock]:
    """The shorter side ends as it began: an offer lasts, nothing is taken."""
    length = max(len(offers), len(takes))

    def padded(side: list[bool], value: bool) -> Iterator[bool]:
        return chain(side, repeat(value, length - len(side)))

    sides = zip(padded(offers, True), padded(takes, False), strict=True)
    return [
        Clock(offer, data[number % len(data)] + number, take) for number, (offer, take) in enumerate(sides)
    ]


async def _bench(dut: Any) -> tuple[FifoBench, context.Context]:
    run = context.read()
    bench = FifoBench(dut, run.parameters)
    await bench.restart()
    return bench, run


@cocotb.test()
async def it_is_a_list_at_every_clock(dut: Any) -> None:
    """Drawn offers and takes, often until it is full or empty."""
    bench, run = await _bench(dut)

    async def example(clocks: list[Clock]) -> None:
        await bench.restart()
        await bench.steps(clocks)
        await bench.drain()

    await holds(run, example, _clocks(bench))


@cocotb.test()
async def a_long_run_is_a_list_at_every_clock(dut: Any) -> None:
    """Volume: seeded, with both sides fast and slow by turns."""
    bench, run = await _bench(dut)
    generator = run.generator(0)
    for _ in range(max(1, run.operands // (4 * _PART))):
        offer, take = generator.choice([0.1, 0.5, 0.9, 1.0], size=2)
        offers, takes = generator.random((2, _PART)) < [[offer], [take]]
        data = [int.from_bytes(generator.bytes((bench.width + 7) // 8), "big") for _ in range(_PART)]
        await bench.steps(
            [Clock(*values) for values in zip(offers.tolist(), data, takes.tolist(), strict=True)]
        )
    await bench.drain()
    bench.log.info("%d items checked", bench.taken)


@cocotb.test()
async def reset_at_any_moment_empties_it(dut: Any) -> None:
    """Nothing of before comes out, and all room is there again."""
    bench, run = await _bench(dut)

    async def example(before: list[Clock], after: list[Clock]) -> None:
        await bench.steps(before)
        await bench.restart()
        await bench.steps(after)
        await bench.drain()

    await holds(run, example, _clocks(bench), _clocks(bench))


@cocotb.test()
async def it_holds_what_it_promises_and_passes_one_a_clock(dut: Any) -> None:
    """Filled without a taker it holds DEPTH; then, and from empty, one goes in and one out in every clock."""
    bench, _ = await _bench(dut)
    for number in range(bench.depth + 5):
        await bench.step(Clock(True, number, False))
    same("items held", bench.depth, bench.accepted)
    await bench.drain()
    await bench.restart()
    clocks = 10 * bench.depth
    for number in range(clocks + _LATENCY):
        await bench.step(Clock(True, number, True))
    full_rate = bench.depth >= 4
    assert bench.taken >= (clocks if full_rate else clocks * 2 // 3), (
        f"{bench.taken} items in {clocks} clocks"
    )
