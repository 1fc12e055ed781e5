"""What closure plays on the objects' set-up: frames of every kind of object, full ones, resets."""

from functools import partial
from itertools import product
from typing import Any

from numpy.random import Generator

from models.fixed import BOOK, COLOUR, RADIUS
from models.scene.types import BLACK, Material, Sphere, Triangle, Vec3
from verif.coverage.subjects import Scenario, Scenarios, of_block
from verif.env import resets
from verif.env.context import Context
from verif.env.coverage.flow import LONG
from verif.env.resets import Reference
from verif.units.object_setup.bench import ObjectSetupBench
from verif.units.object_setup.rows import Frame

_ONE: Vec3 = (COLOUR.one,) * 3
_MOST: Vec3 = (COLOUR.max,) * 3
_FLAT: tuple[Vec3, Vec3, Vec3] = ((0, 0, 0), (1, 2, 3), (2, 4, 6))
"""Corners on one line."""
_FACING: tuple[Vec3, Vec3, Vec3] = ((0, 0, 0), (9, 1, 0), (0, 8, 2))


def _material(ambient: Vec3 = BLACK, mirror: bool = False, glass: bool = False) -> Material:
    return Material(ambient, BLACK, BLACK, _ONE if mirror else BLACK, _ONE if glass else BLACK)


def _vector(generator: Generator, low: int, high: int) -> Vec3:
    x, y, z = generator.integers(low, high, 3, endpoint=True).tolist()
    return (x, y, z)


async def frames(bench: ObjectSetupBench, _generator: Generator, _size: int) -> None:
    """No objects, and one or two of each kind, dull or mirrors, opaque or glass; dark, lit, too bright."""
    await bench.run(Frame(_ONE, (), (), 1), 2 * LONG)
    for ambient, mirror, glass in product(
        (BLACK, _ONE, (700, 800, 900), _MOST), (True, False), (True, False)
    ):
        material = _material(ambient, mirror, glass)
        ball = Sphere(material, (1, 2, 3), 4)
        facing, flat = Triangle(material, _FACING), Triangle(material, _FLAT)
        light = _MOST if ambient is _MOST else _ONE
        for balls, triangles in (
            ((ball,), ()),
            ((), (flat,)),
            ((ball,), (facing,)),
            ((ball, ball), (flat, facing)),
        ):
            await bench.run(Frame(light, balls, triangles, 1 if mirror else 2 * LONG))


async def full_frames(bench: ObjectSetupBench, _generator: Generator, _size: int) -> None:
    """As many objects as the indices hold; every radius."""
    most = [min(most, 255) for most in bench.most]
    radii = range(1, RADIUS.max + 1)
    for first in range(0, len(radii), most[0]):
        balls = [Sphere(_material(_ONE), (radius, 0, 1), radius) for radius in radii[first:][: most[0]]]
        filled = (*balls, *balls[:1] * (most[0] - len(balls)))
        triangles = (Triangle(_material(), _FACING),) * (most[1] if first == 0 else 0)
        await bench.run(Frame(_ONE, filled, triangles, 2))


async def reset_states(register: Any, bench: ObjectSetupBench, _generator: Generator, _size: int) -> None:
    """Reset in each state of a set-up of a sphere and a triangle, and at rest."""
    frame = Frame(_ONE, (Sphere(_material(), (1, 2, 3), 5),), (Triangle(_material(), _FACING),), 3)

    async def start() -> None:
        await bench.start(frame)

    await bench.restart()
    await resets.in_each_state(Reference(start, bench.step, frame.clocks + 2, bench.restart), register)


async def at_random(bench: ObjectSetupBench, generator: Generator, _size: int) -> None:
    """Any objects, of uniform numbers; a normaliser of any latency."""

    def material() -> Material:
        ambient, diffuse, specular, reflection, transparency = (
            _vector(generator, 0, COLOUR.max) for _ in range(5)
        )
        index = int(generator.integers(16))
        return Material(ambient, diffuse, specular, reflection, transparency, index)

    def place() -> Vec3:
        return _vector(generator, BOOK.min, BOOK.max)

    spheres, triangles = (int(generator.integers(0, min(most, 4) + 1)) for most in bench.most)
    balls = tuple(
        Sphere(material(), place(), int(generator.integers(1, RADIUS.max + 1))) for _ in range(spheres)
    )
    flats = tuple(Triangle(material(), (place(), place(), place())) for _ in range(triangles))
    light = _vector(generator, 0, COLOUR.max)
    await bench.run(Frame(light, balls, flats, int(generator.integers(1, 60))))


async def closure_subject(dut: Any, _run: Context) -> Scenarios:
    """The set-up, ready to be played on."""
    bench = await ObjectSetupBench.create(dut)
    played: dict[str, Scenario] = {"frames": frames, "full frames": full_frames}
    return of_block(bench, {**played, "resets": partial(reset_states, dut.state_reg)}, at_random)
