"""The unsigned long division: ports, parameter sets and model."""

import numpy as np
from numpy.random import Generator

from models.arith import div_core
from verif.env.fields import Field, Operands
from verif.env.unit import Break, Parameters, PipelinedUnit


def _inputs(p: Parameters) -> tuple[Field, ...]:
    return (
        Field("upper", p["DEN_W"], p["LANES"], signed=False),
        Field("lower", p["QUOT_W"], p["LANES"], signed=False),
        Field("den", p["DEN_W"], signed=False),
    )


def _outputs(p: Parameters) -> tuple[Field, ...]:
    return (
        Field("quotient", p["QUOT_W"], p["LANES"], signed=False),
        Field("remainder", p["DEN_W"], p["LANES"], signed=False),
    )


def _model(p: Parameters, operands: Operands) -> Operands:
    upper, lower, den = operands["upper"], operands["lower"], operands["den"]
    return div_core(upper, lower, den, p["DEN_W"], p["QUOT_W"])._asdict()


def _that_fit(p: Parameters, generator: Generator, size: int) -> Operands:
    """Dividends whose quotient fits, every second one a multiple of the denominator or next to one."""
    shape = (p["LANES"], size) if p["LANES"] > 1 else (size,)
    den = 1 + (generator.integers(0, (1 << p["DEN_W"]) - 1, size) >> generator.integers(0, p["DEN_W"], size))
    quotient = generator.integers(0, 1 << p["QUOT_W"], shape) >> generator.integers(0, p["QUOT_W"], shape)
    near = np.minimum(generator.integers(0, 3, shape), den - 1)
    remainder = np.where(np.arange(size) % 2 == 0, near, generator.integers(0, den, shape))
    dividend = quotient * den + remainder
    return {"upper": dividend >> p["QUOT_W"], "lower": dividend & ((1 << p["QUOT_W"]) - 1), "den": den}


UNIT = PipelinedUnit(
    name="div_core",
    parameters={"DEN_W": 20, "QUOT_W": 18, "LANES": 1},
    sets={
        "unit_vector": {"DEN_W": 19, "QUOT_W": 17, "LANES": 3},
        "narrow": {"DEN_W": 4, "QUOT_W": 4, "LANES": 1},
    },
    exhaustive="narrow",
    inputs=_inputs,
    outputs=_outputs,
    model=_model,
    directed=_that_fit,
    breaks=(
        Break("arith/div_core.v", "(g_stage[QUOT_W].den_reg & {DEN_W{r[DEN_W]}})", "{DEN_W{1'b0}}"),
        Break("arith/div_core.v", "{{DEN_W{1'b0}}, !add}", "{DEN_W + 1{1'b0}}"),
        Break("arith/valid_pipe.v", "valid_next[LATENCY-1:0]", "valid_next[LATENCY-1:0] | valid_reg"),
    ),
)
