"""What the simulator runs for a picture: draws one frame and leaves the pixels in the run's folder."""

import json
import time
from pathlib import Path
from typing import Any

import cocotb
import numpy as np
from cocotb.triggers import with_timeout

from models.core import Registers
from models.scene.frame import Frame
from verif.core.driver import CoreDriver, Picture
from verif.env import context
from verif.env.clocking import PERIOD_NS

PIXELS, STATUS, PROGRESS = "pixels.npz", "status.json", "progress"
_PROGRESS_SECONDS = 0.2
_SETUP_CLOCKS = 200_000
"""After so many clocks for the set-up, and those that the caller allows a pixel, the core hangs."""


class _Progress:
    """Leaves the number of pixels drawn, and the seconds that took, in a file, a few times a second."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._start = self._last = time.monotonic()

    def __call__(self, pixels: int) -> None:
        now = time.monotonic()
        if now - self._last >= _PROGRESS_SECONDS:
            self._last = now
            fresh = self._path.with_suffix(".new")
            fresh.write_text(f"{pixels} {now - self._start}")
            fresh.replace(self._path)


def _leave(directory: Path, picture: Picture, seconds: float, cpu_seconds: float) -> None:
    np.savez(directory / PIXELS, rgb=picture.rgb, hit=picture.hit)
    status = {
        "latency": picture.latency,
        "cycles": picture.cycles,
        "counts": vars(picture.counts),
        "degenerate": picture.degenerate,
        "seconds": seconds,
        "cpu_seconds": cpu_seconds,
        "fault": int(picture.fault),
    }
    (directory / STATUS).write_text(json.dumps(status))


@cocotb.test()
async def draw(dut: Any) -> None:
    """One frame from reset, at full rate; with a pixel to probe, up to that pixel."""
    run = context.read()
    registers = Registers(*run.extra["registers"])
    words = Frame.from_hex(Path(run.extra["frame"]).read_text()).words
    pixel = run.extra.get("pixel")
    core = CoreDriver(dut)
    await core.reset(registers)
    if pixel is not None:
        await core.probe(*pixel)
    start, cpu_start = time.perf_counter(), time.process_time()
    clocks = _SETUP_CLOCKS + run.extra["clocks_per_pixel"] * registers.width * registers.height
    drawing = core.draw(words, _Progress(run.directory / PROGRESS), until_probed=pixel is not None)
    picture = await with_timeout(drawing, clocks * PERIOD_NS, "ns")
    seconds, cpu_seconds = time.perf_counter() - start, time.process_time() - cpu_start
    _leave(run.directory, picture, seconds, cpu_seconds)
    assert pixel is None or picture.fault or core.probed, "the pixel never came out of the core"
    if pixel is None and not picture.fault:
        assert len(picture.rgb) == registers.width * registers.height, "not one pixel for each of the picture"
