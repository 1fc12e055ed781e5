"""What closure plays on a design: a portion of undirected stimulus, or one by the recipe of a hole.

Arithmetic units need nothing of their own: recipes shape operands, and idles, stalls and resets are played
here. Any other design has a `scenarios.py` whose `closure_subject` says what its recipes' names play.
"""

import importlib
import importlib.util
from collections.abc import Awaitable, Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

from numpy.random import Generator

from verif.env.block import Block
from verif.env.context import Context
from verif.env.coverage.collector import Collector
from verif.env.coverage.flow import IDLES, LONG, RESET_BUSY, RESET_IDLE, STALLS
from verif.env.coverage.points import Recipe
from verif.env.coverage.sampling import Signals
from verif.env.fields import Operands, count, select
from verif.env.operands import uniform
from verif.env.pipelined import PipelinedBench
from verif.env.stream_bench import StreamBench
from verif.env.unit import PipelinedUnit, StreamUnit
from verif.env.units import find


class Subject(Protocol):
    """A design that runs, has been reset, and is watched."""

    @property
    def coverage(self) -> Collector:
        """Its bins."""

    @property
    def largest(self) -> int:
        """The size beyond which a portion is not doubled."""

    async def undirected(self, generator: Generator) -> None:
        """A portion of what anybody would draw without looking at the bins."""

    async def follow(self, recipe: Recipe, generator: Generator, size: int) -> None:
        """A portion that a recipe draws; size: about how much, doubled while the hole stays."""


Scenario = Callable[[Any, Generator, int], Awaitable[None]]
"""Plays on a bench, with a generator, about as much as a size says."""

_UNDIRECTED = 256
"""Operands of an undirected portion."""
_LARGEST = 4096


@dataclass(frozen=True)
class Scenarios:
    """A subject whose recipes are scenarios of a bench."""

    bench: Any
    coverage: Collector
    scenarios: Mapping[str, Scenario]
    at_random: Scenario
    """The undirected one."""
    largest: int = _LARGEST

    async def undirected(self, generator: Generator) -> None:
        """One portion of the undirected scenario."""
        await self.at_random(self.bench, generator, 1)

    async def follow(self, recipe: Recipe, generator: Generator, size: int) -> None:
        """Plays the scenario of the recipe's name. Raises KeyError where the bench has none."""
        await self.scenarios[recipe.name](self.bench, generator, size)


def _drawn(bench: PipelinedBench | StreamBench, generator: Generator, size: int) -> Operands:
    """Uniform operands, made legal."""
    return bench.unit.legal(bench.parameters, uniform(generator, bench.unit.inputs(bench.parameters), size))


def _shaped(bench: PipelinedBench | StreamBench, recipe: Recipe, generator: Generator, size: int) -> Operands:
    if recipe.shape is None:
        raise KeyError(f"no scenario is called {recipe.name}")
    shaped = recipe.shape(bench.parameters, generator, _drawn(bench, generator, size))
    return bench.unit.legal(bench.parameters, shaped)


def _known(coverage: Collector | None) -> Collector:
    if coverage is None:
        raise ValueError("this run samples no coverage: its settings name no unit")
    return coverage


class PipelinedSubject:
    """A pipelined unit."""

    largest = _LARGEST

    def __init__(self, bench: PipelinedBench) -> None:
        self._bench = bench
        self.coverage = _known(bench.coverage)
        self._scenarios: Mapping[str, Scenario] = {
            IDLES: _pipelined_idles,
            RESET_BUSY: _pipelined_reset_busy,
            RESET_IDLE: _pipelined_reset_idle,
        }

    async def undirected(self, generator: Generator) -> None:
        """Uniform operands, back to back."""
        await self._bench.run(_drawn(self._bench, generator, _UNDIRECTED))

    async def follow(self, recipe: Recipe, generator: Generator, size: int) -> None:
        """Operands that the recipe shapes, or its scenario."""
        if recipe.name in self._scenarios:
            await self._scenarios[recipe.name](self._bench, generator, size)
        else:
            await self._bench.run(_shaped(self._bench, recipe, generator, size))


async def _pipelined_idles(bench: PipelinedBench, generator: Generator, _size: int) -> None:
    await bench.run(_drawn(bench, generator, 8), [0, 0, 1, 3, 2 * LONG])


async def _pipelined_reset_busy(bench: PipelinedBench, generator: Generator, _size: int) -> None:
    await bench.drive(_drawn(bench, generator, 4))
    await bench.reset()


async def _pipelined_reset_idle(bench: PipelinedBench, generator: Generator, _size: int) -> None:
    await bench.reset()


class StreamSubject:
    """A unit between two valid/ready streams."""

    largest = _LARGEST

    def __init__(self, bench: StreamBench) -> None:
        self._bench = bench
        self.coverage = _known(bench.coverage)

    async def undirected(self, generator: Generator) -> None:
        """Uniform operands, nobody waits."""
        await self._bench.run(_drawn(self._bench, generator, 8))

    async def follow(self, recipe: Recipe, generator: Generator, size: int) -> None:
        """Operands that the recipe shapes, or idles, stalls and resets."""
        bench, some = self._bench, _drawn(self._bench, generator, 8)
        if recipe.name == IDLES:
            await bench.run(some, idles=_waits(bench))
        elif recipe.name == STALLS:
            await bench.run(some, stalls=_waits(bench))
        elif recipe.name == RESET_BUSY:
            bench.send(some)
            await bench.clocking.cycles(bench.unit.latency(bench.parameters) // 2 + 2)
            await bench.reset()
        elif recipe.name == RESET_IDLE:
            await bench.reset()
        else:
            drawn = _shaped(bench, recipe, generator, min(size, 64))
            await bench.run(select(drawn, slice(0, count(drawn))))


def _waits(bench: StreamBench) -> Sequence[int]:
    """None, one clock, a few, many, each beyond what the unit itself takes."""
    rate = bench.unit.rate(bench.parameters)
    return [0, rate, rate + 1, rate + 3, rate + 2 * LONG, 1, 3, 2 * LONG]


def of_block(bench: Block, scenarios: Mapping[str, Scenario], at_random: Scenario) -> Scenarios:
    """A block's bench as a subject. Raises ValueError where its run samples no coverage."""
    return of_signals(bench, bench.signals, scenarios, at_random)


def of_signals(
    bench: Any, signals: Signals | None, scenarios: Mapping[str, Scenario], at_random: Scenario
) -> Scenarios:
    """The same of a bench of another kind that samples signals."""
    return Scenarios(bench, _known(None if signals is None else signals.collector), scenarios, at_random)


async def subject(dut: Any, run: Context) -> Subject:
    """The design of this run, ready to be played on. Raises ValueError where a block has no scenarios."""
    if importlib.util.find_spec(run.extra["scenarios"]) is not None:
        scenarios = importlib.import_module(run.extra["scenarios"])
        found: Subject = await scenarios.closure_subject(dut, run)
        return found
    unit = find(run.unit)
    if isinstance(unit, PipelinedUnit):
        return PipelinedSubject(await PipelinedBench.create(dut, unit, run.parameters))
    if isinstance(unit, StreamUnit):
        return StreamSubject(await StreamBench.create(dut, unit, run.parameters))
    raise ValueError(
        f"verif/units/{unit.name}/scenarios.py: is missing; a block says there what closure plays"
    )
