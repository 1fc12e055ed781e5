"""The whole frame, bit by bit as the core draws it: model of ``hdl/raytracer.v``."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from models.core.camera import Basis, Registers, camera
from models.core.pixel import rgb888
from models.core.rays import ray_generator
from models.core.setup import object_setup
from models.core.shader import PointLight, Shaded, Sphere, shade_hit
from models.core.sphere import SphereHit, sphere_intersect
from models.core.unit_vector import unit_vector
from models.fixed import Raw
from models.formats import Formats
from models.limits import INFINITY
from models.scene.types import Scene, Vec3, View

MISS = -1
"""Object number of a ray that hits nothing."""

_BATCH = 8192
"""Rays at a time: what is between two steps stays in the cache."""


@dataclass(frozen=True)
class Rendering:
    """A picture: ``rgb`` uint8 (h, w, 3), ``hit`` int16 (h, w) object numbers or MISS, and the number of
    hits whose light was at the hit point."""

    rgb: NDArray[np.uint8]
    hit: NDArray[np.int16]
    lights_at_point: int


def registers(view: View, fmts: Formats) -> Registers:
    """A view as the core's registers hold it: tangents rounded to the nearest step.

    Raises ValueError where a tangent does not fit.
    """
    tangents = [round(tangent * fmts.tan.one) for tangent in (view.tan_h, view.tan_v)]
    for name, raw in zip(("tan_h", "tan_v"), tangents, strict=True):
        if not 0 <= raw <= fmts.tan.max:
            raise ValueError(f"{name} does not fit the register's format {fmts.tan}")
    return Registers(view.width, view.height, *tangents)


def _column(vector: Vec3) -> Raw:
    return np.array(vector, dtype=np.int64).reshape(3, 1)


@dataclass(frozen=True)
class Frame:
    """A scene after its set-up: what holds still while rays are traced."""

    scene: Scene
    registers: Registers
    fmts: Formats
    basis: Basis
    sphere: Sphere | None
    light: PointLight

    @classmethod
    def of(cls, scene: Scene, size: Registers, fmts: Formats) -> "Frame":
        """Set-up of a frame with at most one sphere and one light, this slice's capacity.

        Raises CameraFault for a camera that cannot be drawn, ValueError for more objects.
        """
        if len(scene.spheres) > 1 or len(scene.lights) > 1 or scene.triangles:
            raise ValueError("more than one sphere, one light, no triangle")
        basis = camera(scene.camera, size, fmts)
        return cls(scene, size, fmts, basis, _sphere(scene, fmts), _light(scene))

    def directions(self, x: Raw, y: Raw) -> Raw:
        """Unit directions (3, n) of pixels."""
        screen = ray_generator(self.basis, self.registers.width, self.registers.height, x, y)
        return unit_vector(screen, self.fmts.screen.width, self.fmts).unit

    def origin(self) -> Raw:
        """The camera as a point, (3, 1)."""
        return _column(self.scene.camera.position) << (self.fmts.point.frac_bits - self.fmts.coord.frac_bits)

    def test(self, direction: Raw, sphere: Sphere) -> SphereHit:
        """Primary rays against the sphere."""
        infinity = int(INFINITY * self.fmts.point.one)
        return sphere_intersect(
            self.origin(), direction, sphere.center, sphere.radius_sq, infinity, self.fmts
        )


def _sphere(scene: Scene, fmts: Formats) -> Sphere | None:
    if not scene.spheres:
        return None
    sphere = scene.spheres[0]
    material = sphere.material
    radius = np.array([sphere.radius], dtype=np.int64)
    constants = object_setup(radius, _column(scene.ambient), _column(material.ambient), fmts)
    return Sphere(
        _column(sphere.center),
        constants.radius_sq,
        constants.inv_radius,
        constants.ambient,
        _column(material.diffuse),
        _column(material.specular),
        _column(material.transparency),
    )


def _light(scene: Scene) -> PointLight:
    if not scene.lights:
        return PointLight(False, _column((0, 0, 0)), _column((0, 0, 0)))
    return PointLight(True, _column(scene.lights[0].position), _column(scene.lights[0].intensity))


def _batches(pixels: int) -> Iterator[slice]:
    return (slice(start, min(start + _BATCH, pixels)) for start in range(0, pixels, _BATCH))


def render(scene: Scene, size: Registers, fmts: Formats) -> Rendering:
    """The picture that the core draws. Raises as `Frame.of` does."""
    frame = Frame.of(scene, size, fmts)
    pixels = size.width * size.height
    behind = rgb888(_column(scene.background) << (fmts.shade.frac_bits - fmts.coeff.frac_bits), fmts)
    rgb = np.empty((pixels, 3), dtype=np.uint8)
    rgb[:] = behind[:, 0]
    hits = np.full(pixels, MISS, dtype=np.int16)
    at_point = 0
    for part in _batches(pixels if frame.sphere is not None else 0):
        index = np.arange(part.start, part.stop)
        direction = frame.directions(index % size.width, index // size.width)
        assert frame.sphere is not None
        found = frame.test(direction, frame.sphere)
        (where,) = found.hit.nonzero()
        if where.size:
            shaded = shade_hit(direction[:, where], found.where(where), frame.sphere, frame.light, fmts)
            rgb[part.start + where] = rgb888(shaded.colour, fmts).T
            hits[part.start + where] = 0
            at_point += int((shaded.degenerate & frame.light.on).sum())
    shape = (size.height, size.width)
    return Rendering(rgb.reshape(*shape, 3), hits.reshape(shape), at_point)


def _fields(record: SphereHit | Shaded, *names: str) -> dict[str, Raw]:
    return {name: np.asarray(getattr(record, name), dtype=np.int64) for name in names}


def trace_pixel(scene: Scene, size: Registers, fmts: Formats, x: int, y: int) -> dict[str, Raw]:
    """One pixel, stage by stage: name of the stage and its raw value, in the order of the pipeline."""
    frame = Frame.of(scene, size, fmts)
    at = np.array([x], dtype=np.int64), np.array([y], dtype=np.int64)
    screen = ray_generator(frame.basis, size.width, size.height, *at)
    direction = unit_vector(screen, fmts.screen.width, fmts).unit
    stages: dict[str, Raw] = {"screen": screen, "direction": direction}
    if frame.sphere is None:
        return stages
    found = frame.test(direction, frame.sphere)
    stages |= {"hit": found.hit.astype(np.int64)}
    if found.hit[0]:
        shaded: Shaded = shade_hit(direction, found, frame.sphere, frame.light, fmts)
        stages |= _fields(found, "leaving", "distance", "offset", "half_chord")
        stages |= _fields(shaded, "point", "normal", "mirrored", "light", "limit", "shadowed")
        stages |= _fields(shaded, "direct", "colour")
    return stages
