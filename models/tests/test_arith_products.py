"""Resizing, sums and products against exact rationals."""

from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from models.arith import add_sub, cross_product, dot, mul, resize, vec_mul, vec_scale
from models.fixed import BOOK, COLOUR, Format
from models.tests.arith_oracles import (
    clamp,
    column,
    every,
    every_pair,
    floored,
    formats,
    raws,
    scalar,
    value,
    vectors,
)

NARROW = [Format(2, 1), Format(1, 3), Format(3, 0), Format(2, 3)]


@pytest.mark.parametrize("in_fmt", NARROW, ids=str)
@pytest.mark.parametrize("out_fmt", [*NARROW, Format(5, 6), Format(2, 2, signed=False)], ids=str)
def test_resize_floors_and_saturates_every_number(in_fmt: Format, out_fmt: Format) -> None:
    numbers = every(in_fmt)
    expected = [floored(value(int(x), in_fmt), out_fmt) for x in numbers]
    assert resize(numbers, in_fmt, out_fmt).tolist() == expected


def test_resize_leaves_its_operand_alone() -> None:
    numbers = every(Format(2, 3))
    before = numbers.copy()
    resize(numbers, Format(2, 3), Format(1, 1))
    assert np.array_equal(numbers, before)


@given(st.data(), formats(30), formats(30))
def test_resize_is_monotonic(data: st.DataObject, in_fmt: Format, out_fmt: Format) -> None:
    numbers = sorted(data.draw(st.lists(raws(in_fmt), min_size=2, max_size=8)))
    resized = resize(np.array(numbers), in_fmt, out_fmt).tolist()
    assert all(low <= high for low, high in pairwise(resized))


@given(st.data(), formats(30), st.booleans())
def test_sum_and_difference_saturate(data: st.DataObject, fmt: Format, subtract: bool) -> None:
    a, b = data.draw(vectors(fmt)), data.draw(vectors(fmt))
    sign = -1 if subtract else 1
    expected = [clamp(x + sign * y, fmt) for x, y in zip(a, b, strict=True)]
    assert add_sub(column(a), column(b), fmt, subtract).ravel().tolist() == expected


def test_smallest_minus_largest_is_the_smallest() -> None:
    assert add_sub(scalar(BOOK.min), scalar(BOOK.max), BOOK, subtract=True).tolist() == [BOOK.min]


@given(st.data(), st.integers(2, 31), st.integers(2, 32))
def test_mul_is_exact_up_to_63_bits(data: st.DataObject, a_bits: int, b_bits: int) -> None:
    a, b = data.draw(raws(Format(a_bits, 0))), data.draw(raws(Format(b_bits, 0)))
    assert mul(scalar(a), scalar(b), a_bits, b_bits).tolist() == [a * b]


@pytest.mark.parametrize("signed", [True, False])
def test_vec_mul_floors_and_saturates_every_product(signed: bool) -> None:
    a_fmt, b_fmt, out_fmt = (Format(i, f, signed) for i, f in ((2, 2), (3, 1), (2, 1)))
    a, b = every_pair(a_fmt, b_fmt)
    expected = [
        floored(value(int(x), a_fmt) * value(int(y), b_fmt), out_fmt) for x, y in zip(a, b, strict=True)
    ]
    assert vec_mul(a, b, a_fmt, b_fmt, out_fmt).tolist() == expected


@given(st.data(), st.booleans())
def test_vec_mul_of_any_format_is_the_floor_of_the_product(data: st.DataObject, signed: bool) -> None:
    # Integer bits of both operands beside the result's fraction still fit 63 bits.
    a_fmt, b_fmt, out_fmt = (data.draw(formats(21, signed)) for _ in range(3))
    a, b = data.draw(vectors(a_fmt)), data.draw(vectors(b_fmt))
    expected = [floored(value(x, a_fmt) * value(y, b_fmt), out_fmt) for x, y in zip(a, b, strict=True)]
    assert vec_mul(column(a), column(b), a_fmt, b_fmt, out_fmt).ravel().tolist() == expected


@given(raws(BOOK), vectors(BOOK))
def test_vec_scale_multiplies_each_component_by_the_scalar(s: int, a: tuple[int, int, int]) -> None:
    expected = [floored(value(s, BOOK) * value(x, BOOK), BOOK) for x in a]
    assert vec_scale(scalar(s), column(a), BOOK, BOOK, BOOK).ravel().tolist() == expected


@given(raws(COLOUR))
def test_full_intensity_times_a_colour_is_the_colour(colour: int) -> None:
    assert vec_mul(scalar(COLOUR.one), scalar(colour), COLOUR, COLOUR, COLOUR).tolist() == [colour]


@given(st.data())
def test_dot_truncates_and_saturates_the_exact_sum_once(data: st.DataObject) -> None:
    a_fmt, b_fmt, out_fmt = data.draw(formats(16)), data.draw(formats(16)), data.draw(formats(30))
    a, b = data.draw(vectors(a_fmt)), data.draw(vectors(b_fmt))
    total = sum((value(x, a_fmt) * value(y, b_fmt) for x, y in zip(a, b, strict=True)), Fraction(0))
    assert dot(column(a), column(b), a_fmt, b_fmt, out_fmt).tolist() == [floored(total, out_fmt)]


def test_dot_of_products_that_cancel_does_not_saturate() -> None:
    a = column((BOOK.max, BOOK.max, 0))
    b = column((BOOK.max, -BOOK.max, 0))
    assert dot(a, b, BOOK, BOOK, BOOK).tolist() == [0]


@given(st.data())
def test_cross_product_truncates_and_saturates_each_difference_once(data: st.DataObject) -> None:
    a_fmt, b_fmt, out_fmt = data.draw(formats(16)), data.draw(formats(16)), data.draw(formats(30))
    a, b = data.draw(vectors(a_fmt)), data.draw(vectors(b_fmt))
    ax, ay, az = (value(x, a_fmt) for x in a)
    bx, by, bz = (value(x, b_fmt) for x in b)
    exact = (ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx)
    expected = [floored(x, out_fmt) for x in exact]
    assert cross_product(column(a), column(b), a_fmt, b_fmt, out_fmt).ravel().tolist() == expected


@pytest.mark.parametrize("unit", [dot, cross_product])
def test_one_vector_meets_many(unit: object) -> None:
    assert callable(unit)
    many = np.arange(30, dtype=np.int64).reshape(3, 10) * 1000
    one = column((512, -700, 90))
    assert np.array_equal(
        unit(one, many, BOOK, BOOK, BOOK), unit(np.repeat(one, 10, axis=1), many, BOOK, BOOK, BOOK)
    )


def test_operands_too_wide_for_64_bit_arithmetic_are_refused() -> None:
    wide = Format(32, 0)
    one = column((1, 1, 1))
    for product in (dot, cross_product, vec_mul):
        with pytest.raises(ValueError, match="does not fit"):
            product(one, one, wide, wide, BOOK)
    with pytest.raises(ValueError, match="does not fit"):
        mul(one, one, 32, 32)
    with pytest.raises(ValueError, match="does not fit"):
        add_sub(one, one, Format(63, 0))


def test_signed_times_unsigned_is_refused() -> None:
    with pytest.raises(ValueError, match="all be signed or all unsigned"):
        vec_mul(scalar(1), scalar(1), BOOK, COLOUR, BOOK)
