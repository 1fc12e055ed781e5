"""Norm, normalise and block shift against exact integers."""

import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from models.arith import block_shift, norm, norm_format, normalise
from models.arith.block_shift import bit_length
from models.fixed import BOOK, Format
from models.tests.arith_oracles import column, every_vector, formats, raws, vectors

Vector = tuple[int, int, int]


def exact_norm(vector: Vector, guard: int) -> int:
    return math.isqrt(sum(x * x for x in vector) << (2 * guard))


def exact_unit(vector: Vector, out_frac: int, guard: int) -> list[int]:
    root = exact_norm(vector, guard)
    return [int(Fraction(x << (out_frac + guard), root)) if root else 0 for x in vector]


@pytest.mark.parametrize("guard", [0, 3])
def test_norm_and_unit_of_every_narrow_vector_are_exact(guard: int) -> None:
    fmt, out_frac = Format(2, 2), 3
    a = every_vector(fmt)
    result = normalise(a, fmt, out_frac, guard)
    each = [tuple(int(x) for x in v) for v in a.T]
    assert result.norm.tolist() == [exact_norm((x, y, z), guard) for x, y, z in each]
    assert result.unit.T.tolist() == [exact_unit((x, y, z), out_frac, guard) for x, y, z in each]
    assert result.degenerate.tolist() == [not any(v) for v in each]
    assert np.array_equal(norm(a, fmt, guard), result.norm)


@given(st.data(), formats(20), st.integers(0, 24), st.integers(0, 9))
def test_norm_and_unit_of_any_format_are_exact(
    data: st.DataObject, fmt: Format, out_frac: int, guard: int
) -> None:
    vector = data.draw(vectors(fmt))
    result = normalise(column(vector), fmt, out_frac, guard)
    assert result.norm.tolist() == [exact_norm(vector, guard)]
    assert result.unit.ravel().tolist() == exact_unit(vector, out_frac, guard)


@given(vectors(BOOK), st.integers(0, 6))
def test_no_component_of_a_unit_vector_is_beyond_one(vector: Vector, guard: int) -> None:
    unit = normalise(column(vector), BOOK, 16, guard).unit
    assert np.all(np.abs(unit) <= 1 << 16)


@given(vectors(BOOK).filter(any))
def test_a_shifted_vector_has_a_unit_vector_as_good_as_float64(vector: Vector) -> None:
    shifted = block_shift(column(vector), 19, 24).vector
    unit = normalise(shifted, Format(2, 22), 16).unit.ravel() / (1 << 16)
    exact = np.array(vector) / math.sqrt(sum(x * x for x in vector))
    assert np.max(np.abs(unit - exact)) < 2**-15


@pytest.mark.parametrize("component", [1, -1, BOOK.min, BOOK.max])
def test_a_vector_along_an_axis_has_components_of_exactly_one_and_zero(component: int) -> None:
    a = np.diag([component] * 3)
    unit = normalise(a, BOOK, 16, 2).unit
    assert np.array_equal(unit, np.diag([int(math.copysign(1 << 16, component))] * 3))


def test_the_zero_vector_gives_zero_and_is_degenerate() -> None:
    result = normalise(column((0, 0, 0)), BOOK)
    assert result.unit.tolist() == [[0], [0], [0]]
    assert result.norm.tolist() == [0]
    assert result.degenerate.tolist() == [True]


def test_the_longest_vector_fits_the_format_of_the_norm() -> None:
    assert norm(column((BOOK.min,) * 3), BOOK, 4)[0] <= norm_format(BOOK, 4).max


def test_a_norm_too_wide_for_64_bit_arithmetic_is_refused() -> None:
    with pytest.raises(ValueError, match="does not fit"):
        norm(column((1, 1, 1)), BOOK, guard=12)


def redundant_sign_bits(x: int, bits: int) -> int:
    return bits - 1 - (x if x >= 0 else ~x).bit_length()


@given(st.data(), st.integers(2, 62), st.integers(2, 62))
def test_block_shift_is_the_largest_that_no_component_overflows(
    data: st.DataObject, in_bits: int, out_bits: int
) -> None:
    fmt = Format(in_bits, 0)
    drop = data.draw(st.integers(0, in_bits))
    vector = [x >> drop for x in data.draw(st.lists(raws(fmt), min_size=1, max_size=4))]
    shift = min(redundant_sign_bits(x, in_bits) for x in vector)
    result = block_shift(np.array(vector)[:, np.newaxis], in_bits, out_bits)
    expected = [math.floor(Fraction(x << shift) * Fraction(2) ** (out_bits - in_bits)) for x in vector]
    assert result.shift.tolist() == [shift]
    assert result.vector.ravel().tolist() == expected
    assert all(fmt.min <= x << shift <= fmt.max for x in vector)
    assert shift == in_bits - 1 or not all(fmt.min <= x << (shift + 1) <= fmt.max for x in vector)


def test_vectors_of_zero_and_minus_one_shift_furthest() -> None:
    result = block_shift(np.array([[0, -1, 0], [0, -1, -1], [0, -1, 0]]))
    assert result.shift.tolist() == [18, 18, 18]
    assert result.vector[:, 0].tolist() == [0, 0, 0]
    assert result.vector[:, 1].tolist() == [Format(18, 0).min] * 3


@given(st.integers(0, 62).flatmap(lambda bits: st.integers(0, (1 << bits) - 1)))
def test_bit_length_is_that_of_python(number: int) -> None:
    assert bit_length(np.array([number]), 62).tolist() == [number.bit_length()]
