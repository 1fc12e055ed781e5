"""Drawn tables of objects and rays through them, with what must become of each ray.

Objects crowd around 0, some of them twice, so that most rays meet several, and some two at one distance.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.random import Generator

from models.core.objects import Flat, Objects
from models.core.trace import MISS, attenuate, nearest
from models.fixed import BOOK, COLOUR, RADIUS, Raw
from models.formats import Formats
from models.header import selected
from models.scene.types import BLACK, Camera, Material, Scene, Sphere, Triangle, Vec3
from verif.env import vectors
from verif.env.fields import Field, Operands, join
from verif.env.operands import stream
from verif.env.unit import Parameters
from verif.units.intersection import rays
from verif.units.trace_unit import unit

_REACH, _FAR = 3.0, 6.0
"""Where objects are, and where rays start: so far from 0 along each axis."""
_AGAIN, _DEAD = 0.3, 0.1
"""Shares of objects with an earlier one's shape, and of triangles without area."""
_STEP_BEFORE = 1 / 32
"""A ray starts so far before its own triangle: more than T_MIN, so it would be hit."""

_CAMERA = Camera(BLACK, BLACK, BLACK)


@dataclass(frozen=True)
class Job:
    """A ray or a shadow ray: what goes in, what must come out, of which `open_bits` low bits may be anything,
    and its tests one after the other, whether each counts.
    """

    shadow: bool
    word: int
    result: int
    open_bits: int
    tests: tuple[bool, ...]


@dataclass(frozen=True)
class Lines:
    """Rays that may be of both kinds: origin, direction (3, n); own (n,): a triangle or MISS; limit (n,);
    colour, base (3, n)."""

    origin: Raw
    direction: Raw
    own: Raw
    limit: Raw
    colour: Raw
    base: Raw


class Table:
    """A table of objects, as the scene and as the unit have them."""

    def __init__(self, scene: Scene, p: Parameters) -> None:
        self._p, self._fmts = p, selected(p)
        self.objects = Objects.of(scene, self._fmts)

    @property
    def number(self) -> int:
        """How many objects the frame has."""
        return len(self.objects.shapes)

    @cached_property
    def rows(self) -> list[int]:
        """The rows of the unit's table; behind those of the frame there are others, which must not matter."""
        objects, spare = self.objects, self._p["OBJECTS"] - self.number
        shapes, vertices = np.zeros((3, self.number), dtype=np.int64), []
        dead = [isinstance(shape, Flat) and shape.dead for shape in objects.shapes]
        for number, shape in enumerate(objects.shapes):
            if isinstance(shape, Flat):
                shapes[:, number] = shape.normal[:, 0]
                vertices.append(np.concatenate(shape.corners)[:, 0])
            else:
                shapes[2, number] = shape.radius_sq[0]
                vertices.append(np.concatenate([shape.center[:, 0], np.zeros(6, dtype=np.int64)]))
        rows = join(
            unit.geometry(self._p),
            {
                "triangle": objects.triangle.astype(np.int64),
                "dead": np.array(dead, dtype=np.int64),
                "glass": self._glass,
                "shape": shapes,
                "vertices": np.array(vertices, dtype=np.int64).reshape(-1, 9).T,
                "transparency": objects.transparency,
            },
        )
        return rows + [self._decoy] * spare

    @property
    def _glass(self) -> Raw:
        """Objects that let light through (n,)."""
        return np.asarray(self.objects.transparency.any(axis=0).astype(np.int64))

    @property
    def _decoy(self) -> int:
        """A sphere around 0 that most rays would meet."""
        nothing, radius_sq = np.zeros((3, 1), dtype=np.int64), np.array([[0], [0], [RADIUS.max**2]])
        bit = {name: np.zeros(1, dtype=np.int64) for name in ("triangle", "dead", "glass")}
        rest = {"shape": radius_sq, "vertices": np.zeros((9, 1), dtype=np.int64), "transparency": nothing}
        return join(unit.geometry(self._p), {**bit, **rest})[0]

    def jobs(self, lines: Lines, kinds: Sequence[bool], generator: Generator) -> list[Job]:
        """The lines as rays, and as shadow rays where ``kinds`` says so; what only passes is anything."""
        given = self._given(lines, generator)
        got = {**given, **self._hits(lines), **self._terms(lines)}
        p = self._p
        words = {False: join(unit.ray(p), given), True: join(unit.shadow(p), given)}
        results = {False: join(unit.hit(p), got), True: join(unit.term(p), got)}
        found_bits = sum(port.bits for port in unit.found(p))
        jobs = []
        for index, shadow in enumerate(kinds):
            open_bits = 0 if shadow or got["hit"][index] else found_bits
            tests = self._tests(int(lines.own[index]))
            jobs.append(Job(shadow, words[shadow][index], results[shadow][index], open_bits, tests))
        return jobs

    def _given(self, lines: Lines, generator: Generator) -> Operands:
        """Every field of rays and shadow rays."""
        size = lines.own.size
        passing = [next(ports) for ports in (iter(unit.ray(self._p)), iter(unit.shadow(self._p)))]
        anything = stream(generator, [*passing, Field("own", self._p["OBJECT_W"], signed=False)], size)
        owned = lines.own != MISS
        own = np.where(owned, lines.own, anything["own"])
        return {**anything, **vars(lines), "owned": owned.astype(np.int64), "own": own}

    def _hits(self, lines: Lines) -> Operands:
        best, tests = nearest(self.objects, lines.origin, lines.direction, lines.own, self._fmts)
        self._count(lines, tests)
        glass = self._glass[best.number] if self.number else np.zeros_like(best.number)
        return {**vars(best), "hit": (best.number != MISS).astype(np.int64), "glass": glass}

    def _terms(self, lines: Lines) -> Operands:
        left, _, tests = attenuate(
            self.objects, lines.origin, lines.direction, lines.limit, lines.own, lines.colour, self._fmts
        )
        self._count(lines, tests)
        return {"sum": self._fmts.shade.saturate(lines.base + left)}

    def _count(self, lines: Lines, tests: int) -> None:
        """The model's number of tests is the sum of those of each ray."""
        assert tests == sum(sum(self._tests(own)) for own in lines.own.tolist())

    def _tests(self, own: int) -> tuple[bool, ...]:
        """Of a ray that starts on a triangle, or MISS: which of its tests count; one that does not where
        there is nothing to test."""
        counts = [
            not (isinstance(shape, Flat) and shape.dead)
            for number, shape in enumerate(self.objects.shapes)
            if number != own
        ]
        return tuple(counts) or (False,)


def scene(spheres: Sequence[Sphere], triangles: Sequence[Triangle]) -> Scene:
    """These objects; nothing else of a scene matters here."""
    return Scene(_CAMERA, (), tuple(spheres), tuple(triangles), BLACK, BLACK)


def vector(values: Raw) -> Vec3:
    """Numbers of shape (3,) as those of a scene."""
    x, y, z = values.tolist()
    return x, y, z


def material(transparency: Vec3) -> Material:
    """One that lets so much light through."""
    return Material(BLACK, BLACK, BLACK, transparency=transparency)


def drawn_table(generator: Generator, spheres: int, triangles: int, p: Parameters) -> Table:
    """So many objects: opaque ones and glass, some with an earlier one's shape, triangles without area."""
    balls: list[Sphere] = []
    for _ in range(spheres):
        center, radius = _place(generator), int(generator.integers(1, RADIUS.max, endpoint=True))
        if balls and generator.random() < _AGAIN:
            twin = balls[generator.integers(len(balls))]
            center, radius = twin.center, twin.radius
        balls.append(Sphere(_any_material(generator), center, radius))
    flats: list[Triangle] = []
    for _ in range(triangles):
        a, b, c = (_place(generator) for _ in range(3))
        corners = (a, b, b if generator.random() < _DEAD else c)
        if flats and generator.random() < _AGAIN:
            corners = flats[generator.integers(len(flats))].vertices
        flats.append(Triangle(_any_material(generator), corners))
    return Table(scene(balls, flats), p)


def _place(generator: Generator) -> Vec3:
    return vector(np.rint(generator.uniform(-_REACH, _REACH, 3) * BOOK.one).astype(np.int64))


def _any_material(generator: Generator) -> Material:
    usual = generator.integers(0, COLOUR.one, 3, endpoint=True)
    large = generator.integers(0, COLOUR.max, 3, endpoint=True)
    one_channel = usual * np.eye(3, dtype=np.int64)[generator.integers(3)]
    choices = [np.zeros_like(usual), usual, np.full_like(usual, COLOUR.one), one_channel, large]
    return material(vector(choices[generator.integers(len(choices))]))


def drawn_lines(generator: Generator, table: Table, size: int, p: Parameters) -> Lines:
    """Rays that are aimed at the objects; half of those that can start on a triangle, just before it."""
    fmts = selected(p)
    targets, starts = (_places(generator, table, size, fmts) for _ in range(2))
    origin = generator.uniform(-_FAR, _FAR, (3, size))
    flat = np.flatnonzero(table.objects.triangle)
    own = np.full(size, MISS, dtype=np.int64)
    if flat.size:
        own = np.where(generator.random(size) < 0.5, generator.choice(flat, size), MISS)
    for number in np.unique(own[own != MISS]):
        origin = np.where(own == number, starts[number], origin)
    target = generator.uniform(-_REACH, _REACH, (3, size))
    aim = generator.integers(0, max(1, table.number), size)
    for number in range(table.number):
        target = np.where(aim == number, targets[number], target)
    way = vectors.unit(target - origin)
    direction = vectors.truncated(way, fmts.unit)
    before = np.where(own != MISS, _STEP_BEFORE, 0.0)
    start = vectors.truncated(origin - way * before, fmts.point)
    best, _ = nearest(table.objects, start, direction, own, fmts)
    anywhere = vectors.truncated(generator.uniform(0.0, 2 * _FAR, size), fmts.point)
    shade = fmts.shade
    colour, base = (
        vectors.pick(
            generator,
            generator.integers(0, shade.one, (3, size), endpoint=True),
            generator.integers(0, shade.max, (3, size), endpoint=True),
            generator.choice([0, 1, shade.one, shade.max], (3, size)),
        )
        for _ in range(2)
    )
    limit = vectors.pick(generator, rays.limits(generator, best.distance, fmts), anywhere)
    return Lines(start, direction, own, limit, colour, base)


def _places(generator: Generator, table: Table, size: int, fmts: Formats) -> list[vectors.Floats]:
    """Of each object places (3, n): within a triangle; in a sphere, half of them at its rim."""
    places = []
    for shape in table.objects.shapes:
        if isinstance(shape, Flat):
            weight = generator.dirichlet([1.0, 1.0, 1.0], size).T
            corners = [fmts.coord.to_float(corner) for corner in shape.corners]
            places.append(sum(w * corner for w, corner in zip(weight, corners, strict=True)))
        else:
            radius = np.sqrt(fmts.radius_sq.to_float(shape.radius_sq))
            share = vectors.pick(generator, generator.random(size), np.ones(size))
            places.append(
                fmts.coord.to_float(shape.center) + radius * share * vectors.directions(generator, size)
            )
    return places


@dataclass(frozen=True)
class Frame:
    """What is drawn of a frame: numbers of objects, kinds of rays, and the seed of all else."""

    spheres: int
    triangles: int
    kinds: Sequence[bool]
    seed: int

    def make(self, p: Parameters) -> tuple[Table, list[Job]]:
        """Its table, and its rays."""
        generator = np.random.default_rng(self.seed)
        flats = min(self.triangles, p["OBJECTS"] - self.spheres)
        table = drawn_table(generator, self.spheres, flats, p)
        lines = drawn_lines(generator, table, len(self.kinds), p)
        return table, table.jobs(lines, self.kinds, generator)
