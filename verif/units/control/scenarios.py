"""What closure plays on the control: drawn frames, resets at any moment, and frames without surprises."""

from typing import Any

from hypothesis import strategies as st
from numpy.random import Generator

from models.limits import Fault
from verif.coverage.subjects import Scenarios, of_block
from verif.env.context import Context
from verif.env.draws import examples
from verif.units.control.bench import ControlBench, Job, goings, job_lists

_LONGEST = 80
"""Clocks before a reset, at most: more than a frame takes."""


async def frames(bench: ControlBench, generator: Generator, size: int) -> None:
    """Drawn frames and clocks of `go`, faults among them."""
    for jobs, going in examples(st.tuples(job_lists(), goings()), generator, size):
        await bench.restart(jobs, going)
        await bench.run(jobs)


async def resets(bench: ControlBench, generator: Generator, size: int) -> None:
    """Resets in the middle of drawn frames."""
    for jobs in examples(job_lists(), generator, size):
        await bench.restart(jobs)
        for _ in range(int(generator.integers(_LONGEST))):
            await bench.step()
    await bench.restart(())


async def at_random(bench: ControlBench, generator: Generator, _size: int) -> None:
    """Good frames whose blocks take any number of clocks."""

    def clocks() -> int:
        return int(generator.integers(1, 40))

    jobs = [
        Job(clocks(), clocks(), Fault.NONE, clocks(), Fault.NONE, clocks(), clocks(), clocks())
        for _ in range(4)
    ]
    await bench.restart(jobs)
    await bench.run(jobs)


async def closure_subject(dut: Any, _run: Context) -> Scenarios:
    """The control, ready to be played on."""
    bench = await ControlBench.create(dut)
    return of_block(bench, {"frames": frames, "resets": resets}, at_random)
