"""What must have been seen of the dot product: factors, limits and residue of the sum, terms that cancel."""

import numpy as np
from numpy.typing import NDArray

from models.arith import exact_dot
from models.fixed import Raw
from verif.env.coverage.classes import any_lane
from verif.env.coverage.points import Coverage, Holds, Samples
from verif.env.coverage.sieve import Sieve
from verif.env.unit import Parameters
from verif.units.dot.unit import UNIT
from verif.units.product_coverage import factors, rounded
from verif.units.products import dropped_bits, formats

SIEVE = Sieve(UNIT)


def _exact(_p: Parameters, s: Samples) -> Raw:
    return exact_dot(s["a"], s["b"])


def _products(s: Samples) -> Raw:
    return np.asarray(s["a"] * s["b"])


def _too_large(p: Parameters, s: Samples) -> NDArray[np.bool_]:
    """Terms, (3, n), that saturate alone."""
    out, value = formats(p)[2], _products(s) >> dropped_bits(p)
    return np.asarray((value > out.max) | (value < out.min))


def _in_range(p: Parameters, s: Samples) -> NDArray[np.bool_]:
    out, value = formats(p)[2], _exact(p, s) >> dropped_bits(p)
    return np.asarray((value <= out.max) & (value >= out.min))


def _cancel_to_zero(p: Parameters, s: Samples) -> NDArray[np.bool_]:
    return np.asarray((_exact(p, s) == 0) & any_lane(_products(s) != 0))


def _large_terms_fit(p: Parameters, s: Samples) -> NDArray[np.bool_]:
    return np.asarray((_too_large(p, s).sum(axis=0) > 1) & _in_range(p, s))


def _small_terms_do_not_fit(p: Parameters, s: Samples) -> NDArray[np.bool_]:
    return np.asarray(~any_lane(_too_large(p, s)) & ~_in_range(p, s))


def _residues_carry(p: Parameters, s: Samples) -> NDArray[np.bool_]:
    """The floor of the sum is not the sum of the floors."""
    floors = (_products(s) >> dropped_bits(p)).sum(axis=0)
    return np.asarray((floors != _exact(p, s) >> dropped_bits(p)) & _in_range(p, s))


def _only(lane: int) -> Holds:
    def holds(_p: Parameters, s: Samples) -> NDArray[np.bool_]:
        there = _products(s) != 0
        return np.asarray(there[lane] & (there.sum(axis=0) == 1))

    return holds


TERMS = SIEVE.point(
    "terms",
    "the three products and their sum",
    {
        "cancel_to_zero": _cancel_to_zero,
        "too_large_ones_cancel": _large_terms_fit,
        "fitting_ones_do_not_fit_together": _small_terms_do_not_fit,
        "residues_carry": _residues_carry,
        "only_x": _only(0),
        "only_y": _only(1),
        "only_z": _only(2),
    },
)

COVERAGE = Coverage((*factors(UNIT.inputs, "a", "b"), *rounded(SIEVE, _exact), TERMS))
