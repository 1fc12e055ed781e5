"""Valid/ready streams: one definition gives the bus, the transaction, source, sink and monitor.

    RADICANDS = Stream("radicands", (Field("radicand", 40, signed=False),))
    source = RADICANDS.source(dut, "in", clocking)

A source offers what is queued, a sink takes it, a monitor watches and holds both sides to the
protocol. How long a source idles and a sink stalls is drawn by the test and given to them as a
list, so that it shrinks and repeats. This module is the only one that touches cocotb-bus.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections import deque
from collections.abc import Callable, Coroutine, Iterable, Sequence
from dataclasses import dataclass, make_dataclass
from functools import cached_property
from itertools import cycle, repeat
from typing import Any

import cocotb
from cocotb.task import Task
from cocotb.triggers import Event, RisingEdge
from cocotb_bus.bus import Bus

from verif.env import unknowns
from verif.env.clocking import Clocking
from verif.env.fields import Field, Operands, count, join, split

Transaction = Any
"""An instance of a stream's own frozen dataclass: an int a field, a tuple of ints where it has lanes."""


@dataclass(frozen=True)
class Naming:
    """What a stream's signals are called; ``{prefix}`` and ``{field}`` are filled in."""

    valid: str = "{prefix}_valid"
    ready: str = "{prefix}_ready"
    field: str = "{prefix}_{field}"


PREFIXED = Naming()
"""in_valid, in_ready, in_data."""
BARE = Naming(field="{field}")
"""in_valid, in_ready, data: the units' ports, where only the handshake has the prefix."""
AXI4_STREAM = Naming("{prefix}_tvalid", "{prefix}_tready", "{prefix}_t{field}")
"""s_axis_frame_tvalid, s_axis_frame_tready, s_axis_frame_tdata."""


@dataclass(frozen=True)
class Stream:
    """What flows, and what its signals are called. name: of the transaction's class."""

    name: str
    fields: tuple[Field, ...]
    naming: Naming = PREFIXED

    @cached_property
    def transaction(self) -> type[Transaction]:
        """Frozen dataclass of one transaction: equality is the comparison."""
        members = [(field.name, int if field.lanes == 1 else tuple[int, ...]) for field in self.fields]
        return make_dataclass(self.name.title().replace("_", ""), members, frozen=True)

    def bus(self, dut: Any, prefix: str) -> Any:
        """The signals as attributes ``valid``, ``ready`` and ``field_<name>``."""
        naming = self.naming
        signals = {"valid": naming.valid.format(prefix=prefix), "ready": naming.ready.format(prefix=prefix)}
        for field in self.fields:
            signals[f"field_{field.name}"] = naming.field.format(prefix=prefix, field=field.name)
        return Bus(dut, None, signals, case_insensitive=False)

    def source(self, dut: Any, prefix: str, clocking: Clocking) -> StreamSource:
        """Drives valid and the fields."""
        return StreamSource(self, self.bus(dut, prefix), clocking)

    def sink(self, dut: Any, prefix: str, clocking: Clocking) -> StreamSink:
        """Drives ready."""
        return StreamSink(self, self.bus(dut, prefix), clocking)

    def monitor(self, dut: Any, prefix: str, clocking: Clocking) -> StreamMonitor:
        """Drives nothing."""
        return StreamMonitor(self, self.bus(dut, prefix), clocking)

    def words(self, operands: Operands) -> list[tuple[int, ...]]:
        """Port values of operands, a tuple each, in the order of the fields."""
        return list(zip(*(join((field,), _only(field, operands)) for field in self.fields), strict=True))

    def operands(self, words: Sequence[tuple[int, ...]]) -> Operands:
        """The operands that `words` made port values of."""
        columns = list(zip(*words, strict=True)) or [()] * len(self.fields)
        found: dict[str, Any] = {}
        for field, column in zip(self.fields, columns, strict=True):
            found.update(split((field,), column))
        return found

    def transactions(self, operands: Operands) -> list[Transaction]:
        """One transaction an operand."""
        number = count(operands)
        columns = [_column(field, operands, number) for field in self.fields]
        return [self.transaction(*row) for row in zip(*columns, strict=True)]

    def word(self, transaction: Transaction) -> tuple[int, ...]:
        """Port values of one transaction, in the order of the fields."""
        return tuple(_packed(field, getattr(transaction, field.name)) for field in self.fields)

    def unpack(self, word: tuple[int, ...]) -> Transaction:
        """The transaction that `word` made port values of."""
        return self.transaction(*map(_unpacked, self.fields, word))


def _only(field: Field, operands: Operands) -> Operands:
    return {field.name: operands[field.name]}


def _column(field: Field, operands: Operands, number: int) -> list[Any]:
    values = operands[field.name]
    if field.lanes == 1:
        return [int(value) for value in values]
    return [tuple(int(lane[index]) for lane in values) for index in range(number)]


def _packed(field: Field, value: int | tuple[int, ...]) -> int:
    mask, word = (1 << field.width) - 1, 0
    for lane in (value,) if isinstance(value, int) else value:
        word = word << field.width | lane & mask
    return word


def _unpacked(field: Field, word: int) -> int | tuple[int, ...]:
    mask = (1 << field.width) - 1
    lanes = [word >> field.width * lane & mask for lane in reversed(range(field.lanes))]
    numbers = tuple(lane - (1 << field.width) if lane > field.high else lane for lane in lanes)
    return numbers if field.lanes > 1 else numbers[0]


class _Agent(ABC):
    """Something that runs beside the test: `start`, `stop`, and `clear` when the design is reset."""

    def __init__(self, stream: Stream, bus: Any, clocking: Clocking) -> None:
        self.stream = stream
        self._bus = bus
        self._clocking = clocking
        self._task: Task[None] | None = None

    def start(self) -> None:
        """Begins to work; does nothing where it already does."""
        if self._task is None:
            self._task = cocotb.start_soon(self._run())

    def stop(self) -> None:
        """Ceases to work, with its outputs low."""
        if self._task is not None:
            self._task.cancel()
            self._task = None
        self._release()

    def clear(self) -> None:
        """Forgets all that was under way, and goes on working if it was."""
        working = self._task is not None
        self.stop()
        self._forget()
        if working:
            self.start()

    @abstractmethod
    def _run(self) -> Coroutine[Any, Any, None]:
        """What it does, clock by clock, until it is stopped."""

    @abstractmethod
    def _release(self) -> None:
        """Lowers what it drives."""

    @abstractmethod
    def _forget(self) -> None:
        """Empties what it holds."""


def _pattern(waits: Sequence[int]) -> Iterable[int]:
    return cycle(waits) if waits else repeat(0)


class StreamSource(_Agent):
    """Offers queued transactions in order. Between them the fields are unknown, see `verif.env.unknowns`."""

    def __init__(self, stream: Stream, bus: Any, clocking: Clocking) -> None:
        super().__init__(stream, bus, clocking)
        self._ports = [getattr(bus, f"field_{field.name}") for field in stream.fields]
        self._queue: deque[tuple[int, ...]] = deque()
        self._filled = Event()
        self._idles = iter(_pattern(()))
        self._last = tuple(0 for _ in stream.fields)
        self._release()

    def idle(self, clocks: Sequence[int]) -> None:
        """Clocks without an offer before each transaction from now on, over and over; none if empty."""
        self._idles = iter(_pattern(clocks))

    def send(self, transactions: Iterable[Transaction]) -> None:
        """Queues transactions."""
        self.send_words(map(self.stream.word, transactions))

    def send_words(self, words: Iterable[tuple[int, ...]]) -> None:
        """Queues port values, see `Stream.words`."""
        self._queue.extend(words)
        self._filled.set()

    def _release(self) -> None:
        self._bus.valid.value = 0
        for port, field, value in zip(self._ports, self.stream.fields, self._last, strict=True):
            port.value = unknowns.instead(value, field.bits)

    def _forget(self) -> None:
        self._queue.clear()

    async def _run(self) -> None:
        edge, valid, ready = self._clocking.edge, self._bus.valid, self._bus.ready
        while True:
            while not self._queue:
                self._filled.clear()
                await self._filled.wait()
            idle = next(self._idles)
            await self._clocking.cycles(idle)
            self._last = self._queue.popleft()
            for port, value in zip(self._ports, self._last, strict=True):
                port.value = value
            valid.value = 1
            await edge
            while not _high(ready):
                await edge
            self._release()


def _high(signal: Any) -> bool:
    """Whether a signal is 1; an unknown one is not (the monitor reports it)."""
    return str(signal.value) == "1"


class StreamSink(_Agent):
    """Takes what is offered: ready is low for a number of clocks, then high until a transfer."""

    def __init__(self, stream: Stream, bus: Any, clocking: Clocking) -> None:
        super().__init__(stream, bus, clocking)
        self._offered = RisingEdge(bus.valid)
        self._stalls: Sequence[int] = ()
        self._release()

    def stall(self, clocks: Sequence[int]) -> None:
        """Clocks without ready before each transfer from now on, over and over; none if empty."""
        self._stalls = tuple(clocks)
        self.clear()

    def _release(self) -> None:
        self._bus.ready.value = 0

    def _forget(self) -> None:
        """Nothing: a sink holds no transactions."""

    async def _run(self) -> None:
        edge, valid, ready = self._clocking.edge, self._bus.valid, self._bus.ready
        if not any(self._stalls):
            ready.value = 1
            return
        for stall in _pattern(self._stalls):
            if stall:
                ready.value = 0
                await self._clocking.cycles(stall)
            ready.value = 1
            await edge
            while not _high(valid):
                await self._offered
                await edge


@dataclass
class Transfers:
    """What a monitor saw: port values, the clock of the first offer of each, and that of its transfer."""

    words: list[tuple[int, ...]]
    offered: list[int]
    taken: list[int]

    @classmethod
    def none(cls) -> Transfers:
        """Nothing yet."""
        return cls([], [], [])


class StreamMonitor(_Agent):
    """Notes every transfer and every breach of the protocol.

    Valid must not fall, nor a field change, before ready; valid, ready and what is offered must be
    known. It looks at every clock, since a signal that turns unknown raises no edge. Breaches
    are collected, not raised: the test that reads them can shrink. ``listeners`` get each transaction.
    """

    def __init__(self, stream: Stream, bus: Any, clocking: Clocking) -> None:
        super().__init__(stream, bus, clocking)
        self._ports = [getattr(bus, f"field_{field.name}") for field in stream.fields]
        self.listeners: list[Callable[[Transaction], None]] = []
        self.breaches: list[str] = []
        self.transfers = Transfers.none()
        self.clock = 0

    def _release(self) -> None:
        """Nothing: a monitor drives no signal."""

    def _forget(self) -> None:
        self.breaches.clear()
        self.transfers = Transfers.none()

    def take(self) -> Transfers:
        """What was seen since the last call."""
        seen, self.transfers = self.transfers, Transfers.none()
        return seen

    async def _run(self) -> None:
        edge, valid, ready = self._clocking.edge, self._bus.valid, self._bus.ready
        pending: tuple[int, ...] | None = None
        offered = 0
        while True:
            await edge
            self.clock += 1
            handshake = str(valid.value) + str(ready.value)
            if handshake not in ("00", "01", "10", "11"):
                self._breach(f"valid, ready = {handshake[0]}, {handshake[1]}")
                pending = None
            elif handshake[0] == "0":
                if pending is not None:
                    self._breach("valid fell before ready")
                pending = None
            else:
                word = self._sample()
                if pending is None:
                    offered = self.clock
                elif word is not None and word != pending:
                    self._breach(f"{pending} became {word} before ready")
                pending = word
                if word is not None and handshake[1] == "1":
                    self._transfer(word, offered)
                    pending = None

    def _sample(self) -> tuple[int, ...] | None:
        values = [port.value for port in self._ports]
        try:
            return tuple(map(int, values))
        except ValueError:
            self._breach(f"unknown bits are offered: {', '.join(map(str, values))}")
            return None

    def _breach(self, what: str) -> None:
        self.breaches.append(f"{self.stream.name}, clock {self.clock}: {what}")

    def _transfer(self, word: tuple[int, ...], offered: int) -> None:
        self.transfers.words.append(word)
        self.transfers.offered.append(offered)
        self.transfers.taken.append(self.clock)
        if self.listeners:
            transaction = self.stream.unpack(word)
            for listener in self.listeners:
                listener(transaction)
