"""Measures on one scene: cocotb against a bare C++ loop, and the bit-exact model against the RTL.

All contenders take turns, `--runs` times; the medians are compared. Seconds are those of the CPU, which
a busy machine falsifies less. The figures go to
build/bench/bench.json too. Nothing here passes or fails but wrong pixels.
"""

import argparse
import json
import statistics
import subprocess
import sys
import time
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from models.core import render
from verif.core.builds import core_build
from verif.core.job import Job, request
from verif.env.build import CACHE, Build, ensure
from verif.env.simulators import MissingTool, verilator_root
from verif.render.simulate import simulate

_FOLDER = CACHE / "bench"
_SOURCE = Path(__file__).with_name("bare.cpp")
_FNV_START, _FNV_PRIME, _WORD = 14695981039346656037, 1099511628211, (1 << 64) - 1


@dataclass(frozen=True)
class Figures:
    """Medians of one scene's runs: clocks of the frame, clocks a CPU second, CPU seconds a picture."""

    scene: str
    runs: int
    cycles: int
    bare_cycles_per_second: float
    cocotb_cycles_per_second: float
    cocotb_to_bare: float
    rtl_seconds: float
    model_seconds: float
    rtl_to_model: float


def _link_bare(build: Build) -> Path:
    """The bare loop, linked with the objects of the cocotb build."""
    directory = ensure(build)
    include = verilator_root() / "include"
    objects = [directory / "Vtop__ALL.a", *sorted(directory.glob("verilated*.o"))]
    _FOLDER.mkdir(parents=True, exist_ok=True)
    binary = _FOLDER / f"bare-{build.key}"
    includes = [f"-I{path}" for path in (directory, include, include / "vltstd")]
    flags = [build.optimise, "-std=gnu++20", "-fcoroutines", "-pthread", *includes]
    command = ["g++", *flags, str(_SOURCE), *map(str, objects), "-o", str(binary)]
    subprocess.run(command, check=True)
    return binary


def _hash(rgb: NDArray[np.uint8]) -> str:
    value = _FNV_START
    for byte in rgb.tobytes():
        value = (value ^ byte) * _FNV_PRIME & _WORD
    return f"{value:016x}"


def _run_bare(binary: Path, job: Job, frame: Path) -> tuple[int, float, str]:
    size = job.registers
    words = [*vars(size).values(), frame]
    command = [str(binary), *map(str, words)]
    output = subprocess.run(command, capture_output=True, text=True, check=True, cwd=_FOLDER).stdout
    cycles, seconds, digest = output.split()
    return int(cycles), float(seconds), digest


def measure(job: Job, runs: int) -> Figures:
    """All contenders in turn; raises ValueError where one of them draws another picture."""
    build = core_build(job.build, job.simulator)
    binary = _link_bare(build)
    frame = _FOLDER / "frame.hex"
    frame.write_text(job.frame.to_hex())
    bare, cocotb, model, cycles = [], [], [], 0
    wanted = ""
    for index in range(runs):
        print(f"  round {index + 1} of {runs}", file=sys.stderr, flush=True)
        start = time.process_time()
        picture = render(job.file.scene, job.registers, job.formats)
        model.append(time.process_time() - start)
        wanted = wanted or _hash(picture.rgb)
        clocks, seconds, digest = _run_bare(binary, job, frame)
        bare.append(clocks / seconds)
        drawn = simulate(build, job.frame, job.registers, "bench", _FOLDER, clocks_per_pixel=256)
        cocotb.append(drawn.cpu_seconds)
        cycles = drawn.latency
        if digest != wanted or (drawn.rgb != picture.rgb).any():
            raise ValueError("the contenders did not draw the same picture: the figures mean nothing")
    rtl, bare_rate, ours = statistics.median(cocotb), statistics.median(bare), statistics.median(model)
    rate = cycles / rtl
    return Figures(str(job.file.path), runs, cycles, bare_rate, rate, rate / bare_rate, rtl, ours, rtl / ours)


def main() -> int:
    """Command line; see the module's docstring."""
    parser = argparse.ArgumentParser(prog="make bench", description=__doc__)
    parser.add_argument("--scene", default="models/scenes/one_sphere.toml")
    parser.add_argument("--size", default="512x512")
    parser.add_argument("--runs", type=int, default=5)
    words = parser.parse_args()
    try:
        job = request(words.scene, words.size)
    except MissingTool as error:
        print(error, file=sys.stderr)
        return 2
    figures = measure(job, words.runs)
    (_FOLDER / "bench.json").write_text(json.dumps(asdict(figures), indent=2) + "\n")
    print(f"{figures.scene}, {words.size}, {figures.cycles} cycles, medians of {figures.runs} runs")
    print(f"bare C++ loop     {figures.bare_cycles_per_second:>10.0f} cycles/s")
    print(f"cocotb            {figures.cocotb_cycles_per_second:>10.0f} cycles/s")
    print(f"cocotb / bare     {figures.cocotb_to_bare:>10.2f}")
    print(f"RTL simulation    {figures.rtl_seconds:>10.3f} s")
    print(f"bit-exact model   {figures.model_seconds:>10.3f} s")
    print(f"RTL / model       {figures.rtl_to_model:>10.1f}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
