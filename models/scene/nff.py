"""NFF, the Neutral File Format of E. Haines' Standard Procedural Databases.

Read: `v` (from, at, up, the full vertical angle, hither, resolution), `b`, `l x y z [r g b]`,
`f r g b Kd Ks Shine T ior`, `s`, `p`, `pp`, comments after `#`. A light without a colour gets sqrt(n)/n of
each channel, n the number of lights. Diffuse is the colour times Kd, specular and reflection are Ks,
transparency is T, the refractive index is the nearest code for ior, ambient light is 0. Shine, hither and the
normals of `pp` are read and not used. Polygons become fans of triangles. All else is refused by its name.

The whole scene is scaled by one factor to suit the core's numbers, see `models.scene.nff_scale`.
"""

import math
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import NoReturn, TypeVar

from models.scene import numbers
from models.scene.errors import SceneError
from models.scene.nff_scale import Drawing, Point, convert, fit
from models.scene.types import BLACK, Material, SceneFile, Vec3, View

_REFUSED = {
    "c": "cones and cylinders are not drawn by the core",
    "t": "triangular patches are not drawn by the core",
    "tt": "textured triangular patches are not drawn by the core",
    "patch": "patches are not drawn by the core",
}
_VIEW_NUMBERS = {"from": 3, "at": 3, "up": 3, "angle": 1, "hither": 1, "resolution": 2}
T = TypeVar("T")
_FLAT = 1e-9
"""Fan triangles that face back by less than this share of the polygon are its rounding, not its shape."""


def parse(text: str, path: Path) -> SceneFile:
    """The scene of an NFF text, its view and remarks; SceneError names the line and the entity.

    `path` is only said, not read.
    """
    reader = _Reader(text, path)
    drawing = reader.read()
    chosen = reader.guard(lambda: fit(drawing), None, "")
    scene, remark = reader.guard(lambda: convert(drawing, chosen), None, "")
    return SceneFile(scene, reader.view(), (remark, *reader.notes), path, path.stem, square_pixels=True)


class _Reader:
    """Reads one file line by line; lines without content are gone, the others keep their numbers."""

    def __init__(self, text: str, path: Path) -> None:
        self._path = path
        content = ((number, line.split("#")[0].split()) for number, line in enumerate(text.split("\n"), 1))
        self._lines = [(number, tokens) for number, tokens in content if tokens]
        self._next = 0
        self._number = 0
        self._view: dict[str, list[float]] = {}
        self._material: Material | None = None
        self._lights: list[tuple[Point, Vec3 | None]] = []
        self.notes: list[str] = []
        self._drawing = Drawing()

    def read(self) -> Drawing:
        entities: dict[str, Callable[[list[str]], None]] = {
            "v": self._viewpoint,
            "b": self._background,
            "l": self._light,
            "f": self._fill,
            "s": self._sphere,
            "p": lambda tokens: self._polygon("p", tokens, 3),
            "pp": lambda tokens: self._polygon("pp", tokens, 6),
        }
        while self._next < len(self._lines):
            name, *tokens = self._take()
            if name in _REFUSED:
                self._fail(name, _REFUSED[name])
            if name not in entities:
                self._fail(name[:20], f"is not an entity of NFF; known are {', '.join(entities)}")
            entities[name](tokens)
        if not self._view:
            raise SceneError(self._path, None, "v", "is missing; a viewpoint is needed")
        share = numbers.colour(math.sqrt(len(self._lights)) / len(self._lights)) if self._lights else 0
        lights = [(place, colour or (share, share, share)) for place, colour in self._lights]
        return replace(self._drawing, lights=lights)

    def view(self) -> View:
        """Square pixels, the file's angle and resolution."""
        width, height = (int(number) for number in self._view["resolution"])
        return View.square(width, height, self._view["angle"][0])

    def guard(self, work: Callable[[], T], line: int | None, field: str) -> T:
        """What `work` gives; its ValueError becomes the SceneError of a line."""
        try:
            return work()
        except ValueError as error:
            raise SceneError(self._path, line, field, str(error)) from None

    def _take(self) -> list[str]:
        self._number, tokens = self._lines[self._next]
        self._next += 1
        return tokens

    def _fail(self, field: str, problem: str) -> NoReturn:
        raise SceneError(self._path, self._number, field, problem)

    def _floats(self, field: str, tokens: list[str], *counts: int) -> list[float]:
        if len(tokens) not in counts:
            wanted = " or ".join(str(count) for count in counts)
            self._fail(field, f"takes {wanted} numbers, not {len(tokens)}")
        values = []
        for token in tokens:
            try:
                values.append(float(token))
            except ValueError:
                self._fail(field, f"{token[:20]!r} is not a number")
            if not math.isfinite(values[-1]):
                self._fail(field, f"{token[:20]!r} is not a finite number")
        return values

    def _colour(self, field: str, values: list[float]) -> Vec3:
        red, green, blue = (
            self.guard(partial(numbers.colour, value), self._number, field) for value in values
        )
        return (red, green, blue)

    def _viewpoint(self, tokens: list[str]) -> None:
        self._floats("v", tokens, 0)
        if self._view:
            self._fail("v", "stands a second time; one viewpoint is drawn")
        entity = self._number
        while self._next < len(self._lines) and self._lines[self._next][1][0] in _VIEW_NUMBERS:
            name, *rest = self._take()
            if name in self._view:
                self._fail(f"v.{name}", "stands a second time")
            self._view[name] = self._floats(f"v.{name}", rest, _VIEW_NUMBERS[name])
            self._check_view(name, self._view[name])
        for name in _VIEW_NUMBERS:
            if name not in self._view:
                raise SceneError(self._path, entity, f"v.{name}", "is missing")
        place, at, up = ((*self._view[name],) for name in ("from", "at", "up"))
        self._drawing = replace(self._drawing, place=_point(place), at=_point(at), up=_point(up))

    def _check_view(self, name: str, values: list[float]) -> None:
        if name == "angle" and not 0 < values[0] < 180:
            self._fail("v.angle", f"{values[0]:g} is not between 0 and 180 degrees")
        if name == "resolution" and not all(value >= 1 and value.is_integer() for value in values):
            self._fail("v.resolution", "is not a width and a height in whole pixels")

    def _background(self, tokens: list[str]) -> None:
        colour = self._colour("b", self._floats("b", tokens, 3))
        self._drawing = replace(self._drawing, background=colour)

    def _light(self, tokens: list[str]) -> None:
        values = self._floats("l", tokens, 3, 6)
        colour = self._colour("l", values[3:]) if values[3:] else None
        self._lights.append((_point(values[:3]), colour))

    def _fill(self, tokens: list[str]) -> None:
        *rgb, kd, ks, _shine, transparency, ior = self._floats("f", tokens, 8)
        specular = self._colour("f.Ks", [ks] * 3)
        index = 0
        if transparency:
            index = self.guard(partial(numbers.refractive_index, ior), self._number, "f.ior")
        self._material = Material(
            ambient=BLACK,
            diffuse=self._colour("f.Kd", [channel * kd for channel in rgb]),
            specular=specular,
            reflection=specular,
            transparency=self._colour("f.T", [transparency] * 3),
            index=index,
        )
        if transparency and self._material.refractive_index != ior:
            became = self._material.refractive_index
            self.notes.append(f"line {self._number}: the refractive index {ior:g} became {became:g}")

    def _fill_of(self, field: str) -> Material:
        if self._material is None:
            self._fail(field, "stands before the first f; give it a fill colour")
        return self._material

    def _sphere(self, tokens: list[str]) -> None:
        values = self._floats("s", tokens, 4)
        if values[3] <= 0:
            self._fail("s", f"{values[3]:g} is not a radius")
        self._drawing.spheres.append((self._fill_of("s"), _point(values[:3]), values[3]))

    def _polygon(self, name: str, tokens: list[str], numbers_a_line: int) -> None:
        entity = self._number
        (count,) = self._floats(name, tokens, 1)
        if count < 3 or not count.is_integer():
            self._fail(name, f"{tokens[0][:20]} is not a number of vertices")
        material = self._fill_of(name)
        points: list[Point] = []
        while len(points) < count:
            if self._next == len(self._lines):
                self._fail(name, f"the file ends after {len(points)} of {int(count)} vertices")
            points.append(_point(self._floats(name, self._take(), numbers_a_line)[:3]))
        fan = [(points[0], points[n], points[n + 1]) for n in range(1, len(points) - 1)]
        if not _is_fan(fan):
            raise SceneError(
                self._path, entity, name, "is not convex; cut it into convex polygons or begin elsewhere"
            )
        self._drawing.triangles.extend((material, corners) for corners in fan)


def _point(values: list[float] | tuple[float, ...]) -> Point:
    x, y, z = values
    return (x, y, z)


def _normal(a: Point, b: Point, c: Point) -> Point:
    (ux, uy, uz), (vx, vy, vz) = ([q - p for p, q in zip(a, end, strict=True)] for end in (b, c))
    return (uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx)


def _is_fan(fan: list[tuple[Point, Point, Point]]) -> bool:
    """Whether all triangles face one way, so that together they cover the polygon and nothing else."""
    normals = [_normal(*corners) for corners in fan]
    total = [sum(axis) for axis in zip(*normals, strict=True)]
    limit = _FLAT * sum(component * component for component in total)
    return all(sum(n * t for n, t in zip(normal, total, strict=True)) >= -limit for normal in normals)
