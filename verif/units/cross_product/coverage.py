"""What must have been seen of the cross product: factors, limits and residue, parallel vectors, axes."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from models.fixed import Raw
from verif.env.coverage.classes import all_lanes, any_lane, operand
from verif.env.coverage.points import Coverage, Holds, Samples
from verif.env.coverage.rounding import lanes_apart
from verif.env.coverage.sieve import Sieve
from verif.env.fields import Operands
from verif.env.unit import Parameters
from verif.units.cross_product.unit import UNIT
from verif.units.product_coverage import rounded
from verif.units.products import dropped_bits, formats

SIEVE = Sieve(UNIT)


def _terms(s: Samples) -> tuple[Raw, Raw]:
    """Minuends and subtrahends (3, n)."""
    a, b = s["a"], s["b"]
    return a[[1, 2, 0]] * b[[2, 0, 1]], a[[2, 0, 1]] * b[[1, 2, 0]]


def _exact(_p: Parameters, s: Samples) -> Raw:
    plus, minus = _terms(s)
    return np.asarray(plus - minus)


def _fits(p: Parameters, exact: Raw) -> NDArray[np.bool_]:
    out, value = formats(p)[2], exact >> dropped_bits(p)
    return np.asarray((value <= out.max) & (value >= out.min))


def _terms_case(matches: Callable[[Parameters, Raw, Raw], NDArray[np.bool_]]) -> Holds:
    def holds(p: Parameters, s: Samples) -> NDArray[np.bool_]:
        return any_lane(matches(p, *_terms(s)))

    return holds


TERMS = SIEVE.point(
    "terms",
    "two products and their difference",
    {
        "equal": _terms_case(lambda _p, plus, minus: (plus == minus) & (plus != 0)),
        "too_large_ones_cancel": _terms_case(
            lambda p, plus, minus: ~_fits(p, plus) & ~_fits(p, minus) & _fits(p, plus - minus)
        ),
        "fitting_ones_do_not_fit_together": _terms_case(
            lambda p, plus, minus: _fits(p, plus) & _fits(p, minus) & ~_fits(p, plus - minus)
        ),
        "residues_borrow": _terms_case(
            lambda p, plus, minus: (
                (plus - minus >> dropped_bits(p)) != (plus >> dropped_bits(p)) - (minus >> dropped_bits(p))
            )
        ),
    },
)


def _vectors(s: Samples, sign: int) -> NDArray[np.bool_]:
    """Parallel, none of them zero, the same way or opposite."""
    plus, minus = _terms(s)
    along = np.sign((s["a"] * s["b"]).sum(axis=0))
    return np.asarray(all_lanes(plus == minus) & (along == sign))


VECTORS = SIEVE.point(
    "vectors",
    "how the vectors stand to each other",
    {
        "parallel": lambda _p, s: _vectors(s, 1),
        "opposite": lambda _p, s: _vectors(s, -1),
        "a_is_zero": lambda _p, s: all_lanes(s["a"] == 0) & all_lanes(s["b"] != 0),
        "b_is_zero": lambda _p, s: all_lanes(s["b"] == 0) & all_lanes(s["a"] != 0),
        "almost_parallel": lambda _p, s: (
            ~_vectors(s, 1) & (np.abs(_exact({}, s)).max(axis=0) * 64 < np.abs(_terms(s)[0]).max(axis=0))
        ),
    },
)


def _along_axes(p: Parameters, generator: np.random.Generator, size: int) -> Operands:
    """Vectors along two axes."""
    a_fmt, b_fmt, _ = formats(p)
    a, b = (generator.integers(fmt.min, fmt.max, (3, size), endpoint=True) for fmt in (a_fmt, b_fmt))
    first = generator.integers(0, 3, size)
    lanes = np.arange(3)[:, None]
    return {"a": a * (lanes == first), "b": b * (lanes == (first + generator.integers(1, 3, size)) % 3)}


def _axes(first: int, second: int) -> Holds:
    def holds(_p: Parameters, s: Samples) -> NDArray[np.bool_]:
        lanes = np.arange(3)[:, None]
        along = ((s["a"] != 0) == (lanes == first)) & ((s["b"] != 0) == (lanes == second))
        return np.asarray(along.all(axis=0))

    return holds


AXES = SIEVE.of("vectors along axes", _along_axes).point(
    "axes",
    "which axes the vectors lie on",
    {
        f"{'xyz'[first]}_{'xyz'[second]}": _axes(first, second)
        for first in range(3)
        for second in range(3)
        if first != second
    },
)

COVERAGE = Coverage(
    (
        operand(UNIT.inputs, "a"),
        operand(UNIT.inputs, "b"),
        *rounded(SIEVE, _exact),
        lanes_apart(SIEVE, "p"),
        TERMS,
        VECTORS,
        AXES,
    )
)
