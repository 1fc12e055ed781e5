"""What closure plays on the store of rays: frames of each depth, full levels, stalls, resets."""

from itertools import product
from typing import Any

from numpy.random import Generator

from verif.coverage.subjects import Scenarios, of_block
from verif.env.context import Context
from verif.env.coverage.flow import LONG
from verif.units.ray_store.bench import Frame, Manners, StoreBench

_DEPTHS = (1, 2, 5)


def _some(generator: Generator, low: int, high: int) -> tuple[int, ...]:
    return tuple(generator.integers(low, high, 12).tolist())


async def frames(bench: StoreBench, generator: Generator, size: int) -> None:
    """Frames of few rays and of each depth and number of children, answered in any way, nobody stalls."""
    for depth, branches in product(_DEPTHS, range(3)):
        if depth <= bench.depths:
            manners = Manners(splits=_some(generator, 0, 6), delays=(1, 2, 4))
            await bench.frame(Frame(depth, branches, min(size, LONG)), manners)


async def full_levels(bench: StoreBench, _generator: Generator, _size: int) -> None:
    """Two children a ray: all that can go goes, unanswered, then all answers come to a taker that waits."""
    tracer = bench.begin(Frame(bench.depths, 2, bench.room // 2 + LONG), Manners(splits=(2,)))
    for _ in range(2 * bench.depths):
        while await bench.step(tracer, answer=False) or bench.store.waiting:
            pass
        while tracer.owes:
            await bench.step(tracer, take=False)
    await bench.restart()


async def stalls(bench: StoreBench, _generator: Generator, _size: int) -> None:
    """A taker that stalls, primary rays that come late, answers that come late."""
    lengths = (0, 0, 0, 1, 3, 2 * LONG)
    frame = Frame(min(bench.depths, 2), 1, 12)
    await bench.frame(frame, Manners(stalls=lengths))
    await bench.frame(frame, Manners(asks=lengths))
    await bench.frame(frame, Manners(delays=(2 * LONG,), splits=(0,)))


async def resets(bench: StoreBench, generator: Generator, size: int) -> None:
    """Reset at rest and at any moment of a frame, with a taker that stalls and one that does not."""
    await bench.restart()
    for _ in range(size):
        manners = Manners(splits=(2,), delays=(LONG,), stalls=(int(generator.integers(3)),))
        await bench.play(
            bench.begin(Frame(bench.depths, 2, LONG), manners), int(generator.integers(4 * LONG))
        )
        await bench.restart()


async def at_random(bench: StoreBench, generator: Generator, _size: int) -> None:
    """A frame of any depth; all wait now and then, any number of children comes."""
    frame = Frame(int(generator.integers(1, bench.depths + 1)), int(generator.integers(3)), 10)
    waits, delays, held = (_some(generator, *span) for span in ((0, 3), (1, 6), (0, 3)))
    await bench.frame(frame, Manners(waits, _some(generator, 0, 6), delays, (0,), held))


async def closure_subject(dut: Any, run: Context) -> Scenarios:
    """The store, ready to be played on."""
    bench = StoreBench(dut, run.parameters)
    await bench.restart()
    played = {"frames": frames, "full levels": full_levels, "stalls": stalls, "resets": resets}
    return of_block(bench, played, at_random)
