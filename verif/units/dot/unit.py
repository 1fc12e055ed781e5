"""The dot product: ports, parameter sets and model."""

from models.arith import dot
from models.fixed import Format
from verif.env.fields import Field, Operands
from verif.env.unit import Parameters, PipelinedUnit


def _formats(p: Parameters) -> tuple[Format, Format, Format]:
    return (
        Format(p["A_INT"], p["A_FRAC"]),
        Format(p["B_INT"], p["B_FRAC"]),
        Format(p["OUT_INT"], p["OUT_FRAC"]),
    )


def _inputs(p: Parameters) -> tuple[Field, ...]:
    a, b, _ = _formats(p)
    return (Field.of("a", a, lanes=3), Field.of("b", b, lanes=3))


def _outputs(p: Parameters) -> tuple[Field, ...]:
    return (Field.of("p", _formats(p)[2]),)


def _model(p: Parameters, operands: Operands) -> Operands:
    return {"p": dot(operands["a"], operands["b"], *_formats(p))}


UNIT = PipelinedUnit(
    name="dot",
    parameters={"A_INT": 9, "A_FRAC": 10, "B_INT": 9, "B_FRAC": 10, "OUT_INT": 9, "OUT_FRAC": 10},
    sets={"narrow": {"A_INT": 1, "A_FRAC": 2, "B_INT": 1, "B_FRAC": 1, "OUT_INT": 1, "OUT_FRAC": 1}},
    exhaustive="narrow",
    inputs=_inputs,
    outputs=_outputs,
    model=_model,
)
