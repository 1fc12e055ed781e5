"""Scenes as TOML text: the inverse of `models.scene.toml.parse`, exact to the last bit."""

import json
import math
from collections.abc import Iterable, Sequence

from models.fixed import BOOK, RADIUS
from models.scene.types import BLACK, Material, Scene, Vec3, View


def to_toml(scene: Scene, view: View | None = None, title: str = "", notes: Sequence[str] = ()) -> str:
    """The text that `parse` reads back as the same scene, view (within rounding), title and notes.

    Raises ValueError for a view that is neither the book's nor one of square pixels: no file can say it.
    """
    names = {material: f"m{number}" for number, material in enumerate(_materials(scene))}
    lines = []
    if title:
        lines.append(f"title = {_text(title)}")
    if notes:
        lines.append(f"notes = {_text(chr(10).join(notes))}")
    lines += [f"ambient = {_vector(scene.ambient)}", f"background = {_vector(scene.background)}"]
    lines += ["", "[camera]"]
    lines += [f"{name} = {_vector(getattr(scene.camera, name))}" for name in ("position", "up", "center")]
    lines += _view(view) if view else []
    for material, name in names.items():
        lines += ["", f"[materials.{name}]", *_material(material)]
    for light in scene.lights:
        lines += ["", "[[lights]]", f"position = {_vector(light.position)}"]
        lines += [f"intensity = {_vector(light.intensity)}"]
    for sphere in scene.spheres:
        lines += ["", "[[spheres]]", f'material = "{names[sphere.material]}"']
        lines += [f"center = {_vector(sphere.center)}", f"radius = {sphere.radius / RADIUS.one!r}"]
    for triangle in scene.triangles:
        lines += ["", "[[triangles]]", f'material = "{names[triangle.material]}"']
        lines += [f"vertices = [{', '.join(_vector(vertex) for vertex in triangle.vertices)}]"]
    return "\n".join(lines) + "\n"


def _materials(scene: Scene) -> Iterable[Material]:
    """Each material once, in the order of the objects."""
    return dict.fromkeys(thing.material for thing in scene.objects)


def _material(material: Material) -> list[str]:
    lines = [f"{name} = {_vector(getattr(material, name))}" for name in ("ambient", "diffuse", "specular")]
    for name in ("reflection", "transparency"):
        if getattr(material, name) != BLACK:
            lines.append(f"{name} = {_vector(getattr(material, name))}")
    return [*lines, f"index = {material.index}"] if material.index else lines


def _view(view: View) -> list[str]:
    lines = ["", "[view]", f"width = {view.width}", f"height = {view.height}"]
    square = View.square(view.width, view.height, math.degrees(2 * math.atan(view.tan_v)))
    if _is_book(view):
        return lines
    if not math.isclose(square.tan_h, view.tan_h):
        raise ValueError(f"{view} has neither square pixels nor the book's field of view")
    return [*lines, f"angle = {math.degrees(2 * math.atan(view.tan_v))!r}"]


def _is_book(view: View) -> bool:
    try:
        return View.book(view.width, view.height) == view
    except ValueError:
        return False


def _vector(raw: Vec3) -> str:
    """Exact: a raw integer over 1024 has a short decimal, which reads back as itself."""
    return f"[{', '.join(repr(component / BOOK.one) for component in raw)}]"


def _text(text: str) -> str:
    """A TOML basic string; JSON's escapes are TOML's, but for DEL, which TOML wants escaped."""
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")
