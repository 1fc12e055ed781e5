"""What closure plays on the queue: fills and drains, a single item, steady traffic at each level, resets."""

from typing import Any

from numpy.random import Generator

from verif.coverage.subjects import Scenarios, of_block
from verif.env.context import Context
from verif.env.coverage.flow import LONG
from verif.units.fifo.bench import Clock, FifoBench

_PORTION = 200
"""Clocks of an undirected portion."""


async def _play(bench: FifoBench, offers: int, takes: int, clocks: int) -> None:
    for number in range(clocks):
        await bench.step(Clock(bool(offers), number, bool(takes)))


async def fills(bench: FifoBench, _generator: Generator, _size: int) -> None:
    """Filled, held, a place made and taken, drained."""
    await _play(bench, 1, 0, bench.depth + LONG)
    await _play(bench, 1, 1, 1)
    await _play(bench, 1, 0, 2)
    await bench.drain()


async def trickles(bench: FifoBench, _generator: Generator, _size: int) -> None:
    """One item alone, taken at once, late, and very late; a taker that waits; then some in a row."""
    for wait in (0, 4, 2 * LONG):
        await _play(bench, 1, 0, 1)
        await _play(bench, 0, 0, wait)
        await _play(bench, 0, 1, LONG + wait)
    await _play(bench, 1, 1, LONG)
    await bench.drain()


async def steady(bench: FifoBench, generator: Generator, _size: int) -> None:
    """At every level: a push alone, nothing, both, a pop alone; once round the places with both."""
    for level in range(bench.depth + 1):
        await bench.drain()
        await _play(bench, 1, 0, level)
        await _play(bench, 0, 0, 3)
        for offers, takes in generator.permutation([(1, 1), (1, 0), (0, 0), (0, 1)]).tolist():
            await _play(bench, offers, takes, 2)
    await _play(bench, 1, 1, 2 * bench.depth)
    await bench.drain()


async def resets(bench: FifoBench, generator: Generator, _size: int) -> None:
    """Reset at every level, at once and when the first item has come to the output."""
    for level in range(bench.depth + 1):
        for wait in (0, int(generator.integers(1, LONG))):
            await _play(bench, 1, 0, level)
            await _play(bench, 0, 0, wait)
            await bench.restart()


async def at_random(bench: FifoBench, generator: Generator, _size: int) -> None:
    """Offers and takes in every other clock."""
    offers, takes = (generator.random((2, _PORTION)) < 0.5).tolist()
    for number, (offer, take) in enumerate(zip(offers, takes, strict=True)):
        await bench.step(Clock(offer, number, take))


async def closure_subject(dut: Any, run: Context) -> Scenarios:
    """The queue, ready to be played on."""
    bench = FifoBench(dut, run.parameters)
    await bench.restart()
    played = {"fills": fills, "trickles": trickles, "steady": steady, "resets": resets}
    return of_block(bench, played, at_random)
