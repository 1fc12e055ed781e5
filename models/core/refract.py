"""Transmitted directions: model of ``hdl/shade/refract.v`` (book 8.2.5)."""

from fractions import Fraction
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from models.arith import isqrt, resize, vec_mul
from models.fixed import Format, Raw
from models.formats import Formats
from models.limits import INDEX_STEP

INDEX_CODES = 16


def ratios(fmts: Formats) -> tuple[Raw, Raw]:
    """eta = n_from / n_to and its square, floored, by ``leaving * 16 + index``: two tables of 32 numbers."""
    indices = [1 + code * INDEX_STEP for code in range(INDEX_CODES)]
    exact = [1 / n for n in indices] + indices
    return (
        np.array([int(eta * fmts.eta.one) for eta in exact], dtype=np.int64),
        np.array([int(Fraction(eta) ** 2 * fmts.eta_sq.one) for eta in exact], dtype=np.int64),
    )


def incidence(cosine: Raw, fmts: Formats) -> Raw:
    """c = -N.V of cosines N.V (n,), held in 0 to 1."""
    return np.clip(-cosine, 0, fmts.cosine.one)


def radicand(cosine: Raw, index: Raw, leaving: NDArray[np.bool_], fmts: Formats) -> Raw:
    """1 - eta^2 (1 - c^2) of shape (n,), twice the fraction of `gain`; negative where reflection is total."""
    square_frac, root_frac = 2 * fmts.unit.frac_bits, fmts.gain.frac_bits
    c = incidence(cosine, fmts)
    sine_sq = fmts.sine_sq.resize((1 << square_frac) - c * c, square_frac)
    eta_sq = ratios(fmts)[1][index + INDEX_CODES * leaving]
    bend_frac = fmts.eta_sq.frac_bits + fmts.sine_sq.frac_bits
    return np.asarray((1 << 2 * root_frac) - (eta_sq * sine_sq >> (bend_frac - 2 * root_frac)))


class Refracted(NamedTuple):
    """T (3, n) in `unit`, and where it is R instead: total internal reflection."""

    transmitted: Raw
    total: NDArray[np.bool_]


def refract(
    direction: Raw,
    normal: Raw,
    mirrored: Raw,
    cosine: Raw,
    index: Raw,
    leaving: NDArray[np.bool_],
    fmts: Formats,
) -> Refracted:
    """T = (eta c - sqrt(1 - eta^2 (1 - c^2))) N + eta V with c = -N.V, or R where the root has no number.

    direction V, normal N, mirrored R: (3, n) in `unit`; cosine N.V (n,) in `unit`; index: codes (n,).
    """
    eta = ratios(fmts)[0][index + INDEX_CODES * leaving]
    root_frac = fmts.gain.frac_bits
    under_root = radicand(cosine, index, leaving, fmts)
    total = np.asarray(under_root < 0)
    root = isqrt(np.where(total, 0, under_root), 2 * root_frac + 2)
    bent = vec_mul(eta, incidence(cosine, fmts), fmts.eta, fmts.cosine, Format(2, root_frac, signed=False))
    gain = fmts.gain.saturate(bent - root)
    exact = gain * normal + eta * direction
    sum_fmt = Format(fmts.gain.int_bits + fmts.unit.int_bits + 2, root_frac + fmts.unit.frac_bits)
    transmitted = resize(exact, sum_fmt, fmts.unit)
    return Refracted(np.where(total, mirrored, transmitted), total)
