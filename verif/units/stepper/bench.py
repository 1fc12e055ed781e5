"""Tests of the stepper against the division that it avoids."""

from collections.abc import Mapping
from typing import Any

import cocotb
from hypothesis import strategies as st

from verif.env import context
from verif.env.block import Block, holds, same
from verif.units.stepper.unit import UNIT

_LONG_LINES = 8


class StepperBench(Block):
    """Loads spans and steps through lines."""

    def __init__(self, dut: Any, parameters: Mapping[str, int]) -> None:
        super().__init__(dut, idle=())
        self.spans = 1 << parameters["SPAN_W"]
        self.counts = 1 << parameters["COUNT_W"]
        self.set(load=0, step=0)

    async def load(self, span: int, count: int) -> None:
        """Starts a line of ``count`` pixels; `step`, which must not matter, is high."""
        self.set(quotient=span // count, remainder=span % count, count=count)
        await self.clock(load=1, step=1)
        self.set(load=0, step=0)

    async def check(self, span: int, count: int, place: int) -> None:
        """One clock without a step: the value of pixel ``place`` stands."""
        await self.clock(step=0)
        self._compare(span, count, place)

    def _compare(self, span: int, count: int, place: int) -> None:
        expected = (2 * place + 1) * span // count % self.spans
        same(f"span {span} of {count}, pixel {place}", expected, self.read("value"))

    async def line(self, span: int, count: int, pixels: int, holds_at: frozenset[int] = frozenset()) -> None:
        """A line, one pixel a clock, an idle clock before those in ``holds_at``."""
        await self.load(span, count)
        for place in range(pixels):
            if place in holds_at:
                await self.check(span, count, place)
            await self.clock(step=1)
            self._compare(span, count, place)
        self.set(step=0)


def _spans(bench: StepperBench) -> st.SearchStrategy[int]:
    return st.sampled_from([0, 1, bench.spans // 2, bench.spans - 1]) | st.integers(0, bench.spans - 1)


def _counts(bench: StepperBench) -> st.SearchStrategy[int]:
    return st.sampled_from([1, 2, bench.counts // 2, bench.counts - 1]) | st.integers(1, bench.counts - 1)


@cocotb.test()
async def value_is_the_floored_quotient_at_every_pixel(dut: Any) -> None:
    """Drawn spans, counts and idle clocks; shrinks to the shortest line that goes wrong."""
    run = context.read()
    bench = StepperBench(dut, run.parameters)

    async def example(span: int, count: int, pixels: int, idle: frozenset[int]) -> None:
        await bench.clock()
        await bench.line(span, count, min(pixels, count), idle)

    idle = st.frozensets(st.integers(0, 63), max_size=8)
    await holds(run, example, _spans(bench), _counts(bench), st.integers(1, 64), idle)


@cocotb.test()
async def no_error_accumulates_over_the_longest_line(dut: Any) -> None:
    """Every pixel of lines as long as the counter allows: the largest spans, the smallest, anything."""
    run = context.read()
    bench = StepperBench(dut, run.parameters)
    await bench.clock()
    generator = run.generator(0)
    count = bench.counts - 1
    spans = [
        bench.spans - 1,
        1,
        count - 1,
        *(int(span) for span in generator.integers(0, bench.spans, _LONG_LINES)),
    ]
    for span in spans[: max(3, min(len(spans), run.operands // count))]:
        await bench.line(span, count, count)


@cocotb.test()
async def twice_the_remainder_carries_from_half_of_the_count_on(dut: Any) -> None:
    """Twice the remainder differs from the count by less than each of its bits is worth.

    One carry makes up for the other until the sum is near the count, so lines are long enough for that.
    """
    run = context.read()
    bench = StepperBench(dut, run.parameters)
    await bench.clock()
    for count in (bench.counts // 3, bench.counts // 3 * 2):
        for bit in range(run.parameters["COUNT_W"] - 1):
            for away in (-1, -(3 << bit) // 4, 1, (3 << bit) // 4):
                whole = int(run.generator(bit).integers(0, bench.spans // count - 1)) * count
                await bench.line(whole + (count + away) // 2, count, min(count, (count << 1 >> bit) + 3))


@cocotb.test()
async def every_line_of_a_narrow_stepper_is_exact(dut: Any) -> None:
    """All spans, all counts, all pixels, in the parameter set that is narrow enough."""
    run = context.read()
    if run.parameter_set != UNIT.exhaustive:
        return
    bench = StepperBench(dut, run.parameters)
    await bench.clock()
    for count in range(1, bench.counts):
        for span in range(bench.spans):
            await bench.line(span, count, count)


@cocotb.test()
async def a_load_in_the_middle_of_a_line_starts_the_next_one_exactly(dut: Any) -> None:
    """What is left of the line before has no influence."""
    run = context.read()
    bench = StepperBench(dut, run.parameters)

    async def example(first: tuple[int, int], steps: int, second: tuple[int, int]) -> None:
        await bench.clock()
        await bench.line(*first, min(steps, first[1]))
        await bench.line(*second, min(8, second[1]))

    line = st.tuples(_spans(bench), _counts(bench))
    await holds(run, example, line, st.integers(1, 16), line)
