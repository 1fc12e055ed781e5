"""The project's own scene files, TOML.

Top level: `ambient`, `background` (colours), `title`, `notes` (texts, optional). Tables: `[camera]` with
position, up, center; `[[lights]]` with position, intensity; `[[spheres]]` with material, center, radius;
`[[triangles]]` with material, vertices; `[materials.<name>]` with ambient, diffuse, specular and, where they
are not black, reflection, transparency, and the refractive index as `n` (1 to 2.875) or as its code `index`
(0 to 15); `[view]` with width, height and the full vertical `angle` in degrees (without it the book's field
of view). A material is the name of one of `[materials]`, or an inline table.

Coordinates and colours are rounded to the nearest step of 1/1024; a radius must be a multiple of 1/8.
"""

import math
import re
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any, NoReturn

from models.scene import numbers
from models.scene.errors import SceneError
from models.scene.frame import FrameError, check_camera
from models.scene.toml_lines import Key, LineIndex
from models.scene.types import (
    BLACK,
    INDEX,
    Camera,
    Light,
    Material,
    Scene,
    SceneFile,
    Sphere,
    Triangle,
    Vec3,
    View,
)

_MAX_PIXELS = 4096
"""Largest width or height of a `[view]`."""


def parse(text: str, path: Path) -> SceneFile:
    """The scene of a TOML text; SceneError names the line and the field of what is wrong.

    `path` is only said, not read.
    """
    try:
        tables = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        found = re.search(r"\(at line (\d+)", str(error))
        line = int(found[1]) if found else max(1, len(text.splitlines()))
        problem = re.sub(r" \(at .*\)$", "", str(error))
        raise SceneError(path, line, "", f"is not TOML: {problem[:1].lower()}{problem[1:]}") from None
    return _Reader(path, LineIndex(text)).scene_file(tables)


class _Reader:
    """Turns the tables of one file into a scene."""

    def __init__(self, path: Path, lines: LineIndex) -> None:
        self._path = path
        self._lines = lines
        self._materials: dict[str, Material] = {}

    def scene_file(self, tables: dict[str, Any]) -> SceneFile:
        optional = ("title", "notes", "lights", "spheres", "triangles", "materials", "view")
        self._table(tables, (), ("camera", "ambient", "background"), optional)
        for name, table in self._named_tables(tables.get("materials", {}), ("materials",)):
            self._materials[name] = self._material(table, ("materials", name))
        scene = Scene(
            camera=self._camera(tables["camera"]),
            lights=tuple(self._light(*item) for item in self._array(tables, "lights")),
            spheres=tuple(self._sphere(*item) for item in self._array(tables, "spheres")),
            triangles=tuple(self._triangle(*item) for item in self._array(tables, "triangles")),
            ambient=self._colour(tables["ambient"], ("ambient",)),
            background=self._colour(tables["background"], ("background",)),
        )
        view = self._view(tables["view"]) if "view" in tables else None
        title, notes = (self._text(tables.get(key, ""), (key,)) for key in ("title", "notes"))
        square = "angle" in tables.get("view", {})
        return SceneFile(scene, view, tuple(notes.splitlines()), self._path, title, square)

    def _camera(self, table: object) -> Camera:
        fields = self._table(table, ("camera",), ("position", "up", "center"))
        camera = Camera(
            *(self._point(fields[name], ("camera", name)) for name in ("position", "up", "center"))
        )
        try:
            check_camera(camera)
        except FrameError as error:
            self._fail(("camera", error.field.rpartition(".")[2]), error.problem)
        return camera

    def _light(self, table: object, key: Key) -> Light:
        fields = self._table(table, key, ("position", "intensity"))
        return Light(
            self._point(fields["position"], (*key, "position")),
            self._colour(fields["intensity"], (*key, "intensity")),
        )

    def _sphere(self, table: object, key: Key) -> Sphere:
        fields = self._table(table, key, ("material", "center", "radius"))
        return Sphere(
            self._material_of(fields["material"], (*key, "material")),
            self._point(fields["center"], (*key, "center")),
            self._scalar(fields["radius"], (*key, "radius"), numbers.radius),
        )

    def _triangle(self, table: object, key: Key) -> Triangle:
        fields = self._table(table, key, ("material", "vertices"))
        material = self._material_of(fields["material"], (*key, "material"))
        vertices = fields["vertices"]
        if not isinstance(vertices, list) or len(vertices) != 3:
            self._fail((*key, "vertices"), "is not an array of three points")
        a, b, c = (self._point(point, (*key, "vertices", n)) for n, point in enumerate(vertices))
        return Triangle(material, (a, b, c))

    def _material_of(self, value: object, key: Key) -> Material:
        if not isinstance(value, str):
            return self._material(value, key)
        if value not in self._materials:
            known = ", ".join(self._materials) or "none"
            self._fail(key, f"{value!r} is not one of [materials] ({known})")
        return self._materials[value]

    def _material(self, table: object, key: Key) -> Material:
        fields = self._table(
            table, key, ("ambient", "diffuse", "specular"), ("reflection", "transparency", "index", "n")
        )
        colours = {
            name: self._colour(fields[name], (*key, name)) if name in fields else BLACK
            for name in ("ambient", "diffuse", "specular", "reflection", "transparency")
        }
        return Material(**colours, index=self._index(fields, key))

    def _index(self, fields: dict[str, Any], key: Key) -> int:
        if "n" in fields and "index" in fields:
            self._fail((*key, "n"), "stands beside index, which says the same; remove one")
        if "n" in fields:
            return self._scalar(fields["n"], (*key, "n"), numbers.refractive_index)
        return self._integer(fields.get("index", 0), (*key, "index"), INDEX.min, INDEX.max)

    def _view(self, table: object) -> View:
        fields = self._table(table, ("view",), ("width", "height"), ("angle",))
        width, height = (
            self._integer(fields[name], ("view", name), 1, _MAX_PIXELS) for name in ("width", "height")
        )
        try:
            if "angle" not in fields:
                return View.book(width, height)
            return View.square(width, height, float(self._number(fields["angle"], ("view", "angle"))))
        except ValueError as error:
            problem = str(error).partition(": ")[2]
            self._fail(("view", "angle") if "angle" in fields else ("view",), problem)

    def _point(self, value: object, key: Key) -> Vec3:
        return self._vector(value, key, numbers.coordinate)

    def _colour(self, value: object, key: Key) -> Vec3:
        return self._vector(value, key, numbers.colour)

    def _vector(self, value: object, key: Key, convert: Callable[[float], int]) -> Vec3:
        if not isinstance(value, list) or len(value) != 3:
            self._fail(key, "is not an array of three numbers")
        x, y, z = (self._scalar(item, (*key, position), convert) for position, item in enumerate(value))
        return (x, y, z)

    def _scalar(self, value: object, key: Key, convert: Callable[[float], int]) -> int:
        number = self._number(value, key)
        try:
            return convert(number)
        except ValueError as error:
            self._fail(key, str(error))

    def _number(self, value: object, key: Key) -> float:
        if isinstance(value, bool) or not isinstance(value, int | float):
            self._fail(key, f"is {_kind(value)}, not a number")
        if isinstance(value, float) and not math.isfinite(value):
            self._fail(key, f"{value} is not a finite number")
        return value

    def _integer(self, value: object, key: Key, least: int, most: int) -> int:
        if isinstance(value, bool) or not isinstance(value, int):
            self._fail(key, f"is {_kind(value)}, not an integer")
        if not least <= value <= most:
            self._fail(key, f"{numbers.show(value)} is not from {least} to {most}")
        return value

    def _text(self, value: object, key: Key) -> str:
        if not isinstance(value, str):
            self._fail(key, f"is {_kind(value)}, not a text")
        return value

    def _array(self, tables: dict[str, Any], name: str) -> list[tuple[object, Key]]:
        items = tables.get(name, [])
        if not isinstance(items, list):
            self._fail((name,), f"is {_kind(items)}, not an array of tables; write [[{name}]]")
        return [(item, (name, position)) for position, item in enumerate(items)]

    def _named_tables(self, value: object, key: Key) -> list[tuple[str, object]]:
        if not isinstance(value, dict):
            self._fail(key, f"is {_kind(value)}, not a table")
        return list(value.items())

    def _table(
        self, value: object, key: Key, required: tuple[str, ...], optional: tuple[str, ...] = ()
    ) -> dict[str, Any]:
        """The fields of a table that has all of `required` and nothing else but `optional`."""
        if not isinstance(value, dict):
            self._fail(key, f"is {_kind(value)}, not a table")
        known = (*required, *optional)
        for name in value:
            if name not in known:
                self._fail((*key, name), f"is not known here; known are {', '.join(known)}")
        for name in required:
            if name not in value:
                self._fail((*key, name), "is missing")
        return value

    def _fail(self, key: Key, problem: str) -> NoReturn:
        raise SceneError(self._path, self._lines.line(key), _field(key), problem)


def _field(key: Key) -> str:
    """``spheres[1].center[2]``"""
    text = "".join(f"[{part}]" if isinstance(part, int) else f".{part}" for part in key)
    return text.removeprefix(".")


def _kind(value: object) -> str:
    names = {bool: "a boolean", int: "an integer", float: "a number", str: "a text", list: "an array"}
    return names.get(type(value), "a table" if isinstance(value, dict) else "a date or time")
