"""Distances at which rays hit objects (book, 8.2.2), and the nearest of them.

A distance is a hit where T_MIN <= t < INFINITY; all else is `inf`.
"""

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from models.fixed import BOOK, RADIUS
from models.limits import INFINITY, T_MIN
from models.reference.vectors import Bools, Floats, Ints, column, dot, normalise
from models.scene.types import Scene, Sphere, Triangle

_T_MIN, _INFINITY = float(T_MIN), float(INFINITY)


class Shape(Protocol):
    """The geometry of an object."""

    def distance(self, origin: Floats, direction: Floats) -> Floats:
        """(n,) distances of the hits of rays (3, n) with unit directions, `inf` where they miss."""

    def normal(self, point: Floats) -> Floats:
        """Unit outward normals (3, n) at points of the surface; a triangle's is (p1 - p0) x (p2 - p0)."""


@dataclass(frozen=True)
class SphereShape:
    """Center (3, 1) and radius."""

    center: Floats
    radius: float

    @classmethod
    def of(cls, sphere: Sphere) -> "SphereShape":
        """The sphere of a scene in numbers."""
        return cls(column(sphere.center), sphere.radius / RADIUS.one)

    def distance(self, origin: Floats, direction: Floats) -> Floats:
        """The smaller root that is at least T_MIN: from inside, the far one."""
        center = self.center - origin
        along = dot(direction, center)
        disc = along * along - dot(center, center) + self.radius * self.radius
        root = np.sqrt(np.maximum(disc, 0.0))
        near, far = along - root, along + root
        return _hit(np.where(near >= _T_MIN, near, far), disc >= 0)

    def normal(self, point: Floats) -> Floats:
        """Away from the center."""
        return normalise(point - self.center)


@dataclass(frozen=True)
class TriangleShape:
    """Corners (3, 1) each, and the plane's normal (3, 1), not of unit length.

    Inside or outside is decided in the plane across the ray: each corner's place there depends on the ray and
    the corner alone, and the sign of an edge's area is right or 0, which counts as inside (Woop et al.:
    Watertight Ray/Triangle Intersection, 2013). So triangles that share edges or corners leave no gap.
    """

    corners: tuple[Floats, Floats, Floats]
    plane: Floats

    @classmethod
    def of(cls, triangle: Triangle) -> "TriangleShape":
        """The triangle of a scene in numbers; the normal is exact before it is rounded once."""
        p0, p1, p2 = (np.array(vertex, dtype=np.int64) for vertex in triangle.vertices)
        plane = np.cross(p1 - p0, p2 - p0).astype(np.float64)[:, None] / BOOK.one**2
        a, b, c = (column(vertex) for vertex in triangle.vertices)
        return cls((a, b, c), plane)

    @property
    def is_degenerate(self) -> bool:
        """Without area; it is never hit."""
        return not self.plane.any()

    def distance(self, origin: Floats, direction: Floats) -> Floats:
        """Both sides are hit, edges and corners belong to the triangle, parallel rays miss."""
        if self.is_degenerate:
            return np.full(direction.shape[1], np.inf)
        across = _axes_across(direction)
        (ax, ay), (bx, by), (cx, cy) = (
            [dot(corner - origin, axis) for axis in across] for corner in self.corners
        )
        sides = (ax * by - ay * bx, bx * cy - by * cx, cx * ay - cy * ax)
        least, most = np.minimum.reduce(sides), np.maximum.reduce(sides)
        facing = dot(self.plane, direction)
        inside = ((least >= 0) | (most <= 0)) & (facing != 0)
        t = dot(self.plane, self.corners[0] - origin) / np.where(facing != 0, facing, 1.0)
        return _hit(t, inside)

    def normal(self, point: Floats) -> Floats:
        """The same everywhere."""
        return np.broadcast_to(normalise(self.plane), point.shape)


def _axes_across(direction: Floats) -> tuple[Floats, Floats]:
    """Two unit vectors (3, n) perpendicular to each unit direction and to each other.

    Duff et al.: Building an Orthonormal Basis, Revisited, 2017.
    """
    x, y, z = direction
    sign = np.copysign(1.0, z)
    a = -1 / (sign + z)
    b = x * y * a
    return np.stack([1 + sign * x * x * a, sign * b, -sign * x]), np.stack([b, sign + y * y * a, -y])


def shapes(scene: Scene) -> tuple[Shape, ...]:
    """The shapes of a scene by object number."""
    return (
        *(SphereShape.of(sphere) for sphere in scene.spheres),
        *(TriangleShape.of(triangle) for triangle in scene.triangles),
    )


def nearest(objects: tuple[Shape, ...], origin: Floats, direction: Floats) -> tuple[Floats, Ints]:
    """Distance (n,) and object number (n,) of each ray's nearest hit, `inf` and -1 where there is none.

    Of equal distances the lowest object number's counts.
    """
    best = np.full(direction.shape[1], np.inf)
    number = np.full(direction.shape[1], -1, dtype=np.int64)
    for candidate, shape in enumerate(objects):
        distance = shape.distance(origin, direction)
        nearer = distance < best
        best[nearer] = distance[nearer]
        number[nearer] = candidate
    return best, number


def _hit(t: Floats, exists: Bools) -> Floats:
    return np.where(exists & (t >= _T_MIN) & (t < _INFINITY), t, np.inf)
