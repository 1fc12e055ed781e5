"""What closure plays on the scene memory: whole frames, anything at all in each clock, resets."""

from typing import Any

from numpy.random import Generator

from models.limits import Record
from verif.coverage.subjects import Scenarios, of_block
from verif.env.context import Context
from verif.env.draws import examples
from verif.units.scene_memory.bench import PORTS, Clock, MemoryBench, clocks

_RECORD_BITS = 475
_PORTION = 100
"""Clocks of an undirected portion."""


def _record(generator: Generator) -> int:
    return int.from_bytes(generator.bytes(_RECORD_BITS // 8), "big")


def _quiet(bench: MemoryBench, index: int, swap: bool = False) -> Clock:
    """Nothing is written; one record of each kind is read."""
    return Clock(False, 0, 0, 0, swap, {kind: index % size for kind, size in bench.capacity.items()})


async def _frame(bench: MemoryBench, generator: Generator) -> None:
    """Every record is written, then they swap, then each is read."""
    keys = [(kind, index) for kind in Record for index in range(bench.capacity.get(kind, 1))]
    for kind, index in keys:
        await bench.step(Clock(True, kind, index, _record(generator), False, dict.fromkeys(PORTS, 0)))
    await bench.step(_quiet(bench, 0, swap=True))
    for index in range(max(bench.capacity.values())):
        await bench.step(_quiet(bench, index))


async def frames(bench: MemoryBench, generator: Generator, _size: int) -> None:
    """Whole frames, one behind the other."""
    for _ in range(3):
        await _frame(bench, generator)


async def mixed(bench: MemoryBench, generator: Generator, size: int) -> None:
    """Anything in each clock: writes, reads, swaps, kinds that there are not."""
    for portion in examples(clocks(bench), generator, size):
        for inputs in portion:
            await bench.step(inputs)


async def resets(bench: MemoryBench, generator: Generator, _size: int) -> None:
    """Reset with either bank drawn."""
    await bench.restart()
    await _frame(bench, generator)
    await bench.restart()


async def at_random(bench: MemoryBench, generator: Generator, _size: int) -> None:
    """Uniform records, one written in every other clock, one read in each; a swap now and then."""
    kinds, writes = generator.integers(0, len(Record), _PORTION).tolist(), generator.random(_PORTION) < 0.5
    swaps = (generator.random(_PORTION) < 0.05).tolist()
    for kind, write, swap in zip(kinds, writes.tolist(), swaps, strict=True):
        sizes = bench.capacity
        reads = {kept: int(generator.integers(size)) for kept, size in sizes.items()}
        index = int(generator.integers(sizes.get(Record(kind), 1)))
        await bench.step(Clock(write, kind, index, _record(generator), swap, reads))


async def closure_subject(dut: Any, run: Context) -> Scenarios:
    """The memory, ready to be played on."""
    bench = MemoryBench(dut, run.parameters)
    await bench.restart()
    return of_block(bench, {"frames": frames, "mixed": mixed, "resets": resets}, at_random)
