"""The tests that every pipelined unit has; a unit's `bench.py` takes them with `standard_tests`.

The mixed operands of a fast stream serve the valid/ready units as well (`verif.env.stream_tests`).
"""

from collections.abc import Awaitable, Callable, Sequence
from typing import Any

import cocotb
from cocotb.task import resume
from cocotb.triggers import with_timeout
from hypothesis import strategies as st
from numpy.random import Generator

from verif.env import context, definitions, operands, properties
from verif.env.clocking import PERIOD_NS
from verif.env.definitions import Definition
from verif.env.fields import Operands, concatenate, count, every, select
from verif.env.pipelined import Mismatch, PipelinedBench
from verif.env.unit import ArithmeticUnit, PipelinedUnit

_CHUNK = 20_000
_RATE_STREAM, _DEFINITION_STREAM = 1 << 16, 1 << 17
_DEFINITION_SHARE = 20
"""Each of a unit's definitions gets this part of a fast stream: a unit has several, and Icarus is slow."""
_GAPS = st.lists(st.integers(0, 3), max_size=8)


Body = Callable[..., Awaitable[None]]
"""A test of a bench that has been made, and of its run's settings."""


def standard_tests(
    unit: PipelinedUnit,
    *statements: Definition,
    more: Sequence[Body] = (),
    bench: type[PipelinedBench] = PipelinedBench,
) -> dict[str, Any]:
    """Cocotb tests by name, for the globals of a bench module: the standard ones, a unit's definitions
    and what ``more`` tests it has, each on a ``bench`` of its own.
    """
    bodies: tuple[Body, ...] = (
        every_operand_drawn_gives_the_models_result,
        a_fast_stream_matches_the_model,
        every_operand_of_a_narrow_unit_matches_the_model,
        reset_drops_what_is_in_flight_and_nothing_after,
        rate_is_one_operand_a_clock_at_the_promised_latency,
    )
    bodies += (*(_as_body(statement) for statement in statements), *more)
    return {body.__name__: _as_test(body, unit, bench) for body in bodies}


def _as_body(statement: Definition) -> Body:
    async def body(bench: PipelinedBench, run: context.Context) -> None:
        size = min(run.operands // _DEFINITION_SHARE, _CHUNK)
        drawn = mixed(bench.unit, run.generator(_DEFINITION_STREAM), run, size)
        given, got = await bench.answers(drawn)
        definitions.check(statement, bench.unit, run.parameters, given, got)

    body.__name__ = statement.__name__
    body.__doc__ = statement.__doc__
    return body


def _as_test(body: Body, unit: PipelinedUnit, bench: type[PipelinedBench]) -> Any:
    async def test(dut: Any) -> None:
        run = context.read()
        await body(await bench.create(dut, unit, run.parameters), run)

    test.__name__ = test.__qualname__ = body.__name__
    test.__doc__ = body.__doc__
    test.__module__ = f"verif.units.{unit.name}.bench"
    return cocotb.test()(test)


async def within_time(bench: PipelinedBench, drawn: Operands, gaps: list[int]) -> None:
    """Resets, runs one batch; a hang fails instead of waiting for ever."""
    clocks = count(drawn) * (2 + max(gaps, default=0)) + bench.unit.latency(bench.parameters) + 100
    await bench.reset()
    await with_timeout(bench.run(drawn, gaps), clocks * PERIOD_NS, "ns")


async def every_operand_drawn_gives_the_models_result(bench: PipelinedBench, run: context.Context) -> None:
    """Property over operands and idle clocks; shrinks to one operand."""
    example = resume(within_time)

    def body(drawn: Operands, gaps: list[int]) -> None:
        example(bench, bench.unit.legal(run.parameters, drawn), gaps)

    await properties.check(run, body, operands.batches(bench.unit.inputs(run.parameters)), _GAPS)


async def a_fast_stream_matches_the_model(bench: PipelinedBench, run: context.Context) -> None:
    """Volume: seeded operands of mixed classes, back to back."""
    done, part = 0, 0
    while done < run.operands:
        generator = run.generator(part)
        size = min(_CHUNK, run.operands - done)
        done += await bench.run(mixed(bench.unit, generator, run, size))
        part += 1
    bench.log.info("%d operands checked", done)


def mixed(unit: ArithmeticUnit, generator: Generator, run: context.Context, size: int) -> Operands:
    """Legal operands of all classes, the unit's own among them."""
    drawn = operands.stream(generator, unit.inputs(run.parameters), size)
    if unit.directed is not None:
        directed = unit.directed(run.parameters, generator, size // 2)
        directed = select(directed, slice(0, size // 2))
        kept = select(drawn, slice(0, size - count(directed)))
        drawn = select(concatenate([kept, directed]), generator.permutation(size))
    return unit.legal(run.parameters, drawn)


async def every_operand_of_a_narrow_unit_matches_the_model(
    bench: PipelinedBench, run: context.Context
) -> None:
    """All combinations, in the parameter set that is narrow enough; other sets have none to try."""
    if run.parameter_set != bench.unit.exhaustive:
        return
    everything = bench.unit.legal(run.parameters, every(bench.unit.inputs(run.parameters)))
    checked = 0
    for start in range(0, count(everything), _CHUNK):
        checked += await bench.run(select(everything, slice(start, start + _CHUNK)))
    assert checked == count(everything)
    bench.log.info("%d operands checked, all there are", checked)


async def reset_drops_what_is_in_flight_and_nothing_after(
    bench: PipelinedBench, run: context.Context
) -> None:
    """Reset at a drawn moment: no result of before comes out, the next operands are exact."""

    async def example(before: Operands, after: Operands, wait: int) -> None:
        await bench.reset()
        await bench.drive(before)
        await bench.clocking.cycles(wait)
        await bench.reset()
        await bench.drain()
        if bench.compare():
            raise Mismatch("a result of before the reset came out after it")
        await bench.run(after)

    step = resume(example)
    latency = bench.unit.latency(run.parameters)
    batch = operands.batches(bench.unit.inputs(run.parameters), 8)

    def body(before: Operands, after: Operands, wait: int) -> None:
        legal = bench.unit.legal
        step(legal(run.parameters, before), legal(run.parameters, after), wait)

    await properties.check(run, body, batch, batch, st.integers(0, latency))


async def rate_is_one_operand_a_clock_at_the_promised_latency(
    bench: PipelinedBench, run: context.Context
) -> None:
    """As many results as operands in as many clocks; the checker holds each to the latency."""
    size = 2 * bench.unit.latency(run.parameters) + 16
    drawn = mixed(bench.unit, run.generator(_RATE_STREAM), run, size)
    await bench.drive(drawn)
    await bench.drain()
    clocks = bench.result_clocks()
    assert clocks == list(range(clocks[0], clocks[0] + size)), "results did not come one a clock"
    assert bench.compare() == size
