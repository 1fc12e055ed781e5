"""The exact multiplier: ports, parameter sets and model."""

from models.arith import mul
from verif.env.fields import Field, Operands
from verif.env.unit import Break, Parameters, PipelinedUnit


def _inputs(p: Parameters) -> tuple[Field, ...]:
    signed = bool(p["SIGNED"])
    return (Field("a", p["A_W"], p["LANES"], signed), Field("b", p["B_W"], p["LANES"], signed))


def _outputs(p: Parameters) -> tuple[Field, ...]:
    return (Field("p", p["A_W"] + p["B_W"], p["LANES"], bool(p["SIGNED"])),)


def _model(p: Parameters, operands: Operands) -> Operands:
    return {"p": mul(operands["a"], operands["b"], p["A_W"], p["B_W"], bool(p["SIGNED"]))}


UNIT = PipelinedUnit(
    name="mul",
    parameters={"A_W": 19, "B_W": 19, "LANES": 3, "SIGNED": 1},
    sets={
        "point": {"A_W": 25, "B_W": 18},
        "unsigned": {"A_W": 36, "B_W": 21, "LANES": 2, "SIGNED": 0},
        "rests": {"A_W": 22, "B_W": 21},
        "short": {"A_W": 5, "B_W": 8, "LANES": 1},
        "narrow": {"A_W": 6, "B_W": 7, "LANES": 1},
    },
    exhaustive="narrow",
    inputs=_inputs,
    outputs=_outputs,
    model=_model,
    breaks=(
        Break("arith/mul.v", "g_piece[k-1].total + term", "g_piece[k-1].total - term"),
        Break("arith/mul_piece.v", "{1'b0, a[A_LOW+:PIECE_W]}", "{a[A_LOW+PIECE_W-1], a[A_LOW+:PIECE_W]}"),
        Break("arith/mul_piece.v", "i < S_W - 1;", "i < S_W - 1 && i < 3;", set="rests"),
        Break("arith/mul_piece.v", "shift_and_add - (addend", "shift_and_add + (addend", set="short"),
        Break("arith/valid_pipe.v", "if (rst) valid_reg", "if (1'b0) valid_reg"),
    ),
)
