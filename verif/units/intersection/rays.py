"""Rays that pass a sphere in every way there is: hits, tangents, misses, from far, near, inside, behind."""

import numpy as np
from numpy.random import Generator

from models.fixed import Raw
from models.formats import Formats
from models.limits import INFINITY, T_MIN
from verif.env import vectors
from verif.env.fields import Operands


def spheres(generator: Generator, size: int, fmts: Formats) -> tuple[Raw, Raw]:
    """Centers (3, n) in `coord` and radii (n,) in `radius`: near 0, anywhere, at the range's edge."""
    one = fmts.coord.one
    near = generator.integers(-8 * one, 8 * one, (3, size))
    anywhere = generator.integers(fmts.coord.min, fmts.coord.max, (3, size), endpoint=True)
    edge = generator.choice([fmts.coord.min, fmts.coord.max], (3, size))
    edge += generator.integers(-one, one, (3, size))
    center = vectors.pick(generator, near, near, anywhere, fmts.coord.saturate(edge))
    return center, generator.integers(1, fmts.radius.max, size, endpoint=True)


def aimed(generator: Generator, center: Raw, radius: Raw, size: int, fmts: Formats) -> tuple[Raw, Raw]:
    """Origins (3, n) in `point` and directions (3, n) in `unit` of rays past spheres."""
    r = np.broadcast_to(fmts.radius.to_float(radius), (size,))
    direction = vectors.directions(generator, size)
    tangent = 1.0 + generator.choice([-1.0, 1.0], size) * 2.0 ** -generator.integers(3, 24, size)
    inner, outer = generator.random(size), generator.uniform(1.0, 1.7, size)
    aside = r * vectors.pick(generator, np.zeros(size), inner, inner, tangent, outer)
    half_chord = np.sqrt(np.maximum(0.0, r * r - aside * aside))
    few_steps = generator.integers(-6, 6, size, endpoint=True) / fmts.point.one
    limit = float(T_MIN) + few_steps
    ahead = vectors.pick(
        generator,
        half_chord + limit,
        limit - half_chord,
        half_chord * generator.uniform(-1.0, 1.0, size),
        half_chord + generator.uniform(0.0, 10.0, size),
        half_chord + 2.0 ** generator.uniform(0.0, 8.5, size),
        -half_chord - generator.uniform(0.0, 10.0, size),
    )
    origin = fmts.coord.to_float(center) + vectors.across(generator, direction) * aside - direction * ahead
    return vectors.truncated(origin, fmts.point), vectors.truncated(direction, fmts.unit)


def limits(generator: Generator, distance: Raw, fmts: Formats) -> Raw:
    """Limits (n,) in `point`: none, at a distance, a step to either side of it, at the smallest one."""
    one, size = fmts.point.one, distance.size
    nothing = np.full(size, int(INFINITY * one))
    step = generator.integers(-1, 1, size, endpoint=True)
    smallest = int(T_MIN * one) + step
    at_hit = fmts.point.saturate(distance + step)
    return vectors.pick(generator, nothing, nothing, nothing, nothing, at_hit, at_hit, smallest)


def past_spheres(generator: Generator, size: int, fmts: Formats) -> Operands:
    """Tests of rays against spheres; limits have still to be chosen and are as far as can be."""
    center, radius = spheres(generator, size, fmts)
    origin, direction = aimed(generator, center, radius, size, fmts)
    nothing = np.zeros_like(radius)
    spare = generator.integers(fmts.coord.min, fmts.coord.max, (6, size), endpoint=True)
    return {
        "origin": origin,
        "direction": direction,
        "limit": np.full(size, int(INFINITY * fmts.point.one)),
        "triangle": nothing,
        "shape": np.stack([nothing, nothing, radius * radius]),
        "vertices": np.concatenate([center, spare]),
    }
