"""Tests of the timing: every clock is the mode's, and a monitor that sees only the pulses finds it."""

from typing import Any

import cocotb
import numpy as np
from hypothesis import strategies as st

from models.video import Mode, waveform
from verif.env import context
from verif.env.block import Block, holds, same
from verif.video.modes import mode_of
from verif.video.monitor import Monitor
from verif.video.samples import Probe

_FRAMES = 3
_SIGNALS = ("hsync", "vsync", "active", "blank_start", "x", "y")


class TimingBench(Block):
    """The timing, clock by clock against the mode."""

    def __init__(self, dut: Any, mode: Mode) -> None:
        super().__init__(dut, idle=())
        self.mode = mode
        self._wave = waveform(mode)

    def _expected(self, clock: int) -> dict[str, int]:
        """What the outputs are, so many clocks after reset; x and y where the place is seen."""
        across, down = self.mode.horizontal, self.mode.vertical
        # Reset is the first clock behind the back porch of the first line that is not seen.
        start = (down.lead + down.active) * across.total + across.lead
        time = (start + clock) % self.mode.clocks
        line, place = divmod(time, across.total)
        expected = {
            "hsync": int(self._wave.hsync[time]),
            "vsync": int(self._wave.vsync[time]),
            "active": int(self._wave.de[time]),
            "blank_start": int(line == down.lead + down.active and place == 0),
        }
        if expected["active"]:
            expected |= {"x": place - across.lead, "y": line - down.lead}
        return expected

    async def compare(self, clocks: int) -> None:
        """Every output in each of the clocks since reset."""
        for clock in range(clocks):
            await self.clock()
            for name, value in self._expected(clock).items():
                same(f"{name}, {clock} clocks after reset", value, self.read(name))


@cocotb.test()
async def every_clock_is_the_modes(dut: Any) -> None:
    """Pulses, active part, places and the start of blank, for some frames from reset."""
    mode = mode_of(context.read().parameters)
    bench = TimingBench(dut, mode)
    await bench.reset()
    await bench.compare(_FRAMES * mode.clocks)


@cocotb.test()
async def reset_at_any_clock_begins_a_vertical_blank(dut: Any) -> None:
    """In reset the pulses rest; behind it all is as it was the first time."""
    run = context.read()
    mode = mode_of(run.parameters)
    bench = TimingBench(dut, mode)

    async def example(before: int, cycles: int) -> None:
        await bench.reset()
        await bench.clocks(before)
        await bench.reset(cycles)
        same("hsync in reset", int(not mode.horizontal.positive), bench.read("hsync"))
        same("vsync in reset", int(not mode.vertical.positive), bench.read("vsync"))
        same("active in reset", 0, bench.read("active"))
        await bench.compare(mode.clocks)

    await holds(run, example, st.integers(0, 2 * mode.clocks), st.integers(2, 5), cost=4)


@cocotb.test()
async def a_monitor_locks_and_finds_every_figure_of_the_mode(dut: Any) -> None:
    """It gets the wires alone."""
    mode = mode_of(context.read().parameters)
    bench = TimingBench(dut, mode)
    await bench.reset()
    monitor = Monitor((mode,))
    probe = Probe(dut, dut.clk, {"de": "active"})
    frames = monitor.feed(await probe.take((_FRAMES + 1) * mode.clocks))
    same("frames", _FRAMES, len(frames))
    for frame in frames:
        same("faults", [], frame.faults(mode))
        same("size", mode.size[::-1], frame.picture.shape[:2])
    same("clocks between frames", {mode.clocks}, set(np.diff([frame.start for frame in frames]).tolist()))
