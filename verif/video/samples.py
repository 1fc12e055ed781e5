"""Where a monitor's samples come from in a simulation: a recorder's file, or the signals themselves."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from cocotb.triggers import RisingEdge, with_timeout

from models.video import Mode
from verif.env.pipelined import Mismatch
from verif.video.monitor import Frame, Monitor, Samples

RECORDING = Path("screen.bin")
"""Where `screen_recorder` leaves the samples, in the folder of the run."""

_SAMPLE_BYTES = 4
_PATIENCE = 2
"""Frames within which vsync must change."""


class Screen:
    """A monitor at a design whose screen is recorded (`told`, `samples`, `unknown` of `screen_recorder`).

    frame_ps: about how long a frame lasts.
    """

    def __init__(self, dut: Any, mode: Mode, frame_ps: int) -> None:
        self._dut, self._mode = dut, mode
        self._patience_ps = _PATIENCE * frame_ps
        self._read = 0
        self._monitor = Monitor((mode,))

    def plug(self) -> None:
        """A new monitor, which sees what comes from now on."""
        self._monitor = Monitor((self._mode,))
        self._read = self._samples

    @property
    def _samples(self) -> int:
        return int(self._dut.samples.value.to_unsigned())

    async def frames(self) -> list[Frame]:
        """Waits for a change of vsync; the frames seen since the last call, each in every figure the mode's.

        Raises NoLock, and Mismatch where a figure is not exact or a signal unknown.
        """
        await with_timeout(self._dut.told.value_change, self._patience_ps, "ps")
        if int(self._dut.unknown.value):
            raise Mismatch("the screen has unknown bits")
        frames = self._monitor.feed(self._new())
        for frame in frames:
            if faults := frame.faults(self._mode):
                raise Mismatch("\n".join(faults))
        return frames

    def _new(self) -> Samples:
        """The samples that came since the last call."""
        end = self._samples
        with RECORDING.open("rb") as file:
            file.seek(_SAMPLE_BYTES * self._read)
            data = file.read(_SAMPLE_BYTES * (end - self._read))
        if len(data) != _SAMPLE_BYTES * (end - self._read):
            raise Mismatch(f"the recording ends before sample {end}")
        self._read = end
        return np.frombuffer(data, dtype="<u4")


_PLACES = {"r": 16, "g": 8, "b": 0, "hsync": 24, "vsync": 25, "de": 26}


class Probe:
    """Samples taken in Python, clock by clock, of any design; slow, but nothing stands beside the design.

    names: of the signals r, g, b, hsync, vsync and de, where they are called otherwise; those that the
    design does not have are 0.
    """

    def __init__(self, dut: Any, clk: Any, names: Mapping[str, str] | None = None) -> None:
        wanted = {signal: (names or {}).get(signal, signal) for signal in _PLACES}
        self._signals = [
            (getattr(dut, name), _PLACES[signal]) for signal, name in wanted.items() if hasattr(dut, name)
        ]
        self._edge = RisingEdge(clk)

    async def take(self, clocks: int) -> Samples:
        """The samples of the next clocks."""
        taken = np.empty(clocks, dtype=np.uint32)
        for clock in range(clocks):
            await self._edge
            taken[clock] = sum(int(signal.value) << place for signal, place in self._signals)
        return taken
