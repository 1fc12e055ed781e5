"""A scalar times a vector: ports, parameter sets and model."""

import numpy as np
from numpy.random import Generator

from models.arith import vec_scale
from verif.env.fields import Field, Operands
from verif.env.unit import Break, Parameters, PipelinedUnit
from verif.units.products import formats, pairs_at_the_limit


def _inputs(p: Parameters) -> tuple[Field, ...]:
    a, s, _ = formats(p)
    return (Field.of("s", s), Field.of("a", a, p["LANES"]))


def _outputs(p: Parameters) -> tuple[Field, ...]:
    return (Field.of("p", formats(p)[2], p["LANES"]),)


def _model(p: Parameters, operands: Operands) -> Operands:
    return {"p": vec_scale(operands["s"], operands["a"], *formats(p))}


def _at_the_limits(p: Parameters, generator: Generator, size: int) -> Operands:
    """One lane, a different one each time, scaled to a limit; the others are neighbours of it."""
    a, s = pairs_at_the_limit(p, generator, (size,))
    fmt = formats(p)[0]
    lanes = a + generator.integers(-1, 2, (p["LANES"], size))
    lanes[generator.integers(0, p["LANES"], size), np.arange(size)] = a
    return {"s": s, "a": fmt.saturate(lanes)}


UNIT = PipelinedUnit(
    name="vec_scale",
    parameters={
        "A_INT": 9,
        "A_FRAC": 10,
        "B_INT": 9,
        "B_FRAC": 10,
        "OUT_INT": 9,
        "OUT_FRAC": 10,
        "LANES": 3,
        "SIGNED": 1,
    },
    sets={
        "normal": {"A_INT": 3, "A_FRAC": 15, "B_INT": 5, "B_FRAC": 16, "OUT_INT": 2, "OUT_FRAC": 16},
        "narrow": {"A_INT": 2, "A_FRAC": 1, "B_INT": 2, "B_FRAC": 1, "OUT_INT": 2, "OUT_FRAC": 1},
    },
    exhaustive="narrow",
    inputs=_inputs,
    outputs=_outputs,
    model=_model,
    directed=_at_the_limits,
    breaks=(
        Break("arith/vec_scale.v", "{LANES{s}}", "a"),
        Break("arith/mul_piece.v", "addend << (S_W - 1)", "addend << S_W"),
        Break("arith/delay.v", "chain_next[DEPTH*WIDTH+:WIDTH]", "chain_next[(DEPTH-1)*WIDTH+:WIDTH]"),
    ),
)
