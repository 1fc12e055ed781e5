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
_SLOTS = {Record.CAMERA: 9, Record.LIGHT: 6, Record.SPHERE: SPHERE_SLOTS, Record.TAIL: 6}
_KINDS = 8

Key = tuple[Record, int]


@dataclass(frozen=True)
class Clock:
    """Inputs of one clock. Written is a record or, with `write` low, something to be ignored."""

    write: bool
    kind: int
    index: int
    record: int
    swap: bool
    light: int
    sphere: int


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
            index = inputs.index if kind in (Record.LIGHT, Record.SPHERE) else 0
            value = inputs.record & ((1 << _SLOTS[kind] * _SLOT_W) - 1)
            self._banks[1 - self._drawn][kind, index] = value
        if inputs.swap:
            self._drawn = 1 - self._drawn


class MemoryBench(Block):
    """Drives a clock and compares all four outputs with the banks."""

    def __init__(self, dut: Any, parameters: Mapping[str, int]) -> None:
        super().__init__(dut, idle=("write_valid", "swap"))
        self.lights, self.spheres = parameters["LIGHTS"], parameters["SPHERES"]
        self._banks = Banks()
        self._light: int | None = None
        self._sphere: int | None = None

    async def restart(self) -> None:
        """Reset in the middle of anything."""
        await self.reset()
        self._banks.reset()
        self._light = self._sphere = None

    def _compare(self, name: str, expected: int | None) -> None:
        if expected is not None:
            same(f"{name} at clock {self.now}", hex(expected), hex(self.read(name)))

    async def step(self, inputs: Clock) -> None:
        """One clock: the frame drawn is what it was, light and sphere are those of the clock before."""
        await self.clock(
            write_valid=int(inputs.write),
            write_kind=inputs.kind,
            write_index=inputs.index,
            write_record=inputs.record,
            swap=int(inputs.swap),
            light_index=inputs.light,
            sphere_index=inputs.sphere,
        )
        self._compare("camera", self._banks.drawn(Record.CAMERA))
        self._compare("tail", self._banks.drawn(Record.TAIL))
        self._compare("light", self._light)
        self._compare("sphere", self._sphere)
        self._light = self._banks.drawn(Record.LIGHT, inputs.light)
        self._sphere = self._banks.drawn(Record.SPHERE, inputs.sphere)
        self._banks.clock(inputs)


def _clocks(bench: MemoryBench) -> st.SearchStrategy[list[Clock]]:
    kind = st.sampled_from([int(kind) for kind in _SLOTS]) | st.integers(0, _KINDS - 1)
    most = min(bench.lights, bench.spheres)
    clock = st.builds(
        Clock,
        write=st.booleans(),
        kind=kind,
        index=st.integers(0, most - 1),
        record=st.integers(0, (1 << RECORD_SLOTS * _SLOT_W) - 1),
        swap=st.integers(0, 3).map(lambda drawn: drawn == 3),
        light=st.integers(0, bench.lights - 1),
        sphere=st.integers(0, bench.spheres - 1),
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

    await holds(run, example, _clocks(bench), _clocks(bench))


@cocotb.test()
async def every_record_of_a_frame_comes_back_after_the_swap(dut: Any) -> None:
    """Each kind and index once, then a swap, then each one read; the other bank in the same way."""
    run = context.read()
    bench = MemoryBench(dut, run.parameters)
    await bench.restart()
    keys = [(Record.CAMERA, 0), (Record.TAIL, 0)]
    keys += [(Record.LIGHT, index) for index in range(bench.lights)]
    keys += [(Record.SPHERE, index) for index in range(bench.spheres)]
    generator = run.generator(0)
    quiet = Clock(False, 0, 0, 0, False, 0, 0)
    for _ in range(20):
        for kind, index in keys:
            record = int.from_bytes(generator.bytes(RECORD_SLOTS * _SLOT_W // 8), "big")
            await bench.step(Clock(True, kind, index, record, False, 0, 0))
        await bench.step(Clock(False, 0, 0, 0, True, 0, 0))
        for index in range(max(bench.lights, bench.spheres)):
            light, sphere = index % bench.lights, index % bench.spheres
            await bench.step(Clock(False, 0, 0, 0, False, light, sphere))
        await bench.step(quiet)
