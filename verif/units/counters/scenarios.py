"""What closure plays on the counters: events alone and together, long frames, resets."""

from dataclasses import fields
from typing import Any

from numpy.random import Generator

from verif.coverage.subjects import Scenarios, of_block
from verif.env.context import Context
from verif.units.counters.bench import Clock, CountersBench

_EVENTS = tuple(field.name for field in fields(Clock) if field.name not in ("frame_start", "tested"))
_LONG_FRAME = 260
"""Clocks: more than 8 bits count."""
_PORTION = 200
"""Clocks of an undirected portion."""


def _of(*events: str) -> Clock:
    happen: dict[str, Any] = dict.fromkeys(events, True)
    return Clock(**happen)


async def events(bench: CountersBench, _generator: Generator, _size: int) -> None:
    """None, each alone, each with the start of a frame, all of them; every choice of trace units."""
    every_unit = (1 << bench.units) - 1
    tested = [Clock(tested=bits) for bits in range(every_unit + 1)]
    everything = Clock(True, True, True, True, True, every_unit, True, True)
    await bench.restart()
    await bench.steps([_of("frame_start"), Clock(), *map(_of, _EVENTS), *tested])
    await bench.steps(_of("frame_start", event) for event in _EVENTS)
    await bench.steps([Clock(frame_start=True, tested=every_unit), everything, everything])


async def long_frames(bench: CountersBench, _generator: Generator, _size: int) -> None:
    """A frame that is busy, with a light left out in every clock, for longer than 8 bits count."""
    await bench.restart()
    await bench.steps([Clock(frame_start=True)])
    await bench.steps([Clock(busy=True, at_point=True)] * _LONG_FRAME)


async def resets(bench: CountersBench, _generator: Generator, _size: int) -> None:
    """Reset with nothing counted, a frame under way, events since reset."""
    await bench.restart()
    for counted in (Clock(), Clock(busy=True), Clock(at_point=True, flat=True)):
        await bench.steps([counted] * 3)
        await bench.restart()


async def at_random(bench: CountersBench, generator: Generator, _size: int) -> None:
    """Every event in every other clock; a frame begins now and then."""
    starts = (generator.random(_PORTION) < 0.05).tolist()
    flags = (generator.random((_PORTION, 6)) < 0.5).tolist()
    tested = generator.integers(0, 1 << bench.units, _PORTION).tolist()
    for start, (busy, primary, secondary, shadow, at_point, flat), tests in zip(
        starts, flags, tested, strict=True
    ):
        await bench.step(Clock(start, busy, primary, secondary, shadow, tests, at_point, flat))


async def closure_subject(dut: Any, run: Context) -> Scenarios:
    """The counters, ready to be played on."""
    bench = CountersBench(dut, run.parameters)
    await bench.restart()
    return of_block(bench, {"events": events, "long frames": long_frames, "resets": resets}, at_random)
