"""Bench of a unit between two valid/ready streams: source, sink, a monitor on each side, scoreboard.

The model is fed by the input monitor; the scoreboard compares in order and refuses leftovers and
extras; the latency of each result is checked against the promise.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np

from verif.env import context
from verif.env.clocking import Clocking
from verif.env.coverage.collector import Collector
from verif.env.coverage.declared import coverage_of
from verif.env.coverage.flow import IDLE, STALL
from verif.env.coverage.sampling import clock_number, collector
from verif.env.fields import Operands, count
from verif.env.pipelined import Mismatch
from verif.env.scoreboard import Scoreboard
from verif.env.streams import BARE, Stream, Transaction, Transfers
from verif.env.unit import Parameters, StreamUnit


class StreamBench:
    """Drives a unit and watches it. Make one a test, with `create`."""

    def __init__(self, dut: Any, unit: StreamUnit, parameters: Parameters) -> None:
        self.unit, self.parameters = unit, parameters
        self.clocking = Clocking(dut)
        self.log = dut._log
        self.given = Stream("operands", unit.inputs(parameters), BARE)
        self.got = Stream("results", unit.outputs(parameters), BARE)
        self._source = self.given.source(dut, "in", self.clocking)
        self._sink = self.got.sink(dut, "out", self.clocking)
        self._in = self.given.monitor(dut, "in", self.clocking)
        self._out = self.got.monitor(dut, "out", self.clocking)
        self._in.listeners.append(self._accepted)
        self.scoreboard = Scoreboard(self.got.fields, self.given.fields)
        self._out.listeners.append(self.scoreboard.receive)
        run = context.read()
        self.coverage: Collector | None = collector(run, coverage_of(unit)) if run.unit else None

    @classmethod
    async def create(cls, dut: Any, unit: StreamUnit, parameters: Parameters) -> "StreamBench":
        """A bench whose clock runs and whose unit has been reset."""
        bench = cls(dut, unit, parameters)
        await bench.reset()
        return bench

    def _accepted(self, transaction: Transaction) -> None:
        operands = self.given.operands([self.given.word(transaction)])
        expected = self.got.transactions(self.unit.model(self.parameters, operands))
        self.scoreboard.expect(expected[0], transaction)

    async def reset(self) -> None:
        """Resets the unit; all agents forget what was in flight and start again after it."""
        agents = (self._source, self._sink, self._in, self._out)
        if self.coverage is not None:
            busy = self.scoreboard.outstanding > 0
            self.coverage.tell("reset.busy" if busy else "reset.idle", clock_number())
        for agent in agents:
            agent.stop()
            agent.clear()
        await self.clocking.reset()
        self._in.clock = self._out.clock = 0
        self.scoreboard.clear()
        for agent in agents:
            agent.start()

    def send(self, operands: Operands, idles: Sequence[int] = (), stalls: Sequence[int] = ()) -> int:
        """Queues operands; the number of clocks within which all results must have come."""
        self._source.idle(idles)
        self._sink.stall(stalls)
        self._source.send_words(self.given.words(operands))
        latency, rate = self.unit.latency(self.parameters), self.unit.rate(self.parameters)
        each = rate + max(idles, default=0) + max(stalls, default=0) + 2
        return count(operands) * each + latency + 16

    async def run(
        self, operands: Operands, idles: Sequence[int] = (), stalls: Sequence[int] = ()
    ) -> tuple[Transfers, Transfers]:
        """Sends operands, waits for the results, checks them; what went in and what came out."""
        limit, number = self.send(operands, idles, stalls), count(operands)
        for _ in range(limit):
            if len(self._out.transfers.taken) >= number:
                break
            await self.clocking.edge
        await self.clocking.cycles(4)
        return self.check(number)

    async def stuck(self, operands: Operands, clocks: int) -> None:
        """A sink that takes nothing for so long while operands wait, then all; then none comes for as long.

        Mismatch where anything moves while the sink is stuck, or a result is lost or one comes of nothing.
        """
        self._sink.stop()
        limit = self.send(operands)
        held = []
        for part in (clocks // 2, clocks - clocks // 2):
            await self.clocking.cycles(part)
            held.append((len(self._in.transfers.taken), len(self._out.transfers.taken)))
        if held[0] != held[1] or held[1][1]:
            raise Mismatch(f"operands and results taken while the sink is stuck: {held[0]}, later {held[1]}")
        self._sink.start()
        await self.clocking.cycles(limit + clocks)
        self.check(count(operands))

    def check(self, number: int) -> tuple[Transfers, Transfers]:
        """Raises Mismatch where any agent saw something wrong; else what was seen since the last call."""
        given, got = self._in.take(), self._out.take()
        if breaches := [*self._in.breaches, *self._out.breaches]:
            raise Mismatch("\n".join(breaches[:4]))
        self.scoreboard.check()
        if not len(given.taken) == len(got.taken) == number:
            raise Mismatch(f"{number} operands sent, {len(given.taken)} accepted, {len(got.taken)} results")
        latency = self.unit.latency(self.parameters)
        for accepted, offered in zip(given.taken, got.offered, strict=True):
            if offered - accepted != latency:
                raise Mismatch(f"latency {offered - accepted} clocks at clock {accepted}, promised {latency}")
        self._cover(given, got)
        return given, got

    def _cover(self, given: Transfers, got: Transfers) -> None:
        if self.coverage is None or not given.words:
            return
        operands, results = self.given.operands(given.words), self.got.operands(got.words)
        rate = self.unit.rate(self.parameters)
        accepted, taken = np.array(given.taken), np.array(got.taken)
        # The unit takes the next operand a rate after the one before, or when its result is taken.
        ready = np.maximum(accepted[:-1] + rate, taken[:-1])
        waits = {IDLE: np.concatenate([[-1], accepted[1:] - ready]), STALL: taken - np.array(got.offered)}
        self.coverage.add({**operands, **results, **waits}, clock_number())
