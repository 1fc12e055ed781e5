"""Hit point and normal: ports, model, hits that the ray-sphere test has found, hits of triangles."""

from typing import Any

import numpy as np
from numpy.random import Generator

from models.core import sphere_intersect, surface
from models.fixed import Raw
from models.formats import BUILDS, Formats
from models.header import defines, selected
from models.limits import INFINITY, T_MIN
from verif.env import vectors
from verif.env.fields import Field, Operands, bit, concatenate, count, select
from verif.env.unit import Break, Parameters, PipelinedUnit
from verif.units.intersection import rays


def _inputs(p: Parameters) -> tuple[Field, ...]:
    fmts = selected(p)
    return (
        Field.of("origin", fmts.point, lanes=3),
        Field.of("direction", fmts.unit, lanes=3),
        bit("triangle"),
        bit("leaving"),
        Field.of("distance", fmts.point),
        Field.of("offset", fmts.offset, lanes=3),
        Field.of("half_chord", fmts.half_chord),
        Field.of("center", fmts.coord, lanes=3),
        Field.of("shape", fmts.unit, lanes=3),
    )


def _outputs(p: Parameters) -> tuple[Field, ...]:
    fmts = selected(p)
    return (Field.of("point", fmts.point, lanes=3), Field.of("normal", fmts.unit, lanes=3))


def inv_radius(shape: Raw, fmts: Formats) -> Raw:
    """1 / radius (n,) of the shapes (3, n) of spheres: their low bits."""
    lane = (1 << fmts.unit.width) - 1
    low = ((shape[1] & lane) << fmts.unit.width) | (shape[2] & lane)
    return np.asarray(low & fmts.inv_radius.max)


def round_shape(inverse: Raw, fmts: Formats) -> Raw:
    """The shapes (3, n) of spheres of these 1 / radius (n,)."""
    above, low = np.divmod(inverse, 1 << fmts.unit.width)
    return np.stack(
        [np.zeros_like(above), above, np.where(low > fmts.unit.max, low - (1 << fmts.unit.width), low)]
    )


def _model(p: Parameters, operands: Operands) -> Operands:
    fmts = selected(p)
    given: dict[str, Any] = {port.name: operands[port.name] for port in _inputs(p)}
    shape = given.pop("shape")
    for name in ("triangle", "leaving"):
        given[name] = given[name] == 1
    return surface(**given, inv_radius=inv_radius(shape, fmts), normal=shape, fmts=fmts)._asdict()


def _spheres(generator: Generator, size: int, fmts: Formats) -> Operands:
    """Consistent hits; about a third of the rays hits."""
    center, radius = rays.spheres(generator, 3 * size, fmts)
    origin, direction = rays.aimed(generator, center, radius, 3 * size, fmts)
    found = sphere_intersect(origin, direction, center, radius * radius, fmts.point.max, fmts)
    hit = np.flatnonzero(found.hit)[:size]
    return {
        "origin": origin[:, hit],
        "direction": direction[:, hit],
        "triangle": np.zeros_like(hit),
        "leaving": found.leaving[hit].astype(np.int64),
        "distance": found.distance[hit],
        "offset": found.offset[:, hit],
        "half_chord": found.half_chord[hit],
        "center": center[:, hit],
        "shape": round_shape(inverse(radius[hit], fmts), fmts),
    }


def _triangles(generator: Generator, size: int, fmts: Formats) -> Operands:
    """Hits of triangles of either side, near and far; what a sphere has beside them is anything."""
    one = fmts.point.one
    near, far = float(T_MIN), float(INFINITY)
    distance = vectors.pick(
        generator,
        generator.uniform(near, 8.0, size),
        near * (far / near) ** generator.random(size),
        generator.choice([near, far], size),
    )
    direction = vectors.directions(generator, size)
    extent = generator.choice([8.0, 256.0], size)
    target = generator.uniform(-1.0, 1.0, (3, size)) * extent
    normal = vectors.at_cosine(generator, direction, vectors.cosines(generator, size))
    ray, facing = vectors.truncated(direction, fmts.unit), vectors.truncated(normal, fmts.unit)
    steps = np.round(distance * one).astype(np.int64)
    start = np.round(target * one).astype(np.int64) - (ray * steps >> fmts.unit.frac_bits)
    return {
        "origin": fmts.point.saturate(start),
        "direction": ray,
        "triangle": np.ones_like(steps),
        "leaving": ((ray * facing).sum(axis=0) > 0).astype(np.int64),
        "distance": steps,
        "offset": generator.integers(fmts.offset.min, fmts.offset.max, (3, size), endpoint=True),
        "half_chord": generator.integers(0, fmts.half_chord.max, size, endpoint=True),
        "center": generator.integers(fmts.coord.min, fmts.coord.max, (3, size), endpoint=True),
        "shape": facing,
    }


def _directed(p: Parameters, generator: Generator, size: int) -> Operands:
    """Real hits, spheres and triangles in any order."""
    fmts = selected(p)
    hits = concatenate([_spheres(generator, size - size // 3, fmts), _triangles(generator, size // 3, fmts)])
    return select(hits, generator.permutation(count(hits)))


def inverse(radius: Raw, fmts: Formats) -> Raw:
    """1 / radius in `inv_radius` of radii in `radius`, floored."""
    return np.asarray((1 << (fmts.inv_radius.frac_bits + fmts.radius.frac_bits)) // radius)


UNIT = PipelinedUnit(
    name="surface",
    sets={"book": defines(BUILDS["book"])},
    inputs=_inputs,
    outputs=_outputs,
    model=_model,
    directed=_directed,
    breaks=(
        Break("shade/surface.v", "along_leaving ? m_wide : -m_wide", "-m_wide"),
        Break("shade/surface.v", "along_triangle || along_leaving;", "along_leaving;"),
        Break("shade/surface.v", "triangle ? {3 * OFFSET_W{1'b0}} : offset", "offset"),
        Break(
            "shade/surface.v",
            "({turned_triangle, flat_reg, point_reg",
            "({along_triangle, flat_reg, point_reg",
        ),
        Break(
            "shade/surface.v",
            "({turned_triangle, flat_reg, point_reg",
            "({turned_triangle, flat_reg, point_next",
        ),
        Break("shade/surface.v", "along_leaving ? -n_wide : n_wide", "along_leaving ? ~n_wide : n_wide"),
    ),
)
