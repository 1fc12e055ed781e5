"""Triangles that share edges and corners, and rays aimed at what they share: none may pass between them."""

from dataclasses import dataclass

import numpy as np
from numpy.random import Generator

from models.core.setup import triangle_normals
from models.fixed import Raw
from models.formats import Formats
from models.header import selected
from models.limits import INFINITY
from verif.env import vectors
from verif.env.definitions import Holds
from verif.env.fields import Operands, concatenate, select
from verif.env.unit import Parameters
from verif.env.vectors import Floats
from verif.units.intersection.triangle_truth import Ray, Truth, clear_of, turn


@dataclass(frozen=True)
class Patch:
    """How triangles share corners: corners of each triangle by number, and the way around all of them.

    Corner 0 is the one that rays are aimed at, or the start of the edge to corner 1 that they are aimed at.
    """

    triangles: tuple[tuple[int, int, int], ...]
    rim: tuple[int, ...]
    closed: bool

    @property
    def points(self) -> int:
        """How many corners there are."""
        return 1 + max(max(triangle) for triangle in self.triangles)


PAIR = Patch(((0, 1, 2), (3, 1, 0)), (0, 2, 1, 3), closed=False)
"""Two triangles with one edge in common."""

FAN = Patch(((0, 1, 2), (3, 0, 2), (0, 4, 3), (4, 0, 5), (1, 5, 0)), (1, 2, 3, 4, 5), closed=True)
"""Five triangles around a corner, some of them seen from the back."""


def _around(generator: Generator, patch: Patch, size: int) -> Floats:
    """Places (points, 2, n) in the plane: of a fan around 0, of a pair to both sides of an edge."""
    reach = 2.0 ** generator.uniform(-3.0, 0.0, (patch.points, size))
    if patch.closed:
        spokes = patch.points - 1
        angle = (
            (np.arange(spokes)[:, None] + generator.uniform(-0.4, 0.4, (spokes, size))) * 2 * np.pi / spokes
        )
        ring = np.stack([np.cos(angle), np.sin(angle)], axis=1) * reach[1:, None]
        return np.concatenate([np.zeros((1, 2, size)), ring])
    sides = np.array([-1.0, 1.0, 0.0, 0.0])[:, None], np.array([0.0, 0.0, -1.0, 1.0])[:, None]
    slide = generator.uniform(-1.0, 1.0, (4, size))
    slide[:2] = 0.0
    return np.stack([sides[0] * reach + slide, sides[1] * reach], axis=1)


def _corners(generator: Generator, patch: Patch, size: int, fmts: Formats) -> Raw:
    """Corners (points, 3, n) in `coord`: patches of many sizes, flat, bent or creased, in any place."""
    extent = 2.0 ** generator.uniform(-3.0, 7.0, size)
    normal = vectors.directions(generator, size)
    u = vectors.across(generator, normal)
    v = np.cross(normal, u, axis=0)
    flat = _around(generator, patch, size)
    bump = generator.standard_normal((patch.points, size)) * generator.choice([0.0, 0.05, 0.4], size)
    place = flat[:, 0, None] * u + flat[:, 1, None] * v + bump[:, None] * normal
    center = generator.uniform(-100.0, 100.0, (3, size)) * generator.choice([0.05, 1.0], size)
    return fmts.coord.saturate(np.rint((center + place * extent) * fmts.coord.one).astype(np.int64))


def rays_at(generator: Generator, patch: Patch, size: int, p: Parameters) -> Operands:
    """Operands of ``size`` patches, the triangles of each one after the other with one and the same ray.

    The ray is aimed at a shared corner or at a place on a shared edge: exactly, or a few steps beside it.
    """
    fmts = selected(p)
    corner = _corners(generator, patch, size, fmts)
    numbers = fmts.coord.to_float(corner)
    share = generator.uniform(0.0, 0.9, size) * generator.choice([0.0, 1.0, 1.0], size)
    target = numbers[0] + share * (numbers[1] - numbers[0])
    square = vectors.unit(np.cross(numbers[1] - numbers[0], numbers[2] - numbers[0], axis=0))
    lean = vectors.directions(generator, size) * generator.uniform(0.0, 0.8, size)
    way = vectors.unit(square * generator.choice([-1.0, 1.0], size) + lean)
    direction = vectors.truncated(way, fmts.unit)
    ahead = 2.0 ** generator.uniform(-3.0, 7.5, size)
    start = np.rint((target - fmts.unit.to_float(direction) * ahead) * fmts.point.one).astype(np.int64)
    beside = generator.integers(-3, 3, (3, size), endpoint=True) * generator.choice([0, 1], size)
    nothing = np.zeros(size, dtype=np.int64)
    ray: dict[str, Raw] = {
        "origin": fmts.point.saturate(start + beside),
        "direction": direction,
        "limit": nothing + int(INFINITY * fmts.point.one),
        "triangle": nothing + 1,
    }
    parts = []
    for triangle in patch.triangles:
        a, b, c = (corner[number] for number in triangle)
        parts.append(
            {
                **ray,
                "shape": triangle_normals(a, b, c, fmts).normal,
                "vertices": np.concatenate([a, b, c]),
            }
        )
    count = len(patch.triangles)
    return select(concatenate(parts), np.arange(count * size).reshape(count, size).T.ravel())


def aimed_within(patch: Patch, p: Parameters, given: Operands) -> Holds:
    """For each patch: the ray passes within its rim, further from it than corners may be off, and meets the
    planes of all its triangles at distances that count. So it must hit one of them.
    """
    count = len(patch.triangles)
    truth = Truth.of(p, given)
    limit = selected(p).point.to_float(given["limit"])
    met = (truth.apt & truth.between(limit)).reshape(-1, count).all(axis=1)
    ray = Ray.of(p, select(given, slice(0, None, count)))
    vertices = given["vertices"].reshape(9, -1, count)
    places: dict[int, Floats] = {}
    for index, triangle in enumerate(patch.triangles):
        for lane, number in enumerate(triangle):
            places[number] = ray.fmts.coord.to_float(vertices[3 * lane : 3 * lane + 3, :, index])
    rim = [ray.sees(places[number]) for number in patch.rim]
    angle, clear = np.zeros(met.size), met
    for start, end in zip(rim, rim[1:] + rim[:1], strict=True):
        clear = clear & clear_of(start, end)
        angle += np.arctan2(turn(start.place, end.place), (start.place * end.place).sum(axis=0))
    return np.asarray(clear & (np.abs(angle) > np.pi))
