"""Tests of the frame buffer: whatever is read between two swaps is one whole picture, each in its turn."""

from collections.abc import Sequence
from typing import Any

import cocotb
import numpy as np
from hypothesis import strategies as st
from numpy.typing import NDArray

from verif.env import context
from verif.env.block import holds, same
from verif.env.pipelined import Mismatch
from verif.video.clocks import PIXEL_PS, Clocks, Ratio, ratios
from verif.video.modes import store_of
from verif.video.pictures import LARGEST, Shot, extremes, powers, shots
from verif.video.seen import watch
from verif.video.sender import Sender

Codes = NDArray[np.uint32]

_CROSSING = 8
"""More of the slower clocks than a picture takes from its last pixel until a swap finds it."""

_NONE: Codes = np.zeros((0, 0), dtype=np.uint32)


class BufferBench:
    """The stream on one side; on the other the test is the screen: it swaps, and reads the picture shown.

    shown: number of that picture, -1 for none.
    """

    def __init__(self, dut: Any) -> None:
        self.run = context.read()
        self.store = store_of(self.run.parameters)
        self.full = Shot(self.store.width, self.store.height)
        self._dut = dut
        self.clocks = Clocks(dut)
        self.sender = Sender(dut, self.clocks.core, self.store)
        self.seen = watch(self.run, self.store, self.clocks, self.sender)
        self.shown = -1
        dut.swap.value = 0
        dut.address.value = 0

    async def restart(self, ratio: Ratio) -> None:
        """Both sides anew."""
        self._dut.swap.value = 0
        self.sender.restart()
        self.shown = -1
        await self.clocks.run(ratio)
        self.sender.start()

    async def pixel_clocks(self, number: int) -> None:
        """Lets clocks of the screen pass."""
        for _ in range(number):
            await self.clocks.pixel_edge

    async def crossing(self) -> None:
        """Waits for what is under way from one clock to the other."""
        slower, pixel = self.clocks.ratio.slower_ps, self.clocks.ratio.pixel_ps
        await self.pixel_clocks(_CROSSING * -(-slower // pixel))

    async def sending(self, pixels: int) -> None:
        """Waits for as long as so many pixels take, and for what they lead to."""
        await self.pixel_clocks(-(-pixels * self.clocks.ratio.core_ps // self.clocks.ratio.pixel_ps))
        await self.crossing()

    async def swap(self) -> None:
        """One clock of swap; from the next one on its effect is seen."""
        self._dut.swap.value = 1
        await self.clocks.pixel_edge
        self._dut.swap.value = 0
        await self.clocks.pixel_edge

    def size(self) -> tuple[int, int]:
        """Of the picture shown."""
        return int(self._dut.shown_width.value), int(self._dut.shown_height.value)

    async def _read(self) -> Codes:
        """The picture shown, a pixel a clock; its size holds still meanwhile."""
        width, height = size = self.size()
        if width > self.store.width or height > self.store.height:
            raise Mismatch(f"a picture of {width} x {height} is shown")
        rows, columns = np.mgrid[:height, :width]
        codes = []
        for address in (rows * self.store.width + columns).ravel().tolist():
            self._dut.address.value = address
            await self.clocks.pixel_edge
            codes.append(str(self._dut.colour.value))
        await self.clocks.pixel_edge
        # A colour comes a clock behind its address.
        codes = [*codes[1:], str(self._dut.colour.value)] if codes else []
        same("size of the picture shown", size, self.size())
        if any(set(code) - {"0", "1"} for code in codes):
            raise Mismatch("the picture shown has unknown bits")
        return np.array([int(code, 2) for code in codes], dtype=np.uint32).reshape(height, width)

    def _stored(self, number: int) -> Codes | None:
        """What is read of a picture; None where it does not exist."""
        pictures = self.sender.assembler.pictures
        if number >= len(pictures):
            return None
        return _NONE if number < 0 else self.store.codes(self.store.crop(pictures[number]))

    async def look(self) -> int:
        """Reads the picture shown: it is the same as before, or the next one. Its number."""
        # What becomes complete while it is read cannot be what is shown.
        expected = self._stored(self.shown + 1), self._stored(self.shown)
        codes = await self._read()
        if expected[0] is not None and np.array_equal(codes, expected[0]):
            self.shown += 1
            self._told("the_next_picture")
        elif expected[1] is None or not np.array_equal(codes, expected[1]):
            raise Mismatch(f"behind picture {self.shown}:\n{codes}\nis shown, the next one is\n{expected[0]}")
        else:
            self._told("no_picture_yet" if self.shown < 0 else "the_same_picture")
        return self.shown

    def _told(self, name: str) -> None:
        if self.seen is not None:
            self.seen.tell(f"swap.{name}")

    async def all_shown(self, _pictures: int) -> None:
        """See `verif.video.scenarios.Screen`."""
        await self.watch()

    async def watch(self, gaps: Sequence[int] = ()) -> None:
        """Swaps and looks until all is sent and the last picture is shown."""
        quiet = 0
        core_clocks = -(-self.clocks.ratio.core_ps // self.clocks.ratio.pixel_ps)
        for turn in range(20 + 20 * self.sender.queued * core_clocks):
            before, sent = self.shown, self.sender.sent
            await self.pixel_clocks(gaps[turn % len(gaps)] if gaps else 0)
            if sent:
                await self.crossing()
            await self.swap()
            quiet = quiet + 1 if sent and await self.look() == before else 0
            if not sent:
                await self.look()
            if quiet == 2:
                break
        same("pixels taken", self.sender.queued, self.sender.assembler.taken)
        same("last picture shown", len(self.sender.assembler.pictures) - 1, self.shown)
        self.sender.check()


def _idles() -> st.SearchStrategy[list[int]]:
    return st.lists(st.sampled_from([0, 0, 0, 1, 2, 9]), max_size=5)


def _gaps() -> st.SearchStrategy[list[int]]:
    return st.lists(st.integers(0, 3) | st.integers(0, 60), max_size=4)


@cocotb.test()
async def every_whole_picture_is_shown_in_its_turn_and_nothing_else(dut: Any) -> None:
    """Drawn pictures of all sizes, whole and broken, idles, swaps, and clocks."""
    bench = BufferBench(dut)

    async def example(ratio: Ratio, sent: list[Shot], idles: list[int], gaps: list[int]) -> None:
        await bench.restart(ratio)
        whole = await bench.sender.send(sent, idles)
        await bench.watch(gaps)
        same("whole pictures", len(whole), len(bench.sender.assembler.pictures))

    sent = st.lists(shots(bench.store), min_size=1, max_size=6)
    await holds(bench.run, example, ratios(), sent, _idles(), _gaps())


@cocotb.test()
async def the_longest_line_and_column_are_cut_and_the_smallest_pictures_are_not(dut: Any) -> None:
    """Sizes that need all their bits, or one alone, behind pictures of one to three pixels a side."""
    bench = BufferBench(dut)
    sent = [*extremes(bench.store), *powers()]
    await bench.restart(Ratio(PIXEL_PS // 2))
    await bench.sender.send(sent)
    await bench.watch()
    same("pictures", len(sent), len(bench.sender.assembler.pictures))


@cocotb.test()
async def a_complete_picture_waits_for_a_swap_and_holds_the_stream(dut: Any) -> None:
    """Without a swap just one picture is taken, and none is shown; each swap shows it and frees the next."""
    bench = BufferBench(dut)
    pixels, number = bench.store.width * bench.store.height, 4

    async def example(ratio: Ratio, wait: int) -> None:
        await bench.restart(ratio)
        await bench.sender.send([bench.full] * number)
        for picture in range(number):
            await bench.sending(pixels + wait)
            same("pixels taken", (picture + 1) * pixels, bench.sender.assembler.taken)
            same("tready", 0, int(dut.s_axis_video_tready.value))
            same("shown before the swap", picture - 1, await bench.look())
            await bench.swap()
            same("shown behind the swap", picture, await bench.look())
        bench.sender.check()

    await holds(bench.run, example, ratios(), st.integers(0, 100), cost=2)


@cocotb.test()
async def a_swap_without_a_complete_picture_changes_nothing(dut: Any) -> None:
    """A part of a picture is written behind a whole one, and screens go by; then comes the next picture."""
    bench = BufferBench(dut)
    pixels = bench.store.width * bench.store.height

    async def example(ratio: Ratio, part: int, swaps: int) -> None:
        await bench.restart(ratio)
        await bench.sender.send([bench.full])
        await bench.watch()
        await bench.sender.send([Shot(bench.full.width, bench.full.height, cut=part)])
        await bench.sending(part)
        for _ in range(swaps):
            await bench.swap()
            same("shown", 0, await bench.look())
        await bench.sender.send([bench.full])
        await bench.watch()
        same("shown in the end", 1, bench.shown)

    await holds(bench.run, example, ratios(), st.integers(1, pixels - 1), st.integers(1, 6), cost=2)


@cocotb.test()
async def behind_a_whole_picture_all_is_dropped_up_to_the_next(dut: Any) -> None:
    """More lines of one pixel, which nothing begins, than rows can be counted."""
    bench = BufferBench(dut)
    await bench.restart(Ratio(PIXEL_PS // 2))
    await bench.sender.send([Shot(1, 1)])
    await bench.sender.send_rest(LARGEST + 5, last=True)
    await bench.sender.send([bench.full])
    await bench.watch()
    same("pictures", 2, len(bench.sender.assembler.pictures))


@cocotb.test()
async def the_rest_of_a_picture_that_reset_cuts_is_dropped(dut: Any) -> None:
    """Two lines of four, reset, then lines enough to make it whole."""
    bench = BufferBench(dut)
    await bench.restart(Ratio(PIXEL_PS // 2))
    await bench.sender.send([Shot(1, 4, cut=2)])
    await bench.sending(2)
    bench.sender.stop()
    # An edge of this clock may be at this very moment.
    await bench.clocks.core_reset(2)
    bench.sender.drop()
    bench.sender.start()
    await bench.sender.send_rest(5, last=True)
    await bench.sender.send([bench.full])
    await bench.watch()
    same("pictures", 1, len(bench.sender.assembler.pictures))


@cocotb.test()
async def reset_of_either_side_takes_no_pixel(dut: Any) -> None:
    """A picture that is offered meanwhile waits, and then is whole."""
    bench = BufferBench(dut)
    for reset in (bench.clocks.core_reset, bench.clocks.pixel_reset):
        await bench.restart(Ratio(PIXEL_PS // 2))
        running = cocotb.start_soon(reset(2 * _CROSSING))
        # The screen's reset has to get to the core's clock.
        await bench.clocks.core.cycles(_CROSSING)
        await bench.sender.send([bench.full])
        await running
        same("pixels taken", 0, bench.sender.assembler.taken)
        await bench.watch()
        same("pictures", 1, len(bench.sender.assembler.pictures))


@cocotb.test()
async def reset_of_the_core_drops_what_is_not_complete(dut: Any) -> None:
    """At any moment: what is complete is shown, what is not never is, and the next picture is whole."""
    bench = BufferBench(dut)

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
        await bench.watch()
        same("whole pictures", whole, len(bench.sender.assembler.pictures))

    sent = st.lists(shots(bench.store), min_size=1, max_size=3)
    waits, cycles, rests = st.integers(0, 200), st.integers(1, 4), st.integers(0, 9)
    await holds(bench.run, example, ratios(), sent, waits, cycles, rests, sent)


@cocotb.test()
async def reset_of_the_screen_empties_both_buffers(dut: Any) -> None:
    """While the stream goes on: nothing is shown, then only what began behind the reset."""
    bench = BufferBench(dut)

    async def example(ratio: Ratio, sent: list[Shot], swaps: int, wait: int, more: int) -> None:
        await bench.restart(ratio)
        await bench.sender.send(sent)
        for _ in range(swaps):
            await bench.swap()
            await bench.pixel_clocks(wait)
        await bench.clocks.pixel_reset(more)
        bench.sender.assembler.forget()
        bench.shown = -1
        await bench.pixel_clocks(1)
        same("size shown", (0, 0), bench.size())
        await bench.watch()

    sent = st.lists(shots(bench.store), min_size=2, max_size=6)
    await holds(bench.run, example, ratios(), sent, st.integers(0, 4), st.integers(0, 80), st.integers(0, 5))
