"""The sixteenth power: ports, model, cosines that survive it."""

import numpy as np
from numpy.random import Generator

from models.core import highlight
from models.formats import BUILDS
from models.header import defines, selected
from verif.env.fields import Field, Operands
from verif.env.unit import Break, Parameters, PipelinedUnit


def _inputs(p: Parameters) -> tuple[Field, ...]:
    return (Field.of("cosine", selected(p).cosine),)


def _outputs(p: Parameters) -> tuple[Field, ...]:
    return (Field.of("power", selected(p).cosine),)


def _model(p: Parameters, operands: Operands) -> Operands:
    return {"power": highlight(operands["cosine"], selected(p))}


def _directed(p: Parameters, generator: Generator, size: int) -> Operands:
    """Uniform powers: the root of a power; and the neighbours of 1."""
    root = np.sqrt(np.sqrt(np.sqrt(np.sqrt(generator.uniform(0.0, 2.1, size)))))
    one = selected(p).cosine.one
    close = generator.integers(-40, 40, size, endpoint=True) + one
    near = (root * one).astype(np.int64)
    return {"cosine": np.where(generator.random(size) < 0.2, close, near)}


UNIT = PipelinedUnit(
    name="highlight",
    sets={"book": defines(BUILDS["book"])},
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
