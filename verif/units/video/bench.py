"""Tests of the video block: a monitor sees whole pictures, each in its turn, in exactly the mode."""

from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import cocotb
from cocotb.triggers import FallingEdge, RisingEdge, Timer
from hypothesis import strategies as st

from models.images import Rgb
from models.video import screen
from verif.env import context
from verif.env.block import holds, same
from verif.env.pipelined import Mismatch
from verif.video.clocks import PIXEL_PS, Clocks, Ratio, ratios
from verif.video.modes import mode_of, store_of
from verif.video.pictures import Shot, check_order, extremes, shots
from verif.video.samples import Screen
from verif.video.seen import watch
from verif.video.sender import Sender

_DELAY = 4
"""Frames after which a picture that is complete has been seen: one under way, one for the crossing, and
those that the monitor has not told of."""


class VideoBench:
    """The stream on one side, a monitor on the other, which sees but the wires of the screen."""

    def __init__(self, dut: Any) -> None:
        self.run = context.read()
        self._dut = dut
        self.store = store_of(self.run.parameters)
        self.mode = mode_of(self.run.parameters)
        self.full = Shot(self.store.width, self.store.height)
        self.clocks = Clocks(dut)
        self.sender = Sender(dut, self.clocks.core, self.store)
        self.seen_bins = watch(self.run, self.store, self.clocks, self.sender)
        self._screen = Screen(dut, self.mode, self.mode.clocks * PIXEL_PS)
        self.seen: list[Rgb] = []

    async def restart(self, ratio: Ratio) -> None:
        """Both sides and the monitor anew."""
        self.sender.restart()
        await self.clocks.run(ratio)
        self.plug()
        self.sender.start()

    def plug(self) -> None:
        """A monitor that has seen nothing; the screen has just been reset."""
        self._screen.plug()
        self.seen.clear()

    async def frames(self, number: int) -> None:
        """Looks at so many more frames."""
        wanted = len(self.seen) + number
        while len(self.seen) < wanted:
            self.seen += [frame.picture for frame in await self._screen.frames()]

    def judge(self) -> int:
        """Each frame seen is black, or a whole picture in its turn; the number of the last one."""
        pictures = self.sender.assembler.pictures
        shown = check_order(self.seen, [screen(picture, self.mode, self.store) for picture in pictures])
        self.sender.check()
        return shown

    async def bright(self, pixels: int) -> None:
        """Waits until so many pixels that are not black have been seen."""
        seen = 0
        for _ in range(2 * self.mode.clocks * pixels):
            await self.clocks.pixel_edge
            seen += any(self.now[:3])
            if seen == pixels:
                return
        raise Mismatch(f"{seen} pixels are not black, {pixels} were awaited")

    async def in_reset(self) -> bool:
        """Half a pixel clock later: whether the screen's side is in reset."""
        await FallingEdge(self._dut.pixel_clk)
        return bool(self._dut.pixel_rst.value)

    @property
    def now(self) -> tuple[int, ...]:
        """r, g, b, de, hsync, vsync at this moment."""
        dut = self._dut
        return tuple(int(wire.value) for wire in (dut.r, dut.g, dut.b, dut.de, dut.hsync, dut.vsync))

    @property
    def at_rest(self) -> tuple[int, ...]:
        """`now` of a screen in reset."""
        return 0, 0, 0, 0, int(not self.mode.horizontal.positive), int(not self.mode.vertical.positive)

    async def all_shown(self, pictures: int) -> None:
        """See `verif.video.scenarios.Screen`."""
        await self.watch(pictures)

    async def watch(self, shots: int, idles: Sequence[int] = ()) -> None:
        """Looks until all is sent, pictures ``shots`` of it, and the last one is seen; judges all frames."""
        clocks = self.sender.queued * (1 + max(idles, default=0))
        frame_ps = self.mode.clocks * self.clocks.ratio.pixel_ps
        for _ in range(_DELAY + shots + 2 * clocks * self.clocks.ratio.core_ps // frame_ps):
            if self.sender.sent:
                break
            await self.frames(1)
        same("pixels taken", self.sender.queued, self.sender.assembler.taken)
        await self.frames(_DELAY)
        same("last picture seen", len(self.sender.assembler.pictures) - 1, self.judge())


def _idles() -> st.SearchStrategy[list[int]]:
    return st.lists(st.sampled_from([0, 0, 0, 1, 2, 9, 40]), max_size=5)


@cocotb.test()
async def every_frame_seen_is_a_whole_picture_in_its_turn(dut: Any) -> None:
    """Drawn pictures of all sizes, whole and broken, idles, clocks; each figure of a frame is the mode's."""
    bench = VideoBench(dut)

    async def example(ratio: Ratio, sent: list[Shot], idles: list[int]) -> None:
        await bench.restart(ratio)
        whole = await bench.sender.send(sent, idles)
        await bench.watch(len(sent), idles)
        same("whole pictures", len(whole), len(bench.sender.assembler.pictures))

    await holds(bench.run, example, ratios(), st.lists(shots(bench.store), min_size=1, max_size=6), _idles())


@cocotb.test()
async def a_source_that_never_waits_is_held_at_a_picture_a_frame(dut: Any) -> None:
    """With a core as fast as the screen, or faster: no picture is seen twice, none is left out."""
    bench = VideoBench(dut)
    number = 6

    async def example(ratio: Ratio) -> None:
        await bench.restart(ratio)
        await bench.sender.send([bench.full] * number)
        await bench.frames(number + _DELAY)
        same("last picture seen", number - 1, bench.judge())
        black = sum(not picture.any() for picture in bench.seen)
        changes = [bool((a != b).any()) for a, b in pairwise(bench.seen[black:])]
        same("changes of the picture", [True] * (number - 1), changes[: number - 1])

    await holds(bench.run, example, ratios(slower=1, faster=3), cost=2)


@cocotb.test()
async def there_is_black_until_the_first_picture_is_complete(dut: Any) -> None:
    """All of one but a pixel is written, and the screen stays black; then comes a whole one."""
    bench = VideoBench(dut)
    pixels = bench.store.width * bench.store.height

    async def example(ratio: Ratio, frames: int) -> None:
        await bench.restart(ratio)
        await bench.sender.send([Shot(bench.full.width, bench.full.height, cut=pixels - 1)])
        await bench.watch(1)
        await bench.frames(frames)
        same("last picture seen", -1, bench.judge())
        await bench.sender.send([bench.full])
        await bench.watch(1)
        same("last picture seen", 0, bench.judge())

    await holds(bench.run, example, ratios(), st.integers(1, 4), cost=4)


@cocotb.test()
async def pictures_of_other_sizes_are_cut_or_stand_in_the_middle(dut: Any) -> None:
    """Every size from one pixel to more than is stored, one behind the other."""
    bench = VideoBench(dut)
    await bench.restart(Ratio(PIXEL_PS // 2))
    widths, heights = range(1, bench.store.width + 3), range(1, bench.store.height + 3)
    sent = [Shot(width, height) for width in widths for height in heights]
    await bench.sender.send(sent)
    await bench.watch(len(sent))
    same("pictures", len(sent), len(bench.sender.assembler.pictures))


@cocotb.test()
async def the_longest_line_and_column_are_cut_and_the_smallest_pictures_are_not(dut: Any) -> None:
    """Sizes that need all their bits, behind pictures of one to three pixels a side."""
    bench = VideoBench(dut)
    sent = extremes(bench.store)
    await bench.restart(Ratio(PIXEL_PS // 2))
    await bench.sender.send(sent)
    await bench.watch(len(sent))
    same("pictures", len(sent), len(bench.sender.assembler.pictures))


@cocotb.test()
async def reset_of_the_core_in_the_middle_of_a_picture_is_not_seen(dut: Any) -> None:
    """At any moment: the picture before stays, the broken one never comes, and the next one is whole."""
    bench = VideoBench(dut)

    async def example(
        ratio: Ratio, before: list[Shot], wait: int, cycles: int, rest: int, after: list[Shot]
    ) -> None:
        await bench.restart(ratio)
        await bench.sender.send(before)
        await bench.clocks.core.cycles(wait)
        bench.sender.stop()
        await bench.clocks.core_reset(cycles)
        bench.sender.drop()
        bench.sender.start()
        await bench.sender.send_rest(rest)
        pictures = len(bench.sender.assembler.pictures)
        whole = pictures + len(await bench.sender.send(after))
        await bench.watch(len(before) + len(after))
        same("whole pictures", whole, len(bench.sender.assembler.pictures))

    sent = st.lists(shots(bench.store), min_size=1, max_size=3)
    waits, cycles, rests = st.integers(0, 400), st.integers(1, 4), st.integers(0, 9)
    await holds(bench.run, example, ratios(), sent, waits, cycles, rests, sent, cost=2)


@cocotb.test()
async def reset_of_the_screen_begins_with_black(dut: Any) -> None:
    """At any moment, while the stream goes on: the mode is exact again, and then come the next pictures."""
    bench = VideoBench(dut)

    async def example(ratio: Ratio, sent: list[Shot], wait: int, more: int) -> None:
        await bench.restart(ratio)
        await bench.sender.send(sent)
        await Timer(wait * ratio.pixel_ps, "ps")
        await bench.clocks.pixel_reset(more)
        bench.sender.assembler.forget()
        bench.plug()
        await bench.watch(len(sent))

    waits = st.integers(1, 4 * bench.mode.clocks)
    sent = st.lists(shots(bench.store), min_size=2, max_size=6)
    await holds(bench.run, example, ratios(), sent, waits, st.integers(0, 5), cost=2)


@cocotb.test()
async def the_screen_is_black_and_its_syncs_rest_in_reset(dut: Any) -> None:
    """From the first clock of reset, which comes while a picture's pixels are seen, to the last one."""
    bench = VideoBench(dut)

    async def example(ratio: Ratio, pixels: int, more: int) -> None:
        await bench.restart(ratio)
        await bench.sender.send([bench.full])
        await bench.watch(1)
        await bench.bright(pixels)
        reset = cocotb.start_soon(bench.clocks.pixel_reset(more))
        await RisingEdge(dut.pixel_rst)
        await bench.clocks.pixel_edge
        while await bench.in_reset():
            same("screen in reset", bench.at_rest, bench.now)
        await reset

    pixels = st.integers(1, bench.store.width * bench.store.height)
    await holds(bench.run, example, ratios(), pixels, st.integers(0, 5), cost=4)
