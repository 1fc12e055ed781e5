"""Draws a scene through the RTL in a simulator of its own process, and shows how far it is."""

import json
import sys
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from models.core import Counts, Registers
from models.limits import Fault
from models.scene.frame import Frame
from verif.env.build import CACHE, Build, ensure
from verif.env.run import Outcome, run
from verif.render import bench

_BENCH = "verif.render.bench"
_POLL_SECONDS = 0.1
_QUIET_SECONDS = 5
"""Between two lines where the output is not a terminal."""


class SimulationError(RuntimeError):
    """The simulation did not end as it should; the text says where its log is."""


@dataclass(frozen=True)
class Drawn:
    """The RTL's picture: rgb (h, w, 3), hit (h, w); clocks from the first word to the last pixel and, as the
    core counts them, of the frame; its counters; seconds (wall clock and CPU); fault; the run's folder."""

    rgb: NDArray[np.uint8]
    hit: NDArray[np.int16]
    latency: int
    cycles: int
    counts: Counts
    degenerate: int
    seconds: float
    cpu_seconds: float
    fault: Fault
    directory: Path


class _Line:
    """The line that says how far the picture is: rewritten in place on a terminal, else now and then."""

    def __init__(self, progress: Path, registers: Registers) -> None:
        self._progress = progress
        self._registers = registers
        self._last = time.monotonic()
        self._terminal = sys.stderr.isatty()

    def update(self) -> None:
        """Shows what the simulation has left in its file, if anything."""
        if not self._progress.exists():
            return
        pixels, seconds = map(float, self._progress.read_text().split())
        rows, height = int(pixels) // self._registers.width, self._registers.height
        left = seconds / pixels * (self._registers.width * height - pixels)
        text = f"  row {rows} of {height}, {left:.0f} s left"
        if self._terminal:
            print(f"\r{text:<60}", end="", file=sys.stderr, flush=True)
        elif time.monotonic() - self._last >= _QUIET_SECONDS:
            self._last = time.monotonic()
            print(text, file=sys.stderr, flush=True)

    def clear(self) -> None:
        """Takes the line off the terminal."""
        if self._terminal:
            print(f"\r{'':<60}\r", end="", file=sys.stderr, flush=True)


def _watched(work: Callable[[], Outcome], line: _Line) -> Outcome:
    """Runs ``work`` in a thread and keeps the line up to date."""
    done: list[Outcome | BaseException] = []

    def body() -> None:
        try:
            done.append(work())
        except BaseException as error:
            done.append(error)

    thread = threading.Thread(target=body)
    thread.start()
    while thread.is_alive():
        thread.join(_POLL_SECONDS)
        line.update()
    line.clear()
    if isinstance(done[0], BaseException):
        raise done[0]
    return done[0]


def simulate(
    build: Build,
    frame: Frame,
    registers: Registers,
    name: str,
    directory: Path,
    pixel: tuple[int, int] | None = None,
    clocks_per_pixel: int = 4,
) -> Drawn:
    """Draws ``frame``, up to ``pixel`` if one is given; raises SimulationError where the run fails.

    ``directory`` keeps the packed frame; the run's own folder is named after ``name``. A picture that takes
    more than ``clocks_per_pixel`` hangs.
    """
    ensure(build)
    directory.mkdir(parents=True, exist_ok=True)
    packed = directory / f"{name}.hex"
    packed.write_text(frame.to_hex())
    extra = {
        "registers": list(vars(registers).values()),
        "frame": str(packed),
        "pixel": pixel,
        "clocks_per_pixel": clocks_per_pixel,
    }
    line = _Line(run_directory(name) / bench.PROGRESS, registers)
    outcome = _watched(lambda: run(build, _BENCH, name, seed=1, settings={"extra": extra}), line)
    if not outcome.passed:
        raise SimulationError(outcome.complaint())
    return _read(outcome.directory, registers)


def run_directory(name: str) -> Path:
    """Where a run of this name works."""
    return CACHE / "runs" / name


def _read(directory: Path, registers: Registers) -> Drawn:
    status = json.loads((directory / bench.STATUS).read_text())
    pixels = np.load(directory / bench.PIXELS)
    shape = (registers.height, registers.width)
    rgb = np.zeros((registers.height * registers.width, 3), dtype=np.uint8)
    hit = np.full(registers.height * registers.width, -1, dtype=np.int16)
    count = len(pixels["rgb"])
    rgb[:count], hit[:count] = pixels["rgb"], pixels["hit"]
    return Drawn(
        rgb.reshape(*shape, 3),
        hit.reshape(shape),
        status["latency"],
        status["cycles"],
        Counts(**status["counts"]),
        status["degenerate"],
        status["seconds"],
        status["cpu_seconds"],
        Fault(status["fault"]),
        directory,
    )
