"""An oracle for the vectorised renderer: one ray at a time, plain floats, recursion as in the textbooks.

It also reports its margin: how close the closest of its decisions was. Where that is within rounding, two
right renderers may differ, and a test does not compare.
"""

import math
from dataclasses import dataclass

from models.limits import INFINITY, T_MIN
from models.scene.types import Scene, Sphere, Triangle, Vec3, View

Vector = tuple[float, float, float]


def add(a: Vector, b: Vector) -> Vector:
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def scale(a: Vector, s: float) -> Vector:
    return (a[0] * s, a[1] * s, a[2] * s)


def subtract(a: Vector, b: Vector) -> Vector:
    return add(a, scale(b, -1))


def dot(a: Vector, b: Vector) -> float:
    return math.fsum(p * q for p, q in zip(a, b, strict=True))


def cross(a: Vector, b: Vector) -> Vector:
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def times(a: Vector, b: Vector) -> Vector:
    return (a[0] * b[0], a[1] * b[1], a[2] * b[2])


def unit(a: Vector) -> Vector:
    return scale(a, 1 / math.sqrt(dot(a, a)))


def number(raw: Vec3) -> Vector:
    return (raw[0] / 1024, raw[1] / 1024, raw[2] / 1024)


@dataclass
class ScalarRenderer:
    """Renders single pixels; `margin` is the smallest so far."""

    scene: Scene
    view: View
    max_depth: int
    min_weight: float
    margin: float = math.inf

    def pixel(self, x: int, y: int) -> tuple[list[int], int]:
        """RGB and object number of a pixel."""
        camera = self.scene.camera
        position = number(camera.position)
        d = unit(subtract(number(camera.center), position))
        u = unit(cross(d, number(camera.up)))
        v = unit(cross(d, u))
        across = ((2 * x + 1) / self.view.width - 1) * self.view.tan_h
        down = ((2 * y + 1) / self.view.height - 1) * self.view.tan_v
        direction = unit(add(d, add(scale(u, across), scale(v, down))))
        colour = self.trace(position, direction, 1, (1.0, 1.0, 1.0))
        hit = self.nearest(position, direction)
        return [min(255, max(0, math.floor(c * 255))) for c in colour], hit[1]

    def decide(self, value: float) -> bool:
        """Whether a value is at least 0."""
        self.margin = min(self.margin, abs(value))
        return value >= 0

    def counts(self, t: float) -> bool:
        return self.decide(t - float(T_MIN)) and not self.decide(t - float(INFINITY))

    def distance(self, thing: Sphere | Triangle, origin: Vector, way: Vector) -> float:
        if isinstance(thing, Sphere):
            return self.sphere(thing, origin, way)
        return self.triangle(thing, origin, way)

    def sphere(self, sphere: Sphere, origin: Vector, way: Vector) -> float:
        center = subtract(number(sphere.center), origin)
        along = dot(way, center)
        disc = along**2 - dot(center, center) + (sphere.radius / 8) ** 2
        if not self.decide(disc):
            return math.inf
        roots = [along - math.sqrt(disc), along + math.sqrt(disc)]
        return next((t for t in roots if self.counts(t)), math.inf)

    def triangle(self, triangle: Triangle, origin: Vector, way: Vector) -> float:
        """The book's test: barycentric s and t of the point in the plane (8.2.2)."""
        p0, p1, p2 = (number(vertex) for vertex in triangle.vertices)
        u, v = subtract(p1, p0), subtract(p2, p0)
        n = cross(u, v)
        facing = dot(n, way)
        if n == (0, 0, 0) or abs(facing) < 1e-9:
            self.margin = min(self.margin, math.inf if n == (0, 0, 0) else 0)
            return math.inf
        distance = dot(n, subtract(p0, origin)) / facing
        w = subtract(add(origin, scale(way, distance)), p0)
        s = dot(w, cross(n, v)) / dot(u, cross(n, v))
        t = dot(w, cross(n, u)) / dot(v, cross(n, u))
        inside = [self.decide(value) for value in (s, t, 1 - s - t)]
        return distance if all(inside) and self.counts(distance) else math.inf

    def nearest(self, origin: Vector, way: Vector) -> tuple[float, int]:
        distances = [self.distance(thing, origin, way) for thing in self.scene.objects]
        finite = sorted(t for t in distances if t < math.inf)
        if len(finite) > 1:
            self.margin = min(self.margin, finite[1] - finite[0])
        best = min(distances, default=math.inf)
        return best, distances.index(best) if best < math.inf else -1

    def trace(self, origin: Vector, way: Vector, depth: int, weight: Vector) -> Vector:
        """Colour of a ray, not weighted."""
        t, hit = self.nearest(origin, way)
        if hit < 0:
            return number(self.scene.background)
        thing = self.scene.objects[hit]
        point = add(origin, scale(way, t))
        if isinstance(thing, Sphere):
            normal = unit(subtract(point, number(thing.center)))
        else:
            p0, p1, p2 = (number(vertex) for vertex in thing.vertices)
            normal = unit(cross(subtract(p1, p0), subtract(p2, p0)))
        leaving = dot(normal, way) > 0
        self.decide(dot(normal, way))
        normal = scale(normal, -1) if leaving else normal
        mirrored = subtract(way, scale(normal, 2 * dot(normal, way)))
        colour = self.local(thing, point, normal, mirrored)
        if depth == self.max_depth:
            return colour
        material = thing.material
        n = 1 + material.index / 8
        bent = self.bend(way, normal, mirrored, n if leaving else 1 / n)
        for share, direction in ((material.reflection, mirrored), (material.transparency, bent)):
            passed = times(weight, number(share))
            if self.decide(max(passed) - self.min_weight):
                colour = add(colour, times(number(share), self.trace(point, direction, depth + 1, passed)))
        return colour

    def bend(self, way: Vector, normal: Vector, mirrored: Vector, eta: float) -> Vector:
        sine = eta * math.sqrt(max(0.0, 1 - dot(normal, way) ** 2))
        if not self.decide(1 - sine):
            return mirrored
        along = add(way, scale(normal, -dot(normal, way)))
        tangent = scale(along, 1 / math.sqrt(dot(along, along))) if dot(along, along) > 1e-24 else (0, 0, 0)
        return unit(add(scale(tangent, sine), scale(normal, -math.sqrt(1 - sine * sine))))

    def local(self, thing: Sphere | Triangle, point: Vector, normal: Vector, mirrored: Vector) -> Vector:
        material = thing.material
        colour = times(number(self.scene.ambient), number(material.ambient))
        for light in self.scene.lights:
            way = subtract(number(light.position), point)
            length = math.sqrt(dot(way, way))
            self.margin = min(self.margin, length)
            if length == 0 or not self.decide(dot(normal, way) / length):
                continue
            way = scale(way, 1 / length)
            shine = max(0.0, dot(mirrored, way)) ** 16
            term = add(
                scale(number(material.diffuse), dot(normal, way)), scale(number(material.specular), shine)
            )
            term = times(term, number(light.intensity))
            for other in self.scene.objects:
                t = self.distance(other, point, way)
                if t < math.inf and not self.decide(t - length):
                    term = times(term, number(other.material.transparency))
            colour = add(colour, term)
        return colour
