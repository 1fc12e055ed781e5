"""Direction and distance of a light: ports, model, lights at every distance on every side."""

import numpy as np
from numpy.random import Generator

from models.core import light_vector
from models.formats import Knobs, formats
from verif.env import vectors
from verif.env.fields import Field, Operands, bit
from verif.env.unit import Break, Parameters, PipelinedUnit

FMTS = formats(Knobs())


def _inputs(_: Parameters) -> tuple[Field, ...]:
    return (Field.of("point", FMTS.point, lanes=3), Field.of("light", FMTS.coord, lanes=3))


def _outputs(_: Parameters) -> tuple[Field, ...]:
    return (Field.of("direction", FMTS.unit, lanes=3), Field.of("limit", FMTS.point), bit("degenerate"))


def _model(_: Parameters, operands: Operands) -> Operands:
    return light_vector(operands["point"], operands["light"], FMTS)._asdict()


def _directed(_: Parameters, generator: Generator, size: int) -> Operands:
    """Points at the light, a step away, at any distance, and where the distance reaches infinity."""
    shift = FMTS.point.frac_bits - FMTS.coord.frac_bits
    anywhere = generator.integers(FMTS.coord.min, FMTS.coord.max, (3, size), endpoint=True)
    light = np.where(generator.random(size) < 0.5, anywhere >> 5, anywhere)
    direction = vectors.directions(generator, size)
    any_length = 2.0 ** generator.uniform(0.0, FMTS.point.width, size)
    # Off by as much as any bit of the length is worth, so that each decides somewhere.
    off = generator.choice([-1.0, 1.0], size) * 2.0 ** generator.uniform(0.0, FMTS.point.width - 2, size)
    infinity = 256.0 * FMTS.point.one + off
    steps = generator.integers(-1, 1, (3, size), endpoint=True)
    away = vectors.pick(
        generator,
        np.zeros_like(light),
        steps,
        np.trunc(direction * any_length).astype(np.int64),
        np.trunc(direction * any_length).astype(np.int64),
        np.trunc(direction * infinity).astype(np.int64),
    )
    return {"point": FMTS.point.saturate((light << shift) - away), "light": light}


UNIT = PipelinedUnit(
    name="light_vector",
    inputs=_inputs,
    outputs=_outputs,
    model=_model,
    directed=_directed,
    breaks=(
        Break("shade/light_vector.v", "far ? FAR : {", "1'b0 ? FAR : {"),
        Break("shade/light_vector.v", "{GROW{1'b0}}} >> shift", "{GROW{1'b0}}} >> (shift - 1)"),
        Break("shade/light_vector.v", "degenerate_reg <= unit_degenerate", "degenerate_reg <= 1'b0"),
    ),
)
