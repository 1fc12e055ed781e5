"""Tests of the delay line: a word comes out as many clocks after it went in as the line is deep."""

from collections import deque
from typing import Any

import cocotb
from cocotb.task import resume
from hypothesis import strategies as st

from verif.env import context, properties
from verif.env.clocking import Clocking
from verif.env.coverage.sampling import Signals
from verif.env.inside import inside
from verif.env.pipelined import Mismatch
from verif.units.delay.coverage import COVERAGE

_RESET_CLOCKS = 2
_SHALLOWEST_RING = 4
"""Clocks from which on a line is a ring; below it is a chain of registers."""


class DelayBench:
    """Drives all lines alike and remembers what went in since the last reset."""

    def __init__(self, dut: Any, run: context.Context) -> None:
        self._clocking = Clocking(dut)
        self._in, self._out, self._rst = getattr(dut, "in"), dut.out, dut.rst
        self.most = (1 << run.parameters["WIDTH"]) - 1
        self._width, self.depths = run.parameters["WIDTH"], run.parameters["DEPTHS"]
        self._past: deque[int] = deque(maxlen=self.depths)
        self._pointers = [
            inside(dut, f"g_depth[{depth}].u_delay.g_ring.pointer_reg")
            for depth in range(_SHALLOWEST_RING, self.depths)
        ]
        self.signals = Signals(dut, run, COVERAGE) if run.unit else None

    @property
    def pointer_width(self) -> int:
        """Bits of the longest ring's pointer."""
        return max((len(pointer) for pointer in self._pointers), default=0)

    def pointers(self) -> list[int]:
        """Of every ring, the shortest first."""
        return [int(pointer.value) for pointer in self._pointers]

    def power_up(self, start: int) -> None:
        """Sets every ring's pointer, as far as it holds the number."""
        for pointer in self._pointers:
            pointer.value = start % (1 << len(pointer))

    async def reset(self, clocks: int = _RESET_CLOCKS) -> None:
        """Resets the lines; what is in them counts no more."""
        self._in.value = 0
        self._rst.value = 1
        for _ in range(clocks):
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
async def a_reset_sets_the_ring_right_wherever_it_powers_up(dut: Any) -> None:
    """Each pointer of each ring, those behind its last word too; a reset of one clock, behind which all stand
    at their first word; then as many words as the longest line holds, twice."""
    run = context.read()
    bench = DelayBench(dut, run)
    for start in range(1 << bench.pointer_width):
        bench.power_up(start)
        await bench.reset(clocks=1)
        assert not any(bench.pointers()), f"pointers {bench.pointers()} behind a reset at {start}, not all 0"
        for word in run.generator(start).integers(0, bench.most, 2 * bench.depths, endpoint=True):
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
