"""The sixteenth power: ports, model, cosines that survive it."""

import numpy as np
from numpy.random import Generator

from models.core import highlight
from models.formats import Knobs, formats
from verif.env.fields import Field, Operands
from verif.env.unit import Break, Parameters, PipelinedUnit

FMTS = formats(Knobs())


def _inputs(_: Parameters) -> tuple[Field, ...]:
    return (Field.of("cosine", FMTS.cosine),)


def _outputs(_: Parameters) -> tuple[Field, ...]:
    return (Field.of("power", FMTS.cosine),)


def _model(_: Parameters, operands: Operands) -> Operands:
    return {"power": highlight(operands["cosine"], FMTS)}


def _directed(_: Parameters, generator: Generator, size: int) -> Operands:
    """Uniform powers: the root of a power; and the neighbours of 1."""
    root = np.sqrt(np.sqrt(np.sqrt(np.sqrt(generator.uniform(0.0, 2.1, size)))))
    one = generator.integers(-40, 40, size, endpoint=True) + FMTS.cosine.one
    near = (root * FMTS.cosine.one).astype(np.int64)
    return {"cosine": np.where(generator.random(size) < 0.2, one, near)}


UNIT = PipelinedUnit(
    name="highlight",
    inputs=_inputs,
    outputs=_outputs,
    model=_model,
    directed=_directed,
    breaks=(
        Break("shade/highlight.v", "localparam SQUARINGS = 4", "localparam SQUARINGS = 3"),
        Break("shade/highlight.v", ".b        (value[k*W+:W])", ".b        (value[0+:W])"),
        Break("shade/highlight.v", ".SIGNED  (0)", ".SIGNED  (1)"),
    ),
)
