"""Tests of the ray generator: every pixel once, in order, in the right direction, a slot for each."""

import itertools
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import cocotb
import numpy as np
from hypothesis import strategies as st

from models.core.camera import Basis
from models.core.rays import ray_generator as model
from models.fixed import Format, Raw
from models.formats import Knobs, formats
from models.scene.strategies import raws
from models.scene.types import Vec3
from verif.env import context
from verif.env.block import Block, holds, same
from verif.env.fields import Field
from verif.env.operands import from_rows
from verif.env.pipelined import Mismatch

_SIZE_W, _SLOT_W = 12, 8
LARGEST = (1 << _SIZE_W) - 1
_MOST_PIXELS = 48
_FORMATS = formats(Knobs())
_SPAN = Format(_FORMATS.span.int_bits - 1, _FORMATS.span.frac_bits, signed=False)
"""Spans that a camera makes: tangents are below 8, so that twice a span still fits."""
_DIRECTION = Field.of("out_direction", _FORMATS.screen, lanes=3)
_BASIS = (
    Field.of("base", _FORMATS.screen, lanes=3),
    *(
        field
        for side in ("column", "row")
        for field in (
            Field.of(f"{side}_quotient", _FORMATS.span, lanes=3),
            Field(f"{side}_remainder", _SIZE_W, lanes=3, signed=False),
            Field(f"{side}_negative", 1, lanes=3, signed=False),
        )
    ),
)


@dataclass(frozen=True)
class Picture:
    """A picture and where it stands: d in `unit` within +-1, signed spans below 8 in `span`."""

    width: int
    height: int
    d: Vec3
    column: Vec3
    row: Vec3

    @property
    def pixels(self) -> int:
        """How many there are."""
        return self.width * self.height

    def basis(self) -> Basis:
        """As the camera hands it on."""
        d, column, row = (
            np.array(raw, dtype=np.int64).reshape(3, 1) for raw in (self.d, self.column, self.row)
        )
        base = (d << (_FORMATS.screen.frac_bits - _FORMATS.unit.frac_bits)) - column - row
        column_sign, row_sign = np.where(column < 0, -1, 1), np.where(row < 0, -1, 1)
        return Basis(base, np.abs(column), column_sign, np.abs(row), row_sign, d, column, row)

    def directions(self) -> Raw:
        """The model's, (3, pixels)."""
        index = np.arange(self.pixels)
        return model(self.basis(), self.width, self.height, index % self.width, index // self.width)

    def exact(self, x: int, y: int) -> list[Fraction]:
        """A direction by the book's formula, in steps of `screen`."""
        across, down = Fraction(2 * x + 1, self.width) - 1, Fraction(2 * y + 1, self.height) - 1
        unit = 1 << (_FORMATS.screen.frac_bits - _FORMATS.unit.frac_bits)
        lanes = zip(self.d, self.column, self.row, strict=True)
        return [d * unit + across * column + down * row for d, column, row in lanes]


class RayBench(Block):
    """Sets pictures up, offers slots and checks rays."""

    def __init__(self, dut: Any) -> None:
        super().__init__(dut, idle=("start", "slot_valid"), carried={"slot_valid": ("slot",)})
        self._sent: int | None = None

    @classmethod
    async def create(cls, dut: Any) -> "RayBench":
        """A bench whose clock runs and whose block has been reset."""
        bench = cls(dut)
        await bench.restart()
        return bench

    async def restart(self) -> None:
        """Reset; nothing is taken, nothing comes out."""
        await self.reset()
        self._sent = None

    async def start(self, picture: Picture) -> None:
        """One clock of start with this picture."""
        basis = picture.basis()
        lanes: list[int] = list(basis.base[:, 0])
        for span, sign, count in (
            (basis.column_span, basis.column_sign, picture.width),
            (basis.row_span, basis.row_sign, picture.height),
        ):
            lanes += [*(span // count)[:, 0], *(span % count)[:, 0], *(sign < 0)[:, 0]]
        self.set_fields(_BASIS, from_rows(_BASIS, [lanes]))
        self.set(width=picture.width, height=picture.height, start=1)
        await self.step(None)
        self.set(start=0)

    async def step(self, slot: int | None) -> tuple[bool, Raw | None]:
        """One clock with a slot on offer; whether it was taken, and the direction that came out.

        A ray is there one clock after its slot was taken, with that slot, and only then.
        """
        self.set(slot_valid=int(slot is not None), slot=slot or 0)
        await self.clock()
        valid = self.read("out_valid")
        same("out_valid one clock after a slot was taken", int(self._sent is not None), valid)
        ray = None
        if valid:
            same("slot of a ray", self._sent, self.read("out_slot"))
            ray = self.read_field(_DIRECTION)[:, 0]
        taken = slot is not None and bool(self.read("slot_ready"))
        self._sent = slot if taken else None
        return taken, ray

    async def draw(self, picture: Picture, slots: Sequence[int], gaps: Sequence[int], stop: int) -> Raw:
        """Offers slots until ``stop`` were taken; the directions of all rays, (3, stop)."""
        rays: list[Raw] = []
        for number in range(stop):
            for _ in range(gaps[number % len(gaps)]):
                rays += self._seen(await self.step(None))
            taken, ray = await self.step(slots[number % len(slots)])
            if not taken:
                raise Mismatch(f"slot {number} of {picture.pixels} was not taken")
            rays += self._seen((False, ray))
        rays += self._seen(await self.step(None))
        return np.array(rays, dtype=np.int64).reshape(-1, 3).T

    @staticmethod
    def _seen(step: tuple[bool, Raw | None]) -> list[Raw]:
        return [] if step[1] is None else [step[1]]

    async def picture(self, picture: Picture, slots: Sequence[int], gaps: Sequence[int]) -> None:
        """A whole picture; slots offered after it stay."""
        await self.start(picture)
        rays = await self.draw(picture, slots, gaps, picture.pixels)
        same("rays", picture.pixels, rays.shape[1])
        wrong = (rays != picture.directions()).any(axis=0).nonzero()[0]
        if wrong.size:
            at = int(wrong[0])
            same(
                f"ray of pixel {at} of {picture}", picture.directions()[:, at].tolist(), rays[:, at].tolist()
            )
        for _ in range(3):
            taken, ray = await self.step(slots[0])
            assert not taken and ray is None, "a ray behind the last pixel"


def _counts() -> st.SearchStrategy[int]:
    return st.sampled_from([1, 2, LARGEST]) | st.integers(1, LARGEST)


def _spans() -> st.SearchStrategy[Vec3]:
    sign = st.sampled_from([1, -1])
    lane = st.tuples(raws(_SPAN), sign).map(lambda drawn: drawn[0] * drawn[1])
    # Less than a step a pixel: the quotient is 0, of either sign.
    short = st.integers(-_MOST_PIXELS, _MOST_PIXELS)
    return st.tuples(lane | short, lane | short, lane | short)


def pictures() -> st.SearchStrategy[Picture]:
    """Pictures of at most some dozen pixels, spans of any sign."""
    one = _FORMATS.unit.one
    lane = st.sampled_from([0, one, -one]) | st.integers(-one, one)
    line = st.integers(1, _MOST_PIXELS)
    sides = st.one_of(
        st.just((1, 1)),
        line.map(lambda count: (1, count)),
        line.map(lambda count: (count, 1)),
        st.tuples(st.integers(1, 7), st.integers(1, 7)),
    )
    spans = _spans()
    return st.builds(
        lambda side, *vectors: Picture(*side, *vectors), sides, st.tuples(lane, lane, lane), spans, spans
    )


_SLOTS = st.lists(st.integers(0, (1 << _SLOT_W) - 1), min_size=1, max_size=8)
_GAPS = st.lists(st.integers(0, 3), min_size=1, max_size=6)


@cocotb.test()
async def every_pixel_is_cast_once_in_order_and_exactly(dut: Any) -> None:
    """Drawn pictures, slots and gaps; two pictures, one behind the other."""
    bench = await RayBench.create(dut)

    async def example(first: Picture, second: Picture, slots: list[int], gaps: list[int], idle: int) -> None:
        await bench.restart()
        await bench.picture(first, slots, gaps)
        for _ in range(idle):
            await bench.step(None)
        await bench.picture(second, slots, gaps)

    await holds(context.read(), example, pictures(), pictures(), _SLOTS, _GAPS, st.integers(0, 3), cost=2)


@cocotb.test()
async def directions_are_within_two_steps_of_the_books_formula(dut: Any) -> None:
    """Each of the two terms is floored once: less than one step a term, exact in fractions."""
    bench = await RayBench.create(dut)

    async def example(picture: Picture) -> None:
        await bench.restart()
        await bench.start(picture)
        rays = await bench.draw(picture, [0], [0], picture.pixels)
        for at in range(picture.pixels):
            exact = picture.exact(at % picture.width, at // picture.width)
            for lane, wanted in zip(rays[:, at], exact, strict=True):
                assert abs(int(lane) - wanted) < 2, f"pixel {at} of {picture}: {lane}, not {float(wanted)}"

    await holds(context.read(), example, pictures())


@cocotb.test()
async def the_widest_line_is_cast_at_one_ray_a_clock(dut: Any) -> None:
    """As many clocks as pixels, in the largest width and in the largest height."""
    run = context.read()
    bench = await RayBench.create(dut)
    one = _SPAN.max
    steep = ((one, -one, 12345), (-54321, one, -one))
    # Less than a step a pixel, of either sign.
    flat = ((1, -1, 1 - LARGEST), (LARGEST - 1, -2, 1 - LARGEST))
    # Every bit of a remainder, which takes as large a side: alternating ones, the one way and the other.
    striped = ((0x555, -0xAAA, 0x555), (0xAAA, 0x555, -0xAAA))
    spans = (steep, flat, striped, striped[::-1])
    for (width, height), (column, row) in itertools.product(((LARGEST, 1), (1, LARGEST)), spans):
        picture = Picture(width, height, (1, 2, 3), column, row)
        before = bench.now
        await bench.picture(picture, list(range(200)), [0])
        starts, behind = 1, 4
        same("clocks of the picture", starts + picture.pixels + behind, bench.now - before)
    bench.log.info("%d operands asked for, %d rays checked", run.operands, 2 * len(spans) * LARGEST)


@cocotb.test()
async def reset_in_the_middle_of_a_picture_stops_it(dut: Any) -> None:
    """No slot is taken and no ray comes after a reset, until the next start, which is exact."""
    bench = await RayBench.create(dut)

    async def example(before: Picture, part: int, after: Picture, slots: list[int], gaps: list[int]) -> None:
        await bench.restart()
        await bench.start(before)
        await bench.draw(before, slots, gaps, part % before.pixels)
        taken, _ = await bench.step(slots[0])
        assert taken
        await bench.restart()
        for _ in range(3):
            taken, _ = await bench.step(slots[0])
            assert not taken, "a slot was taken between reset and start"
        await bench.picture(after, slots, gaps)

    part = st.integers(0, _MOST_PIXELS)
    await holds(context.read(), example, pictures(), part, pictures(), _SLOTS, _GAPS, cost=2)
