"""The objects of a frame after its set-up: what the core's object tables hold, by object number.

Spheres first, then triangles, as the scene numbers them.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from models.core.setup import object_setup, triangle_normals
from models.core.sphere import sphere_intersect
from models.core.triangle import triangle_intersect
from models.fixed import Raw
from models.formats import Formats
from models.scene.types import Scene, Sphere, Triangle, Vec3


def column(vector: Vec3) -> Raw:
    """A raw vector as a column (3, 1)."""
    return np.array(vector, dtype=np.int64).reshape(3, 1)


@dataclass(frozen=True)
class Found:
    """What one test of n rays against one object says.

    hit, leaving (n,); distance (n,) in `point`; offset (3, n) and half_chord (n,) of a sphere, zero else.
    """

    hit: NDArray[np.bool_]
    leaving: NDArray[np.bool_]
    distance: Raw
    offset: Raw
    half_chord: Raw


@dataclass(frozen=True)
class Solid:
    """A sphere of the tables: center (3, 1) in `coord`, radius squared (1,)."""

    center: Raw
    radius_sq: Raw
    own: bool = False
    """A ray that starts on it may meet it again."""

    def test(self, origin: Raw, direction: Raw, limit: Raw | int, fmts: Formats) -> Found:
        """n rays against the sphere."""
        found = sphere_intersect(origin, direction, self.center, self.radius_sq, limit, fmts)
        return Found(found.hit, found.leaving, found.distance, found.offset, found.half_chord)


@dataclass(frozen=True)
class Flat:
    """A triangle of the tables: corners and unit normal (3, 1); dead: it has no area and is never hit."""

    corners: tuple[Raw, Raw, Raw]
    normal: Raw
    dead: bool
    own: bool = True
    """A ray that starts on it cannot meet it again, whatever rounding says."""

    def test(self, origin: Raw, direction: Raw, limit: Raw | int, fmts: Formats) -> Found:
        """n rays against the triangle."""
        found = triangle_intersect(origin, direction, self.corners, self.normal, limit, fmts)
        nothing = np.zeros_like(found.distance)
        return Found(
            found.hit, found.leaving, found.distance, np.broadcast_to(nothing, (3, *nothing.shape)), nothing
        )


@dataclass(frozen=True)
class Objects:
    """All objects: shapes by number; tables of shape (3, objects) or (objects,), raw.

    triangle: it is one. center: of a sphere, in `coord`. inv_radius: of a sphere. normal: of a triangle.
    ambient: ambient light times k_ambient, in `shade`. diffuse, specular, reflection, transparency: in
    `coeff`. index: code of the refractive index. degenerate: triangles without area.
    """

    shapes: tuple[Solid | Flat, ...]
    triangle: NDArray[np.bool_]
    center: Raw
    inv_radius: Raw
    normal: Raw
    ambient: Raw
    diffuse: Raw
    specular: Raw
    reflection: Raw
    transparency: Raw
    index: Raw

    @property
    def degenerate(self) -> int:
        """How many triangles have no area."""
        return sum(isinstance(shape, Flat) and shape.dead for shape in self.shapes)

    @classmethod
    def of(cls, scene: Scene, fmts: Formats) -> "Objects":
        """Set-up of a scene's objects."""
        spheres, triangles = scene.spheres, scene.triangles
        count = len(spheres) + len(triangles)
        materials = [thing.material for thing in scene.objects]

        def table(name: str) -> Raw:
            rows = [getattr(material, name) for material in materials]
            return np.array(rows, dtype=np.int64).reshape(-1, 3).T

        radii = np.array([sphere.radius for sphere in spheres] + [1] * len(triangles), dtype=np.int64)
        constants = object_setup(radii, column(scene.ambient), table("ambient"), fmts)
        center = np.zeros((3, count), dtype=np.int64)
        normal = np.zeros((3, count), dtype=np.int64)
        shapes: list[Solid | Flat] = []
        for number, sphere in enumerate(spheres):
            center[:, number] = sphere.center
            shapes.append(_solid(sphere, constants.radius_sq[number]))
        for number, triangle in enumerate(triangles, start=len(spheres)):
            flat = _flat(triangle, fmts)
            normal[:, number] = flat.normal[:, 0]
            shapes.append(flat)
        return cls(
            shapes=tuple(shapes),
            triangle=np.arange(count) >= len(spheres),
            center=center,
            inv_radius=constants.inv_radius,
            normal=normal,
            ambient=constants.ambient,
            diffuse=table("diffuse"),
            specular=table("specular"),
            reflection=table("reflection"),
            transparency=table("transparency"),
            index=np.array([material.index for material in materials], dtype=np.int64),
        )


def _solid(sphere: Sphere, radius_sq: Raw) -> Solid:
    return Solid(column(sphere.center), np.asarray(radius_sq).reshape(1))


def _flat(triangle: Triangle, fmts: Formats) -> Flat:
    a, b, c = (column(vertex) for vertex in triangle.vertices)
    normal, degenerate = triangle_normals(a, b, c, fmts)
    return Flat((a, b, c), normal, bool(degenerate[0]))
