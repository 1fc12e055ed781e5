"""Oracles of the arithmetic models: exact rationals, one operand at a time, and how operands are drawn."""

from collections.abc import Iterable
from fractions import Fraction
from functools import cache
from math import floor

import numpy as np
from hypothesis import strategies as st

from models.fixed import Format, Raw


def value(raw: int, fmt: Format) -> Fraction:
    """A raw integer as the number it stands for."""
    return Fraction(raw, fmt.one)


def clamp(raw: int, fmt: Format) -> int:
    """The raw integer nearest to ``raw`` that ``fmt`` holds."""
    return min(max(raw, fmt.min), fmt.max)


def floored(number: Fraction, fmt: Format) -> int:
    """The raw integer of ``number`` rounded toward minus infinity, saturated."""
    return clamp(floor(number * fmt.one), fmt)


def truncated(number: Fraction, fmt: Format) -> int:
    """The raw integer of ``number`` rounded toward zero, saturated."""
    return clamp(int(number * fmt.one), fmt)


@cache
def raws(fmt: Format) -> st.SearchStrategy[int]:
    """Raw integers of a format: its corners, powers of two and their neighbours, and all the rest."""
    powers = [sign * (1 << k) + d for k in range(fmt.width) for sign in (1, -1) for d in (-1, 0, 1)]
    corners = sorted({x for x in [*powers, fmt.min, fmt.min + 1, fmt.max] if fmt.min <= x <= fmt.max})
    return st.one_of(st.sampled_from(corners), st.integers(fmt.min, fmt.max))


@cache
def vectors(fmt: Format) -> st.SearchStrategy[tuple[int, int, int]]:
    """Vectors of raw integers."""
    return st.tuples(raws(fmt), raws(fmt), raws(fmt))


@cache
def formats(max_bits: int, signed: bool = True) -> st.SearchStrategy[Format]:
    """Formats of 2 to ``max_bits`` bits."""
    return st.integers(2, max_bits).flatmap(
        lambda bits: st.integers(0, bits - 1).map(lambda frac: Format(bits - frac, frac, signed))
    )


def every(fmt: Format) -> Raw:
    """Every raw integer of a narrow format."""
    return np.arange(fmt.min, fmt.max + 1, dtype=np.int64)


def every_pair(a_fmt: Format, b_fmt: Format) -> tuple[Raw, Raw]:
    """Every pair of raw integers of two narrow formats."""
    a, b = np.meshgrid(every(a_fmt), every(b_fmt), indexing="ij")
    return a.ravel(), b.ravel()


def every_vector(fmt: Format) -> Raw:
    """Every vector of a narrow format, shape (3, n)."""
    return np.stack([lane.ravel() for lane in np.meshgrid(*[every(fmt)] * 3, indexing="ij")])


def column(vector: Iterable[int]) -> Raw:
    """One vector as an array of shape (3, 1)."""
    return np.array(list(vector), dtype=np.int64)[:, np.newaxis]


def scalar(raw: int) -> Raw:
    """One number as an array of shape (1,)."""
    return np.array([raw], dtype=np.int64)
