"""What closure plays on the light of steps: lights of all kinds, steps of hardly any weight, resets."""

from typing import Any

import numpy as np
from numpy.random import Generator

from models.header import selected
from verif.coverage.subjects import Scenarios, of_block
from verif.env.context import Context
from verif.env.operands import uniform
from verif.units.lighting import steps as drawing
from verif.units.lighting.bench import create, load, run_steps
from verif.units.lighting.steps import Frame, drawn_steps
from verif.units.shading import ShadingBench

_PORTION = 200
"""Steps of an undirected portion."""


async def _frame(bench: ShadingBench, generator: Generator) -> Frame:
    return await load(bench, int(generator.integers(1 << 32)))


async def steps(bench: ShadingBench, generator: Generator, size: int) -> None:
    """Lights near and far, before and behind the surface, at the point, and none."""
    frame = await _frame(bench, generator)
    await run_steps(bench, frame, drawn_steps(generator, 8 * size, bench.parameters))


async def dim_steps(bench: ShadingBench, generator: Generator, size: int) -> None:
    """Weights of none, of one step, and of some in one channel alone."""
    frame = await _frame(bench, generator)
    drawn = drawn_steps(generator, 8 * size, bench.parameters)
    one_channel = np.arange(3)[:, None] == generator.integers(0, 3, 8 * size)
    weight = np.where(one_channel, drawn["weight"], 0) >> generator.integers(0, 20, 8 * size)
    kind = generator.integers(0, 3, 8 * size)
    weight = np.where(kind == 0, 0, np.where(kind == 1, np.minimum(weight, 1), weight))
    await run_steps(bench, frame, {**drawn, "weight": weight})


async def far_lights(bench: ShadingBench, generator: Generator, size: int) -> None:
    """Lights in one corner of the scene's range, points in the opposite one, surfaces that face them."""
    frame, fmts = await _frame(bench, generator), selected(bench.parameters)
    way = generator.choice([-1, 1], (3, size))
    corner = np.where(way > 0, fmts.coord.max, fmts.coord.min)
    facing = way * int(fmts.unit.one / np.sqrt(3))
    far = {
        "position": corner,
        "point": -corner << (fmts.point.frac_bits - fmts.coord.frac_bits),
        "normal": facing,
        "mirrored": facing,
    }
    await run_steps(bench, frame, {**drawn_steps(generator, size, bench.parameters), **far})


async def resets(bench: ShadingBench, generator: Generator, _size: int) -> None:
    """Reset with steps in flight, and with none."""
    await _frame(bench, generator)
    await bench.drive(drawn_steps(generator, 4, bench.parameters))
    await bench.restart()
    await bench.nothing_comes()
    await bench.restart()


async def at_random(bench: ShadingBench, generator: Generator, _size: int) -> None:
    """Uniform steps."""
    frame = await _frame(bench, generator)
    drawn = uniform(generator, drawing.inputs(bench.parameters), _PORTION)
    await run_steps(bench, frame, drawing.legal(drawn, bench.parameters))


async def closure_subject(dut: Any, _run: Context) -> Scenarios:
    """The block, ready to be played on."""
    bench, _ = await create(dut)
    return of_block(
        bench, {"steps": steps, "dim steps": dim_steps, "far lights": far_lights, "resets": resets}, at_random
    )
