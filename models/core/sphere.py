"""Ray and sphere: the sphere's half of ``hdl/trace/intersection.v`` (book 8.2.2)."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from models.arith import dot, isqrt, vec_scale
from models.fixed import Format, Raw
from models.formats import Formats
from models.limits import T_MIN


class SphereHit(NamedTuple):
    """Of n tests: hit or not, far end of the chord or not, distance (n,) in `point`, offset q (3, n) in
    `offset`, half of the chord (n,) in `half_chord`; along (I.c) and discriminant are the stages between."""

    hit: NDArray[np.bool_]
    leaving: NDArray[np.bool_]
    distance: Raw
    offset: Raw
    half_chord: Raw
    along: Raw
    discriminant: Raw


def sphere_intersect(
    origin: Raw, direction: Raw, center: Raw, radius_sq: Raw, limit: Raw | int, fmts: Formats
) -> SphereHit:
    """Where rays (3, n) meet spheres with centers (3, n) or (3, 1) at ``T_MIN <= t < limit``."""
    point, frac = fmts.point, fmts.point.frac_bits
    relative = (center << (frac - fmts.coord.frac_bits)) - origin
    if relative.shape[1] > 1 or np.abs(relative).max() > point.max:
        relative = point.saturate(relative)
    along = dot(direction, relative, fmts.unit, point, point)
    foot = vec_scale(along, direction, fmts.unit, point, point)
    offset = np.subtract(relative, foot, out=foot)
    np.clip(offset, fmts.offset.min, fmts.offset.max, out=offset)
    discriminant = (radius_sq << (2 * frac - fmts.radius_sq.frac_bits)) - _square(offset)
    half_chord = isqrt(discriminant & _radicand_mask(fmts), 2 * fmts.half_chord.width)
    near = along - half_chord
    t_min = int(T_MIN * point.one)
    leaving = np.less(near, t_min)
    distance = np.where(leaving, along + half_chord, near)
    hit = (discriminant >= 0) & (distance >= t_min) & (distance < limit)
    return SphereHit(hit, leaving, point.saturate(distance), offset, half_chord, along, discriminant)


def _square(vector: Raw) -> Raw:
    total = vector[0] * vector[0]
    total += vector[1] * vector[1]
    total += vector[2] * vector[2]
    return np.asarray(total)


def _radicand_mask(fmts: Formats) -> int:
    """What the root sees of a discriminant, a negative one too: its low bits."""
    return Format(2 * fmts.half_chord.width, 0, signed=False).max
