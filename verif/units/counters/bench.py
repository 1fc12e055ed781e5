"""Tests of the core's counters against sums of what has happened, at every clock."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, fields
from typing import Any

import cocotb
from hypothesis import strategies as st

from verif.env import context
from verif.env.block import Block, holds, same

_COUNTER_OF = {
    "busy": "cycles",
    "primary": "primary_rays",
    "secondary": "secondary_rays",
    "shadow": "shadow_rays",
    "tested": "tests",
    "at_point": "lights_at_point",
    "flat": "degenerate",
}
"""Event and counter, by port."""
_REGISTERS = ("frame_reg", "at_point_reg", "flat_reg")
"""All counters, side by side."""
COUNTER_W = 32
_SINCE_RESET = ("lights_at_point", "degenerate")
_RARE = 1 / 50
"""Share of the clocks of a long run in which a frame begins."""


@dataclass(frozen=True)
class Clock:
    """Inputs of one clock, by port."""

    frame_start: bool = False
    busy: bool = False
    primary: bool = False
    secondary: bool = False
    shadow: bool = False
    tested: int = 0
    at_point: bool = False
    flat: bool = False

    @property
    def inputs(self) -> dict[str, int]:
        """By port."""
        return {field.name: int(getattr(self, field.name)) for field in fields(self)}


class CountersBench(Block):
    """Makes events, and compares all counters at every clock."""

    def __init__(self, dut: Any, parameters: Mapping[str, int]) -> None:
        super().__init__(dut, idle=[field.name for field in fields(Clock)])
        self.units = parameters["UNITS"]
        self.expected = dict.fromkeys(_COUNTER_OF.values(), 0)

    async def restart(self) -> None:
        """Reset for one clock: all counters are 0."""
        await self.reset(cycles=1)
        self.expected = dict.fromkeys(_COUNTER_OF.values(), 0)

    async def preset(self, number: int) -> None:
        """A clock without events; all counters stand at ``number`` after it."""
        await self.step(Clock())
        for register in _REGISTERS:
            value = getattr(self._dut, register)
            value.value = sum(number << low for low in range(0, len(value), COUNTER_W))
        self.expected = dict.fromkeys(self.expected, number)

    async def step(self, inputs: Clock) -> None:
        """One clock: the counters show all that was before it."""
        await self.clock(**inputs.inputs)
        got = {counter: self.read(counter) for counter in self.expected}
        same(f"counters at clock {self.now}", self.expected, got)
        for event, counter in _COUNTER_OF.items():
            counted = self.expected[counter] + int(getattr(inputs, event)).bit_count()
            self.expected[counter] = counted % (1 << COUNTER_W)
            if inputs.frame_start and counter not in _SINCE_RESET:
                self.expected[counter] = 0

    async def steps(self, clocks: Iterable[Clock]) -> None:
        """Clocks one after the other, and one without events."""
        for inputs in clocks:
            await self.step(inputs)
        await self.step(Clock())


def _clocks(bench: CountersBench) -> st.SearchStrategy[list[Clock]]:
    flag = st.booleans()
    tested = st.integers(0, (1 << bench.units) - 1)
    rarely = st.sampled_from([False, False, False, True])
    return st.lists(st.builds(Clock, rarely, flag, flag, flag, flag, tested, flag, flag), max_size=30)


async def _bench(dut: Any) -> tuple[CountersBench, context.Context]:
    run = context.read()
    bench = CountersBench(dut, run.parameters)
    await bench.restart()
    return bench, run


@cocotb.test()
async def every_event_counts_in_its_counter(dut: Any) -> None:
    """Drawn events and frames; what is of a frame begins anew with it, the rest goes on."""
    bench, run = await _bench(dut)

    async def example(clocks: list[Clock]) -> None:
        await bench.restart()
        await bench.steps(clocks)

    await holds(run, example, _clocks(bench))


@cocotb.test()
async def a_long_run_counts_exactly(dut: Any) -> None:
    """Volume: seeded, many events of all kinds, frames of some fifty clocks."""
    bench, run = await _bench(dut)
    generator, size = run.generator(0), max(1000, run.operands // 10)
    starts = generator.random(size) < _RARE
    events = (generator.random((6, size)) < 0.5).T.tolist()
    tested = generator.integers(0, 1 << bench.units, size).tolist()
    for start, (busy, primary, secondary, shadow, at_point, flat), tests in zip(
        starts.tolist(), events, tested, strict=True
    ):
        await bench.step(Clock(start, busy, primary, secondary, shadow, tests, at_point, flat))
    bench.log.info("%s", bench.expected)


@cocotb.test()
async def each_event_alone_moves_one_counter(dut: Any) -> None:
    """By one, or by as many trace units as have tested; past the low bits of the counters too."""
    bench, _ = await _bench(dut)
    all_units = (1 << bench.units) - 1
    clocks = 300
    for event, counter in _COUNTER_OF.items():
        await bench.restart()
        many = event == "tested"
        alone: dict[str, Any] = {event: all_units if many else True}
        await bench.steps([Clock(**alone)] * clocks)
        expected = dict.fromkeys(bench.expected, 0)
        expected[counter] = clocks * (bench.units if many else 1)
        same(f"counters after {clocks} clocks of {event}", expected, bench.expected)


@cocotb.test()
async def reset_clears_all_counters(dut: Any) -> None:
    """At any moment, also those that count across frames."""
    bench, run = await _bench(dut)

    async def example(before: list[Clock], after: list[Clock]) -> None:
        await bench.steps(before)
        await bench.restart()
        await bench.steps(after)

    await holds(run, example, _clocks(bench), _clocks(bench))


@cocotb.test()
async def every_bit_of_every_counter_counts(dut: Any) -> None:
    """Also those that no run waits for: counters are set to each 2^k - 1 and count on, past 2^32 too."""
    bench, _ = await _bench(dut)
    tested = (1 << bench.units) - 1
    for bits in range(1, COUNTER_W + 1):
        await bench.preset((1 << bits) - 1)
        await bench.step(Clock(False, True, True, True, True, tested, True, True))
        await bench.step(Clock())
