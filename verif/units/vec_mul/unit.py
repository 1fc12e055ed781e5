"""The point-wise product of vectors: ports, parameter sets and model."""

from numpy.random import Generator

from models.arith import vec_mul
from verif.env.fields import Field, Operands
from verif.env.unit import Break, Parameters, PipelinedUnit
from verif.units.products import formats, pairs_at_the_limit


def _inputs(p: Parameters) -> tuple[Field, ...]:
    a, b, _ = formats(p)
    return (Field.of("a", a, p["LANES"]), Field.of("b", b, p["LANES"]))


def _outputs(p: Parameters) -> tuple[Field, ...]:
    return (Field.of("p", formats(p)[2], p["LANES"]),)


def _model(p: Parameters, operands: Operands) -> Operands:
    return {"p": vec_mul(operands["a"], operands["b"], *formats(p))}


def _at_the_limits(p: Parameters, generator: Generator, size: int) -> Operands:
    shape = (p["LANES"], size) if p["LANES"] > 1 else (size,)
    a, b = pairs_at_the_limit(p, generator, shape)
    return {"a": a, "b": b}


UNIT = PipelinedUnit(
    name="vec_mul",
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
        "coefficients": {"B_INT": 1, "B_FRAC": 16, "OUT_FRAC": 12, "LANES": 6, "SIGNED": 0},
        "narrow": {
            "A_INT": 3,
            "A_FRAC": 3,
            "B_INT": 2,
            "B_FRAC": 4,
            "OUT_INT": 2,
            "OUT_FRAC": 3,
            "LANES": 1,
        },
    },
    exhaustive="narrow",
    inputs=_inputs,
    outputs=_outputs,
    model=_model,
    directed=_at_the_limits,
    breaks=(
        Break("arith/resize.v", "assign out = overflow ?", "assign out = 1'b0 ?"),
        Break("arith/resize.v", "| {OUT_W{overflow}}", "| {OUT_W{1'b0}}", set="coefficients"),
        Break("arith/vec_mul.v", ".in_tag   (product_tag)", ".in_tag   (in_tag)"),
    ),
)
