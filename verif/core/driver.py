"""Drives `core_tb`: registers, frames, and pictures in batches, with no Python in most clocks."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from cocotb.triggers import ReadOnly
from numpy.typing import NDArray

from models.core import Registers
from models.limits import Fault
from verif.env.clocking import Clocking

NO_OBJECT = 255
_PIXEL_BITS = 32


@dataclass(frozen=True)
class Picture:
    """What came out of a frame: rgb (n, 3) uint8 and hit (n,) int16 of the pixels in order, -1 for none;
    clocks from the first word of the frame to its last pixel; the fault, where it was refused."""

    rgb: NDArray[np.uint8]
    hit: NDArray[np.int16]
    cycles: int
    fault: Fault


class CoreDriver:
    """The core with its clock running."""

    def __init__(self, dut: Any) -> None:
        self._dut = dut
        self.clocking = Clocking(dut)
        self._batch = len(dut.batch) // _PIXEL_BITS
        dut.rst.value = 1
        dut.s_axis_frame_tvalid.value = 0
        dut.m_axis_video_tready.value = 0
        dut.probe_on.value = 0
        dut.probe_x.value = 0
        dut.probe_y.value = 0

    async def reset(self, registers: Registers) -> None:
        """Resets the core and sets its registers."""
        self._dut.s_axis_frame_tvalid.value = 0
        for name in ("width", "height", "tan_h", "tan_v"):
            getattr(self._dut, name).value = getattr(registers, name)
        await self.clocking.reset()

    async def probe(self, x: int, y: int) -> None:
        """From the next frame on keeps the stages of one pixel."""
        self._dut.probe_x.value, self._dut.probe_y.value = x, y
        self._dut.probe_on.value = 0
        await self.clocking.edge
        self._dut.probe_on.value = 1

    def probed(self) -> int | None:
        """The probe's value, or None where the pixel has not been drawn."""
        return int(str(self._dut.probe.value), 2) if int(self._dut.probe_done.value) else None

    async def send(self, words: Sequence[int]) -> None:
        """One frame, a word a clock where the core takes it."""
        valid, ready = self._dut.s_axis_frame_tvalid, self._dut.s_axis_frame_tready
        data, last = self._dut.s_axis_frame_tdata, self._dut.s_axis_frame_tlast
        valid.value = 1
        for index, word in enumerate(words):
            data.value = word
            last.value = int(index == len(words) - 1)
            await self.clocking.edge
            while not int(ready.value):
                await self.clocking.edge
        valid.value = 0

    async def draw(
        self,
        words: Sequence[int],
        progress: Callable[[int], None] = lambda _: None,
        until_probed: bool = False,
    ) -> Picture:
        """Sends a frame and takes its pixels as fast as they come; ``progress`` hears of each batch."""
        self._dut.m_axis_video_tready.value = 1
        await self.send(words)
        parts: list[NDArray[np.uint32]] = []
        pixels = 0
        while True:
            await self._dut.event_flip.value_change
            await ReadOnly()
            count = int(self._dut.batch_count.value)
            if count:
                parts.append(self._pixels(count))
                pixels += count
                progress(pixels)
            done, error = int(self._dut.event_done.value), int(self._dut.event_error.value)
            if done or error or (until_probed and int(self._dut.probe_done.value)):
                fault = Fault(self._dut.event_code.value.to_unsigned()) if error else Fault.NONE
                return _picture(parts, self._dut.cycles.value.to_unsigned(), fault)

    def _pixels(self, count: int) -> NDArray[np.uint32]:
        value = int(str(self._dut.batch.value), 2)
        return np.frombuffer(value.to_bytes(4 * self._batch, "little"), dtype="<u4")[:count]


def _picture(parts: Sequence[NDArray[np.uint32]], cycles: int, fault: Fault) -> Picture:
    words = np.concatenate(parts) if parts else np.empty(0, dtype=np.uint32)
    objects = (words >> 24).astype(np.int16)
    hit = np.where(objects == NO_OBJECT, -1, objects).astype(np.int16)
    rgb = np.stack([words >> 16 & 255, words >> 8 & 255, words & 255], axis=-1).astype(np.uint8)
    return Picture(rgb, hit, cycles, fault)
