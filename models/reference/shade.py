"""Local colour of a hit: ambient light, and Phong's two terms of each light (book, 8.2.3)."""

from dataclasses import dataclass

import numpy as np

from models.fixed import COLOUR
from models.limits import SHININESS
from models.reference.intersect import Shape
from models.reference.vectors import Bools, Floats, Ints, column, dot, normalise
from models.scene.types import Scene


@dataclass(frozen=True)
class Materials:
    """Coefficients by object number: (3, objects) each, the refractive index (objects,)."""

    ambient: Floats
    diffuse: Floats
    specular: Floats
    reflection: Floats
    transparency: Floats
    index: Floats

    @classmethod
    def of(cls, scene: Scene) -> "Materials":
        """The materials of a scene's objects in numbers."""
        materials = [thing.material for thing in scene.objects]

        def table(name: str) -> Floats:
            rows = [getattr(material, name) for material in materials]
            return np.array(rows, dtype=np.float64).reshape(-1, 3).T / COLOUR.one

        index = np.array([material.refractive_index for material in materials], dtype=np.float64)
        return cls(
            table("ambient"),
            table("diffuse"),
            table("specular"),
            table("reflection"),
            table("transparency"),
            index,
        )


@dataclass(frozen=True)
class Hits:
    """Hits of n rays: points (3, n), unit normals toward the viewer (3, n), incoming and reflected directions
    (3, n), object numbers (n,), and where the normal had to be turned: the ray leaves the object (n,).
    """

    point: Floats
    normal: Floats
    incoming: Floats
    reflected: Floats
    number: Ints
    leaving: Bools


def hits(
    objects: tuple[Shape, ...], origin: Floats, direction: Floats, distance: Floats, number: Ints
) -> Hits:
    """The hits of rays at known distances on known objects."""
    point = origin + distance * direction
    normal = np.empty_like(point)
    for candidate, shape in enumerate(objects):
        own = number == candidate
        if own.any():
            normal[:, own] = shape.normal(point[:, own])
    leaving = dot(normal, direction) > 0
    normal = np.where(leaving, -normal, normal)
    reflected = direction - 2 * dot(normal, direction) * normal
    return Hits(point, normal, direction, reflected, number, leaving)


def local_colour(scene: Scene, objects: tuple[Shape, ...], materials: Materials, at: Hits) -> Floats:
    """Colour (3, n) that the lights give to each hit, secondary rays left out."""
    colour = column(scene.ambient) * materials.ambient[:, at.number]
    for light in scene.lights:
        way = column(light.position) - at.point
        length = np.sqrt(dot(way, way))
        to_light = normalise(way)
        cosine = dot(at.normal, to_light)
        lit = np.flatnonzero(cosine > 0)
        number = at.number[lit]
        atten = attenuation(objects, materials, at.point[:, lit], to_light[:, lit], length[lit])
        shine = np.maximum(0.0, dot(at.reflected[:, lit], to_light[:, lit])) ** SHININESS
        terms = materials.diffuse[:, number] * cosine[lit] + materials.specular[:, number] * shine
        colour[:, lit] += atten * column(light.intensity) * terms
    return colour


def attenuation(
    objects: tuple[Shape, ...], materials: Materials, point: Floats, to_light: Floats, length: Floats
) -> Floats:
    """Share of each channel (3, n) that reaches a point: each object in between filters it once."""
    atten = np.ones_like(point)
    for candidate, shape in enumerate(objects):
        between = shape.distance(point, to_light) < length
        atten *= np.where(between, materials.transparency[:, candidate, None], 1.0)
    return atten
