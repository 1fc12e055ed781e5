"""What closure plays on the sums of pixels: work and terms that meet, bright terms, resets."""

from typing import Any

from numpy.random import Generator

from verif.coverage.subjects import Scenarios, of_block
from verif.env.context import Context
from verif.units.accumulator.bench import MOST, AccumulatorBench, Clock, Colour, More, Term

_PORTION = 200
"""Clocks of an undirected portion."""


def _terms(slot: int, number: int, colour: Colour = (1, 2, 3)) -> list[Clock]:
    return [Clock(term=Term(slot, colour))] * number


async def pixels(bench: AccumulatorBench, _generator: Generator, _size: int) -> None:
    """Pixels of no more work, one, some, the most; every slot completes one, a clock behind the other."""
    most = bench.most_work - 1
    for slot, count in ((0, 0), (0, 1), (1, most // 2), (bench.slots - 1, most)):
        await bench.steps([Clock(More(slot, count)), *_terms(slot, count + 1)])
    await bench.steps(clock for slot in range(bench.slots) for clock in _terms(slot, 1))
    await bench.finish()


async def meetings(bench: AccumulatorBench, generator: Generator, size: int) -> None:
    """Work and terms of two slots in any order, then one slot alone, over and over."""
    for _ in range(8 * size):
        more, term = generator.integers(0, 2, 2).tolist()
        has_more, has_term = (generator.random(2) < (0.3, 0.8)).tolist()
        await bench.step(
            Clock(More(more, 1) if has_more else None, Term(term, (1, 1, 1)) if has_term else None)
        )
    await bench.finish()
    await bench.steps(_terms(0, 2 * 8))
    await bench.finish()


async def bright_terms(bench: AccumulatorBench, _generator: Generator, _size: int) -> None:
    """Sums of nothing, of just the most that there is, and of more, more than once, in each channel."""
    half = MOST // 2
    await bench.steps(_terms(0, 1, (0, 0, 0)))
    for last in (MOST - half, MOST - half + 1):
        await bench.steps([Clock(More(0, 1)), *_terms(0, 1, (half,) * 3), *_terms(0, 1, (last,) * 3)])
    await bench.steps([Clock(More(0, bench.most_work - 1)), *_terms(0, bench.most_work, (MOST,) * 3)])
    await bench.finish()


async def resets(bench: AccumulatorBench, generator: Generator, _size: int) -> None:
    """Reset at rest, one and two clocks behind a term, and within the clearing, up to its last clock."""
    for behind in range(3):
        await bench.steps([*_terms(1, 1), *[Clock()] * behind])
        await bench.restart()
    await bench.restart()
    for clocks in (bench.slots - 1, int(generator.integers(1, bench.slots))):
        await bench.reset()
        await bench.clocks(clocks)
    await bench.restart()


async def at_random(bench: AccumulatorBench, generator: Generator, _size: int) -> None:
    """Any work of any slot in one clock of four, any term in every other."""
    has_more, has_term = (generator.random((2, _PORTION)) < [[0.25], [0.5]]).tolist()
    slots = generator.integers(0, bench.slots, (2, _PORTION)).tolist()
    counts = generator.integers(0, bench.most_work, _PORTION).tolist()
    colours = generator.integers(0, MOST, (_PORTION, 3), endpoint=True).tolist()
    for number in range(_PORTION):
        more = More(slots[0][number], counts[number]) if has_more[number] else None
        term = Term(slots[1][number], tuple(colours[number])) if has_term[number] else None
        await bench.step(Clock(more, term))
    await bench.finish()


async def closure_subject(dut: Any, run: Context) -> Scenarios:
    """The sums, ready to be played on."""
    bench = AccumulatorBench(dut, run.parameters)
    await bench.restart()
    played = {"pixels": pixels, "meetings": meetings, "bright terms": bright_terms, "resets": resets}
    return of_block(bench, played, at_random)
