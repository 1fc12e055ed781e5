"""What closure plays on the trace unit: frames of all sizes, consumers that stop, resets."""

from typing import Any

from numpy.random import Generator

from verif.coverage.subjects import Scenarios, of_block
from verif.env.context import Context
from verif.units.trace_unit.driver import Manners, TraceBench
from verif.units.trace_unit.frames import Frame

_RAYS = 24
_STOPPED = (False,) * 40
_MOMENTS = 6


def _frame(bench: TraceBench, generator: Generator, spheres: int, triangles: int, rays: int = _RAYS) -> Frame:
    kinds = (generator.random(rays) < 0.5).tolist()
    return Frame(spheres, triangles, kinds, int(generator.integers(1 << 32)))


async def frames(bench: TraceBench, generator: Generator, _size: int) -> None:
    """Tables of no object, one, some, and as many as fit, rays back to back."""
    most = bench.parameters["OBJECTS"]
    for spheres, triangles in ((0, 0), (1, 0), (0, 1), (1, 1), (most - most // 2, most // 2)):
        await bench.frame(*_frame(bench, generator, spheres, triangles).make(bench.parameters))


async def stalls(bench: TraceBench, generator: Generator, _size: int) -> None:
    """Results of one kind are not taken for long, by turns."""
    rays = 2 * bench.parameters["ROOM"] + _RAYS
    for hits, terms in ((_STOPPED, (True,)), ((True,), _STOPPED)):
        frame = _frame(bench, generator, 1, 0, rays)
        await bench.frame(*frame.make(bench.parameters), Manners(hits=hits, terms=terms))


async def resets(bench: TraceBench, generator: Generator, _size: int) -> None:
    """Resets while rays are tested and results wait."""
    for _ in range(_MOMENTS):
        table, jobs = _frame(bench, generator, 1, 1).make(bench.parameters)
        await bench.load(table)
        await bench.play(jobs, Manners(hits=_STOPPED, terms=_STOPPED), int(generator.integers(20, 200)))
        await bench.restart()


async def at_random(bench: TraceBench, generator: Generator, _size: int) -> None:
    """A table of a uniform number of objects, rays with uniform gaps, results taken at once."""
    most = bench.parameters["OBJECTS"]
    spheres = int(generator.integers(most + 1))
    frame = _frame(bench, generator, spheres, int(generator.integers(most - spheres + 1)))
    await bench.frame(*frame.make(bench.parameters), Manners(generator.integers(0, 9, 8).tolist()))


async def closure_subject(dut: Any, run: Context) -> Scenarios:
    """The unit, ready to be played on."""
    bench = TraceBench(dut, run.parameters)
    await bench.restart()
    return of_block(bench, {"frames": frames, "stalls": stalls, "resets": resets}, at_random)
