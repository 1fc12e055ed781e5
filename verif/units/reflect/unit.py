"""The mirrored direction: ports, model, unit vectors at all angles."""

from numpy.random import Generator

from models.core import reflect
from models.formats import Knobs, formats
from verif.env import vectors
from verif.env.fields import Field, Operands
from verif.env.unit import Break, Parameters, PipelinedUnit

FMTS = formats(Knobs())


def _inputs(_: Parameters) -> tuple[Field, ...]:
    return (Field.of("direction", FMTS.unit, lanes=3), Field.of("normal", FMTS.unit, lanes=3))


def _outputs(_: Parameters) -> tuple[Field, ...]:
    return (Field.of("mirrored", FMTS.unit, lanes=3),)


def _model(_: Parameters, operands: Operands) -> Operands:
    return {"mirrored": reflect(operands["direction"], operands["normal"], FMTS)}


def _directed(_: Parameters, generator: Generator, size: int) -> Operands:
    """Unit vectors: head on, grazing, from behind, and at any angle."""
    normal = vectors.directions(generator, size)
    direction = vectors.at_cosine(generator, normal, vectors.cosines(generator, size))
    return {
        "direction": vectors.truncated(direction, FMTS.unit),
        "normal": vectors.truncated(normal, FMTS.unit),
    }


UNIT = PipelinedUnit(
    name="reflect",
    inputs=_inputs,
    outputs=_outputs,
    model=_model,
    directed=_directed,
    breaks=(
        Break("shade/reflect.v", "- {n[W-1], n, 1'b0}", "- {{2{n[W-1]}}, n}"),
        Break("shade/reflect.v", "- {n[W-1], n, 1'b0}", "- {1'b0, n, 1'b0}"),
        Break("shade/reflect.v", ".in_valid (along_valid)", ".in_valid (1'b1)"),
    ),
)
