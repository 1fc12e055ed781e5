"""The format conversion: one input format to every kind of output format, side by side in a wrapper."""

from models.arith import resize
from models.fixed import Format
from verif.env.fields import Field, Operands
from verif.env.unit import Break, Parameters, PipelinedUnit

_INT_CHANGES = (-2, -1, 0, 1)
_FRAC_CHANGES = (-2, 0, 2)


def output_formats(p: Parameters) -> dict[str, Format]:
    """By the name of the port: bits added to the integer part and to the fraction, signed or not."""
    names = {}
    for signed in (True, False):
        for i in _INT_CHANGES:
            for f in _FRAC_CHANGES:
                changes = f"i{i + 2}_f{f + 2}"
                fmt = Format(p["IN_INT"] + i, p["IN_FRAC"] + f, signed)
                names[f"{'s' if signed else 'u'}_{changes}"] = fmt
    return names


def input_format(p: Parameters) -> Format:
    """Format of the number that is converted."""
    return Format(p["IN_INT"], p["IN_FRAC"])


def _inputs(p: Parameters) -> tuple[Field, ...]:
    return (Field.of("number", input_format(p)),)


def _outputs(p: Parameters) -> tuple[Field, ...]:
    return tuple(Field.of(name, fmt) for name, fmt in output_formats(p).items())


def _model(p: Parameters, operands: Operands) -> Operands:
    fmt = input_format(p)
    return {name: resize(operands["number"], fmt, out) for name, out in output_formats(p).items()}


UNIT = PipelinedUnit(
    name="resize",
    top="resize_formats",
    parameters={"IN_INT": 11, "IN_FRAC": 20},
    sets={"narrow": {"IN_INT": 4, "IN_FRAC": 4}},
    exhaustive="narrow",
    inputs=_inputs,
    outputs=_outputs,
    model=_model,
    breaks=(
        Break("arith/resize.v", "{negative, {OUT_W - 1{!negative}}}", "{negative, {OUT_W - 1{negative}}}"),
        Break("arith/resize.v", "negative ? {OUT_W{1'b0}} : mid", "mid"),
        Break("arith/resize.v", "{{OUT_W - MID_W{negative}}, mid}", "{{OUT_W - MID_W{1'b0}}, mid}"),
        Break("arith/resize.v", "& {OUT_W{!negative}}", ""),
    ),
)
