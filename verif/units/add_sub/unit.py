"""The saturating sum and difference: ports, parameter sets, model, and sums at the limits."""

import numpy as np
from numpy.random import Generator

from models.arith import add_sub
from models.fixed import Format
from verif.env.fields import Field, Operands
from verif.env.unit import Break, Parameters, PipelinedUnit


def _port(name: str, p: Parameters) -> Field:
    return Field.of(name, Format(p["INT"], p["FRAC"]), lanes=p["LANES"])


def _inputs(p: Parameters) -> tuple[Field, ...]:
    return (_port("a", p), _port("b", p))


def _outputs(p: Parameters) -> tuple[Field, ...]:
    return (_port("sum", p),)


def _model(p: Parameters, operands: Operands) -> Operands:
    fmt = Format(p["INT"], p["FRAC"])
    return {"sum": add_sub(operands["a"], operands["b"], fmt, subtract=bool(p["SUBTRACT"]))}


def _at_the_limits(p: Parameters, generator: Generator, size: int) -> Operands:
    """Sums next to either limit and next to zero: equal, opposite and complementary operands."""
    port = _port("a", p)
    shape = (port.lanes, size) if port.lanes > 1 else (size,)
    a = generator.integers(port.low, port.high + 1, shape)
    target = generator.choice([port.low, 0, port.high], shape) + generator.integers(-2, 3, shape)
    b = a - target if p["SUBTRACT"] else target - a
    return {"a": a, "b": np.clip(b, port.low, port.high)}


UNIT = PipelinedUnit(
    name="add_sub",
    parameters={"INT": 9, "FRAC": 10, "LANES": 3, "SUBTRACT": 0},
    sets={
        "subtract": {"INT": 10, "FRAC": 15, "SUBTRACT": 1},
        "narrow": {"INT": 3, "FRAC": 3, "LANES": 1, "SUBTRACT": 1},
    },
    exhaustive="narrow",
    inputs=_inputs,
    outputs=_outputs,
    model=_model,
    directed=_at_the_limits,
    breaks=(
        Break("arith/add_sub.v", "{a[lane*W+W-1], a[lane*W+:W]}", "{1'b0, a[lane*W+:W]}"),
        Break("arith/add_sub.v", "a_wide - b_wide", "a_wide + b_wide", set="subtract"),
        Break("arith/add_sub.v", ".LATENCY(1)", ".LATENCY(2)"),
    ),
)
