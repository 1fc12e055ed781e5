"""What closure plays: pictures of all kinds, clocks, and resets of either side."""

from typing import Any

from hypothesis import strategies as st
from numpy.random import Generator

from verif.coverage.subjects import Scenarios
from verif.env.context import Context
from verif.env.draws import examples
from verif.units.video.bench import VideoBench
from verif.video.clocks import PIXEL_PS, Ratio, ratios
from verif.video.pictures import Shot, shots
from verif.video.seen import CLOCKS, PICTURES, RESETS, known

_FEW = 4
_LONGEST = 200
"""Clocks before a reset, at most."""
_PLAIN = Ratio(PIXEL_PS // 2)


async def pictures(bench: VideoBench, generator: Generator, size: int) -> None:
    """Drawn pictures, whole and broken, of all sizes, and one of one pixel."""
    drawn = st.lists(shots(bench.store), min_size=2, max_size=6)
    for sent in examples(drawn, generator, min(size, _FEW)):
        await bench.restart(_PLAIN)
        await bench.sender.send([*sent, Shot(1, 1)])
        await bench.watch(len(sent))


async def clocks(bench: VideoBench, generator: Generator, size: int) -> None:
    """A picture at drawn ratios of the clocks."""
    for ratio in examples(ratios(), generator, min(size, _FEW)):
        await bench.restart(ratio)
        sent = [bench.full]
        await bench.sender.send(sent)
        await bench.watch(len(sent))


async def resets(bench: VideoBench, generator: Generator, _size: int) -> None:
    """Either side is reset in the middle of a stream, and with nothing there."""
    for before in (0, 0, 3, 3):
        await bench.restart(_PLAIN)
        await bench.clocks.pixel_reset() if before else await bench.clocks.core_reset(1)
        await bench.sender.send([bench.full] * before)
        await bench.clocks.core.cycles(int(generator.integers(1, _LONGEST)))
        bench.sender.stop()
        await bench.clocks.core_reset(2)
        bench.sender.drop()
        await bench.clocks.pixel_reset()


async def at_random(bench: VideoBench, generator: Generator, _size: int) -> None:
    """Whole pictures of uniform sizes, with the core's clock twice as fast."""
    store = bench.store
    sent = [
        Shot(int(width), int(height))
        for width, height in generator.integers(1, (store.width + 1, store.height + 1), (_FEW, 2))
    ]
    await bench.restart(_PLAIN)
    await bench.sender.send(sent)
    await bench.watch(len(sent))


async def closure_subject(dut: Any, _run: Context) -> Scenarios:
    """The bench, ready to be played on."""
    bench = VideoBench(dut)
    scenarios = {PICTURES: pictures, CLOCKS: clocks, RESETS: resets}
    return Scenarios(bench, known(bench.seen_bins), scenarios, at_random, largest=_FEW)
