"""Constants of the objects of a frame, once a frame: model of ``hdl/scene/object_setup.v``."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from models.arith import vec_mul
from models.core.unit_vector import unit_vector
from models.fixed import Raw
from models.formats import Formats


@dataclass(frozen=True)
class ObjectConstants:
    """radius squared (n,) in `radius_sq`, 1 / radius (n,) in `inv_radius`, ambient term (3, n) in `shade`."""

    radius_sq: Raw
    inv_radius: Raw
    ambient: Raw


class TriangleNormals(NamedTuple):
    """Unit normals (3, n) in `unit`, and the triangles (n,) without area, whose normal is 0."""

    normal: Raw
    degenerate: NDArray[np.bool_]


@dataclass(frozen=True)
class TriangleConstants:
    """Normals (3, n) in `unit`, triangles (n,) that are never hit, ambient term (3, n) in `shade`."""

    normal: Raw
    degenerate: NDArray[np.bool_]
    ambient: Raw


def cross_bits(fmts: Formats) -> int:
    """Bits of a component that the shared normaliser takes: it holds the cross products of differences of
    coordinates, and of two unit vectors."""
    return max(2 * fmts.unit.width + 1, 2 * (fmts.coord.width + 1) + 1)


def object_setup(radius: Raw, ambient_light: Raw, k_ambient: Raw, fmts: Formats) -> ObjectConstants:
    """What tests and shading need of spheres with these radii (n,), not 0, and coefficients (3, n)."""
    one = 1 << (fmts.inv_radius.frac_bits + fmts.radius.frac_bits)
    ambient = _ambient(ambient_light, k_ambient, fmts)
    return ObjectConstants(np.asarray(radius * radius), np.asarray(one // radius), ambient)


def triangle_setup(
    vertices: tuple[Raw, Raw, Raw], ambient_light: Raw, k_ambient: Raw, fmts: Formats
) -> TriangleConstants:
    """What tests and shading need of triangles with these vertices and coefficients, (3, n) each."""
    normals = triangle_normals(*vertices, fmts)
    return TriangleConstants(normals.normal, normals.degenerate, _ambient(ambient_light, k_ambient, fmts))


def triangle_normals(p0: Raw, p1: Raw, p2: Raw, fmts: Formats) -> TriangleNormals:
    """Directions of (p1 - p0) x (p2 - p0) of vertices (3, n) in `coord`; the product itself is exact."""
    a, b = p1 - p0, p2 - p0
    cross = np.array([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])
    found = unit_vector(cross, cross_bits(fmts), fmts)
    return TriangleNormals(found.unit, found.degenerate)


def _ambient(ambient_light: Raw, k_ambient: Raw, fmts: Formats) -> Raw:
    return vec_mul(ambient_light, k_ambient, fmts.coeff, fmts.coeff, fmts.shade)
