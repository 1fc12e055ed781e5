"""From hits to colours: models of the blocks in ``hdl/shade`` around phong (book 8.2.3, 8.2.4)."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from models.arith import dot, vec_mul, vec_scale
from models.core.phong import colour_add, phong
from models.core.sphere import SphereHit, sphere_intersect
from models.core.unit_vector import unit_vector
from models.fixed import Format, Raw
from models.formats import Formats
from models.limits import INFINITY


class Surface(NamedTuple):
    """Hit points (3, n) in `point` and normals (3, n) in `unit`, turned toward the viewer."""

    point: Raw
    normal: Raw


def surface(
    direction: Raw,
    offset: Raw,
    half_chord: Raw,
    leaving: NDArray[np.bool_],
    center: Raw,
    inv_radius: Raw,
    fmts: Formats,
) -> Surface:
    """Point and normal of hits: center - m and -+m / r with m = q +- h I, see ``hdl/shade/surface.v``."""
    frac = fmts.point.frac_bits
    signed_chord = Format(fmts.half_chord.int_bits + 1, frac)
    chord = vec_scale(half_chord, direction, fmts.unit, signed_chord, fmts.offset)
    m = np.where(leaving, offset - chord, offset + chord)
    turned = fmts.offset.saturate(np.where(leaving, m, -m))
    point = fmts.point.saturate((center << (frac - fmts.coord.frac_bits)) - m)
    signed_inverse = Format(fmts.inv_radius.int_bits + 1, fmts.inv_radius.frac_bits)
    return Surface(point, vec_scale(inv_radius, turned, fmts.offset, signed_inverse, fmts.unit))


def reflect(direction: Raw, normal: Raw, fmts: Formats) -> Raw:
    """R = V - 2 (N.V) N, (3, n) in `unit`: model of ``hdl/shade/reflect.v``."""
    cosine = dot(normal, direction, fmts.unit, fmts.unit, fmts.unit)
    along = vec_scale(cosine, normal, fmts.unit, fmts.unit, fmts.unit)
    return fmts.unit.saturate(direction - 2 * along)


class LightVector(NamedTuple):
    """Direction to the light (3, n) in `unit`, distance (n,) in `point`, at most infinity; light at the
    point."""

    direction: Raw
    limit: Raw
    degenerate: NDArray[np.bool_]


def light_vector(point: Raw, light: Raw, fmts: Formats) -> LightVector:
    """From hit points (3, n) to a light (3, 1) or lights: model of ``hdl/shade/light_vector.v``."""
    reach = (light << (fmts.point.frac_bits - fmts.coord.frac_bits)) - point
    unit, norm, shift, degenerate = unit_vector(reach, fmts.reach.width, fmts)
    grow = fmts.reach.int_bits - 2 + fmts.point.frac_bits - fmts.unit.frac_bits
    length = (norm << grow) >> shift
    return LightVector(unit, np.minimum(length, int(INFINITY * fmts.point.one)), degenerate)


class Sphere(NamedTuple):
    """A sphere as the shader sees it: scene fields (3, 1) or (1,) and its `ObjectConstants`."""

    center: Raw
    radius_sq: Raw
    inv_radius: Raw
    ambient: Raw
    k_diffuse: Raw
    k_specular: Raw
    k_transparency: Raw


class PointLight(NamedTuple):
    """A light: position and intensity of shape (3, 1); on: the frame has one."""

    on: bool
    position: Raw
    intensity: Raw


class Shaded(NamedTuple):
    """Stages of the shader for n hits: the last one, colour, is before the ray's weight."""

    point: Raw
    normal: Raw
    mirrored: Raw
    light: Raw
    limit: Raw
    degenerate: NDArray[np.bool_]
    shadowed: NDArray[np.bool_]
    direct: Raw
    colour: Raw


def shade_hit(direction: Raw, hit: SphereHit, sphere: Sphere, light: PointLight, fmts: Formats) -> Shaded:
    """Colours of hits: ambient and what the light adds through its shadow ray."""
    point, normal = surface(
        direction, hit.offset, hit.half_chord, hit.leaving, sphere.center, sphere.inv_radius, fmts
    )
    mirrored = reflect(direction, normal, fmts)
    to_light = light_vector(point, light.position, fmts)
    shadow = sphere_intersect(
        point, to_light.direction, sphere.center, sphere.radius_sq, to_light.limit, fmts
    )
    attenuation = np.where(shadow.hit, sphere.k_transparency, fmts.coeff.one)
    direct = phong(
        normal,
        mirrored,
        to_light.direction,
        to_light.degenerate | (not light.on),
        sphere.k_diffuse,
        sphere.k_specular,
        light.intensity,
        attenuation,
        fmts,
    )
    colour = colour_add(sphere.ambient, direct, fmts)
    return Shaded(point, normal, mirrored, *to_light, shadow.hit, direct, colour)


def shader(
    weight: Raw,
    direction: Raw,
    hit: SphereHit,
    sphere: Sphere,
    light: PointLight,
    background: Raw,
    fmts: Formats,
) -> tuple[Raw, NDArray[np.bool_]]:
    """Weighted colours (3, n) in `shade`, and where the light was at the hit point (n,).

    Model of ``hdl/shade/shader.v``; ``background`` has shape (3, 1).
    """
    shaded = shade_hit(direction, hit, sphere, light, fmts)
    behind = background << (fmts.shade.frac_bits - fmts.coeff.frac_bits)
    colour = np.where(hit.hit, shaded.colour, behind)
    weighted = vec_mul(colour, weight, fmts.shade, fmts.shade, fmts.shade)
    return weighted, hit.hit & shaded.degenerate & light.on
