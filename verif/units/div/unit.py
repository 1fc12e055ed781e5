"""The signed division: ports, parameter sets, model, and quotients at the limits."""

import numpy as np
from numpy.random import Generator

from models.arith import div
from models.fixed import Format
from verif.env.fields import Field, Operands, bit
from verif.env.unit import Break, Parameters, PipelinedUnit


def _format(p: Parameters) -> Format:
    return Format(p["INT"], p["FRAC"])


def _inputs(p: Parameters) -> tuple[Field, ...]:
    return (Field.of("a", _format(p)), Field.of("b", _format(p)))


def _outputs(p: Parameters) -> tuple[Field, ...]:
    return (Field.of("quotient", Format(p["INT"], p["FRAC"] + p["GUARD"])), bit("div_by_zero"))


def _model(p: Parameters, operands: Operands) -> Operands:
    result = div(operands["a"], operands["b"], _format(p), p["GUARD"])
    return {"quotient": result.quotient, "div_by_zero": result.div_by_zero.astype(np.int64)}


def _at_the_limits(p: Parameters, generator: Generator, size: int) -> Operands:
    """Thirds: quotients just at the largest magnitude; whole quotients; zero over and under."""
    fmt = _format(p)
    b = generator.integers(fmt.min, fmt.max + 1, size) >> generator.integers(0, fmt.width, size)
    whole = b * generator.integers(-3, 4, size)
    limit = b * generator.choice([-1, 1], size) * (1 << (p["INT"] - 1)) + generator.integers(-1, 2, size)
    a = np.choose(np.arange(size) % 3, [whole, limit, generator.integers(-1, 2, size)])
    zero_denominator = np.where(np.arange(size) % 16 == 0, 0, b)
    return {"a": fmt.saturate(a), "b": zero_denominator}


UNIT = PipelinedUnit(
    name="div",
    parameters={"INT": 9, "FRAC": 10, "GUARD": 0},
    sets={"guard": {"GUARD": 4}, "narrow": {"INT": 3, "FRAC": 3, "GUARD": 1}},
    exhaustive="narrow",
    inputs=_inputs,
    outputs=_outputs,
    model=_model,
    directed=_at_the_limits,
    breaks=(
        Break("arith/div.v", "upper >= b_mag_reg", "upper > b_mag_reg"),
        Break("arith/div.v", "if (quot_zero) quotient_reg <= {OUT_W{1'b0}};", "if (1'b0) quotient_reg <= 0;"),
        Break("arith/div.v", "div_by_zero_reg <= quot_by_zero;", "div_by_zero_reg <= quot_overflow;"),
    ),
)
