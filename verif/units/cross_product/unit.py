"""The cross product: ports, parameter sets, model, and vectors whose product is at a limit or zero."""

import numpy as np
from numpy.random import Generator

from models.arith import cross_product
from verif.env.fields import Field, Operands
from verif.env.unit import Break, Parameters, PipelinedUnit
from verif.units.products import formats, pairs_at_the_limit


def _inputs(p: Parameters) -> tuple[Field, ...]:
    a, b, _ = formats(p)
    return (Field.of("a", a, lanes=3), Field.of("b", b, lanes=3))


def _outputs(p: Parameters) -> tuple[Field, ...]:
    return (Field.of("p", formats(p)[2], lanes=3),)


def _model(p: Parameters, operands: Operands) -> Operands:
    return {"p": cross_product(operands["a"], operands["b"], *formats(p))}


def _at_the_limits(p: Parameters, generator: Generator, size: int) -> Operands:
    """Halves: components next to a limit; vectors that are parallel, or almost."""
    a, b = pairs_at_the_limit(p, generator, (3, size), addends=2)
    parallel = a * generator.integers(-2, 3, size) + generator.integers(-1, 2, (3, size))
    b = np.where(np.arange(size) % 2 == 0, parallel, b[[1, 2, 0]])
    return {"a": a, "b": formats(p)[1].saturate(b)}


UNIT = PipelinedUnit(
    name="cross_product",
    parameters={"A_INT": 9, "A_FRAC": 10, "B_INT": 9, "B_FRAC": 10, "OUT_INT": 9, "OUT_FRAC": 10},
    sets={"narrow": {"A_INT": 1, "A_FRAC": 1, "B_INT": 1, "B_FRAC": 1, "OUT_INT": 1, "OUT_FRAC": 1}},
    exhaustive="narrow",
    inputs=_inputs,
    outputs=_outputs,
    model=_model,
    directed=_at_the_limits,
    breaks=(
        Break("arith/cross_product.v", "({b_zxy, b_yzx})", "({b_yzx, b_zxy})"),
        Break("arith/cross_product.v", "{minus[(lane+1)*PRODUCT_W-1], minus", "{1'b0, minus"),
        Break("arith/cross_product.v", ".LATENCY(2)", ".LATENCY(1)"),
    ),
)
