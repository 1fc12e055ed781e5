"""Tests of the delay line: a word comes out as many clocks after it went in as the line is deep."""

from collections import deque
from typing import Any

import cocotb
from cocotb.task import resume
from hypothesis import strategies as st

from verif.env import context, properties
from verif.env.clocking import Clocking
from verif.env.coverage.sampling import Signals
from verif.env.pipelined import Mismatch
from verif.units.delay.coverage import COVERAGE

_RESET_CLOCKS = 2


class DelayBench:
    """Drives all lines alike and remembers what went in since the last reset."""

    def __init__(self, dut: Any, run: context.Context) -> None:
        self._clocking = Clocking(dut)
        self._in, self._out, self._rst = getattr(dut, "in"), dut.out, dut.rst
        self.most = (1 << run.parameters["WIDTH"]) - 1
        self._width, self._depths = run.parameters["WIDTH"], run.parameters["DEPTHS"]
        self._past: deque[int] = deque(maxlen=self._depths)
        self.signals = Signals(dut, run, COVERAGE) if run.unit else None

    async def reset(self) -> None:
        """Resets the lines; what is in them counts no more."""
        self._in.value = 0
        self._rst.value = 1
        for _ in range(_RESET_CLOCKS):
            await self._edge()
        self._rst.value = 0
        await self._edge()
        self._past.clear()

    async def _edge(self) -> None:
        await self._clocking.edge
        if self.signals is not None:
            self.signals.sample()

    async def clock(self, word: int) -> None:
        """One word in; checks the lines that have been filled since the reset."""
        self._in.value = word
        await self._edge()
        self._past.append(word)
        out = str(self._out.value)
        for depth, expected in enumerate(reversed(self._past)):
            end = len(out) - depth * self._width
            got = out[end - self._width : end]
            if got != format(expected, f"0{self._width}b"):
                raise Mismatch(f"depth {depth}: expected {expected}, got 0b{got}")


@cocotb.test()
async def words_come_out_as_late_as_the_line_is_deep(dut: Any) -> None:
    """Volume: seeded words, every depth at once."""
    run = context.read()
    bench = DelayBench(dut, run)
    await bench.reset()
    words = run.generator(0).integers(0, bench.most, min(run.operands, 20_000), endpoint=True)
    for word in words:
        await bench.clock(int(word))


@cocotb.test()
async def lines_are_exact_after_a_reset_at_any_moment(dut: Any) -> None:
    """Property over the words before and after a reset; shrinks to the shortest sequence."""
    run = context.read()
    bench = DelayBench(dut, run)

    async def example(before: list[int], after: list[int]) -> None:
        for words in (before, after):
            await bench.reset()
            for word in words:
                await bench.clock(word)

    words = st.lists(st.integers(0, bench.most), max_size=50)
    await properties.check(run, resume(example), words, words)
