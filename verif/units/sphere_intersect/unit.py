"""The ray-sphere test: ports, model, rays that pass a sphere in every way."""

from typing import Any

from numpy.random import Generator

from models.core import SphereHit, sphere_intersect
from models.formats import Knobs, formats
from verif.env.fields import Field, Operands, bit
from verif.env.unit import Break, Parameters, PipelinedUnit
from verif.units.sphere_intersect import rays

FMTS = formats(Knobs())


def _inputs(_: Parameters) -> tuple[Field, ...]:
    return (
        Field.of("origin", FMTS.point, lanes=3),
        Field.of("direction", FMTS.unit, lanes=3),
        Field.of("center", FMTS.coord, lanes=3),
        Field.of("radius_sq", FMTS.radius_sq),
        Field.of("limit", FMTS.point),
    )


def _outputs(_: Parameters) -> tuple[Field, ...]:
    return (
        bit("hit"),
        bit("leaving"),
        Field.of("distance", FMTS.point),
        Field.of("offset", FMTS.offset, lanes=3),
        Field.of("half_chord", FMTS.half_chord),
    )


def _hit(operands: Operands) -> SphereHit:
    given: dict[str, Any] = {port.name: operands[port.name] for port in _inputs({})}
    return sphere_intersect(**given, fmts=FMTS)


def _model(p: Parameters, operands: Operands) -> Operands:
    found = _hit(operands)._asdict()
    return {port.name: found[port.name] for port in _outputs(p)}


def _directed(_: Parameters, generator: Generator, size: int) -> Operands:
    """Rays past spheres; limits at the very distance that the model finds, and beside it."""
    drawn = rays.tests(generator, size, FMTS)
    return {**drawn, "limit": rays.limits(generator, _hit(drawn).distance, FMTS)}


UNIT = PipelinedUnit(
    name="sphere_intersect",
    inputs=_inputs,
    outputs=_outputs,
    model=_model,
    directed=_directed,
    breaks=(
        Break("trace/sphere_intersect.v", "near_reg < $signed(T_MIN)", "near_reg <= $signed(T_MIN)"),
        Break("trace/sphere_intersect.v", "distance_next < limit_reg", "distance_next <= limit_reg"),
        Break("trace/sphere_intersect.v", "along_wide + root_wide", "along_wide - root_wide"),
    ),
)
