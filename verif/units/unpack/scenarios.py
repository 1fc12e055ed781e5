"""What closure plays on the unpacker: frames of fields of all widths, both sides that wait, resets."""

from typing import Any

from numpy.random import Generator

from verif.coverage.subjects import Scenarios, of_block
from verif.env.context import Context
from verif.env.coverage.flow import LONG
from verif.units.unpack.bench import Clock, UnpackBench

_WORDS = 12
"""Of a frame at most."""
_WORD = 32


def _frame(generator: Generator, words: int) -> list[int]:
    return [int(word) for word in generator.integers(0, 1 << _WORD, words)]


async def frames(bench: UnpackBench, generator: Generator, size: int) -> None:
    """Fields as fast as words come: of one bit, of the most, of any; the last one just fits, or just not."""
    for _ in range(max(4, size // 4)):
        words = int(generator.integers(1, _WORDS))
        bench.begin(_frame(generator, words))
        widths = generator.choice([1, bench.field_w, 0], 40 * words).tolist()
        left = _WORD * int(generator.integers(1, words + 1)) + int(generator.integers(-1, 2))
        for width in widths:
            wanted = width or int(generator.integers(1, bench.field_w + 1))
            if left <= 0:
                break
            await bench.step(Clock(min(wanted, left), take=True, offer=True))
            left -= wanted
        await bench.step(Clock(bench.field_w, take=False, offer=True))
        await bench.finish()
        if generator.random() < 0.5:
            await bench.step(Clock(1, take=False, offer=False))
    await _aligned(bench, generator)


async def _aligned(bench: UnpackBench, generator: Generator) -> None:
    """A frame of two words read to a word less one bit, to a word, and to its end."""
    for bits in (_WORD, _WORD + 1, 2 * _WORD):
        bench.begin(_frame(generator, 2))
        for _ in range(2):
            await bench.step(Clock(1, take=False, offer=True))
        for _ in range(bits):
            await bench.step(Clock(1, take=True, offer=True))
        await bench.step(Clock(1, take=False, offer=True))
        await bench.finish()


async def waits(bench: UnpackBench, generator: Generator, _size: int) -> None:
    """A reader that waits for words, words that wait for the reader."""
    bench.begin(_frame(generator, 6))
    for offer, take, clocks in ((0, 1, 2 * LONG), (1, 0, 2 * LONG), (1, 1, 4), (0, 1, 2 * LONG), (1, 1, 4)):
        for _ in range(clocks):
            await bench.step(Clock(bench.field_w, bool(take), bool(offer)))
    await bench.finish()


async def resets(bench: UnpackBench, generator: Generator, _size: int) -> None:
    """Reset with no bit, some, and behind the last word."""
    for words, clocks in ((3, 0), (3, 2), (1, 3)):
        bench.begin(_frame(generator, words))
        for _ in range(clocks):
            await bench.step(Clock(1, take=False, offer=True))
        await bench.restart()


async def at_random(bench: UnpackBench, generator: Generator, _size: int) -> None:
    """A frame of any words, fields of any width, both sides that wait in every other clock."""
    bench.begin(_frame(generator, _WORDS))
    takes, offers = (generator.random((2, 2 * _WORDS)) < 0.5).tolist()
    widths = generator.integers(1, bench.field_w + 1, 2 * _WORDS).tolist()
    for width, take, offer in zip(widths, takes, offers, strict=True):
        await bench.step(Clock(width, take, offer))
    await bench.finish()


async def closure_subject(dut: Any, run: Context) -> Scenarios:
    """The unpacker, ready to be played on."""
    bench = UnpackBench(dut, run.parameters)
    await bench.restart()
    return of_block(bench, {"frames": frames, "waits": waits, "resets": resets}, at_random)
