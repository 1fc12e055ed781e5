"""What closure plays on the children of hits: rays of frames of each kind, the table's ends, resets."""

from typing import Any

import numpy as np
from numpy.random import Generator

from verif.coverage.subjects import Scenarios, of_block
from verif.env.context import Context
from verif.env.operands import uniform
from verif.units.children import frames
from verif.units.children.bench import create, run_rays
from verif.units.children.frames import Frame, drawn_frame, drawn_rays
from verif.units.shading import ShadingBench

_PORTION = 60
"""Rays of an undirected portion."""


async def _frame(
    bench: ShadingBench, generator: Generator, max_depth: int, mirrors: bool, glass: bool
) -> Frame:
    """A frame with any number of lights, loaded."""
    p = bench.parameters
    lights = int(generator.integers(0, 1 << p["LIGHT_W"]))
    frame = drawn_frame(generator, lights, max_depth, mirrors, glass, p)
    await bench.load(frame.materials, frame.settings)
    return frame


async def rays(bench: ShadingBench, generator: Generator, size: int) -> None:
    """Rays whose weights are often just enough or just not; with mirrors and glass, and without either."""
    deepest = (1 << bench.parameters["DEPTH_W"]) - 1
    kinds = ((deepest, True, True), (deepest, True, False), (deepest, False, True))
    for kind in (*kinds, (deepest, False, False), (1, True, True)):
        frame = await _frame(bench, generator, *kind)
        drawn = drawn_rays(generator, frame, 2 * size, bench.parameters)
        await run_rays(bench, frame, drawn)


async def ends_of_the_table(bench: ShadingBench, generator: Generator, size: int) -> None:
    """Rays that have hit the first object or the last one."""
    frame = await _frame(bench, generator, 3, True, True)
    drawn = drawn_rays(generator, frame, size, bench.parameters)
    ends = np.where(drawn["own"] % 2, 0, bench.parameters["OBJECTS"] - 1)
    await run_rays(bench, frame, {**drawn, "own": ends})


async def resets(bench: ShadingBench, generator: Generator, _size: int) -> None:
    """Reset with rays in flight, and with none."""
    frame = await _frame(bench, generator, 2, True, True)
    await bench.drive(frame.steps(drawn_rays(generator, frame, 4, bench.parameters))[0])
    await bench.restart()
    await bench.nothing_comes()
    await bench.restart()


async def at_random(bench: ShadingBench, generator: Generator, _size: int) -> None:
    """Uniform rays of a frame with everything."""
    frame = await _frame(bench, generator, (1 << bench.parameters["DEPTH_W"]) - 1, True, True)
    drawn = uniform(generator, frames.rays(bench.parameters), _PORTION)
    await run_rays(bench, frame, frame.legal(drawn, bench.parameters))


async def closure_subject(dut: Any, _run: Context) -> Scenarios:
    """The block, ready to be played on."""
    bench, _ = await create(dut)
    played = {"rays": rays, "ends of the table": ends_of_the_table, "resets": resets}
    return of_block(bench, played, at_random)
