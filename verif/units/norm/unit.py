"""The length of a vector: ports, parameter sets, model, and vectors of whole length."""

import numpy as np
from numpy.random import Generator

from models.arith import norm, norm_format
from models.fixed import Format
from verif.env.fields import Field, Operands
from verif.env.unit import Break, Parameters, PipelinedUnit

_WHOLE = np.array([(0, 0, 0), (0, 0, 1), (1, 2, 2), (2, 3, 6), (0, 3, 4), (1, 4, 8), (4, 4, 7), (1, 1, 1)])
"""Vectors whose length is whole, and one whose length is not."""


def vector(p: Parameters) -> tuple[Field, ...]:
    """What has a length."""
    return (Field.of("a", Format(p["INT"], p["FRAC"]), lanes=3),)


def _outputs(p: Parameters) -> tuple[Field, ...]:
    return (Field.of("length", norm_format(Format(p["INT"], p["FRAC"]), p["GUARD"])),)


def _model(p: Parameters, operands: Operands) -> Operands:
    return {"length": norm(operands["a"], Format(p["INT"], p["FRAC"]), p["GUARD"])}


def special_vectors(p: Parameters, generator: Generator, size: int) -> Operands:
    """Thirds: of whole length in any order and sign; along an axis; with components almost alike."""
    fmt = Format(p["INT"], p["FRAC"])
    whole = generator.permuted(_WHOLE[generator.integers(0, len(_WHOLE), size)], axis=1).T
    scaled = whole * generator.integers(0, max(2, fmt.max // 8), size) * generator.choice([-1, 1], (3, size))
    any_number = generator.integers(fmt.min, fmt.max + 1, size) >> generator.integers(0, fmt.width, size)
    along = np.zeros((3, size), dtype=np.int64)
    along[generator.integers(0, 3, size), np.arange(size)] = any_number
    alike = any_number + generator.integers(-1, 2, (3, size))
    return {"a": fmt.saturate(np.choose(np.arange(size) % 3, [scaled, along, alike]))}


UNIT = PipelinedUnit(
    name="norm",
    parameters={"INT": 9, "FRAC": 10, "GUARD": 0},
    sets={"unit_vector": {"INT": 1, "FRAC": 17}, "narrow": {"INT": 2, "FRAC": 2, "GUARD": 1}},
    exhaustive="narrow",
    inputs=vector,
    outputs=_outputs,
    model=_model,
    directed=special_vectors,
    breaks=(
        Break("arith/norm.v", "<< (2 * GUARD)", "<< GUARD", set="narrow"),
        Break("arith/norm.v", "+ square[0+:SQUARE_W]", "- square[0+:SQUARE_W]"),
        Break("arith/norm.v", ".in_valid (square_valid)", ".in_valid (in_valid)"),
    ),
)
