"""Tests of the core's streams, clock by clock: idle sources, stalling sinks, and what marks a pixel."""

from collections.abc import Sequence
from typing import Any

import cocotb
import numpy as np
from hypothesis import strategies as st
from numpy.typing import NDArray

from verif.core.driver import StreamedCore
from verif.core.setting import Setting
from verif.core.strategies import Shot
from verif.env.block import holds, same
from verif.env.simulators import Simulator

_LONG, _LONG_ON_ICARUS = 20_000, 100
"""Clocks: of several frames, and of many queues."""


@cocotb.test()
async def waiting_on_either_side_neither_loses_nor_changes_a_pixel(dut: Any) -> None:
    """Drawn idles of the frame's words and drawn stalls of the pixels' consumer: the same stream of pixels.

    Start of frame on the first pixel alone, end of line on each last one; valid and what is offered hold
    until ready.
    """
    setting = Setting.of(dut)
    streams = StreamedCore(dut, setting.core)
    waits = st.lists(st.integers(0, 3) | st.integers(0, 40), max_size=6)

    async def example(shot: Shot, idles: list[int], stalls: list[int]) -> None:
        await streams.reset(shot.registers)
        streams.stall(stalls)
        words = setting.words(shot.scene)
        width, number = shot.registers.width, shot.registers.width * shot.registers.height
        streams.send(words, idles)
        spare = len(words) * max(idles, default=0) + number * max(stalls, default=0)
        got = await setting.collected(shot, streams.pixels(number), spare)
        rgb, first, last = zip(*got.words, strict=True)
        same("pixels", number, len(rgb))
        setting.same_since_reset(setting.same_pixels(shot, colours(rgb)))
        same("pixels marked as first of the frame", [0], [n for n, mark in enumerate(first) if mark])
        ends = list(range(width - 1, number, width))
        same("pixels marked as last of a line", ends, [n for n, mark in enumerate(last) if mark])
        same("busy behind the last pixel", False, setting.core.busy)

    await holds(setting.run, example, setting.shots(), waits, waits)


@cocotb.test()
async def streams_that_are_stuck_for_long_lose_nothing(dut: Any) -> None:
    """The words of a frame in its middle, then the consumer of the pixels, then both, of frames in a row."""
    setting = Setting.of(dut)
    streams = StreamedCore(dut, setting.core)
    long = _LONG_ON_ICARUS if setting.simulator == Simulator.ICARUS else _LONG
    shot = await setting.example(3, 2)
    await streams.reset(shot.registers)
    words, number = setting.words(shot.scene), 6
    middle = [long if place == len(words) // 2 else 0 for place in range(len(words))]
    drawn = []
    for idles, stalls in ((middle, []), ([], [0, 0, long, 0, 0, 0]), (middle, [long, 0, 0, 0, 0, long])):
        streams.stall(stalls)
        streams.send(words, idles)
        got = await setting.collected(shot, streams.pixels(number), sum(idles) + sum(stalls))
        drawn.append(setting.same_pixels(shot, colours([word for word, _, _ in got.words])))
        same("busy behind the last pixel", False, setting.core.busy)
    setting.same_since_reset(*drawn)


def colours(words: Sequence[int]) -> NDArray[np.uint8]:
    """Pixels (n, 3) of video words."""
    packed = np.array(words)
    return np.stack([packed >> 16 & 255, packed >> 8 & 255, packed & 255], axis=-1).astype(np.uint8)


@cocotb.test()
async def the_core_counts_the_clocks_in_which_it_is_busy(dut: Any) -> None:
    """Those behind the one in which the frame begins, to that of its last pixel."""
    setting = Setting.of(dut)
    core = setting.core
    shot = await setting.example(3, 2)
    drawing = cocotb.start_soon(core.draw(setting.words(shot.scene)))
    clocks = -1
    while not drawing.done():
        await core.clocking.edge
        clocks += core.busy
    got = await drawing
    setting.same_picture(shot, got)
    same("clocks", clocks, core.cycles)
