"""Ray and triangle: the triangle's half of ``hdl/trace/intersection.v`` (book 8.2.2).

Inside or outside is decided in the plane across the ray, as Woop, Benthin and Wald do (Watertight
Ray/Triangle Intersection, 2013), without their division: each corner is seen from the ray's origin, rounded
to a mantissa of its own exponent, and moved along the ray onto that plane. What becomes of a corner depends
on the ray and the corner alone, and the sign of an edge's area is exact for the corners so moved. So
triangles that share edges or corners leave no gap. The exponents do not matter: both products of an edge have
the same one.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from models.arith import block_shift, exact_dot, resize, truncating_divide
from models.fixed import Format, Raw
from models.formats import Formats
from models.limits import T_MIN

DISTANCE_INT = 8
"""Integer bits of a quotient: a triangle farther than 2**8 is not hit."""


class TriangleHit(NamedTuple):
    """Of n tests: hit or not, back side or not, distance (n,) in `point`; inside: the ray passes within the
    edges."""

    hit: NDArray[np.bool_]
    leaving: NDArray[np.bool_]
    distance: Raw
    inside: NDArray[np.bool_]


def dominant_axis(direction: Raw) -> Raw:
    """Number of the longest component of directions (3, n), the first of equal ones: shape (n,)."""
    return np.asarray(np.abs(direction).argmax(axis=0))


def triangle_intersect(
    origin: Raw,
    direction: Raw,
    corners: tuple[Raw, Raw, Raw],
    normal: Raw,
    limit: Raw | int,
    fmts: Formats,
) -> TriangleHit:
    """Where rays (3, n) meet triangles at ``T_MIN <= t < limit``.

    Corners (3, n) or (3, 1) in `coord`, unit normals likewise in `unit`.
    """
    seen = [_seen(corner, origin, fmts) for corner in corners]
    inside = _inside(*_areas([mantissa for mantissa, _ in seen], direction, fmts))
    facing = exact_dot(direction, normal)
    away = np.asarray(facing > 0)
    mantissa, shift = seen[0]
    behind = exact_dot(mantissa, normal)
    distance, far = _distance(np.abs(behind), shift, np.abs(facing), fmts)
    same_side = (behind > 0) == away
    t_min = int(T_MIN * fmts.point.one)
    hit = inside & same_side & ~far & (distance >= t_min) & (distance < limit)
    return TriangleHit(hit, away, distance, inside)


def _seen(corner: Raw, origin: Raw, fmts: Formats) -> tuple[Raw, Raw]:
    """Corners from the ray's origin, as mantissas (3, n) in `mantissa` and their shifts (n,)."""
    reach = (corner << (fmts.point.frac_bits - fmts.coord.frac_bits)) - origin
    shifted = block_shift(reach, fmts.reach.width, fmts.mantissa.width)
    return shifted.vector, shifted.shift


def edge_areas(
    origin: Raw, direction: Raw, corners: tuple[Raw, Raw, Raw], fmts: Formats
) -> tuple[Raw, Raw, Raw]:
    """Areas (n,) that the ray makes with each edge: 0 where it passes through the edge's line."""
    return _areas([_seen(corner, origin, fmts)[0] for corner in corners], direction, fmts)


def _areas(seen: list[Raw], direction: Raw, fmts: Formats) -> tuple[Raw, Raw, Raw]:
    """Of the edges of corners that are moved along the ray onto the plane across it."""
    along = dominant_axis(direction)
    places = np.arange(direction.shape[1])
    axes = [(along + turn) % 3 for turn in (1, 2)]
    depth = direction[along, places]
    product = Format(fmts.unit.int_bits + fmts.mantissa.int_bits + 1, fmts.unit.frac_bits + _frac(fmts))
    moved = []
    for mantissa in seen:
        corner = np.broadcast_to(mantissa, direction.shape)
        behind = corner[along, places]
        moved.append(
            [
                resize(depth * corner[axis, places] - direction[axis, places] * behind, product, fmts.unit)
                for axis in axes
            ]
        )
    (ax, ay), (bx, by), (cx, cy) = moved
    return ax * by - ay * bx, bx * cy - by * cx, cx * ay - cy * ax


def _inside(*edges: Raw) -> NDArray[np.bool_]:
    """Whether the plane's origin, where the ray is, lies within the edges of these areas, edges included."""
    least, most = np.minimum.reduce(edges), np.maximum.reduce(edges)
    # Both hold where all areas are 0: seen from here the triangle is a line or a point, and it is not hit.
    # Its neighbours have the same edges, so that leaves no gap either.
    return np.asarray((least >= 0) ^ (most <= 0))


def _frac(fmts: Formats) -> int:
    return fmts.mantissa.frac_bits


def _distance(behind: Raw, shift: Raw, facing: Raw, fmts: Formats) -> tuple[Raw, NDArray[np.bool_]]:
    """Distance (n,) in `point`, truncated, and where it is not below 2**8 or the ray is parallel.

    behind: exact dot product of a normal and a mantissa; facing: exact product of a normal and a direction.
    """
    weight = fmts.reach.int_bits - 1 + fmts.plane.frac_bits - fmts.unit.frac_bits - _frac(fmts)
    plane = (behind << weight) >> shift if weight >= 0 else behind >> (shift - weight)
    plane = fmts.plane.saturate(plane)
    across = fmts.facing.resize(facing, 2 * fmts.unit.frac_bits)
    far = plane >= (across << DISTANCE_INT)
    frac = fmts.point.frac_bits
    numerator, denominator = np.where(far, 0, plane), np.where(far, 1, across)
    quotient = truncating_divide(numerator, denominator, frac, bits=fmts.plane.width + frac)
    return quotient, np.asarray(far)
