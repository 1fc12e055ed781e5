"""Tests of the object's set-up against fractions: it is exact, floored, saturated, and on time."""

from fractions import Fraction
from math import floor
from typing import Any

import cocotb
from hypothesis import strategies as st

from models.formats import Knobs, formats
from models.latency import LATENCY
from models.scene.strategies import vectors
from models.scene.types import Vec3
from verif.env import context
from verif.env.block import Block, holds, same
from verif.env.fields import Field, Operands
from verif.env.operands import from_rows

_FORMATS = formats(Knobs())
_INPUTS = (
    Field.of("radius", _FORMATS.radius),
    Field.of("ambient_light", _FORMATS.coeff, lanes=3),
    Field.of("k_ambient", _FORMATS.coeff, lanes=3),
)
_RADIUS_SQ = Field.of("radius_sq", _FORMATS.radius_sq)
_INV_RADIUS = Field.of("inv_radius", _FORMATS.inv_radius)
_AMBIENT = Field.of("ambient", _FORMATS.shade, lanes=3)
_LATENCY = LATENCY["object_setup"]({})

Drawn = tuple[int, Vec3, Vec3]


def _operands(drawn: Drawn) -> Operands:
    radius, light, coefficient = drawn
    return from_rows(_INPUTS, [(radius, *light, *coefficient)])


def _constants(drawn: Drawn) -> tuple[int, int, list[int]]:
    """Radius squared, 1 / radius and ambient term, raw, straight from their definitions."""
    radius, light, coefficient = drawn
    size = Fraction(radius, _FORMATS.radius.one)
    square = size * size * _FORMATS.radius_sq.one
    inverse = floor(_FORMATS.inv_radius.one / size)
    unit = Fraction(_FORMATS.shade.one, _FORMATS.coeff.one**2)
    ambient = [min(floor(a * b * unit), _FORMATS.shade.max) for a, b in zip(light, coefficient, strict=True)]
    assert square.denominator == 1, "radius squared is not exact in its format"
    return int(square), inverse, ambient


class ObjectSetupBench(Block):
    """Starts the set-up and reads its results."""

    def __init__(self, dut: Any) -> None:
        super().__init__(dut, idle=("start",))

    @classmethod
    async def create(cls, dut: Any) -> "ObjectSetupBench":
        """A bench whose clock runs and whose block has been reset."""
        bench = cls(dut)
        await bench.reset()
        return bench

    async def start(self, drawn: Drawn) -> None:
        """One clock of start with these operands."""
        self.set_fields(_INPUTS, _operands(drawn))
        await self.clock(start=1)
        self.set(start=0)

    def compare(self, drawn: Drawn) -> None:
        """Results against their definitions."""
        got = (
            int(self.read_field(_RADIUS_SQ)[0]),
            int(self.read_field(_INV_RADIUS)[0]),
            [int(lane) for lane in self.read_field(_AMBIENT)[:, 0]],
        )
        same(f"constants of {drawn}", _constants(drawn), got)

    async def run(self, drawn: Drawn, rest: int = 0) -> None:
        """One set-up: done comes once and on time, results stand through ``rest`` more clocks."""
        await self.start(drawn)
        same("clocks from start to done", _LATENCY, await self.until("done", 4 * _LATENCY))
        self.compare(drawn)
        for _ in range(rest):
            await self.clock()
            same("done in the clocks after it", 0, self.read("done"))
            self.compare(drawn)


def _drawn() -> st.SearchStrategy[Drawn]:
    radius = st.integers(1, _FORMATS.radius.max)
    return st.tuples(radius, vectors(_FORMATS.coeff), vectors(_FORMATS.coeff))


@cocotb.test()
async def constants_of_every_radius_are_exact_and_floored(dut: Any) -> None:
    """All 31 radii."""
    bench = await ObjectSetupBench.create(dut)
    one = _FORMATS.coeff.one
    for radius in range(1, _FORMATS.radius.max + 1):
        await bench.run((radius, (one, one // 2, 0), (one, one + 1, one)))


@cocotb.test()
async def ambient_term_is_the_floored_product_and_saturates(dut: Any) -> None:
    """Drawn lights and coefficients; results stand until the next start, which is as exact."""
    bench = await ObjectSetupBench.create(dut)

    async def example(first: Drawn, rest: int, second: Drawn) -> None:
        await bench.reset()
        await bench.run(first, rest)
        await bench.run(second)

    await holds(context.read(), example, _drawn(), st.integers(0, 5), _drawn())


@cocotb.test()
async def reset_abandons_a_set_up_and_the_next_one_is_exact(dut: Any) -> None:
    """Reset at a drawn clock of the work: no done comes of it."""
    bench = await ObjectSetupBench.create(dut)

    async def example(first: Drawn, wait: int, quiet: int, second: Drawn) -> None:
        await bench.reset()
        await bench.start(first)
        await bench.clocks(wait)
        await bench.reset()
        for _ in range(quiet):
            await bench.clock()
            same("done of a set-up that was reset", 0, bench.read("done"))
        await bench.run(second)

    idle = st.integers(0, 2 * _LATENCY)
    await holds(context.read(), example, _drawn(), st.integers(0, _LATENCY), idle, _drawn())
