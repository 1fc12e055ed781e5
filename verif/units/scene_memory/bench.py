"""Tests of the scene memory against two banks of plain dictionaries, at every clock."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import cocotb
from hypothesis import strategies as st

from models.formats import Knobs, formats
from models.limits import RECORD_SLOTS, SPHERE_SLOTS, Record
from verif.env import context
from verif.env.block import Block, holds, same

_SLOT_W = formats(Knobs()).coord.width
_RECORD_W = RECORD_SLOTS * _SLOT_W
_SLOTS = {
    Record.CAMERA: 9,
    Record.LIGHT: 6,
    Record.SPHERE: SPHERE_SLOTS,
    Record.TRIANGLE: RECORD_SLOTS,
    Record.TAIL: 6,
}
PORTS = {Record.LIGHT: "light", Record.SPHERE: "sphere", Record.TRIANGLE: "triangle"}
"""Records of which a frame has many, and the port that reads one of them."""
_KINDS = 8
_INDICES = 256

Key = tuple[Record, int]


@dataclass(frozen=True)
class Clock:
    """Inputs of one clock. Written is a record or, with `write` low, something to be ignored; read is one
    record of each kind, by its index."""

    write: bool
    kind: int
    index: int
    record: int
    swap: bool
    reads: Mapping[Record, int]


class Banks:
    """What the memory must hold; what was never written is unknown, None."""

    def __init__(self) -> None:
        self._banks: tuple[dict[Key, int], dict[Key, int]] = ({}, {})
        self._drawn = 0

    def reset(self) -> None:
        """The bank that is drawn is the first again; what they hold stays."""
        self._drawn = 0

    def drawn(self, kind: Record, index: int = 0) -> int | None:
        """A record of the frame that is drawn."""
        return self._banks[self._drawn].get((kind, index))

    def clock(self, inputs: Clock) -> None:
        """The end of a clock: a write goes to the other bank, then they may swap."""
        if inputs.write and inputs.kind in _SLOTS:
            kind = Record(inputs.kind)
            index = inputs.index if kind in PORTS else 0
            value = inputs.record & ((1 << _SLOTS[kind] * _SLOT_W) - 1)
            self._banks[1 - self._drawn][kind, index] = value
        if inputs.swap:
            self._drawn = 1 - self._drawn


class MemoryBench(Block):
    """Drives a clock and compares all outputs with the banks."""

    def __init__(self, dut: Any, parameters: Mapping[str, int]) -> None:
        super().__init__(
            dut,
            idle=("write_valid", "swap"),
            carried={"write_valid": ("write_kind", "write_index", "write_record")},
        )
        self.capacity = {kind: parameters[f"{kind.name}S"] for kind in PORTS}
        self._banks = Banks()
        self._read: dict[Record, int | None] = {}

    async def restart(self) -> None:
        """Reset in the middle of anything."""
        await self.reset()
        self._banks.reset()
        self._read = {}

    def _compare(self, name: str, expected: int | None) -> None:
        if expected is not None:
            same(f"{name} at clock {self.now}", hex(expected), hex(self.read(name)))

    async def step(self, inputs: Clock) -> None:
        """One clock: the frame drawn is what it was, the records read are those of the clock before."""
        await self.clock(
            write_valid=int(inputs.write),
            write_kind=inputs.kind,
            write_index=inputs.index,
            write_record=inputs.record,
            swap=int(inputs.swap),
            **{f"{port}_index": inputs.reads[kind] for kind, port in PORTS.items()},
        )
        self._compare("camera", self._banks.drawn(Record.CAMERA))
        self._compare("tail", self._banks.drawn(Record.TAIL))
        for kind, port in PORTS.items():
            self._compare(port, self._read.get(kind))
        self._read = {kind: self._banks.drawn(kind, index) for kind, index in inputs.reads.items()}
        self._banks.clock(inputs)


def clocks(bench: MemoryBench) -> st.SearchStrategy[list[Clock]]:
    """One to forty clocks of any inputs."""
    index = st.integers(0, _INDICES - 1)

    def within(kind: int, number: int) -> int:
        """A frame that is read has no record beyond the capacity."""
        return number % bench.capacity.get(Record(kind), _INDICES) if kind in _SLOTS else number

    def build(write: bool, kind: int, number: int, record: int, swap: int, reads: tuple[int, ...]) -> Clock:
        indices = {kind: within(kind, read) for kind, read in zip(PORTS, reads, strict=True)}
        return Clock(write, kind, within(kind, number), record, swap == 3, indices)

    clock = st.builds(
        build,
        st.booleans(),
        st.sampled_from([int(kind) for kind in _SLOTS]) | st.integers(0, _KINDS - 1),
        index,
        st.integers(0, (1 << _RECORD_W) - 1),
        st.integers(0, 3),
        st.tuples(index, index, index),
    )
    return st.integers(1, 40).flatmap(lambda size: st.lists(clock, min_size=size, max_size=size))


@cocotb.test()
async def writes_never_touch_the_frame_that_is_drawn(dut: Any) -> None:
    """Drawn writes, swaps and reads in any mixture, also in the same clock; resets between them."""
    run = context.read()
    bench = MemoryBench(dut, run.parameters)
    await bench.restart()

    async def example(before: list[Clock], after: list[Clock]) -> None:
        await bench.restart()
        for inputs in (*before, *before):
            await bench.step(inputs)
        await bench.restart()
        for inputs in after:
            await bench.step(inputs)

    await holds(run, example, clocks(bench), clocks(bench))


@cocotb.test()
async def every_record_of_a_frame_comes_back_after_the_swap(dut: Any) -> None:
    """Each kind and index once, in any order, and records of no kind; then a swap, then each one read; the
    other bank in the same way. Every second time a bank gets all bits the other way round."""
    run = context.read()
    bench = MemoryBench(dut, run.parameters)
    await bench.restart()
    keys = [(Record.CAMERA, 0), (Record.TAIL, 0)]
    keys += [(kind, index) for kind, size in bench.capacity.items() for index in range(size)]
    strange = [(kind, 0) for kind in range(_KINDS) if kind not in _SLOTS]
    generator = run.generator(0)
    first = dict.fromkeys(PORTS, 0)
    ones = (1 << _RECORD_W) - 1
    turned: dict[tuple[int, int, int], int] = {}
    for turn in range(20):
        for kind, index in generator.permutation([*keys, *strange]).tolist():
            record = turned.pop((turn % 2, kind, index), None)
            if record is None:
                record = int.from_bytes(generator.bytes(-(-_RECORD_W // 8))) & ones
                turned[turn % 2, kind, index] = record ^ ones
            await bench.step(Clock(True, kind, index, record, False, first))
        await bench.step(Clock(False, 0, 0, 0, True, first))
        for index in range(max(bench.capacity.values())):
            reads = {kind: index % size for kind, size in bench.capacity.items()}
            await bench.step(Clock(False, 0, 0, 0, False, reads))
        await bench.step(Clock(False, 0, 0, 0, False, first))
