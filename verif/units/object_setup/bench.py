"""Tests of the objects' set-up against integers and fractions: every row exact, in order, and on time.

The scene memory is a list that answers one clock after the index; the normaliser is its model, behind a drawn
latency.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import product
from typing import Any

import cocotb
import numpy as np
from hypothesis import strategies as st
from numpy.random import Generator

from models.core.setup import object_setup, triangle_setup
from models.fixed import BOOK, COLOUR, RADIUS, Raw
from models.scene.strategies import materials, spheres, triangles, vectors
from models.scene.types import BLACK, Material, Sphere, Triangle, Vec3
from verif.env import context, resets
from verif.env.block import Block, holds, same
from verif.env.fields import Field, split
from verif.env.resets import Reference
from verif.units.object_setup.rows import (
    COUNT_W,
    FORMATS,
    ROW,
    SHAPE_W,
    SLOT_W,
    SLOTS,
    Frame,
    Row,
    cross,
    direction,
    expected,
    packed,
)


class Normaliser:
    """The normaliser's model: a unit vector so many clocks after its vector; a second request is a fault."""

    def __init__(self, bits: int) -> None:
        self._port = Field("vector", bits, lanes=3)
        self.latency = 1
        self.asked: list[Vec3] = []
        self._left: int | None = None

    def reset(self) -> None:
        """Forgets what it was asked."""
        self.asked, self._left = [], None

    def ask(self, word: int) -> None:
        """Takes a vector in this clock."""
        same("clocks to the answer of an earlier request", None, self._left)
        x, y, z = (int(lane) for lane in split((self._port,), [word])[self._port.name][:, 0])
        self.asked.append((x, y, z))
        self._left = self.latency

    def answer(self) -> int | None:
        """The unit vector of the next clock, if any."""
        if self._left is None:
            return None
        self._left -= 1
        if self._left:
            return None
        self._left = None
        return packed(direction(self.asked[-1], self._port.width), FORMATS.unit.width)


class ObjectSetupBench(Block):
    """The set-up between a scene memory and a normaliser; its rows, its requests and its marks."""

    def __init__(self, dut: Any, parameters: Mapping[str, int], generator: Generator) -> None:
        super().__init__(dut, idle=("start", "unit_valid"), carried={"unit_valid": ("unit",)})
        self.bits = parameters["WIDE_W"]
        self.most = tuple(1 << parameters[f"{kind}_INDEX_W"] for kind in ("SPHERE", "TRIANGLE"))
        self._generator = generator
        self._normaliser = Normaliser(self.bits)
        self._records: Mapping[str, list[int]] = {}
        self._running = False
        self.rows: list[Row] = []

    @classmethod
    async def create(cls, dut: Any) -> "ObjectSetupBench":
        """A bench whose clock runs and whose block has been reset."""
        run = context.read()
        bench = cls(dut, run.parameters, run.generator(0))
        await bench.restart()
        return bench

    async def restart(self) -> None:
        """Reset, of the normaliser too."""
        self._normaliser.reset()
        self._running = False
        self._scramble()
        await self.reset()

    def _junk(self, bits: int) -> int:
        return int.from_bytes(self._generator.bytes(-(-bits // 8)), "big") & ((1 << bits) - 1)

    def _scramble(self) -> None:
        """What holds still during a set-up may be anything outside of it."""
        self.set(
            spheres=self._junk(COUNT_W),
            triangles=self._junk(COUNT_W),
            ambient_light=self._junk(3 * SLOT_W),
            **{port: self._junk(slots * SLOT_W) for port, slots in SLOTS.items()},
        )

    async def step(self) -> bool:
        """One clock of everything; whether the set-up is done in it."""
        answer = self._normaliser.answer()
        self.set(unit_valid=int(answer is not None), unit=self._junk(SHAPE_W) if answer is None else answer)
        await self.clock()
        if self.read("vector_valid"):
            self._normaliser.ask(self.read("vector"))
        if self.read("table_valid"):
            self.rows.append({name: self.read(name) for name in ROW})
        else:
            same("degenerate without a row", 0, self.read("degenerate"))
        if self._running:
            self._memory()
        return bool(self.read("done"))

    def _memory(self) -> None:
        """The records, in the next clock, of the indices of this one."""
        for port, slots in SLOTS.items():
            index, records = self.read(f"{port}_index"), self._records[port]
            self.set(**{port: records[index] if index < len(records) else self._junk(slots * SLOT_W)})

    async def start(self, frame: Frame) -> None:
        """One clock of start with this frame."""
        self._records = frame.records()
        self._normaliser.latency = frame.normaliser
        self._normaliser.asked, self.rows = [], []
        self.set(
            spheres=len(frame.spheres),
            triangles=len(frame.triangles),
            ambient_light=packed(frame.ambient),
            start=1,
        )
        same("done in the clock of start", False, await self.step())
        self.set(start=0)
        self._running = True

    async def run(self, frame: Frame, rest: int = 0, start: int = 0) -> None:
        """One set-up: its rows, its requests, its time; marks stand through ``rest`` more clocks.

        ``start``: its level in all clocks before that of done, where it changes nothing.
        """
        await self.start(frame)
        self.set(start=start)
        clocks = 1
        while not await self.step():
            clocks += 1
            self.set(start=start if clocks < frame.clocks else 0)
            assert clocks <= frame.clocks, f"not done {clocks} clocks after start, {frame.clocks} promised"
        same("clocks from start to done", frame.clocks, clocks)
        self._compare(frame)
        self._running = False
        self._scramble()
        for _ in range(rest):
            same("done in the clocks after it", False, await self.step())
            self._marks(frame)
        same("rows", len(frame.spheres) + len(frame.triangles), len(self.rows))

    def _compare(self, frame: Frame) -> None:
        wanted = expected(frame, self.bits)
        same("numbers of the rows", list(range(len(wanted))), [row["table_index"] for row in self.rows])
        for row, got in zip(wanted, self.rows, strict=True):
            for name, value in row.items():
                same(f"{name} of object {row['table_index']}", hex(value), hex(got[name]))
        same("vectors asked for", [cross(triangle) for triangle in frame.triangles], self._normaliser.asked)
        self._marks(frame)

    def _marks(self, frame: Frame) -> None:
        held: list[Sphere | Triangle] = [*frame.spheres, *frame.triangles]
        found = [item.material for item in held]
        same("reflects", any(any(m.reflection) for m in found), bool(self.read("reflects")))
        same("transmits", any(any(m.transparency) for m in found), bool(self.read("transmits")))


def _clamped(vector: Sequence[int]) -> Vec3:
    x, y, z = (min(max(component, BOOK.min), BOOK.max) for component in vector)
    return (x, y, z)


def _flat_triangles() -> st.SearchStrategy[Triangle]:
    """Vertices on one line, or one step beside it."""
    small = st.integers(-200, 200)
    step = st.sampled_from([0, 0, 0, 1, -1])

    def build(material: Material, p: Vec3, d: Vec3, places: tuple[int, int], off: Vec3) -> Triangle:
        p1, p2 = (_clamped([a + k * b for a, b in zip(p, d, strict=True)]) for k in places)
        return Triangle(material, (p, p1, _clamped([a + b for a, b in zip(p2, off, strict=True)])))

    direction, offset = st.tuples(small, small, small), st.tuples(step, step, step)
    return st.builds(build, _materials(), vectors(BOOK), direction, st.tuples(small, small), offset)


def _materials() -> st.SearchStrategy[Material]:
    """Materials, often without a mirror, without glass, or with one channel of it."""
    part = st.sampled_from([BLACK, BLACK, BLACK, (1, 0, 0), (0, 1, 0), (0, 0, 1)])
    plain = st.builds(
        lambda material, mirror, glass: replace(material, reflection=mirror, transparency=glass),
        materials(),
        part,
        part,
    )
    return plain | materials()


def _frames(most: Sequence[int], objects: tuple[int, int] = (3, 4)) -> st.SearchStrategy[Frame]:
    def built(items: st.SearchStrategy[Any], most: int) -> st.SearchStrategy[tuple[Any, ...]]:
        return st.lists(items, max_size=most).map(tuple)

    sphere = st.builds(Sphere, _materials(), vectors(BOOK), st.integers(1, RADIUS.max)) | spheres()
    triangle = _flat_triangles() | _flat_triangles() | triangles()
    limits = [min(pair) for pair in zip(most, objects, strict=True)]
    return st.builds(
        Frame,
        vectors(COLOUR),
        built(sphere, limits[0]),
        built(triangle, limits[1]),
        st.integers(1, 60),
    )


@cocotb.test()
async def rows_of_every_frame_are_exact_and_on_time(dut: Any) -> None:
    """Drawn frames, empty ones too, one set-up behind the other without a reset between them."""
    bench = await ObjectSetupBench.create(dut)

    async def example(first: Frame, rest: int, second: Frame) -> None:
        await bench.restart()
        await bench.run(first, rest)
        await bench.run(second, 2)

    frames = _frames(bench.most)
    await holds(context.read(), example, frames, st.integers(0, 5), frames, cost=2)


@cocotb.test()
async def constants_of_every_radius_are_exact_and_floored(dut: Any) -> None:
    """All 31 radii, as many at a time as the index holds."""
    bench = await ObjectSetupBench.create(dut)
    one = FORMATS.coeff.one
    material = Material((one, one + 1, COLOUR.max), BLACK, BLACK)
    radii = range(1, RADIUS.max + 1)
    for first in range(0, len(radii), bench.most[0]):
        held = tuple(Sphere(material, (radius, 0, 1), radius) for radius in radii[first:][: bench.most[0]])
        await bench.run(Frame((one, one // 2, COLOUR.max), held, (), 1))


@cocotb.test()
async def triangles_of_every_orientation_have_the_exact_product(dut: Any) -> None:
    """Corners of the range, where differences and products are longest, and areas of one step."""
    bench = await ObjectSetupBench.create(dut)
    material = Material(BLACK, BLACK, BLACK)
    ends = (BOOK.min, BOOK.max)
    corners = [(x, y, z) for x in ends for y in ends for z in ends]
    near: list[Vec3] = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
    for places in (corners[:4], corners[4:], corners[::2], near):
        for p0 in places:
            held = tuple(Triangle(material, (p0, p1, p2)) for p1 in places for p2 in places)
            for first in range(0, len(held), bench.most[1]):
                await bench.run(Frame(BLACK, (), held[first:][: bench.most[1]], 1))


def _of_one_bit(axis: int, bit: int) -> Triangle:
    """A triangle whose product is this bit of one component, all else of it 0."""
    half = BOOK.width - 1
    short = min(bit, half)
    # Of the longest edges the product of two is too long or too short, and a second product mends it.
    long = bit > 2 * half
    first = (2 * (1 << half) - 1, 1) if long else (1 << short, 0)
    second = ((1 << half) - 1, (1 << half) + 1) if long else (0, 1 << bit - short)
    corner = [BOOK.min] * 3

    def place(edge: tuple[int, int]) -> Vec3:
        moved = list(corner)
        for turn, reach in enumerate(edge, 1):
            moved[(axis + turn) % 3] += reach
        return _clamped(moved)

    return Triangle(Material(BLACK, BLACK, BLACK), (_clamped(corner), place(first), place(second)))


@cocotb.test()
async def areas_of_a_single_bit_are_no_degenerate_triangles(dut: Any) -> None:
    """Each bit of each component of the product alone, to the longest that the coordinates' range holds."""
    bench = await ObjectSetupBench.create(dut)
    held = []
    for axis, bit in product(range(3), range(2 * BOOK.width)):
        made = _of_one_bit(axis, bit)
        same("product", [1 << bit if lane == axis else 0 for lane in range(3)], list(cross(made)))
        held.append(made)
    for first in range(0, len(held), bench.most[1]):
        await bench.run(Frame(BLACK, (), tuple(held[first:][: bench.most[1]]), 1))


@cocotb.test()
async def rows_are_those_of_the_model(dut: Any) -> None:
    """The model of the set-up, which the model of the core uses, against the same rows."""
    bench = await ObjectSetupBench.create(dut)

    async def example(frame: Frame) -> None:
        await bench.restart()
        await bench.run(frame)
        light = _column(frame.ambient)
        for sphere, row in zip(frame.spheres, bench.rows, strict=False):
            radius = np.array([sphere.radius], dtype=np.int64)
            found = object_setup(radius, light, _column(sphere.material.ambient), FORMATS)
            same("radius squared", int(found.radius_sq[0]), _part(row["table_geometry"], 12))
            same("1 / radius", int(found.inv_radius[0]), _part(row["table_surface"], 3))
            same("ambient term", _lanes(found.ambient, FORMATS.shade.width), _ambient_of(row))
        for triangle, row in zip(frame.triangles, bench.rows[len(frame.spheres) :], strict=True):
            p0, p1, p2 = (_column(place) for place in triangle.vertices)
            made = triangle_setup((p0, p1, p2), light, _column(triangle.material.ambient), FORMATS)
            normal = _lanes(made.normal, FORMATS.unit.width)
            same("normal that tests use", normal, _part(row["table_geometry"], 12))
            same("normal that shading uses", normal, _part(row["table_surface"], 3))
            same("degenerate", int(made.degenerate[0]), row["degenerate"])
            same("ambient term", _lanes(made.ambient, FORMATS.shade.width), _ambient_of(row))

    await holds(context.read(), example, _frames(bench.most), cost=2)


def _column(vector: Vec3) -> Raw:
    return np.array(vector, dtype=np.int64).reshape(3, 1)


def _lanes(column: Raw, width: int) -> int:
    return packed([int(lane) for lane in column[:, 0]], width)


def _part(row: int, slots: int) -> int:
    """The shape above so many slots."""
    return row >> slots * SLOT_W & ((1 << SHAPE_W) - 1)


def _ambient_of(row: Row) -> int:
    return row["table_material"] >> 12 * SLOT_W


@cocotb.test()
async def frames_of_as_many_objects_as_the_indices_hold(dut: Any) -> None:
    """Every sphere and triangle another one, on counters that are full."""
    bench = await ObjectSetupBench.create(dut)
    full = [min(most, (1 << COUNT_W) - 1) for most in bench.most]
    colour = [Material((number, 1, 2), BLACK, BLACK, index=number % 16) for number in range(max(full))]
    held = tuple(Sphere(colour[k], (k, -k, 0), 1 + k % RADIUS.max) for k in range(full[0]))
    flat = tuple(Triangle(colour[k], ((0, 0, 0), (k, 1, 0), (0, k, 2))) for k in range(full[1]))
    await bench.run(Frame((COLOUR.one,) * 3, held, flat, 5))


@cocotb.test()
async def glass_and_mirrors_of_a_single_bit_are_told(dut: Any) -> None:
    """Each bit of each channel alone, of one and of the other: the row and the marks of the frame."""
    bench = await ObjectSetupBench.create(dut)
    for channel, bit in product(range(3), range(COLOUR.width)):
        values = [0, 0, 0]
        values[channel] = 1 << bit
        red, green, blue = values
        for mirror, glass in (((red, green, blue), BLACK), (BLACK, (red, green, blue))):
            material = Material(BLACK, BLACK, BLACK, mirror, glass)
            await bench.run(Frame(BLACK, (Sphere(material, (0, 0, 0), 1),), (), 1))


@cocotb.test()
async def start_before_done_is_ignored(dut: Any) -> None:
    """High in every clock of a drawn set-up, which is exact and on time, and so is the next one."""
    bench = await ObjectSetupBench.create(dut)

    async def example(first: Frame, second: Frame) -> None:
        await bench.restart()
        await bench.run(first, rest=1, start=1)
        await bench.run(second)

    frames = _frames(bench.most)
    await holds(context.read(), example, frames, frames, cost=2)


@cocotb.test()
async def spheres_at_once_behind_triangles_have_their_own_inverse(dut: Any) -> None:
    """Of another frame, sooner than the divider, had it begun with a triangle, would be free."""
    bench = await ObjectSetupBench.create(dut)
    dull = Material(BLACK, BLACK, BLACK)
    triangle = Triangle(dull, ((0, 0, 0), (9, 1, 0), (0, 8, 2)))
    for radius in range(1, RADIUS.max + 1):
        await bench.run(Frame(BLACK, (), (triangle,), 1))
        await bench.run(Frame(BLACK, (Sphere(dull, (0, 0, 0), radius),), (), 1))


@cocotb.test()
async def reset_abandons_a_set_up_and_the_next_one_is_exact(dut: Any) -> None:
    """Reset at a drawn clock of the work: no row and no done comes of it."""
    bench = await ObjectSetupBench.create(dut)

    async def example(first: Frame, wait: int, quiet: int, second: Frame) -> None:
        await bench.restart()
        await bench.start(first)
        for _ in range(min(wait, first.clocks - 1)):
            await bench.step()
        await bench.restart()
        bench.rows = []
        for _ in range(quiet):
            same("done of a set-up that was reset", False, await bench.step())
        same("rows of a set-up that was reset", [], bench.rows)
        await bench.run(second)

    frames = _frames(bench.most)
    await holds(context.read(), example, frames, st.integers(0, 150), st.integers(0, 80), frames, cost=2)


@cocotb.test()
async def reset_in_each_clock_of_each_state_abandons_the_set_up(dut: Any) -> None:
    """Of a sphere and a triangle; the set-up behind it, of others, is exact and on time."""
    bench = await ObjectSetupBench.create(dut)
    some = Material((3, 2, 1), BLACK, BLACK, index=4)
    before = Frame(
        (7, 8, 9), (Sphere(some, (1, 2, 3), 5),), (Triangle(some, ((0, 0, 0), (9, 1, 0), (0, 8, 2))),), 3
    )
    after = Frame(
        (1, 2, 3), (Sphere(some, (4, 0, 1), 9),), (Triangle(some, ((5, 0, 0), (0, 7, 1), (3, 0, 2))),), 2
    )

    async def start() -> None:
        await bench.restart()
        await bench.start(before)

    async def behind() -> None:
        await bench.restart()
        await bench.run(after)

    run = Reference(start, bench.step, before.clocks + 2, behind)
    await resets.at_every_clock(bench.log, run, dut.state_reg, "scene/object_setup.v")
