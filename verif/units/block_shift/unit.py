"""The block floating point shift: ports, parameter sets, model, and vectors of every magnitude."""

from numpy.random import Generator

from models.arith import block_shift
from verif.env.fields import Field, Operands
from verif.env.unit import Break, Parameters, PipelinedUnit


def _inputs(p: Parameters) -> tuple[Field, ...]:
    return (Field("a", p["IN_W"], p["LANES"]),)


def _outputs(p: Parameters) -> tuple[Field, ...]:
    shift_bits = (p["IN_W"] - 1).bit_length()
    return (Field("p", p["OUT_W"], p["LANES"]), Field("shift", shift_bits, signed=False))


def _model(p: Parameters, operands: Operands) -> Operands:
    shifted = block_shift(operands["a"], p["IN_W"], p["OUT_W"])
    return {"p": shifted.vector, "shift": shifted.shift}


def _of_every_magnitude(p: Parameters, generator: Generator, size: int) -> Operands:
    """Vectors whose lanes are all short alike, so that every shift comes up."""
    half = 1 << (p["IN_W"] - 1)
    lanes = generator.integers(-half, half, (p["LANES"], size))
    return {"a": lanes >> generator.integers(0, p["IN_W"], size)}


UNIT = PipelinedUnit(
    name="block_shift",
    parameters={"IN_W": 19, "OUT_W": 18, "LANES": 3},
    sets={"reach": {"IN_W": 26, "OUT_W": 18}, "narrow": {"IN_W": 6, "OUT_W": 8, "LANES": 2}},
    exhaustive="narrow",
    inputs=_inputs,
    outputs=_outputs,
    model=_model,
    directed=_of_every_magnitude,
    breaks=(
        Break("arith/block_shift.v", "rest = rest << (1 << i);", "rest = rest << i;"),
        Break("arith/block_shift.v", "shift_reg <= count_reg;", "shift_reg <= count_reg + 1'b1;"),
        Break("arith/block_shift.v", "a_reg[lane*IN_W+:IN_W] << count_reg", "a_reg[lane*IN_W+:IN_W]"),
    ),
)
