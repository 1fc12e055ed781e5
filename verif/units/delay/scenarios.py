"""What closure plays on the delay lines: words at their limits, and resets wherever the ring stands."""

from typing import Any

from numpy.random import Generator

from verif.coverage.subjects import Scenarios, of_signals
from verif.env.context import Context
from verif.env.coverage.flow import LONG
from verif.units.delay.bench import DelayBench

_ROUND = 10
"""Places of the ring that is watched."""
_PORTION = 100
"""Words of an undirected portion."""


async def words(bench: DelayBench, _generator: Generator, _size: int) -> None:
    """None of the bits and all of them by turns, then one word for long."""
    for word in ([0, bench.most] * _ROUND) + [bench.most] * 2 * LONG:
        await bench.clock(word)


async def resets(bench: DelayBench, generator: Generator, _size: int) -> None:
    """Reset behind each number of words up to a round of the ring."""
    for number in range(_ROUND + 1):
        for word in generator.integers(0, bench.most, number, endpoint=True).tolist():
            await bench.clock(word)
        await bench.reset()


async def at_random(bench: DelayBench, generator: Generator, _size: int) -> None:
    """Any words."""
    for word in generator.integers(0, bench.most, _PORTION, endpoint=True).tolist():
        await bench.clock(word)


async def closure_subject(dut: Any, run: Context) -> Scenarios:
    """The lines, ready to be played on."""
    bench = DelayBench(dut, run)
    await bench.reset()
    return of_signals(bench, bench.signals, {"words": words, "resets": resets}, at_random)
