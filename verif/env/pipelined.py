"""Bench of a pipelined unit: driver, a monitor on each side, a model, a checker.

The unit never stalls, so a transaction is one clock. The monitors note the clock's number with
each transaction; the model is fed by the input monitor; the checker compares in order and refuses
leftovers, extras, wrong tags and wrong latencies.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import cocotb
import numpy as np

from verif.env import context, unknowns
from verif.env.clocking import Clocking
from verif.env.coverage.collector import Collector
from verif.env.coverage.declared import coverage_of
from verif.env.coverage.flow import IDLE
from verif.env.coverage.sampling import clock_number, collector
from verif.env.fields import Field, Operands, count, describe, describe_all, join, split
from verif.env.harness import framed
from verif.env.unit import TAG_W, Parameters, PipelinedUnit


@dataclass
class Trace:
    """What a monitor saw: clock number and port value, valid and tag on top, of each transaction."""

    clocks: list[int] = field(default_factory=list)
    words: list[int] = field(default_factory=list)

    def clear(self) -> None:
        """Forgets everything."""
        self.clocks.clear()
        self.words.clear()

    def operands(self, fields: Sequence[Field]) -> Operands:
        """The values of the unit's ports, and `tag`."""
        return split(framed(fields), self.words)


class Monitor:
    """Samples one side of a unit's harness, whose top bit is valid, at every clock."""

    def __init__(self, port: Any) -> None:
        self._port = port
        self.trace = Trace()

    def sample(self, clock: int) -> None:
        """To be called once a clock, at its edge. An unknown bit in a valid transaction raises."""
        bits = str(self._port.value)
        if bits[0] == "0":
            return
        try:
            self.trace.words.append(int(bits, 2))
        except ValueError:
            raise Mismatch(f"unknown bits at clock {clock}: {bits}") from None
        self.trace.clocks.append(clock)


class Mismatch(AssertionError):
    """The unit did not do what its model does."""


@dataclass(frozen=True)
class Checker:
    """Compares what the two monitors of a unit saw, with the unit's model between them."""

    unit: PipelinedUnit
    parameters: Parameters

    def check(self, given: Trace, got: Trace) -> Operands:
        """Operands and results together. Raises Mismatch with the first operand that went wrong."""
        latency = self.unit.latency(self.parameters)
        if len(given.clocks) != len(got.clocks):
            raise Mismatch(f"{len(given.clocks)} operands in, {len(got.clocks)} results out")
        for start, end in zip(given.clocks, got.clocks, strict=True):
            if end - start != latency:
                raise Mismatch(f"latency {end - start} clocks at clock {start}, promised {latency}")
        inputs, outputs = self.unit.inputs(self.parameters), self.unit.outputs(self.parameters)
        operands, results = given.operands(inputs), got.operands(outputs)
        if (operands["tag"] != results["tag"]).any():
            raise Mismatch("tags come out in another order than they went in")
        expected = self.unit.model(self.parameters, operands)
        for port in outputs:
            wrong = (
                (expected[port.name] != results[port.name]).reshape(port.lanes, -1).any(axis=0).nonzero()[0]
            )
            if wrong.size:
                index = int(wrong[0])
                lines = [f"operand {index} of {count(operands)} ({wrong.size} wrong):"]
                lines += [describe_all(inputs, operands, index)]
                lines += [f"  expected {describe(port, expected[port.name], index)}"]
                lines += [f"  got      {describe(port, results[port.name], index)}"]
                raise Mismatch("\n".join(lines))
        return {**operands, **results}


class PipelinedBench:
    """Drives a unit and watches it. Make one a test, with `create`."""

    def __init__(self, dut: Any, unit: PipelinedUnit, parameters: Parameters) -> None:
        self.unit, self.parameters = unit, parameters
        self.clocking = Clocking(dut)
        self.log = dut._log
        self._inputs = unit.inputs(parameters)
        self._framed = framed(self._inputs)
        self._bits = sum(field.bits for field in self._framed)
        self._port = getattr(dut, "in")
        self._given = Monitor(self._port)
        self._got = Monitor(dut.out)
        self._checker = Checker(unit, parameters)
        self._watched_from = 0
        self._last = 0
        run = context.read()
        self.coverage: Collector | None = collector(run, coverage_of(unit)) if run.unit else None

    @classmethod
    async def create(cls, dut: Any, unit: PipelinedUnit, parameters: Parameters) -> "PipelinedBench":
        """A bench whose clock runs and whose unit has been reset."""
        bench = cls(dut, unit, parameters)
        cocotb.start_soon(bench._watch())
        await bench.reset()
        return bench

    async def reset(self) -> None:
        """Resets the unit and forgets what was in flight.

        The monitors see again from the second clock on: what was in flight must be gone by then.
        """
        self._port.value = unknowns.idle(0, self._bits)
        if self.coverage is not None:
            busy = len(self._given.trace.clocks) > len(self._got.trace.clocks)
            self.coverage.tell("reset.busy" if busy else "reset.idle", clock_number())
        self._watched_from = clock_number() + 2
        self._given.trace.clear()
        self._got.trace.clear()
        await self.clocking.reset()

    async def _watch(self) -> None:
        edge = self.clocking.edge
        await edge  # still under reset
        clock = clock_number()
        while True:
            await edge
            clock += 1
            if clock >= self._watched_from:
                self._given.sample(clock)
                self._got.sample(clock)

    async def drive(self, operands: Operands, gaps: Sequence[int] = ()) -> None:
        """One operand a clock, ``gaps[i % len(gaps)]`` clocks of nothing known before operand i."""
        number = count(operands)
        tags = np.arange(number) & ((1 << TAG_W) - 1)
        words = join(self._framed, {"valid": np.ones(number, np.int64), "tag": tags, **operands})
        edge, port = self.clocking.edge, self._port
        for index, word in enumerate(words):
            if gaps and (idle := gaps[index % len(gaps)]):
                port.value = unknowns.idle(word, self._bits)
                await self.clocking.cycles(idle)
            port.value = word
            await edge
        port.value = unknowns.idle(words[-1], self._bits)

    async def drain(self) -> None:
        """Waits until everything in flight must have come out, and then some."""
        await self.clocking.cycles(self.unit.latency(self.parameters) + 4)

    def result_clocks(self) -> list[int]:
        """Clock numbers of the results seen since the last `compare`."""
        return list(self._got.trace.clocks)

    def compare(self) -> int:
        """Checks everything seen since the last call; the number of operands that was."""
        if not self._given.trace.clocks and not self._got.trace.clocks:
            return 0  # models need not take no operands
        samples = self._checker.check(self._given.trace, self._got.trace)
        checked = len(self._given.trace.clocks)
        self._cover(samples)
        self._given.trace.clear()
        self._got.trace.clear()
        return checked

    def _cover(self, samples: Operands) -> None:
        if self.coverage is not None:
            waited = np.diff(self._given.trace.clocks, prepend=self._last or self._given.trace.clocks[0]) - 1
            self.coverage.add({**samples, IDLE: waited}, clock_number())
        self._last = self._given.trace.clocks[-1]

    async def answers(self, operands: Operands) -> tuple[Operands, Operands]:
        """Operands and results as the monitors saw them, in order, not yet compared."""
        await self.drive(operands)
        await self.drain()
        given = self._given.trace.operands(self._inputs)
        got = self._got.trace.operands(self.unit.outputs(self.parameters))
        if count(given) != count(got):
            raise Mismatch(f"{count(given)} operands in, {count(got)} results out")
        self._cover({**given, **got})
        self._given.trace.clear()
        self._got.trace.clear()
        return given, got

    async def run(self, operands: Operands, gaps: Sequence[int] = ()) -> int:
        """Drives, drains and checks; returns the number of operands checked."""
        await self.drive(operands, gaps)
        await self.drain()
        checked = self.compare()
        if checked != count(operands):
            raise Mismatch(f"{count(operands)} operands driven, {checked} seen by the monitor")
        return checked
