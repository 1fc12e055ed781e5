"""An oracle for the bit-exact renderer's bookkeeping: the core's own blocks, one ray at a time, depth first.

The blocks have oracles of their own; what this checks is which rays there are, and what each of them adds.
"""

from dataclasses import dataclass, field

import numpy as np

from models.arith import vec_mul
from models.core import (
    Objects,
    Registers,
    camera,
    light_vector,
    phong,
    ray_generator,
    reflect,
    rgb888,
    surface,
    unit_vector,
)
from models.core.objects import Flat, Found, column
from models.core.refract import refract
from models.fixed import Raw
from models.formats import Formats
from models.limits import INFINITY, MIN_WEIGHT
from models.scene.types import Scene


@dataclass
class ScalarCore:
    """Draws single pixels; counts what it did."""

    scene: Scene
    size: Registers
    fmts: Formats
    objects: Objects = field(init=False)
    primary: int = 0
    secondary: int = 0
    shadows: int = 0
    tests: int = 0

    def __post_init__(self) -> None:
        self.objects = Objects.of(self.scene, self.fmts)

    def pixel(self, x: int, y: int) -> tuple[list[int], int | None]:
        """RGB of a pixel, and the number of the object that its primary ray hits."""
        size, fmts = self.size, self.fmts
        basis = camera(self.scene.camera, size, fmts)
        screen = ray_generator(basis, size.width, size.height, np.array([x]), np.array([y]))
        direction = unit_vector(screen, fmts.screen.width, fmts).unit
        origin = column(self.scene.camera.position) << (fmts.point.frac_bits - fmts.coord.frac_bits)
        self.primary += 1
        weight = np.full((3, 1), fmts.shade.one)
        total = self.trace(origin, direction, weight, None, 1)
        first = self.nearest(origin, direction, None, count=False)
        colour = np.minimum(total, fmts.shade.max)
        return rgb888(colour, fmts)[:, 0].tolist(), None if first is None else first[0]

    def meet(self, number: int, origin: Raw, direction: Raw, limit: int, own: int | None) -> Found | None:
        """One test, None where there is none to make."""
        shape = self.objects.shapes[number]
        if isinstance(shape, Flat) and (shape.dead or number == own):
            return None
        return shape.test(origin, direction, np.array([limit]), self.fmts)

    def nearest(
        self, origin: Raw, direction: Raw, own: int | None, count: bool = True
    ) -> tuple[int, Found] | None:
        """The object that a ray hits first."""
        best: tuple[int, Found] | None = None
        limit = int(INFINITY * self.fmts.point.one)
        for number in range(len(self.objects.shapes)):
            found = self.meet(number, origin, direction, limit, own)
            self.tests += count and found is not None
            if found is not None and found.hit[0]:
                limit, best = int(found.distance[0]), (number, found)
        return best

    def weighted(self, colour: Raw, weight: Raw) -> Raw:
        return vec_mul(colour, weight, self.fmts.shade, self.fmts.shade, self.fmts.shade)

    def trace(self, origin: Raw, direction: Raw, weight: Raw, own: int | None, depth: int) -> Raw:
        """What a ray and all its children add to the pixel."""
        fmts, objects = self.fmts, self.objects
        met = self.nearest(origin, direction, own)
        if met is None:
            behind = column(self.scene.background) << (fmts.shade.frac_bits - fmts.coeff.frac_bits)
            return self.weighted(behind, weight)
        number, found = met
        triangle = objects.triangle[[number]]
        point, normal = surface(
            origin,
            direction,
            triangle,
            found.leaving,
            found.distance,
            found.offset,
            found.half_chord,
            objects.center[:, [number]],
            objects.inv_radius[[number]],
            objects.normal[:, [number]],
            fmts,
        )
        mirrored, cosine = reflect(direction, normal, fmts)
        here = number if triangle[0] else None
        total = self.weighted(objects.ambient[:, [number]], weight)
        for light in self.scene.lights:
            way = light_vector(point, column(light.position), fmts)
            k_diffuse, k_specular = objects.diffuse[:, [number]], objects.specular[:, [number]]
            shown = phong(
                normal,
                mirrored,
                way.direction,
                way.degenerate,
                k_diffuse,
                k_specular,
                column(light.intensity),
                fmts,
            )
            colour = self.weighted(shown, weight)
            if colour.any():
                total = total + self.lit(point, way.direction, int(way.limit[0]), here, colour)
        if depth < self.size.depth:
            bent = refract(
                direction, normal, mirrored, cosine, objects.index[[number]], found.leaving, fmts
            ).transmitted
            for child, share in ((mirrored, objects.reflection), (bent, objects.transparency)):
                passed = vec_mul(weight, share[:, [number]], fmts.shade, fmts.coeff, fmts.shade)
                if passed.max() >= MIN_WEIGHT * fmts.shade.one:
                    self.secondary += 1
                    total = total + self.trace(point, child, passed, here, depth + 1)
        return total

    def lit(self, point: Raw, direction: Raw, limit: int, own: int | None, colour: Raw) -> Raw:
        """What is left of a light's colour at a point."""
        self.shadows += 1
        for number in range(len(self.objects.shapes)):
            found = self.meet(number, point, direction, limit, own)
            self.tests += found is not None
            if found is not None and found.hit[0]:
                share = self.objects.transparency[:, [number]]
                colour = vec_mul(colour, share, self.fmts.shade, self.fmts.coeff, self.fmts.shade)
        return colour
