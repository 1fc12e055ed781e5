"""The transmitted direction: ports, model, surfaces met at all angles, critical ones among them."""

import numpy as np
from numpy.random import Generator

from models.core import reflect, refract
from models.fixed import Raw
from models.formats import BUILDS, Formats
from models.header import defines, selected
from models.limits import INDEX_STEP
from models.scene.types import INDEX
from verif.env import vectors
from verif.env.fields import Field, Operands, bit
from verif.env.unit import Break, Parameters, PipelinedUnit
from verif.env.vectors import Floats


def eta(index: Raw, leaving: Raw) -> Floats:
    """n_from / n_to of codes (n,)."""
    n = 1.0 + index * float(INDEX_STEP)
    return np.where(leaving == 1, n, 1.0 / n)


def _inputs(p: Parameters) -> tuple[Field, ...]:
    fmts = selected(p)
    return (
        Field.of("direction", fmts.unit, lanes=3),
        Field.of("normal", fmts.unit, lanes=3),
        Field.of("mirrored", fmts.unit, lanes=3),
        Field.of("cosine", fmts.unit),
        Field.of("index", INDEX),
        bit("leaving"),
    )


def _outputs(p: Parameters) -> tuple[Field, ...]:
    return (Field.of("transmitted", selected(p).unit, lanes=3), bit("total"))


def _model(p: Parameters, operands: Operands) -> Operands:
    given = {port.name: operands[port.name] for port in _inputs(p)}
    leaving = given.pop("leaving") == 1
    return refract(**given, leaving=leaving, fmts=selected(p))._asdict()


def _directed(p: Parameters, generator: Generator, size: int) -> Operands:
    """Rays that meet a surface from its front: head on, grazing, at any angle and at the critical one."""
    fmts = selected(p)
    index = generator.integers(0, INDEX.max, size, endpoint=True)
    index = np.where(generator.random(size) < 0.15, 0, index)
    leaving = generator.integers(0, 1, size, endpoint=True)
    near = 1.0 + generator.choice([-1.0, 1.0], size) * 2.0 ** -generator.uniform(6.0, 24.0, size)
    critical = np.sqrt(np.maximum(0.0, 1.0 - (near / (1.0 + index * float(INDEX_STEP))) ** 2))
    anything = np.abs(vectors.cosines(generator, size))
    normal = vectors.directions(generator, size)
    cosine = -vectors.pick(generator, anything, anything, critical)
    direction = vectors.truncated(vectors.at_cosine(generator, normal, cosine), fmts.unit)
    return meeting(direction, vectors.truncated(normal, fmts.unit), index, leaving, fmts)


def meeting(direction: Raw, normal: Raw, index: Raw, leaving: Raw, fmts: Formats) -> Operands:
    """Operands of directions at surfaces, with what the unit before this one makes of them."""
    mirror = reflect(direction, normal, fmts)
    return {
        "direction": direction,
        "normal": normal,
        "mirrored": mirror.mirrored,
        "cosine": mirror.cosine,
        "index": index,
        "leaving": leaving,
    }


UNIT = PipelinedUnit(
    name="refract",
    sets={"book": defines(BUILDS["book"])},
    inputs=_inputs,
    outputs=_outputs,
    model=_model,
    directed=_directed,
    breaks=(
        Break("shade/refract.v", "leave = ((one + code) <<", "leave = ((one + code - 1) <<"),
        Break("shade/refract.v", "/ ((one + code) * (one + code))", "/ ((one + code) * one)"),
        Break("shade/refract.v", "opposite > COSINE_ONE ? COSINE_ONE : opposite", "opposite"),
        Break("shade/refract.v", "total_reg ? ETA_ONE : radicand_eta", "radicand_eta"),
        Break("shade/refract.v", "root_total ? {GAIN_W{1'b0}} : gain_next", "gain_next"),
        Break(
            "shade/refract.v", "{{GAIN_W - ROOT_W{1'b0}}, root}", "{{GAIN_W - ROOT_W{root[ROOT_W-1]}}, root}"
        ),
        Break(
            "shade/refract.v",
            "({sine_vectors, sine_eta, bent, sine_tag})",
            "({square_vectors, sine_eta, bent, sine_tag})",
        ),
    ),
)
