"""The tests that every valid/ready unit has; a unit's `bench.py` takes them with `standard_stream_tests`."""

from collections.abc import Awaitable, Callable
from typing import Any

import cocotb
from cocotb.task import resume
from cocotb.triggers import with_timeout
from hypothesis import strategies as st

from verif.env import context, definitions, operands, properties
from verif.env.clocking import PERIOD_NS
from verif.env.definitions import Definition
from verif.env.fields import Operands, count, every, select
from verif.env.pipelined import Mismatch
from verif.env.pipelined_tests import mixed
from verif.env.stream_bench import StreamBench
from verif.env.unit import StreamUnit

_CHUNK = 500
_STUCK = 1000
"""Clocks: many times any latency, and any counter that a unit of this kind has."""
_RATE_STREAM, _DEFINITION_STREAM = 1 << 16, 1 << 17
_WAITS = st.lists(st.integers(0, 5) | st.integers(0, 60), max_size=6)


def standard_stream_tests(unit: StreamUnit, *statements: Definition) -> dict[str, Any]:
    """Cocotb tests by name, for the globals of a bench module: the standard ones and a unit's definitions."""
    bodies: tuple[Callable[..., Awaitable[None]], ...] = (
        every_operand_drawn_gives_the_models_result_whoever_waits,
        a_fast_stream_matches_the_model,
        every_operand_of_a_narrow_unit_matches_the_model,
        reset_drops_what_is_in_flight_and_nothing_after,
        rate_and_latency_are_as_promised,
        a_result_waits_for_as_long_as_it_must,
        sides_that_are_stuck_for_long_lose_nothing,
    )
    bodies += tuple(_as_body(statement) for statement in statements)
    return {body.__name__: _as_test(body, unit) for body in bodies}


def _as_test(body: Callable[..., Awaitable[None]], unit: StreamUnit) -> Any:
    async def test(dut: Any) -> None:
        run = context.read()
        await body(await StreamBench.create(dut, unit, run.parameters), run)

    test.__name__ = test.__qualname__ = body.__name__
    test.__doc__ = body.__doc__
    test.__module__ = f"verif.units.{unit.name}.bench"
    return cocotb.test()(test)


def _as_body(statement: Definition) -> Callable[..., Awaitable[None]]:
    async def body(bench: StreamBench, run: context.Context) -> None:
        size = min(_length(bench, run), _CHUNK)
        given, got = await bench.run(mixed(bench.unit, run.generator(_DEFINITION_STREAM), run, size))
        sent, results = bench.given.operands(given.words), bench.got.operands(got.words)
        definitions.check(statement, bench.unit, run.parameters, sent, results)

    body.__name__ = statement.__name__
    body.__doc__ = statement.__doc__
    return body


def _length(bench: StreamBench, run: context.Context) -> int:
    """Operands of a fast stream: half the clocks of a pipelined unit's, for four agents look at each."""
    return max(16, run.operands // (2 * bench.unit.rate(run.parameters)))


async def _within_time(bench: StreamBench, drawn: Operands, idles: list[int], stalls: list[int]) -> None:
    """Resets, runs one batch; a hang fails instead of waiting for ever."""
    each = bench.unit.rate(bench.parameters) + max(idles, default=0) + max(stalls, default=0) + 8
    clocks = (count(drawn) + 1) * each + bench.unit.latency(bench.parameters) + 100
    await bench.reset()
    await with_timeout(bench.run(drawn, idles, stalls), clocks * PERIOD_NS, "ns")


async def every_operand_drawn_gives_the_models_result_whoever_waits(
    bench: StreamBench, run: context.Context
) -> None:
    """Property over operands, idle clocks of the source and stalls of the sink; shrinks to one operand."""
    example = resume(_within_time)

    def body(drawn: Operands, idles: list[int], stalls: list[int]) -> None:
        example(bench, bench.unit.legal(run.parameters, drawn), idles, stalls)

    batch = operands.batches(bench.unit.inputs(run.parameters), 8)
    await properties.check(run, body, batch, _WAITS, _WAITS)


async def a_fast_stream_matches_the_model(bench: StreamBench, run: context.Context) -> None:
    """Volume: seeded operands of mixed classes, back to back."""
    length, done, part = _length(bench, run), 0, 0
    while done < length:
        size = min(_CHUNK, length - done)
        await bench.run(mixed(bench.unit, run.generator(part), run, size))
        done += size
        part += 1
    bench.log.info("%d operands checked", done)


async def every_operand_of_a_narrow_unit_matches_the_model(bench: StreamBench, run: context.Context) -> None:
    """All combinations, in the parameter set that is narrow enough; other sets have none to try."""
    if run.parameter_set != bench.unit.exhaustive:
        return
    everything = bench.unit.legal(run.parameters, every(bench.unit.inputs(run.parameters)))
    for start in range(0, count(everything), _CHUNK):
        await bench.run(select(everything, slice(start, start + _CHUNK)))
    bench.log.info("%d operands checked, all there are", count(everything))


async def reset_drops_what_is_in_flight_and_nothing_after(bench: StreamBench, run: context.Context) -> None:
    """Reset at a drawn moment: no result of before comes out, the next operands are exact."""

    async def example(before: Operands, after: Operands, wait: int, stalls: list[int]) -> None:
        await bench.reset()
        bench.send(before, stalls=stalls)
        await bench.clocking.cycles(wait)
        await bench.reset()
        await bench.clocking.cycles(bench.unit.latency(run.parameters) + 4)
        bench.check(0)
        await bench.run(after, stalls=stalls)

    step = resume(example)
    latency = bench.unit.latency(run.parameters)
    batch = operands.batches(bench.unit.inputs(run.parameters), 4)

    def body(before: Operands, after: Operands, wait: int, stalls: list[int]) -> None:
        legal = bench.unit.legal
        step(legal(run.parameters, before), legal(run.parameters, after), wait, stalls)

    await properties.check(run, body, batch, batch, st.integers(0, 2 * latency + 4), _WAITS)


async def rate_and_latency_are_as_promised(bench: StreamBench, run: context.Context) -> None:
    """Where neither side waits, results are one rate apart; every result's latency is the promised one."""
    drawn = mixed(bench.unit, run.generator(_RATE_STREAM), run, 16)
    _, got = await bench.run(drawn)
    rate = bench.unit.rate(run.parameters)
    apart = [after - before for before, after in zip(got.taken, got.taken[1:], strict=False)]
    if apart != [rate] * len(apart):
        raise Mismatch(f"results are {apart} clocks apart, promised {rate}")


async def a_result_waits_for_as_long_as_it_must(bench: StreamBench, run: context.Context) -> None:
    """A sink that stalls for many times the latency gets every result, unchanged, once; a unit without an
    operand waits for no sink."""
    drawn = mixed(bench.unit, run.generator(_RATE_STREAM), run, 4)
    given, _ = await bench.run(drawn, stalls=[5 * bench.unit.latency(run.parameters)])
    if given.taken[0] != given.offered[0]:
        raise Mismatch(
            f"offered at clock {given.offered[0]}, accepted at clock {given.taken[0]}: not at once"
        )


async def sides_that_are_stuck_for_long_lose_nothing(bench: StreamBench, run: context.Context) -> None:
    """A sink that is stuck holds everything, a source that is stuck makes nothing; released, all is exact."""
    await bench.stuck(mixed(bench.unit, run.generator(_RATE_STREAM), run, 4), _STUCK)
