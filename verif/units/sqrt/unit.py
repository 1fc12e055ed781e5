"""The pipelined square root: ports, parameter sets, model, and operands that are hard for any root."""

import numpy as np
from numpy.random import Generator

from models.arith import sqrt
from verif.env.fields import Field, Operands
from verif.env.unit import Break, Parameters, PipelinedUnit


def radicand(p: Parameters) -> tuple[Field, ...]:
    """What a root is taken of."""
    return (Field("radicand", p["D_W"], signed=False),)


def root_and_remainder(p: Parameters) -> tuple[Field, ...]:
    """What comes out of either square root."""
    return (
        Field("root", p["D_W"] // 2, signed=False),
        Field("remainder", p["D_W"] // 2 + 1, signed=False),
    )


def near_squares(p: Parameters, generator: Generator, size: int) -> Operands:
    """Perfect squares of every magnitude and their neighbours."""
    bits = p["D_W"] // 2
    root = generator.integers(0, 1 << bits, size) >> generator.integers(0, bits, size)
    near = root * root + generator.integers(-1, 2, size)
    return {"radicand": np.clip(near, 0, (1 << p["D_W"]) - 1)}


def _model(p: Parameters, operands: Operands) -> Operands:
    return sqrt(operands["radicand"], p["D_W"])._asdict()


UNIT = PipelinedUnit(
    name="sqrt",
    parameters={"D_W": 40},
    sets={"half_chord": {"D_W": 34}, "narrow": {"D_W": 12}},
    exhaustive="narrow",
    inputs=radicand,
    outputs=root_and_remainder,
    model=_model,
    directed=near_squares,
    breaks=(
        Break("arith/sqrt_step.v", "wire add = r[K];", "wire add = 1'b0;"),
        Break("arith/sqrt.v", "(r_last[STEPS+1] ? {q_last, 1'b1} : {STEPS + 1{1'b0}})", "{STEPS + 1{1'b0}}"),
        Break("arith/valid_pipe.v", "if (rst) valid_reg", "if (1'b0) valid_reg"),
    ),
)
