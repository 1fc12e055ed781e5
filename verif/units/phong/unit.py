"""What a light adds to a hit: ports, model, angles and coefficients that matter."""

from typing import Any

import numpy as np
from numpy.random import Generator

from models.core import phong
from models.fixed import Raw
from models.formats import Knobs, formats
from verif.env import vectors
from verif.env.fields import Field, Operands, bit
from verif.env.unit import Break, Parameters, PipelinedUnit

FMTS = formats(Knobs())


def _inputs(_: Parameters) -> tuple[Field, ...]:
    return (
        Field.of("normal", FMTS.unit, lanes=3),
        Field.of("mirrored", FMTS.unit, lanes=3),
        Field.of("direction", FMTS.unit, lanes=3),
        bit("dark"),
        Field.of("k_diffuse", FMTS.coeff, lanes=3),
        Field.of("k_specular", FMTS.coeff, lanes=3),
        Field.of("intensity", FMTS.coeff, lanes=3),
        Field.of("attenuation", FMTS.coeff, lanes=3),
    )


def _outputs(_: Parameters) -> tuple[Field, ...]:
    return (Field.of("colour", FMTS.shade, lanes=3),)


def _model(p: Parameters, operands: Operands) -> Operands:
    given: dict[str, Any] = {port.name: operands[port.name] for port in _inputs(p)}
    given["dark"] = given["dark"] == 1
    return {"colour": phong(**given, fmts=FMTS)}


def coefficients(generator: Generator, size: int) -> Raw:
    """Colours (3, n) in `coeff`: usual ones, none, full, so large that sums and products saturate."""
    usual = generator.integers(0, FMTS.coeff.one, (3, size), endpoint=True)
    large = generator.integers(0, FMTS.coeff.max, (3, size), endpoint=True)
    ends = generator.choice([0, FMTS.coeff.one, FMTS.coeff.max], (3, size), p=(0.3, 0.6, 0.1))
    return vectors.pick(generator, usual, usual, usual, ends, large)


def _directed(_: Parameters, generator: Generator, size: int) -> Operands:
    """Unit vectors with cosines of all sizes, mostly lit; a few dark."""
    normal = vectors.directions(generator, size)
    cosine = vectors.cosines(generator, size)
    turned = np.where(generator.random(size) < 0.8, np.abs(cosine), cosine)
    direction = vectors.at_cosine(generator, normal, turned)
    highlight = 1.0 - 2.0 ** -generator.uniform(0.0, 12.0, size)
    specular = np.where(generator.random(size) < 0.6, highlight, vectors.cosines(generator, size))
    mirrored = vectors.at_cosine(generator, direction, specular)
    return {
        "normal": vectors.truncated(normal, FMTS.unit),
        "mirrored": vectors.truncated(mirrored, FMTS.unit),
        "direction": vectors.truncated(direction, FMTS.unit),
        "dark": (generator.random(size) < 0.1).astype(np.int64),
        "k_diffuse": coefficients(generator, size),
        "k_specular": coefficients(generator, size),
        "intensity": coefficients(generator, size),
        "attenuation": np.minimum(coefficients(generator, size), FMTS.coeff.one),
    }


UNIT = PipelinedUnit(
    name="phong",
    inputs=_inputs,
    outputs=_outputs,
    model=_model,
    directed=_directed,
    breaks=(
        Break("shade/phong.v", "!cosine_dark && clamped", "clamped"),
        Break("shade/phong.v", "product_lit ? product : {3 * SHADE_W{1'b0}}", "product"),
        Break("shade/phong.v", "{{3{power_cosine}}, {3{power}}}", "{{3{power}}, {3{power_cosine}}}"),
    ),
)
