"""What closure plays on the camera: any views, sizes and tangents at their limits, faults, resets."""

from functools import partial
from typing import Any

from numpy.random import Generator

from models.core.camera import Registers
from models.formats import Knobs, formats
from models.scene.types import Camera, Vec3
from verif.coverage.subjects import Scenario, Scenarios, of_block
from verif.env import resets
from verif.env.context import Context
from verif.env.coverage.flow import LONG
from verif.env.resets import Reference
from verif.units.camera.bench import CLOCKS, LARGEST, CameraBench

_FORMATS = formats(Knobs())
_TANGENT = _FORMATS.tan
_USUAL = Registers(4, 3, _TANGENT.one // 2, _TANGENT.one // 3)


def _vector(generator: Generator) -> Vec3:
    x, y, z = generator.integers(_FORMATS.coord.min, _FORMATS.coord.max, 3, endpoint=True).tolist()
    return (x, y, z)


def _camera(generator: Generator) -> Camera:
    """Any; hardly ever one that cannot be drawn."""
    return Camera(_vector(generator), _vector(generator), _vector(generator))


async def views(bench: CameraBench, generator: Generator, _size: int) -> None:
    """Cameras of any direction, one behind the other and with rests; sizes and tangents at their limits."""
    counts = (1, 64, LARGEST)
    tangents = (0, _TANGENT.one // 3, _TANGENT.one, _TANGENT.max)
    for number in range(12):
        size = Registers(
            counts[number % 3], counts[number // 3 % 3], tangents[number % 4], tangents[-number % 4]
        )
        await bench.run(_camera(generator), size)
        await bench.clocks(2 * LONG * (number % 2))


async def faults(bench: CameraBench, generator: Generator, _size: int) -> None:
    """No width, no height, neither; an eye at the center of interest; an up along the view, or none."""
    good, place = _camera(generator), _vector(generator)
    for width, height in ((0, 3), (3, 0), (0, 0)):
        await bench.run(good, Registers(width, height, _TANGENT.one, _TANGENT.one))
    for up in ((0, 0, 1), (0, 0, 0)):
        await bench.run(Camera(place, up, place), _USUAL)
    for up in ((2, 4, -6), (-1, -2, 3), (0, 0, 0)):
        await bench.run(Camera((0, 0, 0), up, (1, 2, -3)), _USUAL)
        await bench.run(good, _USUAL)


async def reset_states(register: Any, bench: CameraBench, generator: Generator, _size: int) -> None:
    """Reset in each state of a set-up, and at rest."""
    drawn = _camera(generator)

    async def start() -> None:
        await bench.start(drawn, _USUAL)

    await bench.reset()
    await resets.in_each_state(Reference(start, bench.clock, CLOCKS, bench.reset), register)


async def at_random(bench: CameraBench, generator: Generator, _size: int) -> None:
    """Any camera, of any size."""
    width, height = generator.integers(1, LARGEST, 2, endpoint=True).tolist()
    tan_h, tan_v = generator.integers(0, _TANGENT.max, 2, endpoint=True).tolist()
    await bench.run(_camera(generator), Registers(width, height, tan_h, tan_v))


async def closure_subject(dut: Any, _run: Context) -> Scenarios:
    """The camera, ready to be played on."""
    bench = await CameraBench.create(dut)
    played: dict[str, Scenario] = {
        "views": views,
        "faults": faults,
        "resets": partial(reset_states, dut.u_camera.state_reg),
    }
    return of_block(bench, played, at_random)
