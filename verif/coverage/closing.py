"""The test that closes coverage: looks at the holes, plays their recipes, looks again.

Its run's settings say for whom (`unit`), which bins others have hit (`known`), and in `extra` how:
`mode` is "directed", until no hole is left, `seconds` are over or nothing more comes of it, or "undirected",
until so many `clocks`.
What it counted is kept as any other test's is.
"""

import time
from typing import Any

import cocotb
from cocotb.triggers import with_timeout
from numpy.random import Generator

from verif.coverage.subjects import Subject, subject
from verif.env import context
from verif.env.clocking import PERIOD_NS
from verif.env.coverage.points import Recipe
from verif.env.coverage.sampling import clock_number

_FIRST_SIZE = 32
_FRUITLESS = 6
"""Rounds of the largest size after which the holes that are left cannot be reached on this build."""
_PATIENCE = 1_000_000
"""Clocks that a portion takes at most."""


@cocotb.test()
async def closure(dut: Any) -> None:
    """Every bin is hit, or the time is over; no portion fails and none hangs."""
    run = context.read()
    if run.extra["mode"] == "undirected":
        await _undirected(await subject(dut, run), run.generator(1), run.extra["clocks"])
    else:
        await _directed(await subject(dut, run), run.generator(0), run.extra["seconds"])


async def _played(portion: Any, what: Subject) -> None:
    await with_timeout(cocotb.start_soon(portion), _PATIENCE * PERIOD_NS, "ns")
    what.coverage.flush(clock_number())


async def _undirected(what: Subject, generator: Generator, clocks: int) -> None:
    while clock_number() < clocks:
        await _played(what.undirected(generator), what)


async def _directed(what: Subject, generator: Generator, seconds: float) -> None:
    end = time.monotonic() + seconds
    size, fruitless = _FIRST_SIZE, 0
    await _played(what.undirected(generator), what)
    while (holes := what.coverage.holes()) and time.monotonic() < end and fruitless < _FRUITLESS:
        for recipe in _recipes(what):
            if any(recipe.name == left.name for left in what.coverage.holes().values()):
                await _played(what.follow(recipe, generator, size), what)
        fruitless = fruitless + 1 if size >= what.largest and what.coverage.holes() == holes else 0
        size = min(2 * size, what.largest)


def _recipes(what: Subject) -> list[Recipe]:
    """The recipes of the holes, each once."""
    return list({recipe.name: recipe for recipe in what.coverage.holes().values()}.values())
