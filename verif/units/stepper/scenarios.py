"""What closure plays on the stepper: lines of every kind, lines that are cut short, the longest line."""

from typing import Any

from numpy.random import Generator

from verif.coverage.subjects import Scenarios, of_block
from verif.env.context import Context
from verif.env.coverage.flow import LONG
from verif.units.stepper.bench import StepperBench

_PIXELS = 16
"""Of a line at most."""


async def lines(bench: StepperBench, generator: Generator, _size: int) -> None:
    """Counts and spans at their limits, remainders at theirs, with idle clocks."""
    most = bench.counts - 1
    odd = int(generator.integers(1, bench.counts // 2)) * 2 + 1
    for count in (1, 2, 5, bench.counts // 2, odd, most):
        quotient = int(generator.integers(1, max(2, bench.spans // count - 1)))
        spans = {0, count // 2, count - 1, quotient * count, quotient * count + count // 2}
        spans |= {quotient * count + count - 1, quotient * count + count // 2 + 1, bench.spans - 1}
        for span in sorted(spans):
            await bench.line(span % bench.spans, count, min(_PIXELS, count), frozenset({3, 5}))
    await bench.clocks(LONG)


async def cut_lines(bench: StepperBench, generator: Generator, size: int) -> None:
    """Lines that the next one cuts, some before their first step."""
    for steps in (0, *generator.integers(0, _PIXELS, size).tolist()):
        count, span = int(generator.integers(1, bench.counts)), int(generator.integers(0, bench.spans))
        await bench.line(span, count, min(count, steps))


async def longest_line(bench: StepperBench, _generator: Generator, _size: int) -> None:
    """The widest span in as many pixels as can be, and one more, in which the value wraps."""
    count = bench.counts - 1
    await bench.line(bench.spans - 1, count, count + 1)


async def at_random(bench: StepperBench, generator: Generator, _size: int) -> None:
    """A line of any span and count."""
    count, span = int(generator.integers(1, bench.counts)), int(generator.integers(0, bench.spans))
    await bench.line(span, count, min(count, 100))


async def closure_subject(dut: Any, run: Context) -> Scenarios:
    """The stepper, ready to be played on."""
    bench = StepperBench(dut, run.parameters)
    await bench.clock()
    return of_block(bench, {"lines": lines, "cut lines": cut_lines, "longest line": longest_line}, at_random)
