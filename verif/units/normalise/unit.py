"""A vector over its length: ports, parameter sets and model."""

import numpy as np

from models.arith import norm_format, normalise
from models.fixed import Format
from verif.env.fields import Field, Operands, bit
from verif.env.unit import Break, Parameters, PipelinedUnit
from verif.units.norm.unit import special_vectors, vector


def _outputs(p: Parameters) -> tuple[Field, ...]:
    return (
        Field.of("unit", Format(2, p["OUT_FRAC"]), lanes=3),
        Field.of("norm", norm_format(Format(p["INT"], p["FRAC"]), p["GUARD"])),
        bit("degenerate"),
    )


def _model(p: Parameters, operands: Operands) -> Operands:
    result = normalise(operands["a"], Format(p["INT"], p["FRAC"]), p["OUT_FRAC"], p["GUARD"])
    return {"unit": result.unit, "norm": result.norm, "degenerate": result.degenerate.astype(np.int64)}


UNIT = PipelinedUnit(
    name="normalise",
    parameters={"INT": 9, "FRAC": 10, "OUT_FRAC": 10, "GUARD": 0},
    sets={
        "unit_vector": {"INT": 1, "FRAC": 17, "OUT_FRAC": 16},
        "narrow": {"INT": 2, "FRAC": 2, "OUT_FRAC": 4, "GUARD": 1},
    },
    exhaustive="narrow",
    inputs=vector,
    outputs=_outputs,
    model=_model,
    directed=special_vectors,
    breaks=(
        Break("arith/normalise.v", "quot_negative[lane] ? -positive", "quot_negative[0] ? -positive"),
        Break("arith/normalise.v", "degenerate_reg <= quot_degenerate;", "degenerate_reg <= 1'b0;"),
        Break("arith/normalise.v", "if (quot_degenerate) unit_reg", "if (1'b0) unit_reg"),
        Break("arith/delay.v", "if (rst || pointer_reg == LAST)", "if (rst)"),
    ),
)
