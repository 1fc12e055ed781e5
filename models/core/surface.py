"""Where a ray hits and which way the surface faces: models of ``hdl/shade/surface.v`` and ``reflect.v``."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from models.arith import dot, vec_scale
from models.fixed import Format, Raw
from models.formats import Formats


class Surface(NamedTuple):
    """Hit points (3, n) in `point` and normals (3, n) in `unit`, turned toward the viewer."""

    point: Raw
    normal: Raw


def surface(
    origin: Raw,
    direction: Raw,
    triangle: NDArray[np.bool_],
    leaving: NDArray[np.bool_],
    distance: Raw,
    offset: Raw,
    half_chord: Raw,
    center: Raw,
    inv_radius: Raw,
    normal: Raw,
    fmts: Formats,
) -> Surface:
    """Point and normal of hits, see ``hdl/shade/surface.v``.

    A sphere's point is center - m, its normal -+m / r with m = q +- h I; a triangle's point is o + t I.
    """
    point, frac = fmts.point, fmts.point.frac_bits
    along = vec_scale(np.where(triangle, distance, half_chord), direction, fmts.unit, point, point)
    m = np.where(leaving, offset - along, offset + along)
    seen_from_center = (center << (frac - fmts.coord.frac_bits)) - m
    place = point.saturate(np.where(triangle, origin + along, seen_from_center))
    turned = fmts.offset.saturate(np.where(leaving, m, -m))
    signed_inverse = Format(fmts.inv_radius.int_bits + 1, fmts.inv_radius.frac_bits)
    round_normal = vec_scale(inv_radius, turned, fmts.offset, signed_inverse, fmts.unit)
    flat_normal = fmts.unit.saturate(np.where(leaving, -normal, normal))
    return Surface(place, np.where(triangle, flat_normal, round_normal))


class Reflected(NamedTuple):
    """R (3, n) and N.V (n,), both in `unit`."""

    mirrored: Raw
    cosine: Raw


def reflect(direction: Raw, normal: Raw, fmts: Formats) -> Reflected:
    """R = V - 2 (N.V) N: model of ``hdl/shade/reflect.v``."""
    cosine = dot(normal, direction, fmts.unit, fmts.unit, fmts.unit)
    along = vec_scale(cosine, normal, fmts.unit, fmts.unit, fmts.unit)
    return Reflected(fmts.unit.saturate(direction - 2 * along), cosine)
