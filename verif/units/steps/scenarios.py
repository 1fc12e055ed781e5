"""What closure plays on the steps: hits of each kind, places that are short, resets."""

from itertools import product
from typing import Any

from numpy.random import Generator

from verif.coverage.subjects import Scenarios, of_block
from verif.env.context import Context
from verif.env.coverage.flow import LONG
from verif.units.steps.bench import Clock, Hit, StepsBench

_KINDS = tuple(product((False, True), repeat=2))
_PORTION = 200
"""Clocks of an undirected portion."""


def _back(direct: int, shadow: int) -> list[Clock]:
    return [Clock(None, direct, shadow)]


async def hits(bench: StepsBench, _generator: Generator, _size: int) -> None:
    """Every kind, with every number of lights, without a gap, and some clocks without a hit."""
    for lights in range(bench.most_lights + 1):
        await bench.restart(lights)
        await bench.hits([Hit(number, *kind) for number, kind in enumerate(_KINDS * 3)])
        await bench.play([Clock(None)] * 2 * LONG)
        await bench.drain()


async def scarce_places(bench: StepsBench, _generator: Generator, _size: int) -> None:
    """All places taken; then one comes back, of either kind and of both, and two at once."""
    long = Clock(Hit(1, True, True))
    await bench.restart(bench.most_lights)
    await bench.play([long] * (2 * bench.room + LONG))
    for direct, shadow in ((1, 0), (0, 1), (0, 1), (1, 0), (1, 1), (2, 2)):
        await bench.play([*_back(direct, shadow), long, long, long])
    for places in (1, 1, 1, 1, 2, 2, 2):
        await bench.play(_back(places, places))
    await bench.drain()


async def resets(bench: StepsBench, _generator: Generator, _size: int) -> None:
    """Reset at rest, within the steps of a hit, behind them, and where no place is left."""
    hit = Clock(Hit(1, True, True))
    await bench.restart(bench.most_lights)
    for clocks in (1, 2, 3, 2 * bench.room + LONG):
        await bench.play([hit] * clocks)
        await bench.restart(bench.most_lights)
    await bench.restart(1)
    await bench.play([Clock(Hit(1, True, False)), *[Clock(None)] * 3])
    await bench.restart()


async def at_random(bench: StepsBench, generator: Generator, _size: int) -> None:
    """Any hits in every other clock; places come back as they are used."""
    bench.light(int(generator.integers(0, bench.most_lights, endpoint=True)))
    rolls = (generator.random((3, _PORTION)) < 0.5).tolist()
    backs = generator.integers(0, 2, (2, _PORTION), endpoint=True).tolist()
    for offer, hit, branching, direct, shadow in zip(*rolls, *backs, strict=True):
        await bench.step(Clock(Hit(0, hit, branching) if offer else None, direct, shadow))
    await bench.drain()


async def closure_subject(dut: Any, run: Context) -> Scenarios:
    """The steps, ready to be played on."""
    bench = StepsBench(dut, run.parameters)
    await bench.restart()
    return of_block(bench, {"hits": hits, "scarce places": scarce_places, "resets": resets}, at_random)
