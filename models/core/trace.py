"""Rays against all objects: model of ``hdl/trace/trace_unit.v`` (book 8.2.2, 8.2.3)."""

from dataclasses import dataclass

import numpy as np

from models.arith import vec_mul
from models.core.objects import Flat, Objects, Solid
from models.fixed import Raw
from models.formats import Formats
from models.limits import INFINITY

MISS = -1
"""Object number of a ray that hits nothing, and of none."""


@dataclass(frozen=True)
class Nearest:
    """The nearest hit of each of n rays: object number (n,) or MISS; the rest means nothing where it missed.

    leaving (n,); distance (n,) in `point`; offset (3, n) in `offset` and half_chord (n,), of a sphere.
    """

    number: Raw
    leaving: Raw
    distance: Raw
    offset: Raw
    half_chord: Raw

    def where(self, index: Raw) -> "Nearest":
        """Some of the rays."""
        return Nearest(
            self.number[index],
            self.leaving[index],
            self.distance[index],
            self.offset[:, index],
            self.half_chord[index],
        )


def _tested(shape: Solid | Flat, number: int, own: Raw) -> Raw | None:
    """Indices of the rays that meet an object's test, None for all of them."""
    if isinstance(shape, Flat) and shape.dead:
        return np.empty(0, dtype=np.int64)
    if not shape.own:
        return None
    starts_here = np.equal(own, number)
    return np.flatnonzero(~starts_here) if starts_here.any() else None


def nearest(objects: Objects, origin: Raw, direction: Raw, own: Raw, fmts: Formats) -> tuple[Nearest, int]:
    """The nearest hit of rays (3, n), of equal distances the lowest number's; and how many tests that took.

    own (n,): the triangle that a ray starts on, or MISS.
    """
    rays = direction.shape[1]
    infinity = int(INFINITY * fmts.point.one)
    best = Nearest(
        np.full(rays, MISS, dtype=np.int64),
        np.zeros(rays, dtype=np.int64),
        np.full(rays, infinity, dtype=np.int64),
        np.zeros((3, rays), dtype=np.int64),
        np.zeros(rays, dtype=np.int64),
    )
    tests = 0
    for number, shape in enumerate(objects.shapes):
        tested = _tested(shape, number, own)
        some = slice(None) if tested is None else tested
        found = shape.test(_some(origin, some), direction[:, some], infinity, fmts)
        tests += found.hit.size
        nearer = np.flatnonzero(found.hit & (found.distance < best.distance[some]))
        place = nearer if tested is None else tested[nearer]
        best.number[place] = number
        best.leaving[place] = found.leaving[nearer]
        best.distance[place] = found.distance[nearer]
        best.offset[:, place] = found.offset[:, nearer]
        best.half_chord[place] = found.half_chord[nearer]
    return best, tests


def _some(origin: Raw, index: slice | Raw) -> Raw:
    return origin if origin.shape[1] == 1 else origin[:, index]


def attenuate(
    objects: Objects, origin: Raw, direction: Raw, limit: Raw, own: Raw, colour: Raw, fmts: Formats
) -> tuple[Raw, Raw, int]:
    """What is left of colours (3, n) in `shade` behind all objects on the way, how many those are (n,), and
    how many tests that took.

    Rays (3, n) end at ``limit`` (n,); each object that they meet filters the colour once, in the order of the
    object numbers, floored and saturated each time.
    """
    left = colour.copy()
    objects_met = np.zeros(colour.shape[1], dtype=np.int64)
    tests = 0
    for number, shape in enumerate(objects.shapes):
        tested = _tested(shape, number, own)
        some = slice(None) if tested is None else tested
        found = shape.test(origin[:, some], direction[:, some], limit[some], fmts)
        tests += found.hit.size
        met = np.flatnonzero(found.hit)
        place = met if tested is None else tested[met]
        share = objects.transparency[:, number, None]
        left[:, place] = vec_mul(left[:, place], share, fmts.shade, fmts.coeff, fmts.shade)
        objects_met[place] += 1
    return left, objects_met, tests
