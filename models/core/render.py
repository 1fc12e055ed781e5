"""The whole frame, bit by bit as the core draws it: model of ``hdl/raytracer.v`` (book 8.2).

A pixel is the sum of its terms, each a ray's weight times a colour. No term is negative, so the saturated sum
does not depend on their order, and the rays of a level can be traced together.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from models.arith import vec_mul
from models.core.camera import Basis, Registers, camera
from models.core.light import light_vector
from models.core.objects import Objects, column
from models.core.phong import phong
from models.core.pixel import rgb888
from models.core.rays import ray_generator
from models.core.refract import refract
from models.core.surface import reflect, surface
from models.core.trace import MISS, Nearest, attenuate, nearest
from models.core.unit_vector import unit_vector
from models.fixed import Raw
from models.formats import Formats
from models.limits import MIN_WEIGHT
from models.scene.types import Light, Scene, View

_BATCH = 16384
"""Primary rays at a time: what is between two steps stays near the processor."""


@dataclass
class Counts:
    """What the core counts: rays by kind, tests of a ray against an object, lights left out because they were
    at the hit point."""

    primary_rays: int = 0
    secondary_rays: int = 0
    shadow_rays: int = 0
    tests: int = 0
    lights_at_point: int = 0


@dataclass(frozen=True)
class Rendering:
    """A picture: ``rgb`` uint8 (h, w, 3), ``hit`` int16 (h, w) object numbers or MISS of the primary rays,
    what was counted, and the number of triangles without area."""

    rgb: NDArray[np.uint8]
    hit: NDArray[np.int16]
    counts: Counts
    degenerate: int


def registers(view: View, fmts: Formats) -> Registers:
    """A view as the core's registers hold it: tangents rounded to the nearest step.

    Raises ValueError where a tangent does not fit.
    """
    tangents = [round(tangent * fmts.tan.one) for tangent in (view.tan_h, view.tan_v)]
    for name, raw in zip(("tan_h", "tan_v"), tangents, strict=True):
        if not 0 <= raw <= fmts.tan.max:
            raise ValueError(f"{name} does not fit the register's format {fmts.tan}")
    return Registers(view.width, view.height, *tangents)


@dataclass(frozen=True)
class _Rays:
    """n rays of one level: pixel (n,), origin (3, n) or (3, 1) in `point`, direction (3, n) in `unit`, weight
    (3, n) or (3, 1) in `shade`, own (n,): the triangle that it starts on, or MISS."""

    pixel: Raw
    origin: Raw
    direction: Raw
    weight: Raw
    own: Raw

    def where(self, index: Raw) -> "_Rays":
        """Some of the rays, with all columns of their own."""
        shape = self.direction.shape
        return _Rays(
            self.pixel[index],
            np.broadcast_to(self.origin, shape)[:, index],
            self.direction[:, index],
            np.broadcast_to(self.weight, shape)[:, index],
            self.own[index],
        )


@dataclass(frozen=True)
class Event:
    """One thing that the core does for a pixel, with raw values.

    hit: object, leaving, direction, point, normal. miss: direction. child: weight, direction. local: term
    without light. light: colour, direction and limit of a shadow ray; left: what is left of the colour.
    pixel: the sum. depth: of the ray, 0 where it is not said.
    """

    kind: str
    depth: int
    values: tuple[int, ...]


Watch = Callable[[str, int, tuple[Raw, ...]], None]
"""Hears of each kind of event with its depth and the values of all rays of a level, (k, n) or (n,) each.

Beside the kinds of `Event`: reflected and transmitted: weight of the ray that is cast if that is not
negligible; refracted: whether all is reflected, whether the ray leaves; shadow: colour, what is left of it,
objects on the way; unlit: whether the light is at the hit point, of hits that a light adds nothing to.
"""

_OF_PIXELS = frozenset({"hit", "miss", "child", "local", "light", "left", "pixel"})
"""Kinds that are events of a pixel."""


def _unwatched(_kind: str, _depth: int, _values: tuple[Raw, ...]) -> None:
    """Nobody listens."""


@dataclass
class _Tracer:
    """The rays of one batch of pixels, and what becomes of them; sums (3, pixels) in `shade`."""

    scene: Scene
    registers: Registers
    fmts: Formats
    objects: Objects
    sums: Raw
    counts: Counts = field(default_factory=Counts)
    watch: Watch = _unwatched

    def trace(self, primary: _Rays) -> Raw:
        """Traces whole trees; the objects (n,) that the primary rays hit."""
        self.counts.primary_rays += primary.pixel.size
        levels, first = [primary], np.empty(0, dtype=np.int64)
        for depth in range(1, self.registers.depth + 1):
            children: list[_Rays] = []
            for rays in levels:
                found, tests = nearest(self.objects, rays.origin, rays.direction, rays.own, self.fmts)
                self.counts.tests += tests
                if depth == 1:
                    first = found.number
                self._miss(rays, np.flatnonzero(found.number == MISS), depth)
                hit = np.flatnonzero(found.number != MISS)
                if hit.size:
                    children += self._shade(rays.where(hit), found.where(hit), depth)
            levels = children
            self.counts.secondary_rays += sum(rays.pixel.size for rays in levels)
        return first

    def _add(self, pixel: Raw, term: Raw) -> None:
        """Rays of one batch belong to different pixels."""
        total = self.sums[:, pixel] + term
        self.sums[:, pixel] = np.minimum(total, self.fmts.shade.max)

    def _miss(self, rays: _Rays, missed: Raw, depth: int) -> None:
        if missed.size:
            fmts = self.fmts
            behind = column(self.scene.background) << (fmts.shade.frac_bits - fmts.coeff.frac_bits)
            weight = np.broadcast_to(rays.weight, rays.direction.shape)[:, missed]
            self.watch("miss", depth, (rays.direction[:, missed],))
            self._local(rays.pixel[missed], behind, weight)

    def _local(self, pixel: Raw, colour: Raw, weight: Raw) -> None:
        """Adds the term that needs no light."""
        local = self._weighted(colour, weight)
        self.watch("local", 0, (local,))
        self._add(pixel, local)

    def _weighted(self, colour: Raw, weight: Raw) -> Raw:
        shade = self.fmts.shade
        return vec_mul(colour, weight, shade, shade, shade)

    def _shade(self, rays: _Rays, hit: Nearest, depth: int) -> list[_Rays]:
        """Adds what the hits of some rays show themselves, and gives their children, a kind a batch."""
        objects, fmts, number = self.objects, self.fmts, hit.number
        leaving, triangle = hit.leaving != 0, objects.triangle[number]
        point, normal = surface(
            rays.origin,
            rays.direction,
            triangle,
            leaving,
            hit.distance,
            hit.offset,
            hit.half_chord,
            objects.center[:, number],
            objects.inv_radius[number],
            objects.normal[:, number],
            fmts,
        )
        mirrored, cosine = reflect(rays.direction, normal, fmts)
        self.watch("hit", depth, (number, hit.leaving, rays.direction, point, normal))
        own = np.where(triangle, number, MISS)
        here = _Rays(rays.pixel, point, rays.direction, rays.weight, own)
        self._local(here.pixel, objects.ambient[:, number], here.weight)
        for light in self.scene.lights:
            self._light(light, here, number, normal, mirrored)
        if depth == self.registers.depth:
            return []
        refracted = refract(rays.direction, normal, mirrored, cosine, objects.index[number], leaving, fmts)
        self.watch("refracted", depth, (refracted.total.astype(np.int64), hit.leaving))
        return [
            *self._child("reflected", here, mirrored, objects.reflection[:, number], depth),
            *self._child("transmitted", here, refracted.transmitted, objects.transparency[:, number], depth),
        ]

    def _light(self, light: Light, here: _Rays, number: Raw, normal: Raw, mirrored: Raw) -> None:
        """Adds what one light adds to hits."""
        objects, fmts = self.objects, self.fmts
        way = light_vector(here.origin, column(light.position), fmts)
        self.counts.lights_at_point += int(way.degenerate.sum())
        shown = phong(
            normal,
            mirrored,
            way.direction,
            way.degenerate,
            objects.diffuse[:, number],
            objects.specular[:, number],
            column(light.intensity),
            fmts,
        )
        colour = self._weighted(shown, here.weight)
        lit = np.flatnonzero(colour.any(axis=0))
        self.watch("unlit", 0, (way.degenerate.astype(np.int64)[~colour.any(axis=0)],))
        self.counts.shadow_rays += lit.size
        if not lit.size:
            return
        left, met, tests = attenuate(
            objects,
            here.origin[:, lit],
            way.direction[:, lit],
            way.limit[lit],
            here.own[lit],
            colour[:, lit],
            fmts,
        )
        self.counts.tests += tests
        self.watch("light", 0, (colour[:, lit], way.direction[:, lit], way.limit[lit]))
        self.watch("left", 0, (left,))
        self.watch("shadow", 0, (colour[:, lit], left, met))
        self._add(here.pixel[lit], left)

    def _child(self, kind: str, here: _Rays, direction: Raw, share: Raw, depth: int) -> list[_Rays]:
        """The secondary rays of one kind: where a channel of the weight is not negligible."""
        fmts = self.fmts
        weight = vec_mul(here.weight, share, fmts.shade, fmts.coeff, fmts.shade)
        self.watch(kind, depth, (weight,))
        keep = np.flatnonzero(weight.max(axis=0) >= int(MIN_WEIGHT * fmts.shade.one))
        if not keep.size:
            return []
        child = _Rays(
            here.pixel[keep], here.origin[:, keep], direction[:, keep], weight[:, keep], here.own[keep]
        )
        self.watch("child", depth + 1, (child.weight, child.direction))
        return [child]


@dataclass(frozen=True)
class _Frame:
    """A scene after its set-up: what holds still while rays are traced."""

    scene: Scene
    registers: Registers
    fmts: Formats
    basis: Basis
    objects: Objects

    @classmethod
    def of(cls, scene: Scene, size: Registers, fmts: Formats) -> "_Frame":
        """Set-up of a frame. Raises CameraFault for a camera that cannot be drawn."""
        return cls(scene, size, fmts, camera(scene.camera, size, fmts), Objects.of(scene, fmts))

    def primary(self, pixel: Raw) -> _Rays:
        """Rays through pixels, counted row by row; ``pixel`` of the rays counts from the first of them."""
        size, fmts = self.registers, self.fmts
        screen = ray_generator(self.basis, size.width, size.height, pixel % size.width, pixel // size.width)
        origin = column(self.scene.camera.position) << (fmts.point.frac_bits - fmts.coord.frac_bits)
        weight = np.full((3, 1), fmts.shade.one, dtype=np.int64)
        direction = unit_vector(screen, fmts.screen.width, fmts).unit
        own = np.full(pixel.size, MISS, dtype=np.int64)
        return _Rays(np.arange(pixel.size), origin, direction, weight, own)

    def tracer(self, pixels: int, counts: Counts, watch: Watch = _unwatched) -> _Tracer:
        """A tracer of so many pixels."""
        sums = np.zeros((3, pixels), dtype=np.int64)
        return _Tracer(self.scene, self.registers, self.fmts, self.objects, sums, counts, watch)


def _batches(pixels: int) -> Iterator[slice]:
    return (slice(start, min(start + _BATCH, pixels)) for start in range(0, pixels, _BATCH))


def render(scene: Scene, size: Registers, fmts: Formats, watch: Watch = _unwatched) -> Rendering:
    """The picture that the core draws; ``watch`` hears of all that is traced for it.

    Raises CameraFault for a camera, or a size, that cannot be drawn.
    """
    frame = _Frame.of(scene, size, fmts)
    pixels = size.width * size.height
    rgb = np.empty((pixels, 3), dtype=np.uint8)
    hits = np.empty(pixels, dtype=np.int16)
    counts = Counts()
    for part in _batches(pixels):
        tracer = frame.tracer(part.stop - part.start, counts, watch)
        hits[part] = tracer.trace(frame.primary(np.arange(part.start, part.stop)))
        rgb[part] = rgb888(tracer.sums, fmts).T
        watch("pixel", 0, (tracer.sums,))
    shape = (size.height, size.width)
    return Rendering(rgb.reshape(*shape, 3), hits.reshape(shape), counts, frame.objects.degenerate)


def trace_pixel(scene: Scene, size: Registers, fmts: Formats, x: int, y: int) -> list[Event]:
    """All that the core does for one pixel, level by level. Raises as `render` does."""
    frame = _Frame.of(scene, size, fmts)
    events: list[Event] = []

    def watch(kind: str, depth: int, values: tuple[Raw, ...]) -> None:
        if kind not in _OF_PIXELS:
            return
        flat = [int(number) for value in values for number in value[..., 0].ravel()]
        events.append(Event(kind, depth, tuple(flat)))

    tracer = frame.tracer(1, Counts(), watch)
    tracer.trace(frame.primary(np.array([x + size.width * y])))
    watch("pixel", 0, (tracer.sums,))
    return events
