"""The iterative division: ports, parameter sets and model."""

import numpy as np
from numpy.random import Generator

from models.arith import div_iter
from verif.env.fields import Field, Operands
from verif.env.unit import Break, Parameters, StreamUnit


def _inputs(p: Parameters) -> tuple[Field, ...]:
    return (Field("num", p["NUM_W"], signed=False), Field("den", p["DEN_W"], signed=False))


def _outputs(p: Parameters) -> tuple[Field, ...]:
    return (Field("quotient", p["NUM_W"], signed=False), Field("remainder", p["DEN_W"], signed=False))


def _model(p: Parameters, operands: Operands) -> Operands:
    return div_iter(operands["num"], operands["den"], p["NUM_W"], p["DEN_W"])._asdict()


def _near_multiples(p: Parameters, generator: Generator, size: int) -> Operands:
    """Multiples of the denominator and their neighbours."""
    den = generator.integers(1, 1 << p["DEN_W"], size)
    times = generator.integers(0, (1 << p["NUM_W"]) // den)
    num = den * times + generator.integers(-1, 2, size)
    return {"num": np.clip(num, 0, (1 << p["NUM_W"]) - 1), "den": den}


UNIT = StreamUnit(
    name="div_iter",
    parameters={"NUM_W": 24, "DEN_W": 12},
    sets={"inverse_radius": {"NUM_W": 20, "DEN_W": 5}, "narrow": {"NUM_W": 6, "DEN_W": 4}},
    exhaustive="narrow",
    inputs=_inputs,
    outputs=_outputs,
    model=_model,
    directed=_near_multiples,
    breaks=(
        Break("arith/div_iter.v", "wire fits = !difference[DEN_W+1];", "wire fits = difference[DEN_W+1];"),
        Break("arith/iterate.v", "(out_valid_reg && !out_ready)", "1'b0"),
        Break("arith/iterate.v", "if (rst) count_reg <=", "if (1'b0) count_reg <="),
    ),
)
