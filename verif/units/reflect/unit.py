"""The mirrored direction: ports, model, unit vectors at all angles."""

from numpy.random import Generator

from models.core import reflect
from models.formats import BUILDS
from models.header import defines, selected
from verif.env import vectors
from verif.env.fields import Field, Operands
from verif.env.unit import Break, Parameters, PipelinedUnit


def _inputs(p: Parameters) -> tuple[Field, ...]:
    unit = selected(p).unit
    return (Field.of("direction", unit, lanes=3), Field.of("normal", unit, lanes=3))


def _outputs(p: Parameters) -> tuple[Field, ...]:
    unit = selected(p).unit
    return (Field.of("mirrored", unit, lanes=3), Field.of("cosine", unit))


def _model(p: Parameters, operands: Operands) -> Operands:
    return reflect(operands["direction"], operands["normal"], selected(p))._asdict()


def _directed(p: Parameters, generator: Generator, size: int) -> Operands:
    """Unit vectors: head on, grazing, from behind, and at any angle."""
    unit = selected(p).unit
    normal = vectors.directions(generator, size)
    direction = vectors.at_cosine(generator, normal, vectors.cosines(generator, size))
    return {"direction": vectors.truncated(direction, unit), "normal": vectors.truncated(normal, unit)}


UNIT = PipelinedUnit(
    name="reflect",
    sets={"book": defines(BUILDS["book"])},
    inputs=_inputs,
    outputs=_outputs,
    model=_model,
    directed=_directed,
    breaks=(
        Break("shade/reflect.v", "- {n[W-1], n, 1'b0}", "- {{2{n[W-1]}}, n}"),
        Break("shade/reflect.v", "- {n[W-1], n, 1'b0}", "- {1'b0, n, 1'b0}"),
        Break("shade/reflect.v", "({along_cosine, along_tag})", "({cosine_value, along_tag})"),
        Break("shade/reflect.v", ".in_valid (along_valid)", ".in_valid (1'b1)"),
    ),
)
