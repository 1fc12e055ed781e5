"""What closure plays on the ray generator: drawn pictures, lines of the largest size, resets."""

from typing import Any

from numpy.random import Generator

from models.scene.types import Vec3
from verif.coverage.subjects import Scenarios, of_block
from verif.env.context import Context
from verif.env.draws import examples
from verif.units.ray_generator.bench import LARGEST, Picture, RayBench, pictures

_FEW = 8
_GAPS = [0, 0, 2, 0, 1]


async def drawn(bench: RayBench, generator: Generator, size: int) -> None:
    """Pictures of all shapes, with gaps."""
    for picture in examples(pictures(), generator, min(size, _FEW)):
        await bench.picture(picture, [1, 2, 3], _GAPS)
    for width, height in ((1, 1), (1, 3), (3, 1), (3, 2)):
        await bench.picture(_uniform(generator, width, height), [4, 5], _GAPS)


async def signs(bench: RayBench, generator: Generator, _size: int) -> None:
    """Spans of all signs."""
    for sign in (-1, 1):
        picture = _uniform(generator, 2, 2)
        column, row = (_signed(span, sign) for span in (picture.column, picture.row))
        await bench.picture(Picture(2, 2, picture.d, column, row), [7], [0])


def _signed(span: Vec3, sign: int) -> Vec3:
    x, y, z = (sign * (abs(lane) + 1) for lane in span)
    return (x, y, z)


async def wide(bench: RayBench, generator: Generator, _size: int) -> None:
    """The largest width, and the largest height."""
    for width, height in ((LARGEST, 1), (1, LARGEST)):
        await bench.picture(_uniform(generator, width, height), [9], [0])


async def resets(bench: RayBench, generator: Generator, _size: int) -> None:
    """Resets in the middle of a picture, and behind one."""
    picture = _uniform(generator, 5, 5)
    await bench.start(picture)
    await bench.draw(picture, [1], [0], 7)
    await bench.restart()
    await bench.picture(picture, [1], [0])
    await bench.restart()


async def at_random(bench: RayBench, generator: Generator, _size: int) -> None:
    """Pictures of a few pixels, spans of uniform numbers, a slot in every clock."""
    width, height = (int(side) for side in generator.integers(1, 8, 2))
    await bench.picture(_uniform(generator, width, height), [0, 1, 2, 3], [0])


def _uniform(generator: Generator, width: int, height: int) -> Picture:
    def vector() -> Vec3:
        x, y, z = (int(lane) for lane in generator.integers(-1000, 1000, 3))
        return (x, y, z)

    return Picture(width, height, vector(), vector(), vector())


async def closure_subject(dut: Any, _run: Context) -> Scenarios:
    """The generator, ready to be played on."""
    bench = await RayBench.create(dut)
    return of_block(bench, {"pictures": drawn, "signs": signs, "wide": wide, "resets": resets}, at_random)
