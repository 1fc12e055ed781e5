"""Tests of the camera: against its model bit by bit, and against geometry in double precision."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product
from typing import Any, cast

import cocotb
import numpy as np
from hypothesis import strategies as st
from numpy.typing import NDArray

from models.core.camera import Basis, Registers
from models.core.camera import camera as model
from models.fixed import Raw
from models.formats import Knobs, formats
from models.latency import LATENCY
from models.limits import Fault
from models.scene.strategies import cameras, raws, undrawable_cameras
from models.scene.types import Camera, Vec3
from verif.env import context, resets
from verif.env.block import Block, holds, same
from verif.env.fields import Field
from verif.env.inside import inside
from verif.env.operands import from_rows
from verif.env.resets import Reference

_SIZE_W = 12
LARGEST = (1 << _SIZE_W) - 1
"""Width or height."""
_FORMATS = formats(Knobs())
_PLACES = tuple(Field.of(name, _FORMATS.coord, lanes=3) for name in ("position", "up", "center"))
_BASE = Field.of("base", _FORMATS.screen, lanes=3)
CLOCKS = LATENCY["camera"]({"SIZE_W": _SIZE_W})
"""From start to done, without a fault."""
_LIMIT = 4 * CLOCKS
_VECTORS = 3
"""Those that are normalised: the view, u and v."""


@dataclass(frozen=True)
class Side:
    """Columns or rows as they come out: quotient and remainder of the span's magnitude, and its sign."""

    quotient: Field
    remainder: Field
    negative: Field

    @classmethod
    def of(cls, name: str) -> "Side":
        """The ports of `column` or `row`."""
        return cls(
            Field.of(f"{name}_quotient", _FORMATS.span, lanes=3),
            Field(f"{name}_remainder", _SIZE_W, lanes=3, signed=False),
            Field(f"{name}_negative", 1, lanes=3, signed=False),
        )


_COLUMN, _ROW = Side.of("column"), Side.of("row")


@dataclass(frozen=True)
class Result:
    """What the camera found: base, and the spans of columns and rows, signed, all raw of shape (3,)."""

    base: Raw
    column: Raw
    row: Raw


def expected_fault(drawn: Camera, size: Registers) -> Fault:
    """The fault by its definition, in integers."""
    view = [c - p for c, p in zip(drawn.center, drawn.position, strict=True)]
    if not size.width or not size.height:
        return Fault.SIZE
    if not any(view):
        return Fault.CAMERA_POSITION
    pairs = ((1, 2), (2, 0), (0, 1))
    parallel = all(view[i] * drawn.up[j] == view[j] * drawn.up[i] for i, j in pairs)
    return Fault.CAMERA_UP if parallel else Fault.NONE


class CameraBench(Block):
    """Starts the camera and reads what it found."""

    def __init__(self, dut: Any) -> None:
        super().__init__(dut, idle=("start",))

    @classmethod
    async def create(cls, dut: Any) -> "CameraBench":
        """A bench whose clock runs and whose block has been reset."""
        bench = cls(dut)
        await bench.reset()
        return bench

    async def start(self, drawn: Camera, size: Registers) -> None:
        """One clock of start with these inputs."""
        row = (*drawn.position, *drawn.up, *drawn.center)
        self.set_fields(_PLACES, from_rows(_PLACES, [row]))
        self.set(width=size.width, height=size.height, tan_h=size.tan_h, tan_v=size.tan_v)
        await self.clock(start=1)
        self.set(start=0)

    def _side(self, side: Side, count: int) -> Raw:
        quotient, remainder, negative = (
            self.read_field(field)[:, 0] for field in (side.quotient, side.remainder, side.negative)
        )
        assert (remainder < count).all(), f"remainder {remainder} of a division by {count}"
        same(f"signs of spans that are 0 in {quotient}, {remainder}", 0, int(negative.max(initial=0) >> 1))
        return np.asarray(np.where(negative, -1, 1) * (quotient * count + remainder))

    def result(self, size: Registers) -> Result:
        """The outputs, as they stand."""
        base = self.read_field(_BASE)[:, 0]
        return Result(base, self._side(_COLUMN, size.width), self._side(_ROW, size.height))

    def compare(self, basis: Basis, size: Registers) -> None:
        """The outputs against a basis, bit by bit."""
        got = self.result(size)
        expected = (basis.base, basis.column_sign * basis.column_span, basis.row_sign * basis.row_span)
        names = ("base", "span of columns", "span of rows")
        for name, wanted, found in zip(names, expected, (got.base, got.column, got.row), strict=True):
            same(name, wanted[:, 0].tolist(), found.tolist())

    async def run(self, drawn: Camera, size: Registers, starts: int = 0) -> Fault:
        """One set-up; its fault. Without one it took as long as promised and matches the model.

        starts: value of `start` behind the first clock, until done.
        """
        await self.start(drawn, size)
        self.set(start=starts)
        clocks = await self.until("done", _LIMIT)
        self.set(start=0)
        fault = Fault(self.read("fault"))
        same(f"fault of {drawn} with {size}", expected_fault(drawn, size), fault)
        same("vectors that the normaliser was given", 0 if fault else _VECTORS, self.read("asked"))
        if fault is Fault.NONE:
            same("clocks from start to done", CLOCKS, clocks)
            self.compare(model(drawn, size, _FORMATS), size)
        return fault

    async def rest(self, size: Registers, clocks: int) -> None:
        """Done does not come again, and results stand, for some clocks after a set-up."""
        before = self.result(size)
        for _ in range(clocks):
            await self.clock()
            same("done in the clocks after it", 0, self.read("done"))
            now = self.result(size)
            same("base", before.base.tolist(), now.base.tolist())
            same("columns", before.column.tolist(), now.column.tolist())
            same("rows", before.row.tolist(), now.row.tolist())


def _sizes() -> st.SearchStrategy[Registers]:
    count = st.sampled_from([1, 2, LARGEST]) | st.integers(1, LARGEST)
    tangent = raws(_FORMATS.tan)
    return st.builds(Registers, count, count, tangent, tangent)


def _nearly_parallel() -> st.SearchStrategy[Camera]:
    """Cameras that cannot be drawn, and those one step of `up` away."""

    def nudge(drawn: Camera, step: Vec3) -> Camera:
        x, y, z = (min(max(a + b, -(1 << 18)), (1 << 18) - 1) for a, b in zip(drawn.up, step, strict=True))
        return Camera(drawn.position, (x, y, z), drawn.center)

    one = st.integers(-1, 1)
    return st.builds(nudge, undrawable_cameras(), st.tuples(one, one, one))


def _any_camera() -> st.SearchStrategy[Camera]:
    return cameras() | undrawable_cameras() | _nearly_parallel()


@cocotb.test()
async def basis_matches_the_model_for_every_camera_size_and_tangent(dut: Any) -> None:
    """Drawn cameras; results stand until the next start."""
    bench = await CameraBench.create(dut)

    async def example(drawn: Camera, size: Registers) -> None:
        await bench.reset()
        await bench.run(drawn, size)
        await bench.rest(size, 2)

    await holds(context.read(), example, cameras(), _sizes())


def _unit(vector: Sequence[int]) -> NDArray[np.float64]:
    exact = np.array(vector, dtype=np.float64)
    return np.asarray(exact / np.linalg.norm(exact))


def _cross(a: Sequence[int], b: Sequence[int]) -> list[int]:
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


@cocotb.test()
async def basis_is_orthonormal_and_looks_at_the_center_of_interest(dut: Any) -> None:
    """With tangents of 1 the spans are u and v themselves; all three against double precision.

    A unit component errs by less than 3 steps: one from a vector cut to a mantissa of 18 bits, of which
    the longest component has 17 or more, one from the norm's root, one from the quotient. v errs by what
    d and u do, as vectors, on top of that.
    """
    bench = await CameraBench.create(dut)
    step = 1 / _FORMATS.unit.one
    component = 3 * step
    whole = component * 3**0.5
    one = _FORMATS.tan.one

    async def example(drawn: Camera, width: int, height: int) -> None:
        size = Registers(width, height, one, one)
        await bench.reset()
        await bench.run(drawn, size)
        got = bench.result(size)
        u, v = (raw / _FORMATS.screen.one for raw in (got.column, got.row))
        d = (got.base + got.column + got.row) / _FORMATS.screen.one
        view = [c - p for c, p in zip(drawn.center, drawn.position, strict=True)]
        right = _cross(view, drawn.up)
        true_d, true_u = _unit(view), _unit(right)
        assert np.abs(d - true_d).max() < component, f"d is {d}, not {true_d}"
        assert np.abs(u - true_u).max() < component, f"u is {u}, not {true_u}"
        assert np.linalg.norm(v - np.cross(true_d, true_u)) < 3 * whole, f"v is {v}"
        basis = np.array([d, u, v])
        error = np.abs(basis @ basis.T - np.eye(3)).max()
        assert error < 5 * whole, f"off orthonormal by {error} in {basis}"

    count = st.integers(1, LARGEST)
    await holds(context.read(), example, cameras(), count, count, cost=2)


@cocotb.test()
async def faults_are_found_exactly_and_only_where_they_are(dut: Any) -> None:
    """Sizes of 0, no view, an up along the view or one step beside it; then a camera that can be drawn."""
    bench = await CameraBench.create(dut)
    count = st.sampled_from([0, 1, LARGEST]) | st.integers(1, LARGEST)
    tangent = raws(_FORMATS.tan)
    sizes = st.builds(Registers, count, count, tangent, tangent)

    async def example(drawn: Camera, size: Registers, idle: int, after: Camera, then: Registers) -> None:
        await bench.reset()
        await bench.run(drawn, size)
        await bench.clocks(idle)
        await bench.run(after, then)

    await holds(context.read(), example, _any_camera(), sizes, st.integers(1, 4), cameras(), _sizes(), cost=2)


@cocotb.test()
async def an_eye_at_the_center_of_interest_sees_nothing(dut: Any) -> None:
    """Anywhere, the corners of the room included; one step off it does."""
    bench = await CameraBench.create(dut)
    size = Registers(3, 2, _FORMATS.tan.one, _FORMATS.tan.one)
    coord = _FORMATS.coord
    for place in ((0, 0, 0), (coord.min, coord.max, coord.min), (7, 8, 9)):
        x, y, z = place
        beside = (x, y - 1, z)
        same("refused", Fault.CAMERA_POSITION, await bench.run(Camera(place, (0, 0, 1), place), size))
        same("drawn", Fault.NONE, await bench.run(Camera(place, (0, 0, 1), beside), size))


@cocotb.test()
async def one_bit_of_a_size_or_of_a_view_is_enough(dut: Any) -> None:
    """Sizes that are powers of two, and views along an axis of a power of two: none of them is a fault."""
    bench = await CameraBench.create(dut)
    tangent, coord = _FORMATS.tan.one, _FORMATS.coord
    for bit in range(_SIZE_W):
        for size in (
            Registers(1 << bit, LARGEST, tangent, tangent),
            Registers(1, 1 << bit, tangent, tangent),
        ):
            same(f"{size}", Fault.NONE, await bench.run(Camera((0, 0, 0), (0, 0, 1), (0, 1, 0)), size))
    for axis, bit in product(range(3), range(coord.width)):
        position, center = np.zeros((2, 3), dtype=int)
        half = (1 << bit) // 2
        position[axis], center[axis] = -half, (1 << bit) - half
        up = np.roll((1, 0, 0), axis + 1)
        drawn = Camera(*(cast(Vec3, tuple(place.tolist())) for place in (position, up, center)))
        same(f"{drawn}", Fault.NONE, await bench.run(drawn, Registers(3, 2, tangent, tangent)))


@cocotb.test()
async def a_start_before_done_is_ignored(dut: Any) -> None:
    """High in every clock of a set-up, whichever way it ends: nothing begins anew."""
    bench = await CameraBench.create(dut)

    async def example(drawn: Camera, size: Registers) -> None:
        await bench.run(drawn, size, starts=1)
        for _ in range(CLOCKS):
            await bench.clock()
            same("done behind it", 0, bench.read("done"))

    await holds(context.read(), example, _any_camera(), _sizes())


@cocotb.test()
async def the_smallest_step_beside_the_view_is_an_up(dut: Any) -> None:
    """Views and ups of one step along the axes: their product is one step, or nothing."""
    bench = await CameraBench.create(dut)
    axes: tuple[Vec3, ...] = ((1, 0, 0), (0, 1, 0), (0, 0, 1))
    size = Registers(3, 2, _FORMATS.tan.one, _FORMATS.tan.one)
    for view in axes:
        for x, y, z in axes:
            for up in ((x, y, z), (-x, -y, -z)):
                fault = await bench.run(Camera((0, 0, 0), up, view), size)
                same("refused", view == (x, y, z), fault is Fault.CAMERA_UP)


@cocotb.test()
async def reset_in_any_state_leaves_nothing_behind(dut: Any) -> None:
    """Reset at a drawn clock: no done comes of it, the next camera is exact."""
    bench = await CameraBench.create(dut)

    async def example(before: Camera, wait: int, after: Camera, size: Registers) -> None:
        await bench.reset()
        await bench.start(before, size)
        await bench.clocks(wait)
        await bench.reset(1)
        await bench.clock()
        same("done after reset", 0, bench.read("done"))
        await bench.run(after, size)

    await holds(context.read(), example, cameras(), st.integers(0, CLOCKS), _any_camera(), _sizes(), cost=2)


@cocotb.test()
async def reset_in_each_clock_of_each_state_leaves_nothing_behind(dut: Any) -> None:
    """Of a whole set-up; the next one, of another camera, is exact and on time."""
    bench = await CameraBench.create(dut)
    size = Registers(3, 2, _FORMATS.tan.one, _FORMATS.tan.one)
    before = Camera((1000, -2000, 3000), (10, 900, -20), (-5, 6, 7))
    after = Camera((-400, 5000, 60), (0, 300, 1000), (8, -9, 10))

    async def start() -> None:
        await bench.reset()
        await bench.start(before, size)

    async def behind() -> None:
        await bench.reset(1)
        await bench.run(after, size)

    run = Reference(start, bench.clock, CLOCKS + 1, behind)
    await resets.at_every_clock(bench.log, run, inside(dut, "u_camera.state_reg"), "scene/camera.v")
