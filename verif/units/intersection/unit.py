"""A ray against an object: ports, model, rays that pass spheres and triangles in every way."""

from typing import Any

import numpy as np
from numpy.random import Generator

from models.core import sphere_intersect, triangle_intersect
from models.fixed import Raw
from models.formats import BUILDS, Formats
from models.header import defines, selected
from verif.env.fields import Field, Operands, bit, concatenate, count, select
from verif.env.unit import Break, Parameters, PipelinedUnit
from verif.units.intersection import rays, triangles

_RARE = 100
"""One operand in so many is at the edge of space."""


def _inputs(p: Parameters) -> tuple[Field, ...]:
    fmts = selected(p)
    return (
        Field.of("origin", fmts.point, lanes=3),
        Field.of("direction", fmts.unit, lanes=3),
        Field.of("limit", fmts.point),
        bit("triangle"),
        Field.of("shape", fmts.unit, lanes=3),
        Field.of("vertices", fmts.coord, lanes=9),
    )


def _outputs(p: Parameters) -> tuple[Field, ...]:
    fmts = selected(p)
    return (
        bit("hit"),
        bit("leaving"),
        Field.of("distance", fmts.point),
        Field.of("offset", fmts.offset, lanes=3),
        Field.of("half_chord", fmts.half_chord),
    )


def _legal(p: Parameters, operands: Operands) -> Operands:
    """The shape of a sphere is its radius squared, with zeros above."""
    shape, mask = operands["shape"], selected(p).radius_sq.max
    nothing = np.zeros_like(shape[0])
    return {
        **operands,
        "shape": np.where(operands["triangle"] == 1, shape, np.stack([nothing, nothing, shape[2] & mask])),
    }


def corners(operands: Operands) -> tuple[Raw, Raw, Raw]:
    """The three corners (3, n); a sphere's center in the first one's place."""
    vertices = operands["vertices"]
    return vertices[0:3], vertices[3:6], vertices[6:9]


def radius_sq(operands: Operands, fmts: Formats) -> Raw:
    """Of a sphere, in `radius_sq`."""
    return operands["shape"][2] & fmts.radius_sq.max


def _model(p: Parameters, operands: Operands) -> Operands:
    fmts = selected(p)
    ray: dict[str, Any] = {name: operands[name] for name in ("origin", "direction", "limit")}
    flat = operands["triangle"] == 1
    ball = sphere_intersect(
        center=corners(operands)[0], radius_sq=radius_sq(operands, fmts), **ray, fmts=fmts
    )
    face = triangle_intersect(corners=corners(operands), normal=operands["shape"], **ray, fmts=fmts)
    return {
        "hit": np.where(flat, face.hit, ball.hit),
        "leaving": np.where(flat, face.leaving, ball.leaving),
        "distance": np.where(flat, face.distance, ball.distance),
        "offset": np.where(flat, 0, ball.offset),
        "half_chord": np.where(flat, 0, ball.half_chord),
    }


def alternating(p: Parameters, generator: Generator, size: int) -> Operands:
    """Spheres and triangles in turn, an even number; limits at the model's distances, and beside them."""
    fmts, half = selected(p), size // 2
    parts = [
        rays.past_spheres(generator, half, fmts),
        triangles.past_triangles(generator, half, fmts),
    ]
    drawn = select(concatenate(parts), np.arange(2 * half).reshape(2, half).T.ravel())
    return {**drawn, "limit": rays.limits(generator, _model(p, drawn)["distance"], fmts)}


def _from_edge_to_edge(p: Parameters, size: int) -> Operands:
    """Rays from a corner of all space against triangles at the opposite one, whose shape is no unit vector
    but as large as it can be: the largest products that the unit can meet, of either sign."""
    fmts = selected(p)
    ends = np.arange(size) % 2 == 0

    def lanes(number: int, low: int, high: int) -> Raw:
        return np.tile(np.where(ends, low, high), (number, 1))

    return {
        "origin": lanes(3, fmts.point.min, fmts.point.max),
        "direction": lanes(3, fmts.unit.one // 2, -fmts.unit.one // 2),
        "limit": np.full(size, fmts.point.max),
        "triangle": np.ones(size, dtype=np.int64),
        "shape": lanes(3, fmts.unit.max, fmts.unit.min),
        "vertices": lanes(9, fmts.coord.max, fmts.coord.min),
    }


def _directed(p: Parameters, generator: Generator, size: int) -> Operands:
    """Runs of the two kinds, see `alternating`; some from one edge of space to the other."""
    drawn = concatenate([alternating(p, generator, size + 2), _from_edge_to_edge(p, 2 + size // _RARE)])
    return select(drawn, generator.permutation(count(drawn)))


_FILE = "trace/intersection.v"
_PLANE = "trace/plane_distance.v"

UNIT = PipelinedUnit(
    name="intersection",
    sets={"book": defines(BUILDS["book"])},
    inputs=_inputs,
    outputs=_outputs,
    model=_model,
    legal=_legal,
    directed=_directed,
    breaks=(
        Break(_FILE, "near_reg < $signed(T_MIN)", "near_reg <= $signed(T_MIN)"),
        Break(_FILE, "t < limit_wide", "t <= limit_wide"),
        Break(_FILE, "b_wide + root_wide", "b_wide - root_wide"),
        Break(_FILE, "y_size >= z_size ?", "y_size > z_size ?"),
        Break(_FILE, "x_size >= y_size && x_size >= z_size", "x_size >= y_size"),
        Break(
            _FILE,
            "(positive_reg == 3'd0) ^ (negative_reg == 3'd0)",
            "(positive_reg == 3'd0) | (negative_reg == 3'd0)",
        ),
        Break(_FILE, "(positive_reg == 3'd0) ^ (negative_reg == 3'd0)", "&positive_reg ^ &negative_reg"),
        Break(_PLANE, "facing_positive != behind_negative", "facing_positive"),
        Break(_FILE, "localparam NEXT = (corner + 2) % 3", "localparam NEXT = corner < 2 ? 2 : 1"),
        Break(_FILE, "wire kind_at_along = kind_reg[T_ALONG-1]", "wire kind_at_along = kind_reg[T_ALONG]"),
        Break(_PLANE, "{WEIGHT{1'b0}}} >> shift_reg", "{WEIGHT{1'b0}}} >> shift", set="book"),
        Break(_PLANE, "behind_negative ? -behind_part : behind_part", "behind_part"),
        Break("trace/corners.v", "center_late_reg <= center_reg", "center_late_reg <= center_next"),
    ),
)
