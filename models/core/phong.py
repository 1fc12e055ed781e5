"""One light on one hit: models of ``hdl/shade/highlight.v`` and ``hdl/shade/phong.v`` (book 8.2.3)."""

import numpy as np
from numpy.typing import NDArray

from models.arith import dot, resize, vec_mul
from models.fixed import Raw
from models.formats import Formats

_SQUARINGS = 4


def highlight(cosine: Raw, fmts: Formats) -> Raw:
    """``cosine**16`` in the format `cosine`: four squarings, each floored and saturated."""
    for _ in range(_SQUARINGS):
        cosine = vec_mul(cosine, cosine, fmts.cosine, fmts.cosine, fmts.cosine)
    return cosine


def phong(
    normal: Raw,
    mirrored: Raw,
    direction: Raw,
    dark: NDArray[np.bool_],
    k_diffuse: Raw,
    k_specular: Raw,
    intensity: Raw,
    fmts: Formats,
) -> Raw:
    """What a light adds, (3, n) in `shade`: zero where N.L <= 0 or the light is ``dark``.

    normal, mirrored, direction: N, R, L of shape (3, n). Coefficients and intensity: (3, n) or (3, 1) in
    `coeff`.
    """
    diffuse_cosine = resize(dot(normal, direction, fmts.unit, fmts.unit, fmts.unit), fmts.unit, fmts.cosine)
    specular_cosine = resize(
        dot(mirrored, direction, fmts.unit, fmts.unit, fmts.unit), fmts.unit, fmts.cosine
    )
    lit = ~dark & (diffuse_cosine > 0)
    power = highlight(specular_cosine, fmts)
    diffuse = vec_mul(k_diffuse, diffuse_cosine, fmts.coeff, fmts.cosine, fmts.shade)
    specular = vec_mul(k_specular, power, fmts.coeff, fmts.cosine, fmts.shade)
    total = vec_mul(colour_add(diffuse, specular, fmts), intensity, fmts.shade, fmts.coeff, fmts.shade)
    return np.where(lit, total, 0)


def colour_add(a: Raw, b: Raw, fmts: Formats) -> Raw:
    """Saturated sum of colours: model of ``hdl/shade/colour_add.v``."""
    return np.asarray(np.minimum(a + b, fmts.shade.max))
