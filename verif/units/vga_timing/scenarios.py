"""What closure plays on the timing: whole frames, and resets at any clock of one."""

from typing import Any

from numpy.random import Generator

from verif.coverage.subjects import Scenarios, of_block
from verif.env.context import Context
from verif.units.vga_timing.bench import TimingBench
from verif.video.modes import mode_of

_RESETS = 16


async def frames(bench: TimingBench, _generator: Generator, _size: int) -> None:
    """A frame and a half, each clock the mode's."""
    await bench.reset()
    await bench.compare(3 * bench.mode.clocks // 2)


async def resets(bench: TimingBench, generator: Generator, _size: int) -> None:
    """Resets at clocks drawn from a whole frame."""
    for clock in generator.integers(1, bench.mode.clocks, _RESETS):
        await bench.reset()
        await bench.clocks(int(clock))
    await bench.reset()
    await bench.compare(1)


async def at_random(bench: TimingBench, generator: Generator, _size: int) -> None:
    """Some clocks: the timing has no other input."""
    await bench.clocks(int(generator.integers(1, bench.mode.clocks)))


async def closure_subject(dut: Any, run: Context) -> Scenarios:
    """The timing, ready to be played on."""
    bench = TimingBench(dut, mode_of(run.parameters))
    await bench.reset()
    return of_block(bench, {"frames": frames, "resets": resets}, at_random)
