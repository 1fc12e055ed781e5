"""What closure plays on the ray generator: pictures of every shape, the longest lines, waits, resets."""

from typing import Any

from numpy.random import Generator

from models.formats import Knobs, formats
from models.scene.types import Vec3
from verif.coverage.subjects import Scenarios, of_block
from verif.env.context import Context
from verif.env.coverage.flow import LONG
from verif.units.ray_generator.bench import LARGEST, Picture, RayBench

_UNIT = formats(Knobs()).unit.one
_SPAN = 1 << formats(Knobs()).span.frac_bits
_SLOTS = (0, 7, 255)


def _vector(generator: Generator, most: int) -> Vec3:
    x, y, z = generator.integers(-most, most, 3, endpoint=True).tolist()
    return (x, y, z)


def _picture(generator: Generator, width: int, height: int) -> Picture:
    """It stands anywhere."""
    vectors = (_vector(generator, _UNIT), _vector(generator, _SPAN), _vector(generator, _SPAN))
    return Picture(width, height, *vectors)


async def shapes(bench: RayBench, generator: Generator, _size: int) -> None:
    """One pixel, a line, a column, some lines, one behind the other, no slot waits."""
    for width, height in ((1, 1), (5, 1), (1, 5), (4, 3), (3, 4)):
        await bench.picture(_picture(generator, width, height), _SLOTS, (0,))


async def longest_lines(bench: RayBench, generator: Generator, _size: int) -> None:
    """As wide, and as high, as can be."""
    for width, height in ((LARGEST, 1), (1, LARGEST)):
        await bench.picture(_picture(generator, width, height), _SLOTS, (0,))


async def waits(bench: RayBench, generator: Generator, _size: int) -> None:
    """Slots that come late, and slots that wait for a picture."""
    await bench.picture(_picture(generator, 3, 4), _SLOTS, (0, 1, 3, 2 * LONG))
    for _ in range(2 * LONG):
        await bench.step(0)
    await bench.picture(_picture(generator, 2, 2), _SLOTS, (0,))


async def resets(bench: RayBench, generator: Generator, _size: int) -> None:
    """Reset behind each ray of a picture, in the next clock and one later, and at rest."""
    picture = _picture(generator, 3, 2)
    for number in range(picture.pixels + 1):
        for idle in range(2):
            await bench.start(picture)
            for slot in range(number):
                await bench.step(slot)
            for _ in range(idle):
                await bench.step(None)
            await bench.restart()


async def at_random(bench: RayBench, generator: Generator, _size: int) -> None:
    """A picture of any small size, slots that come late now and then."""
    width, height = generator.integers(1, 12, 2).tolist()
    slots, gaps = generator.integers(0, 256, 8).tolist(), generator.integers(0, 3, 8).tolist()
    await bench.picture(_picture(generator, width, height), slots, gaps)


async def closure_subject(dut: Any, _run: Context) -> Scenarios:
    """The generator, ready to be played on."""
    bench = await RayBench.create(dut)
    played = {"shapes": shapes, "longest lines": longest_lines, "waits": waits, "resets": resets}
    return of_block(bench, played, at_random)
