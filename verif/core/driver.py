"""Drives `core_tb`: registers, frames and pictures, with no Python in most clocks."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from cocotb.triggers import FallingEdge, First, ReadOnly, Timer
from numpy.typing import NDArray

from models.core import Counts, Registers
from models.limits import Fault
from verif.core.promises import BREACHES, WAITS
from verif.env.clocking import PERIOD_NS, Clocking
from verif.env.fields import Field, bit
from verif.env.pipelined import Mismatch
from verif.env.streams import AXI4_STREAM, Stream, Transfers

FRAME = Stream("frame", (Field("data", 32, signed=False), bit("last")), AXI4_STREAM)
VIDEO = Stream("video", (Field("data", 24, signed=False), bit("user"), bit("last")), AXI4_STREAM)
PIXELS = Path("pixels.bin")
"""Where `core_tb` leaves the pixels, in the folder of the run."""

_PIXEL_BYTES = 8
_POLL_NS = 100_000
"""Simulated time between two looks at how far the picture is."""


@dataclass(frozen=True)
class Picture:
    """What came out of a frame: rgb (n, 3) uint8 and hit (n,) int16 of the pixels in order, -1 for none;
    clocks from the first word of the frame to its last pixel; the core's own counters: clocks, rays and
    tests of the frame, lights left out and triangles without area since reset; the fault, where it was
    refused."""

    rgb: NDArray[np.uint8]
    hit: NDArray[np.int16]
    latency: int
    cycles: int
    counts: Counts
    degenerate: int
    fault: Fault


@dataclass(frozen=True)
class Moment:
    """What the core is about: busy with a frame, given words of one, its counters, a pixel offered, and
    whether that is taken.
    """

    busy: bool
    sending: bool
    counts: Counts
    offered: bool
    taken: bool


class CoreDriver:
    """The core with its clock running; ``own_clock``: as `core_build` builds it, not as `stepped_build`."""

    def __init__(self, dut: Any, own_clock: bool = True) -> None:
        self._dut = dut
        self.clocking = Clocking(dut, own_clock)
        self._fall = FallingEdge(dut.clk)
        self._read = 0
        self.listeners: list[Callable[[Moment], None]] = []
        self.sending = False
        self.sent: list[bool] = []
        self._fresh = True
        dut.rst.value = 1
        dut.s_axis_frame_tvalid.value = 0
        dut.m_axis_video_tready.value = 0
        dut.probe_on.value = 0
        dut.probe_x.value = 0
        dut.probe_y.value = 0
        self.go(True)

    async def reset(self, registers: Registers) -> None:
        """Resets the core and sets its registers; frames are drawn as they come.

        ``listeners`` hear what the core was about. `sent`: of the frames since then, whether each came while
        another was set up or drawn.
        """
        if not self._fresh:
            for listener in self.listeners:
                listener(self._moment())
        self._fresh = self.sending = False
        self.sent = []
        self._dut.s_axis_frame_tvalid.value = 0
        self.go(True)
        self.registers(registers)
        await self.clocking.reset()
        self._read = self._written

    async def probe(self, x: int, y: int) -> None:
        """From the next frame on keeps the stages of one pixel."""
        self._dut.probe_x.value, self._dut.probe_y.value = x, y
        self._dut.probe_on.value = 0
        await self.clocking.edge
        self._dut.probe_on.value = 1

    @property
    def probed(self) -> bool:
        """Whether the probed pixel is complete."""
        return bool(int(self._dut.probe_done.value))

    async def send(self, words: Sequence[int]) -> None:
        """One frame, a word a clock where the core takes it.

        Words change at the falling edge, where ready is what the next rising edge will find, whoever
        makes the clock.
        """
        self.sending = True
        self.sent.append(self.busy)
        valid, ready = self._dut.s_axis_frame_tvalid, self._dut.s_axis_frame_tready
        data, last = self._dut.s_axis_frame_tdata, self._dut.s_axis_frame_tlast
        await self._fall
        valid.value = 1
        for index, word in enumerate(words):
            data.value = word
            last.value = int(index == len(words) - 1)
            taken = False
            while not taken:
                taken = bool(int(ready.value))
                await self._fall
        valid.value = 0
        self.sending = False

    def _moment(self) -> Moment:
        return Moment(
            self.busy,
            self.sending,
            self.counts,
            bool(int(self._dut.m_axis_video_tvalid.value)),
            bool(int(self._dut.m_axis_video_tready.value)),
        )

    async def draw(
        self,
        words: Sequence[int],
        progress: Callable[[int], None] = lambda _: None,
        until_probed: bool = False,
    ) -> Picture:
        """Sends a frame and takes its pixels as fast as they come; ``progress`` hears how far it is."""
        self.take(True)
        await self.send(words)
        return await self.collect(progress, until_probed)

    def take(self, ready: bool) -> None:
        """Whether pixels are taken, from now on."""
        self._dut.m_axis_video_tready.value = int(ready)

    def go(self, ahead: bool) -> None:
        """Whether frames that have been read are drawn, from now on."""
        self._dut.go.value = int(ahead)

    async def wait(self, clocks: int) -> None:
        """Lets clocks pass; Python sleeps meanwhile."""
        if clocks:
            await Timer(clocks * PERIOD_NS, "ns")
            await self.clocking.edge

    async def collect(
        self, progress: Callable[[int], None] = lambda _: None, until_probed: bool = False
    ) -> Picture:
        """The rest of the picture under way, or of the next one; ends with it, or with any fault."""
        first = self._written
        happened, pause = self._dut.event_flip.value_change, Timer(_POLL_NS, "ns")
        while True:
            woken = await First(happened, pause)
            if woken is pause:
                progress(self._written - first)
                continue
            await ReadOnly()
            done, error = int(self._dut.event_done.value), int(self._dut.event_error.value)
            if done or error or (until_probed and int(self._dut.probe_done.value)):
                fault = Fault(self._dut.event_code.value.to_unsigned()) if error else Fault.NONE
                picture = self._picture(fault)
                await self.clocking.edge  # out of the phase in which nothing may be driven
                return picture

    @property
    def _written(self) -> int:
        """Pixels in the file."""
        return int(self._dut.pixels.value.to_unsigned())

    def _counter(self, name: str) -> int:
        return int(getattr(self._dut, name).value.to_unsigned())

    def _picture(self, fault: Fault) -> Picture:
        words = self._pixels()
        objects, colours = words[0::2], words[1::2]
        return Picture(
            rgb=np.stack([colours >> 16 & 255, colours >> 8 & 255, colours & 255], axis=-1).astype(np.uint8),
            hit=objects.view(np.int32).astype(np.int16),
            latency=self._counter("latency"),
            cycles=self.cycles,
            counts=self.counts,
            degenerate=self.degenerate,
            fault=fault,
        )

    def _pixels(self) -> NDArray[np.uint32]:
        """Two words each of the pixels that came since the last call."""
        if int(self._dut.unknown.value):
            raise Mismatch("a pixel of the picture has unknown bits")
        end = self._written
        with PIXELS.open("rb") as file:
            file.seek(_PIXEL_BYTES * self._read)
            data = file.read(_PIXEL_BYTES * (end - self._read))
        self._read = end
        return np.frombuffer(data, dtype="<u4")

    @property
    def cycles(self) -> int:
        """Clocks of the frame that is drawn, or was drawn last."""
        return self._counter("cycles")

    @property
    def counts(self) -> Counts:
        """The core's counters as they stand."""
        return Counts(**{name: self._counter(name) for name in vars(Counts())})

    @property
    def degenerate(self) -> int:
        """Triangles without area since reset."""
        return self._counter("degenerate")

    @property
    def breaches(self) -> list[str]:
        """Promises broken since reset."""
        return self._told("breaches", BREACHES)

    @property
    def waits(self) -> list[str]:
        """What had to be waited for since reset."""
        return self._told("waits", WAITS)

    def _told(self, name: str, meanings: Sequence[str]) -> list[str]:
        bits = self._counter(name)
        return [meaning for place, meaning in enumerate(meanings) if bits >> place & 1]

    @property
    def busy(self) -> bool:
        """A frame is set up or drawn."""
        return bool(int(self._dut.busy.value))

    def registers(self, registers: Registers) -> None:
        """Sets the registers, whatever the core does at the moment."""
        for name in ("width", "height", "tan_h", "tan_v", "depth"):
            getattr(self._dut, name).value = getattr(registers, name)


class StreamedCore:
    """The core between a source of words that idles and a sink of pixels that stalls, both watched."""

    def __init__(self, dut: Any, core: CoreDriver) -> None:
        self._core = core
        self._source = FRAME.source(dut, "s_axis_frame", core.clocking)
        self._sink = VIDEO.sink(dut, "m_axis_video", core.clocking)
        self._video = VIDEO.monitor(dut, "m_axis_video", core.clocking)
        self._agents = (self._source, self._sink, self._video)

    async def reset(self, registers: Registers) -> None:
        """Resets the core; what was under way is forgotten."""
        for agent in self._agents:
            agent.stop()
            agent.clear()
        await self._core.reset(registers)
        for agent in self._agents:
            agent.start()

    def send(self, words: Sequence[int], idles: Sequence[int]) -> None:
        """Queues one frame; ``idles``: clocks without a word before each word, over and over."""
        self._source.idle(idles)
        self._source.send_words((word, int(index == len(words) - 1)) for index, word in enumerate(words))

    def stall(self, clocks: Sequence[int]) -> None:
        """Clocks before each pixel in which it is not taken, over and over."""
        self._sink.stall(clocks)

    async def pixels(self, number: int) -> Transfers:
        """The transfers of that many pixels, and of any that follow them closely.

        Raises Mismatch where the stream breaks its protocol. Waits for ever where pixels are missing.
        """
        while len(self._video.transfers.taken) < number and not self._video.breaches:
            await self._core.clocking.edge
        await self._core.clocking.cycles(4)
        if self._video.breaches:
            raise Mismatch("\n".join(self._video.breaches[:4]))
        return self._video.take()
