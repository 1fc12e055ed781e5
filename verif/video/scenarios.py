"""What closure plays on the frame buffer and on the video block: pictures, clocks, resets of either side."""

from typing import Protocol

from hypothesis import strategies as st
from numpy.random import Generator

from models.video import Store
from verif.coverage.subjects import Scenarios
from verif.env.draws import examples
from verif.video.clocks import PIXEL_PS, Clocks, Ratio, ratios
from verif.video.pictures import Shot, shots
from verif.video.seen import CLOCKS, PICTURES, RESETS, Seen, known
from verif.video.sender import Sender

_FEW = 4
_LONGEST = 200
"""Clocks before a reset, at most."""
_PLAIN = Ratio(PIXEL_PS // 2)


class Screen(Protocol):
    """A bench with a stream on one side and a screen, or who plays one, on the other."""

    store: Store
    full: Shot
    clocks: Clocks
    sender: Sender

    async def restart(self, ratio: Ratio) -> None:
        """Both sides anew."""

    async def all_shown(self, pictures: int) -> None:
        """Waits until all that is queued, so many pictures, has been sent and shown; each must be right."""


async def pictures(bench: Screen, generator: Generator, size: int) -> None:
    """Drawn pictures, whole and broken, of all sizes, and one of one pixel."""
    drawn = st.lists(shots(bench.store), min_size=2, max_size=6)
    for sent in examples(drawn, generator, min(size, _FEW)):
        await _show(bench, _PLAIN, [*sent, Shot(1, 1)])


async def clocks(bench: Screen, generator: Generator, size: int) -> None:
    """A picture at drawn ratios of the clocks."""
    for ratio in examples(ratios(), generator, min(size, _FEW)):
        await _show(bench, ratio, [bench.full])


async def resets(bench: Screen, generator: Generator, _size: int) -> None:
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


async def at_random(bench: Screen, generator: Generator, _size: int) -> None:
    """Whole pictures of uniform sizes, with the core's clock twice as fast."""
    most = (bench.store.width + 1, bench.store.height + 1)
    sizes = generator.integers(1, most, (_FEW, 2)).tolist()
    await _show(bench, _PLAIN, [Shot(width, height) for width, height in sizes])


async def _show(bench: Screen, ratio: Ratio, sent: list[Shot]) -> None:
    await bench.restart(ratio)
    await bench.sender.send(sent)
    await bench.all_shown(len(sent))


def scenarios(bench: Screen, seen: Seen | None) -> Scenarios:
    """The bench, ready to be played on. Raises ValueError where its run samples no coverage."""
    played = {PICTURES: pictures, CLOCKS: clocks, RESETS: resets}
    return Scenarios(bench, known(seen), played, at_random, largest=_FEW)
