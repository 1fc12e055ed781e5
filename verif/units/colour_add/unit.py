"""The sum of colours: ports, model, sums around the largest."""

from numpy.random import Generator

from models.core.phong import colour_add
from models.formats import Knobs, formats
from verif.env.fields import Field, Operands
from verif.env.unit import Break, Parameters, PipelinedUnit

FMTS = formats(Knobs())


def _inputs(_: Parameters) -> tuple[Field, ...]:
    return (Field.of("a", FMTS.shade, lanes=3), Field.of("b", FMTS.shade, lanes=3))


def _outputs(_: Parameters) -> tuple[Field, ...]:
    return (Field.of("sum", FMTS.shade, lanes=3),)


def _model(_: Parameters, operands: Operands) -> Operands:
    return {"sum": colour_add(operands["a"], operands["b"], FMTS)}


def _directed(_: Parameters, generator: Generator, size: int) -> Operands:
    """Sums within two steps of the largest, lane by lane."""
    a = generator.integers(0, FMTS.shade.max, (3, size), endpoint=True)
    beside = generator.integers(-2, 2, (3, size), endpoint=True)
    return {"a": a, "b": FMTS.shade.saturate(FMTS.shade.max - a + beside)}


UNIT = PipelinedUnit(
    name="colour_add",
    inputs=_inputs,
    outputs=_outputs,
    model=_model,
    directed=_directed,
    breaks=(
        Break("shade/colour_add.v", "wide[W-1:0] | {W{wide[W]}}", "wide[W-1:0]"),
        Break("shade/colour_add.v", "{W{wide[W]}}", "{W{wide[W-1]}}"),
        Break("shade/colour_add.v", ".in_valid (in_valid)", ".in_valid (in_valid && !in_tag[0])"),
    ),
)
