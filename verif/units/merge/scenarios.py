"""What closure plays on the merge: every choice of streams that have items, stalls, resets."""

from typing import Any

from numpy.random import Generator

from verif.coverage.subjects import Scenarios, of_block
from verif.env.context import Context
from verif.env.coverage.flow import LONG
from verif.units.merge.bench import Clock, MergeBench

_PORTION = 200
"""Clocks of an undirected portion."""


def _streams(bench: MergeBench, chosen: int) -> list[bool]:
    return [bool(chosen >> stream & 1) for stream in range(bench.ports)]


async def choices(bench: MergeBench, _generator: Generator, _size: int) -> None:
    """Each choice of streams always has items, for longer than a round; then nothing."""
    for chosen in range(1, 1 << bench.ports):
        await bench.steps([Clock(_streams(bench, chosen), True)] * (LONG + bench.ports))
        await bench.drain()


async def stalls(bench: MergeBench, _generator: Generator, _size: int) -> None:
    """All streams, and each alone, into an output that is taken from at once, late, and very late."""
    for chosen in ((1 << bench.ports) - 1, *(1 << stream for stream in range(bench.ports))):
        offers = _streams(bench, chosen)
        for wait in (0, 1, 2 * LONG):
            for _ in range(2):
                await bench.steps([Clock(offers, False)] * wait)
                await bench.steps([Clock(offers, True)] * 2)
            await bench.drain()
    await bench.steps([Clock([False] * bench.ports, True)] * 2 * LONG)


async def resets(bench: MergeBench, _generator: Generator, _size: int) -> None:
    """Reset behind each number of items of a round, taken or not, and at rest."""
    for taken in (False, True):
        for clocks in range(bench.ports + 2):
            await bench.steps([Clock([True] * bench.ports, taken)] * clocks)
            await bench.restart()


async def at_random(bench: MergeBench, generator: Generator, _size: int) -> None:
    """Each stream has a new item, and one is taken, in every other clock."""
    offers = (generator.random((_PORTION, bench.ports)) < 0.5).tolist()
    takes = (generator.random(_PORTION) < 0.5).tolist()
    await bench.steps([Clock(*values) for values in zip(offers, takes, strict=True)])


async def closure_subject(dut: Any, run: Context) -> Scenarios:
    """The merge, ready to be played on."""
    bench = MergeBench(dut, run.parameters)
    await bench.restart()
    return of_block(bench, {"choices": choices, "stalls": stalls, "resets": resets}, at_random)
