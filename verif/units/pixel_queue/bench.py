"""Tests of the queue of pixels: in whatever order they come back, each is sent once, in its place."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import cocotb
from hypothesis import strategies as st

from verif.env import context
from verif.env.block import Block, holds, same
from verif.env.fields import Field, bit
from verif.env.pipelined import Mismatch
from verif.env.scoreboard import Scoreboard
from verif.env.streams import Stream

_PIXEL_W = 24
_LINES_ON_ICARUS = 20
_VIDEO = Stream("video", (Field("data", _PIXEL_W, signed=False), bit("user"), bit("last")))


@dataclass(frozen=True)
class Picture:
    """A picture and the manners of all around the queue.

    asks: clocks without slot_ready before each slot. returns: for each pixel that comes back, which one
    of those in flight, oldest first. waits: clocks before each of these. stalls: of the consumer.
    """

    width: int
    height: int
    asks: Sequence[int]
    returns: Sequence[int]
    waits: Sequence[int]
    stalls: Sequence[int]

    @property
    def pixels(self) -> int:
        """How many there are."""
        return self.width * self.height

    @property
    def clocks(self) -> int:
        """More than it can take."""
        each = sum(max(waits, default=0) for waits in (self.asks, self.waits, self.stalls)) + 8
        return self.pixels * each + 32


class QueueBench(Block):
    """The rays before the queue, and the consumer behind it."""

    def __init__(self, dut: Any, parameters: Mapping[str, int]) -> None:
        super().__init__(
            dut, idle=("start", "slot_ready", "in_valid"), carried={"in_valid": ("in_slot", "in_pixel")}
        )
        self.slots = parameters["SLOTS"]
        self.set(in_slot=0, in_pixel=0, width=1, height=1)
        self._sink = _VIDEO.sink(dut, "out", self.clocking)
        self._monitor = _VIDEO.monitor(dut, "out", self.clocking)
        self.scoreboard = Scoreboard(_VIDEO.fields)
        self._monitor.listeners.append(self.scoreboard.receive)
        self.flying: list[tuple[int, int]] = []
        self.sent = self.taken = 0
        self._generator = context.read().generator(0)

    async def restart(self) -> None:
        """Reset, whatever is in flight."""
        agents = (self._sink, self._monitor)
        for agent in agents:
            agent.stop()
            agent.clear()
        await self.reset()
        self.scoreboard.clear()
        self.flying = []
        for agent in agents:
            agent.start()

    async def start(self, picture: Picture) -> None:
        """One clock of start."""
        self._sink.stall(picture.stalls)
        self.sent = self.taken = 0
        await self.clock(width=picture.width, height=picture.height, start=1)
        self.set(start=0)

    def _expect(self, picture: Picture, slot: int) -> None:
        """A slot has been handed out: its pixel is anything, its place is the next one."""
        if any(slot == other for other, _ in self.flying):
            raise Mismatch(f"slot {slot} is handed out twice")
        pixel = int(self._generator.integers(0, 1 << _PIXEL_W))
        self.flying.append((slot, pixel))
        column = self.sent % picture.width
        self.scoreboard.expect(
            _VIDEO.transaction(pixel, int(self.sent == 0), int(column == picture.width - 1))
        )
        self.sent += 1
        # One more than the slots: the pixel that waits at the output has left its slot.
        if self.sent - self.taken > self.slots + 1:
            raise Mismatch(f"{self.sent - self.taken} pixels in a queue of {self.slots} slots")

    async def step(self, picture: Picture, ask: bool, pixel: tuple[int, int] | None) -> None:
        """One clock: a slot is asked for or not, a pixel comes back or not."""
        self.set(slot_ready=int(ask), in_valid=int(pixel is not None))
        if pixel is not None:
            self.set(in_slot=pixel[0], in_pixel=pixel[1])
        await self.clock()
        if ask and self.read("slot_valid"):
            self._expect(picture, self.read("slot"))
        taken = self.read("out_valid") and self.read("out_ready")
        self.taken += taken
        same(f"done at pixel {self.taken}", taken and self.taken == picture.pixels, bool(self.read("done")))

    async def draw(self, picture: Picture, stop: int) -> None:
        """Draws until ``stop`` pixels have been taken."""
        asks, waits = picture.asks or (0,), picture.waits or (0,)
        ask, wait, returned = asks[0], waits[0], 0
        for _ in range(picture.clocks):
            if self.taken >= stop:
                return
            wants = self.sent < picture.pixels and ask <= 0
            ask -= 1
            pixel = None
            if self.flying and wait <= 0:
                chosen = picture.returns[returned % len(picture.returns)] % len(self.flying)
                pixel = self.flying.pop(chosen)
                returned += 1
                wait = waits[returned % len(waits)]
            else:
                wait -= 1
            sent = self.sent
            await self.step(picture, wants, pixel)
            if self.sent > sent:
                ask = asks[self.sent % len(asks)]
        raise Mismatch(f"{self.taken} of {picture.pixels} pixels after {picture.clocks} clocks")

    async def picture(self, picture: Picture) -> None:
        """A whole picture, checked."""
        await self.start(picture)
        await self.draw(picture, picture.pixels)
        await self.rest(picture)

    async def rest(self, picture: Picture) -> None:
        """Nothing more comes; all that came was right."""
        for _ in range(3):
            await self.step(picture, False, None)
        self.scoreboard.check()
        same("pixels", picture.pixels, self.scoreboard.compared)
        same("breaches of the stream's protocol", [], self._monitor.breaches)
        self.scoreboard.clear()


def _pictures() -> st.SearchStrategy[Picture]:
    sides = st.one_of(
        st.just((1, 1)),
        st.integers(1, 40).map(lambda count: (1, count)),
        st.integers(1, 40).map(lambda count: (count, 1)),
        st.tuples(st.integers(1, 8), st.integers(1, 8)),
    )
    waits = st.lists(st.sampled_from([0, 0, 0, 1, 2, 9]), max_size=6)
    returns = st.lists(st.integers(0, 300), min_size=1, max_size=12)
    return st.builds(lambda side, *manners: Picture(*side, *manners), sides, waits, returns, waits, waits)


async def _bench(dut: Any) -> tuple[QueueBench, context.Context]:
    run = context.read()
    bench = QueueBench(dut, run.parameters)
    await bench.restart()
    return bench, run


@cocotb.test()
async def every_pixel_comes_once_and_in_its_place(dut: Any) -> None:
    """Drawn orders, waits and stalls; one picture behind the other."""
    bench, run = await _bench(dut)

    async def example(first: Picture, second: Picture) -> None:
        await bench.restart()
        await bench.picture(first)
        await bench.picture(second)

    await holds(run, example, _pictures(), _pictures())


@cocotb.test()
async def reset_in_the_middle_of_a_picture_empties_the_queue(dut: Any) -> None:
    """Pixels in flight are forgotten; the next picture is whole."""
    bench, run = await _bench(dut)

    async def example(before: Picture, part: int, after: Picture) -> None:
        await bench.restart()
        await bench.start(before)
        await bench.draw(before, part % before.pixels)
        await bench.restart()
        for _ in range(3):
            await bench.step(after, False, None)
            same("slot on offer after reset", (1, 0), (bench.read("slot_valid"), bench.read("slot")))
        same("pixels after reset", 0, bench.scoreboard.compared + len(bench.scoreboard.complaints))
        await bench.picture(after)

    await holds(run, example, _pictures(), st.integers(0, 60), _pictures())


@cocotb.test()
async def pixels_come_back_in_any_order_all_around_the_ring(dut: Any) -> None:
    """All slots are in flight, and any of them may be the next: each is waited for, and used again."""
    bench, run = await _bench(dut)
    rounds = 4
    returns = run.generator(1).integers(0, bench.slots, 997).tolist()
    # All are handed out before the first comes back; from then on as many are as came.
    waits = (bench.slots, *(0,) * rounds * bench.slots)
    await bench.picture(Picture(bench.slots, rounds, (), returns, waits, ()))


@cocotb.test()
async def a_consumer_that_stops_stops_the_slots(dut: Any) -> None:
    """It takes nothing for long: the slots, and the output, hold a pixel each, and none is lost."""
    bench, _ = await _bench(dut)
    stalls = (3 * bench.slots + 40, *(0,) * 3 * bench.slots)
    slow = Picture(bench.slots, 3, (), (0,), (), stalls)
    await bench.start(slow)
    returned: tuple[int, int] | None = None
    for _ in range(2 * bench.slots + 20):
        await bench.step(slow, bench.sent < slow.pixels, returned)
        returned = bench.flying.pop(0) if bench.flying else None
    same("pixels in the queue", bench.slots + 1, bench.sent)
    if returned is not None:
        bench.flying.insert(0, returned)
    await bench.draw(slow, slow.pixels)
    await bench.rest(slow)


@cocotb.test()
async def a_line_and_a_column_end_where_the_size_says_up_to_the_largest(dut: Any) -> None:
    """All bits of both sizes, one and alternating, in pictures of one line and of one column."""
    bench, run = await _bench(dut)
    largest = (1 << run.parameters["SIZE_W"]) - 1
    for side in (largest, largest // 3, largest // 3 * 2):
        for width, height in ((side, 1), (1, side)):
            await bench.restart()
            await bench.picture(Picture(width, height, (), (0,), (), ()))


@cocotb.test()
async def rate_is_one_pixel_a_clock_where_slots_cover_the_latency(dut: Any) -> None:
    """Pixels come back, in order, some clocks after their slots were taken."""
    bench, _ = await _bench(dut)
    behind = 4
    for latency in {1, bench.slots // 2, bench.slots - behind}:
        if not 1 <= latency <= bench.slots - behind:
            continue
        picture = Picture(64, 16, (), (0,), (), ())
        await bench.start(picture)
        line: list[tuple[int, int] | None] = [None] * latency
        start = bench.now
        while bench.taken < picture.pixels and bench.now < start + 4 * picture.pixels:
            line.append(bench.flying.pop(0) if bench.flying else None)
            await bench.step(picture, bench.sent < picture.pixels, line.pop(0))
        clocks = bench.now - start
        await bench.rest(picture)
        assert clocks <= picture.pixels + latency + behind, (
            f"{clocks} clocks for {picture.pixels} pixels at a latency of {latency}"
        )


@cocotb.test()
async def every_slot_waits_for_its_pixel_while_all_others_are_back(dut: Any) -> None:
    """A line is a pixel longer than the queue, and its first pixel the last to come back: a slot further in
    each line. On Icarus, which is slow, in some slots."""
    bench, _ = await _bench(dut)
    lines = min(bench.slots, _LINES_ON_ICARUS) if "icarus" in cocotb.SIM_NAME.lower() else bench.slots
    picture = Picture(bench.slots + 1, lines, (), (0,), (), ())
    await bench.start(picture)
    line = 0
    for _ in range(4 * picture.pixels):
        others = (at for at, (slot, _) in enumerate(bench.flying) if slot != line % bench.slots)
        at, full = next(others, None), bench.sent == min(bench.taken + bench.slots, picture.pixels)
        if at is None and full and bench.taken == line * picture.width:
            at, line = 0, line + 1
        back = None if at is None else bench.flying.pop(at)
        await bench.step(picture, bench.sent < picture.pixels, back)
        if bench.taken == picture.pixels:
            break
    same("lines whose first pixel came last", lines, line)
    await bench.rest(picture)
