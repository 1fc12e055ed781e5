"""What a light adds to a hit: ports, model, angles and coefficients that matter."""

from typing import Any

import numpy as np
from numpy.random import Generator

from models.core import phong
from models.fixed import Raw
from models.formats import BUILDS, Formats
from models.header import defines, selected
from verif.env import vectors
from verif.env.fields import Field, Operands, bit
from verif.env.unit import Break, Parameters, PipelinedUnit


def _inputs(p: Parameters) -> tuple[Field, ...]:
    fmts = selected(p)
    return (
        Field.of("normal", fmts.unit, lanes=3),
        Field.of("mirrored", fmts.unit, lanes=3),
        Field.of("direction", fmts.unit, lanes=3),
        bit("dark"),
        Field.of("k_diffuse", fmts.coeff, lanes=3),
        Field.of("k_specular", fmts.coeff, lanes=3),
        Field.of("intensity", fmts.coeff, lanes=3),
    )


def _outputs(p: Parameters) -> tuple[Field, ...]:
    return (Field.of("colour", selected(p).shade, lanes=3),)


def _model(p: Parameters, operands: Operands) -> Operands:
    given: dict[str, Any] = {port.name: operands[port.name] for port in _inputs(p)}
    given["dark"] = given["dark"] == 1
    return {"colour": phong(**given, fmts=selected(p))}


def _coefficients(generator: Generator, size: int, fmts: Formats) -> Raw:
    """Colours (3, n) in `coeff`: usual ones, none, full, so large that sums and products saturate."""
    coeff = fmts.coeff
    usual = generator.integers(0, coeff.one, (3, size), endpoint=True)
    large = generator.integers(0, coeff.max, (3, size), endpoint=True)
    ends = generator.choice([0, coeff.one, coeff.max], (3, size), p=(0.3, 0.6, 0.1))
    return vectors.pick(generator, usual, usual, usual, ends, large)


def _directed(p: Parameters, generator: Generator, size: int) -> Operands:
    """Unit vectors with cosines of all sizes, mostly lit; a few dark. Along an axis some are a single bit."""
    fmts = selected(p)
    normal = vectors.directions(generator, size)
    bits = 2.0 ** -generator.integers(0, fmts.cosine.frac_bits, size, endpoint=True)
    cosine = vectors.pick(generator, vectors.cosines(generator, size), vectors.cosines(generator, size), bits)
    turned = np.where(generator.random(size) < 0.8, np.abs(cosine), cosine)
    direction = vectors.at_cosine(generator, normal, turned)
    highlight = 1.0 - 2.0 ** -generator.uniform(0.0, 12.0, size)
    specular = np.where(generator.random(size) < 0.6, highlight, vectors.cosines(generator, size))
    mirrored = vectors.at_cosine(generator, direction, specular)
    return {
        "normal": vectors.truncated(normal, fmts.unit),
        "mirrored": vectors.truncated(mirrored, fmts.unit),
        "direction": vectors.truncated(direction, fmts.unit),
        "dark": (generator.random(size) < 0.1).astype(np.int64),
        "k_diffuse": _coefficients(generator, size, fmts),
        "k_specular": _coefficients(generator, size, fmts),
        "intensity": _coefficients(generator, size, fmts),
    }


UNIT = PipelinedUnit(
    name="phong",
    sets={"book": defines(BUILDS["book"])},
    inputs=_inputs,
    outputs=_outputs,
    model=_model,
    directed=_directed,
    breaks=(
        Break("shade/phong.v", "!cosine_dark && clamped", "clamped"),
        Break("shade/phong.v", "product_lit ? product : {3 * SHADE_W{1'b0}}", "product"),
        Break("shade/phong.v", "({sum_lit, sum_intensity, sum_tag})", "({sum_intensity, sum_lit, sum_tag})"),
        Break("shade/phong.v", "{{3{power_cosine}}, {3{power}}}", "{{3{power}}, {3{power_cosine}}}"),
    ),
)
