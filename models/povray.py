"""Scenes as POV-Ray sees them: an independent renderer to hold the reference against.

POV-Ray's model of light is this project's where a scene keeps to some rules; `to_pov` refuses a scene that
breaks one, and names it. What each of our coefficients becomes, and why:

* Camera: location, direction, right and up are given as vectors, so POV-Ray's rays are ours, and its
  left-handed coordinates do not matter. No anti-aliasing, gamma 1, 16 bits a channel, truncated to ours.
* Diffuse light is the pigment's colour times `diffuse 1`. Ambient light is multiplied by the pigment too, so
  it is divided by it beforehand; a channel with ambient light needs diffuse light.
* Highlights are `phong` with `phong_size 16`, a number and not a colour: specular has to be grey.
* Reflection is a colour in both, without Fresnel's law.
* Transparency: POV-Ray dims what a surface itself shows by what it lets through. Grey transparency is
  `transmit`, and the pigment is divided by the rest. Coloured transparency is a `filter` of 1 with the
  transparency as pigment: nothing of the surface's own is left, so diffuse and ambient have to be 0.
* Shadows: POV-Ray takes the filter of each surface that light crosses, we that of each object. A sphere is
  crossed twice. So spheres that let light through cast no shadow; a copy that only light meets casts it,
  with the square root of the transparency. Triangles are crossed once in both.
* Refraction: POV-Ray keeps a list of the objects that a ray is in; where objects do not overlap, the list
  says what our normals say. The triangles of a refracting material are one mesh; it has to be closed, its
  normals outward.
* Total internal reflection: POV-Ray sends all light along the reflected ray, we k_reflection +
  k_transparency of it. They have to add up to 1 where triangles refract; in a sphere it cannot happen.
* `max_trace_level` is the depth of the ray tree, `adc_bailout` the smallest weight.

What remains, and is most of the difference in the project's scenes (`models/tests/test_povray.py` shows it):
POV-Ray's smallest distances are shorter than our T_MIN, so pixels differ where objects touch and at the edges
of glass; highlights on the inner side of a transparent sphere are brighter in POV-Ray, because their light
crosses the copy once, not twice.

`python -m models.povray [SCENE.toml ...]` compares scenes, those of the project by default.
"""

import argparse
import math
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterable, Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from models import reference
from models.fixed import COLOUR, RADIUS
from models.images import Rgb, psnr_db
from models.limits import MAX_DEPTH, MIN_WEIGHT, SHININESS
from models.reference.camera import basis
from models.reference.vectors import Floats, column
from models.scene.load import load
from models.scene.types import BLACK, Material, Scene, Sphere, Triangle, Vec3, View

BINARY = "povray"
_SECONDS = 120
_SAMPLES = 65535
"""Full intensity in a picture of 16 bits a channel."""


class NotComparable(ValueError):
    """A scene whose light POV-Ray's model does not say."""


def is_installed() -> bool:
    """Whether there is a POV-Ray to ask."""
    return shutil.which(BINARY) is not None


def render(scene: Scene, view: View, folder: Path, max_depth: int = MAX_DEPTH) -> Rgb:
    """The picture that POV-Ray draws; the scene and what POV-Ray says are left in a folder.

    Raises NotComparable, and RuntimeError where POV-Ray fails.
    """
    source, picture = folder / "scene.pov", folder / "picture.ppm"
    source.write_text(to_pov(scene, view, max_depth))
    command = [
        BINARY,
        f"Input_File_Name={source.name}",
        f"Output_File_Name={picture.name}",
        f"Width={view.width}",
        f"Height={view.height}",
        "Output_File_Type=P",
        "Bits_Per_Color=16",
        "File_Gamma=1.0",
        "Dither=Off",
        "Antialias=Off",
        "Display=Off",
        "Verbose=Off",
        "Quality=9",
        "Work_Threads=1",
    ]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=_SECONDS)
    (folder / "povray.log").write_text(done.stdout + done.stderr)
    if done.returncode or not picture.exists():
        raise RuntimeError(f"{BINARY} failed, see {folder / 'povray.log'}: {done.stderr[-500:]}")
    return _to_rgb888(_read_ppm(picture.read_bytes()))


def to_pov(scene: Scene, view: View, max_depth: int = MAX_DEPTH) -> str:
    """The scene in POV-Ray's language; NotComparable names the object that it cannot say."""
    for number, thing in enumerate(scene.objects):
        _check(f"object {number}", thing)
    return "\n".join([*_head(scene, view, max_depth), *_spheres(scene), *_triangles(scene)]) + "\n"


def _head(scene: Scene, view: View, max_depth: int) -> Iterator[str]:
    d, u, v = basis(scene.camera)
    yield "#version 3.7;"
    yield (
        f"global_settings {{ assumed_gamma 1 ambient_light rgb 1 max_trace_level {max_depth} "
        f"adc_bailout {float(MIN_WEIGHT)!r} }}"
    )
    yield f"background {{ rgb {_vector(_colour(scene.background))} }}"
    place = column(scene.camera.position)
    axes = {"location": place, "direction": d, "right": 2 * view.tan_h * u, "up": -2 * view.tan_v * v}
    yield f"camera {{ {' '.join(f'{name} {_vector(axis[:, 0])}' for name, axis in axes.items())} }}"
    for light in scene.lights:
        intensity = _vector(_colour(light.intensity))
        yield f"light_source {{ {_point(light.position)} rgb {intensity} }}"


def _spheres(scene: Scene) -> Iterator[str]:
    for sphere in scene.spheres:
        shape = f"sphere {{ {_point(sphere.center)} {sphere.radius / RADIUS.one!r}"
        texture = _texture(sphere.material, scene.ambient)
        if sphere.material.transparency == BLACK:
            yield f"{shape} {texture} }}"
            continue
        yield f"{shape} {texture} {_interior(sphere.material)} no_shadow }}"
        root = _vector(np.sqrt(_colour(sphere.material.transparency)))
        yield f"{shape} pigment {{ rgbf <{root[1:-1]}, 1> }} no_image no_reflection }}"


def _triangles(scene: Scene) -> Iterator[str]:
    """The triangles of a refracting material are one body, all others stand for themselves."""
    bodies: dict[Material, list[Triangle]] = {}
    for triangle in scene.triangles:
        if _refracts(triangle.material):
            bodies.setdefault(triangle.material, []).append(triangle)
        else:
            yield f"{_triangle(triangle)[:-2]} {_texture(triangle.material, scene.ambient)} }}"
    for material, triangles in bodies.items():
        yield "mesh {"
        yield from map(_triangle, triangles)
        yield f"{_texture(material, scene.ambient)} {_interior(material)} }}"


def _triangle(triangle: Triangle) -> str:
    return f"triangle {{ {', '.join(map(_point, triangle.vertices))} }}"


def _refracts(material: Material) -> bool:
    return material.transparency != BLACK and material.index > 0


def _interior(material: Material) -> str:
    return f"interior {{ ior {material.refractive_index!r} }}"


def _texture(material: Material, light: Vec3) -> str:
    ambient = _colour(material.ambient) * _colour(light)
    clear = _colour(material.transparency)
    if _is_grey(material.transparency):
        rest = 1 - clear[0]
        pigment = _colour(material.diffuse) / (rest if rest else 1.0)
        pigment_text = f"rgbt <{_vector(pigment)[1:-1]}, {_number(clear[0])}>"
        # Where the pigment is 0 so is the ambient light, or `_check` refuses.
        ambient = ambient / np.where(_colour(material.diffuse) > 0, _colour(material.diffuse), 1.0)
    else:
        pigment_text = f"rgbf <{_vector(clear)[1:-1]}, 1>"
    return (
        f"texture {{ pigment {{ {pigment_text} }} finish {{ ambient rgb {_vector(ambient)} diffuse 1 "
        f"phong {_number(_colour(material.specular)[0])} phong_size {SHININESS} "
        f"reflection {{ rgb {_vector(_colour(material.reflection))} }} }} }}"
    )


def _check(name: str, thing: Sphere | Triangle) -> None:
    """The rules at the head of this file."""
    material = thing.material
    if not _is_grey(material.specular):
        raise NotComparable(f"{name}: specular is not grey")
    if any(ka and not kd for ka, kd in zip(material.ambient, material.diffuse, strict=True)):
        raise NotComparable(f"{name}: a channel with ambient light has no diffuse light")
    clear = material.transparency
    keeps_own = _is_grey(clear) and clear[0] < COLOUR.one
    if not keeps_own and (material.diffuse, material.ambient) != (BLACK, BLACK):
        raise NotComparable(
            f"{name}: transparency in colour or in full stands beside diffuse or ambient light"
        )
    sums = [r + t for r, t in zip(material.reflection, material.transparency, strict=True)]
    if isinstance(thing, Triangle) and _refracts(material) and set(sums) != {COLOUR.one}:
        raise NotComparable(
            f"{name}: reflection and transparency of a refracting triangle are not 1 together"
        )


def _is_grey(colour: Vec3) -> bool:
    return len(set(colour)) == 1


def _colour(raw: Vec3) -> Floats:
    return np.array(raw, dtype=np.float64) / COLOUR.one


def _point(raw: Vec3) -> str:
    return _vector(column(raw)[:, 0])


def _vector(values: Iterable[float]) -> str:
    return f"<{', '.join(_number(value) for value in values)}>"


def _number(value: float) -> str:
    if not math.isfinite(value):
        raise NotComparable(f"{value} is not a number of POV-Ray's")
    return f"{float(value):.17g}"


def _read_ppm(data: bytes) -> NDArray[np.uint16]:
    """A binary PPM of 16 bits a channel, (h, w, 3)."""
    head = re.match(rb"P6\s+(?:#[^\n]*\n\s*)*(\d+)\s+(\d+)\s+(\d+)\s", data)
    if not head or int(head[3]) != _SAMPLES:
        raise RuntimeError(f"not a PPM of 16 bits a channel: {data[:40]!r}")
    samples = np.frombuffer(data, dtype=">u2", offset=head.end())
    return samples.reshape(int(head[2]), int(head[1]), 3).astype(np.uint16)


def _to_rgb888(samples: NDArray[np.uint16]) -> Rgb:
    """Truncated as the core does, with half a sample for POV-Ray's rounding."""
    rgb: Rgb = np.floor((samples + 0.5) * (255 / _SAMPLES)).clip(0, 255).astype(np.uint8)
    return rgb


def _main() -> None:
    parser = argparse.ArgumentParser(prog="python -m models.povray", description="Reference against POV-Ray.")
    parser.add_argument("scenes", nargs="*", type=Path, help="default: all in models/scenes")
    parser.add_argument("--width", type=int, default=256, help="of the pictures, default 256")
    options = parser.parse_args()
    if not is_installed():
        sys.exit(f"{BINARY} is not installed; Debian's package of that name has it")
    for path in options.scenes or sorted((Path(__file__).parent / "scenes").glob("*.toml")):
        file = load(path)
        shape = file.view or View.book(1, 1)
        view = file.view_for(options.width, max(1, options.width * shape.height // shape.width))
        with tempfile.TemporaryDirectory() as folder:
            try:
                theirs = render(file.scene, view, Path(folder))
            except NotComparable as reason:
                print(f"{path.stem:16} not compared: {reason}")
                continue
        print(f"{path.stem:16} {psnr_db(reference.render(file.scene, view).rgb, theirs):6.1f} dB", flush=True)


if __name__ == "__main__":
    _main()
