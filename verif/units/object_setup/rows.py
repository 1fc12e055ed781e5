"""What the set-up of the objects must write, by its definition: rows from integers and fractions."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import floor

import numpy as np

from models.core.unit_vector import unit_vector
from models.formats import Knobs, formats
from models.latency import LATENCY
from models.limits import RECORD_SLOTS, SPHERE_SLOTS
from models.scene.types import Material, Sphere, Triangle, Vec3

FORMATS = formats(Knobs())
SLOT_W = FORMATS.coord.width
COUNT_W = 8
SHAPE_W = 3 * FORMATS.unit.width
SLOTS = {"sphere": SPHERE_SLOTS, "triangle": RECORD_SLOTS}
ROW = ("table_index", "table_geometry", "table_surface", "table_material", "degenerate")

Row = Mapping[str, int]
"""An object's number and its three rows by port, as unsigned numbers."""


@dataclass(frozen=True)
class Frame:
    """What is set up, and the clocks that the normaliser takes meanwhile."""

    ambient: Vec3
    spheres: tuple[Sphere, ...]
    triangles: tuple[Triangle, ...]
    normaliser: int

    @property
    def clocks(self) -> int:
        """The time from start to done that the header promises."""
        counts = {"SPHERES": len(self.spheres), "TRIANGLES": len(self.triangles)}
        return LATENCY["object_setup"]({**counts, "NORMALISER": self.normaliser})

    def records(self) -> dict[str, list[int]]:
        """The records by port, as the loader gathers them."""
        return {
            "sphere": [packed([0, *_material(s.material), *s.center, s.radius]) for s in self.spheres],
            "triangle": [packed([1, *_material(t.material), *_flat(t.vertices)]) for t in self.triangles],
        }


def _flat(vectors: Sequence[Vec3]) -> list[int]:
    return [component for vector in vectors for component in vector]


def _material(material: Material) -> list[int]:
    colours = (material.ambient, material.diffuse, material.specular, material.reflection)
    return [*_flat((*colours, material.transparency)), material.index]


def packed(values: Sequence[int], width: int = SLOT_W) -> int:
    """Numbers side by side, the first one in the most significant bits."""
    word = 0
    for value in values:
        word = word << width | value & ((1 << width) - 1)
    return word


def cross(triangle: Triangle) -> Vec3:
    """The exact product (p1 - p0) x (p2 - p0), raw."""
    p0, p1, p2 = triangle.vertices
    a, b = ([to - of for to, of in zip(p, p0, strict=True)] for p in (p1, p2))
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def direction(vector: Vec3, bits: int) -> list[int]:
    """What the normaliser makes of a vector."""
    column = np.array(vector, dtype=np.int64).reshape(3, 1)
    return [int(lane) for lane in unit_vector(column, bits, FORMATS).unit[:, 0]]


def _ambient(light: Vec3, coefficient: Vec3) -> list[int]:
    unit = Fraction(FORMATS.shade.one, FORMATS.coeff.one**2)
    return [min(floor(a * b * unit), FORMATS.shade.max) for a, b in zip(light, coefficient, strict=True)]


def _concatenated(*parts: tuple[int, int]) -> int:
    """Pairs of value and width, the first one in the most significant bits."""
    word = 0
    for value, width in parts:
        assert 0 <= value < 1 << width, f"{value} in {width} bits"
        word = word << width | value
    return word


def _material_row(light: Vec3, material: Material) -> int:
    colours = (material.diffuse, material.specular, material.reflection, material.transparency)
    ambient = packed(_ambient(light, material.ambient), FORMATS.shade.width)
    return _concatenated((ambient, 3 * FORMATS.shade.width), (packed(_flat(colours)), 12 * SLOT_W))


def _rows(
    material: Material, shape: tuple[int, int], places: Sequence[Vec3], dead: bool, light: Vec3
) -> dict[str, int]:
    """Rows of an object; ``shape``: what tests and what shading need. A sphere has one place, its center."""
    triangle = int(len(places) > 1)
    tested, shaded = shape
    vertices = _flat(places) + [0] * (9 - 3 * len(places))
    center = [0, 0, 0] if triangle else places[0]
    glass = int(any(material.transparency))
    transparency = (packed(material.transparency), 3 * SLOT_W)
    return {
        "table_geometry": _concatenated(
            (triangle, 1),
            (int(dead), 1),
            (glass, 1),
            (tested, SHAPE_W),
            (packed(vertices), 9 * SLOT_W),
            transparency,
        ),
        "table_surface": _concatenated(
            (triangle, 1), (material.index, 4), (shaded, SHAPE_W), (packed(center), 3 * SLOT_W)
        ),
        "table_material": _material_row(light, material),
        "degenerate": int(dead),
    }


def _sphere_rows(sphere: Sphere, light: Vec3) -> dict[str, int]:
    """Radius squared, 1 / radius and ambient term straight from their definitions."""
    size = Fraction(sphere.radius, FORMATS.radius.one)
    square = size * size * FORMATS.radius_sq.one
    assert square.denominator == 1, "radius squared is not exact in its format"
    shape = (int(square), floor(FORMATS.inv_radius.one / size))
    return _rows(sphere.material, shape, (sphere.center,), dead=False, light=light)


def _triangle_rows(triangle: Triangle, light: Vec3, bits: int) -> dict[str, int]:
    exact = cross(triangle)
    normal = packed(direction(exact, bits), FORMATS.unit.width)
    return _rows(triangle.material, (normal, normal), triangle.vertices, not any(exact), light)


def expected(frame: Frame, bits: int) -> list[Row]:
    """Every row of a frame, in order, from the definitions."""
    rows = [_sphere_rows(sphere, frame.ambient) for sphere in frame.spheres]
    rows += [_triangle_rows(triangle, frame.ambient, bits) for triangle in frame.triangles]
    return [{"table_index": number, **row} for number, row in enumerate(rows)]
