"""Tests of the merge at every clock: what the header says, and whose turn it is."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import cocotb
from hypothesis import strategies as st

from models.latency import LATENCY
from verif.env import context
from verif.env.block import Block, holds, same
from verif.env.pipelined import Mismatch

_PART = 200
"""Clocks of the long run with one manner of all sides."""

_SCATTER = 0x9E37_79B9_7F4A_7C15_F39C_C060_5CED_C834_1082_276B
"""Odd, and large: multiples of it scatter over all bits of an item."""


@dataclass(frozen=True)
class Clock:
    """Inputs of one clock: which streams have an item from now on, if they had none; whether one is taken."""

    offers: Sequence[bool]
    take: bool


class MergeBench(Block):
    """Offers items, each in its stream until it is accepted, and takes them.

    An item tells its stream and its place in it, scattered over all its bits.
    """

    def __init__(self, dut: Any, parameters: Mapping[str, int]) -> None:
        super().__init__(dut, idle=("in_valid", "out_ready"), carried={"in_valid": ("in_data",)})
        self.set(in_data=0)
        self.ports, self._width = parameters["PORTS"], parameters["WIDTH"]
        self._start()

    def _start(self) -> None:
        self._offered: dict[int, int] = {}
        self._output: int | None = None
        self._waited = [0] * self.ports
        self.accepted = [0] * self.ports
        self.longest = 0
        self._last = -1

    async def restart(self) -> None:
        """Reset for one clock, whatever is offered or waits."""
        await self.reset(cycles=1)
        self._start()

    def _item(self, stream: int) -> int:
        mark = stream + self.ports * self.accepted[stream]
        return (mark ^ mark * _SCATTER >> 40) & ((1 << self._width) - 1)

    async def step(self, inputs: Clock) -> None:
        """One clock, all outputs checked."""
        for stream, offer in enumerate(inputs.offers):
            if offer:
                self._offered.setdefault(stream, self._item(stream))
        valid = sum(1 << stream for stream in self._offered)
        # A stream without an item shows something else all the same.
        shown = [self._offered.get(stream, ~self._item(stream)) for stream in range(self.ports)]
        mask = (1 << self._width) - 1
        data = sum((item & mask) << self._width * stream for stream, item in enumerate(shown))
        await self.clock(in_valid=valid, in_data=data, out_ready=int(inputs.take))
        self._check_output()
        self._end(self._granted(inputs.take), inputs.take)

    def _check_output(self) -> None:
        """Exactly what was accepted and has not been taken, one clock behind its acceptance."""
        same(f"out_valid at clock {self.now}", int(self._output is not None), self.read("out_valid"))
        if self._output is not None:
            same(f"out_data at clock {self.now}", hex(self._output), hex(self.read("out_data")))

    def _granted(self, take: bool) -> int | None:
        """The stream whose item is accepted: one of those that have one, exactly where there is a place."""
        ready = self.read("in_ready")
        granted = [stream for stream in self._offered if ready >> stream & 1]
        expected = bool(self._offered) and (self._output is None or take)
        same(f"items accepted at clock {self.now}", int(expected), len(granted))
        if granted:
            same(f"stream served at clock {self.now}", self._turn(), granted[0])
            self._last = granted[0]
        return granted[0] if granted else None

    def _turn(self) -> int:
        """The next one by number behind the one that was served last, of those that wait."""
        return min(self._offered, key=lambda stream: (stream <= self._last, stream))

    def _end(self, granted: int | None, take: bool) -> None:
        if take:
            self._output = None
        if granted is None:
            return
        self._output = self._offered.pop(granted)
        self.accepted[granted] += 1
        self._waited[granted] = 0
        for stream in self._offered:
            self._waited[stream] += 1
            self.longest = max(self.longest, self._waited[stream])
            if self._waited[stream] >= self.ports:
                raise Mismatch(
                    f"clock {self.now}: stream {stream} has waited for {self.ports} items of others"
                )

    async def steps(self, clocks: Sequence[Clock]) -> None:
        """Clocks one after the other."""
        for inputs in clocks:
            await self.step(inputs)

    async def drain(self) -> None:
        """Everything that was offered comes, one a clock."""
        await self.steps([Clock([False] * self.ports, True)] * (self.ports + LATENCY["merge"]({}) + 1))
        same("items left", (0, None), (len(self._offered), self._output))


def _clocks(bench: MergeBench) -> st.SearchStrategy[list[Clock]]:
    """Some streams always have items."""
    offers = st.lists(st.booleans(), min_size=bench.ports, max_size=bench.ports)
    busy = st.lists(st.booleans(), min_size=bench.ports, max_size=bench.ports)

    def with_busy(drawn: tuple[list[bool], list[Clock]]) -> list[Clock]:
        always, clocks = drawn
        return [
            Clock([one or other for one, other in zip(always, inputs.offers, strict=True)], inputs.take)
            for inputs in clocks
        ]

    clocks = st.lists(st.builds(Clock, offers, st.booleans() | st.just(True)), max_size=60)
    return st.tuples(busy, clocks).map(with_busy)


async def _bench(dut: Any) -> tuple[MergeBench, context.Context]:
    run = context.read()
    bench = MergeBench(dut, run.parameters)
    await bench.restart()
    return bench, run


@cocotb.test()
async def each_item_comes_once_in_order_and_in_fair_turn(dut: Any) -> None:
    """Drawn offers and stalls; some streams always have items."""
    bench, run = await _bench(dut)

    async def example(clocks: list[Clock]) -> None:
        await bench.restart()
        await bench.steps(clocks)
        await bench.drain()

    await holds(run, example, _clocks(bench))


@cocotb.test()
async def a_long_run_loses_nothing(dut: Any) -> None:
    """Volume: seeded, with busy and idle streams and a taker that is fast or slow by turns."""
    bench, run = await _bench(dut)
    generator = run.generator(0)
    for _ in range(max(2, run.operands // (5 * _PART))):
        rates = generator.choice([0.0, 0.1, 0.5, 1.0], bench.ports)
        offers = (generator.random((_PART, bench.ports)) < rates).tolist()
        takes = (generator.random(_PART) < generator.choice([0.1, 0.5, 0.9, 1.0])).tolist()
        await bench.steps([Clock(*values) for values in zip(offers, takes, strict=True)])
    await bench.drain()
    bench.log.info("%s items checked", bench.accepted)


@cocotb.test()
async def streams_that_always_have_items_get_equal_shares_of_one_a_clock(dut: Any) -> None:
    """All of them, and each choice of some."""
    bench, _ = await _bench(dut)
    for chosen in range(1, 1 << bench.ports):
        offers = [bool(chosen >> stream & 1) for stream in range(bench.ports)]
        rounds = 10
        await bench.restart()
        await bench.steps([Clock(offers, True)] * (rounds * sum(offers)))
        same(f"items of streams {offers}", [rounds * offer for offer in offers], bench.accepted)
        same(f"longest wait of streams {offers}", sum(offers) - 1, bench.longest)


@cocotb.test()
async def reset_at_any_moment_empties_it(dut: Any) -> None:
    """The item at the output is forgotten."""
    bench, run = await _bench(dut)

    async def example(before: list[Clock], after: list[Clock]) -> None:
        await bench.steps(before)
        await bench.restart()
        await bench.step(Clock([False] * bench.ports, False))
        await bench.steps(after)
        await bench.drain()

    await holds(run, example, _clocks(bench), _clocks(bench))
