"""What closure plays on the scene memory: whole frames, and writes, swaps and reads in any mixture."""

from typing import Any

from numpy.random import Generator

from models.limits import Record
from verif.coverage.subjects import Scenarios, of_block
from verif.env.context import Context
from verif.env.draws import examples
from verif.units.scene_memory.bench import PORTS, Clock, MemoryBench, clocks

_FEW = 6
_RECORD_BYTES = 8


def _record(generator: Generator) -> int:
    return int.from_bytes(generator.bytes(_RECORD_BYTES), "big")


async def frames(bench: MemoryBench, generator: Generator, _size: int) -> None:
    """Each record written, a swap, and the first and last ones read."""
    first = dict.fromkeys(PORTS, 0)
    keys = [(Record.CAMERA, 0), (Record.TAIL, 0)]
    keys += [(kind, index) for kind, size in bench.capacity.items() for index in range(size)]
    for kind, index in keys:
        await bench.step(Clock(True, kind, index, _record(generator), False, first))
    await bench.step(Clock(False, 0, 0, 0, True, first))
    for reads in (first, {kind: size - 1 for kind, size in bench.capacity.items()}):
        await bench.step(Clock(False, 0, 0, 0, False, reads))


async def mixed(bench: MemoryBench, generator: Generator, size: int) -> None:
    """Drawn clocks, resets between them, and two swaps at once."""
    for drawn in examples(clocks(bench), generator, min(size, _FEW)):
        for inputs in drawn:
            await bench.step(inputs)
        await bench.restart()
    first = dict.fromkeys(PORTS, 0)
    for write in (False, True):
        await bench.step(Clock(write, Record.TAIL, 0, _record(generator), True, first))


async def at_random(bench: MemoryBench, generator: Generator, _size: int) -> None:
    """Records of uniform kinds and indices, now and then a swap."""
    for _ in range(16):
        kind = list(Record)[generator.integers(len(Record))]
        index = int(generator.integers(bench.capacity.get(kind, 1)))
        reads = {port: int(generator.integers(size)) for port, size in bench.capacity.items()}
        await bench.step(Clock(True, kind, index, _record(generator), False, reads))
    await bench.step(Clock(False, 0, 0, 0, True, dict.fromkeys(PORTS, 0)))


async def closure_subject(dut: Any, run: Context) -> Scenarios:
    """The memory, ready to be played on."""
    bench = MemoryBench(dut, run.parameters)
    await bench.restart()
    return of_block(bench, {"frames": frames, "mixed": mixed}, at_random)
