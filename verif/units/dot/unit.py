"""The dot product: ports, parameter sets, model, and vectors whose product is at a limit."""

import numpy as np
from numpy.random import Generator

from models.arith import dot
from verif.env.fields import Field, Operands
from verif.env.unit import Break, Parameters, PipelinedUnit
from verif.units.products import formats, pairs_at_the_limit


def _inputs(p: Parameters) -> tuple[Field, ...]:
    a, b, _ = formats(p)
    return (Field.of("a", a, lanes=3), Field.of("b", b, lanes=3))


def _outputs(p: Parameters) -> tuple[Field, ...]:
    return (Field.of("p", formats(p)[2]),)


def _model(p: Parameters, operands: Operands) -> Operands:
    return {"p": dot(operands["a"], operands["b"], *formats(p))}


def _at_the_limits(p: Parameters, generator: Generator, size: int) -> Operands:
    """Halves: three products that add up to a limit; two large ones that cancel and a small third."""
    a, b = pairs_at_the_limit(p, generator, (3, size), addends=3)
    cancels = np.arange(size) % 2 == 0
    a[1], b[1] = np.where(cancels, a[0], a[1]), np.where(cancels, -b[0], b[1])
    b[2] = np.where(cancels, generator.integers(-1, 2, size), b[2])
    return {"a": a, "b": formats(p)[1].saturate(b)}


UNIT = PipelinedUnit(
    name="dot",
    parameters={"A_INT": 9, "A_FRAC": 10, "B_INT": 9, "B_FRAC": 10, "OUT_INT": 9, "OUT_FRAC": 10},
    sets={
        "along": {"A_INT": 2, "A_FRAC": 16, "B_INT": 10, "B_FRAC": 15, "OUT_INT": 10, "OUT_FRAC": 15},
        "narrow": {"A_INT": 1, "A_FRAC": 1, "B_INT": 1, "B_FRAC": 1, "OUT_INT": 1, "OUT_FRAC": 1},
    },
    exhaustive="narrow",
    inputs=_inputs,
    outputs=_outputs,
    model=_model,
    directed=_at_the_limits,
    breaks=(
        Break("arith/dot.v", "{{2{product[(lane+1)*PRODUCT_W-1]}}", "{{2{1'b0}}"),
        Break("arith/resize.v", "assign out = overflow ?", "assign out = 1'b0 ?"),
        Break("arith/dot.v", ".in_valid (product_valid)", ".in_valid (in_valid)"),
    ),
)
