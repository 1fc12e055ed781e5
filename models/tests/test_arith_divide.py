"""Division against Python integers and rationals."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from models.arith import div, div_core, div_iter, truncating_divide
from models.arith.div_core import _step_by_step
from models.fixed import BOOK, Format
from models.tests.arith_oracles import every, every_pair, formats, raws, scalar, truncated, value

WIDE = Format(63, 0)


def book_division(a: int, b: int, fmt: Format, out_fmt: Format) -> int:
    """The contract of the divider: toward zero, saturated, x/0 the limit of the sign of x, 0/0 zero."""
    if b == 0:
        return 0 if a == 0 else out_fmt.max if a > 0 else out_fmt.min
    return truncated(value(a, fmt) / value(b, fmt), out_fmt)


@given(raws(WIDE), raws(WIDE).filter(bool))
def test_truncating_divide_is_exact_for_every_width(num: int, den: int) -> None:
    assert truncating_divide(scalar(num), scalar(den)).tolist() == [int(Fraction(num, den))]


@given(st.integers(1, 1 << 27), st.integers(1, 1 << 26), st.integers(-1, 1))
def test_truncating_divide_is_exact_beside_whole_quotients(den: int, quotient: int, d: int) -> None:
    num = den * quotient + d
    assert truncating_divide(scalar(num), scalar(den)).tolist() == [num // den]
    assert truncating_divide(scalar(-num), scalar(den)).tolist() == [-(num // den)]


@given(raws(Format(30, 0)), raws(Format(30, 0)).filter(bool), st.integers(0, 33))
def test_truncating_divide_shifts_its_dividend(num: int, den: int, shift: int) -> None:
    expected = [int(Fraction(num << shift, den))]
    assert truncating_divide(scalar(num), scalar(den), shift).tolist() == expected


def test_truncating_divide_takes_no_operands_at_all() -> None:
    nothing = np.zeros(0, dtype=np.int64)
    assert truncating_divide(nothing, nothing).shape == (0,)


def test_truncating_divide_by_zero_is_an_error() -> None:
    with pytest.raises(ZeroDivisionError):
        truncating_divide(scalar(1), scalar(0))


@pytest.mark.parametrize("guard", [0, 2])
@pytest.mark.parametrize("fmt", [Format(2, 2), Format(1, 3), Format(4, 0), Format(3, 3)], ids=str)
def test_every_division_truncates_toward_zero_and_saturates(fmt: Format, guard: int) -> None:
    a, b = every_pair(fmt, fmt)
    out_fmt = Format(fmt.int_bits, fmt.frac_bits + guard)
    result = div(a, b, fmt, guard)
    expected = [book_division(int(x), int(y), fmt, out_fmt) for x, y in zip(a, b, strict=True)]
    assert result.quotient.tolist() == expected
    assert np.array_equal(result.div_by_zero, b == 0)


@given(st.data(), formats(20), st.integers(0, 12))
def test_a_division_of_any_format_truncates_toward_zero(data: st.DataObject, fmt: Format, guard: int) -> None:
    a, b = data.draw(raws(fmt)), data.draw(raws(fmt))
    out_fmt = Format(fmt.int_bits, fmt.frac_bits + guard)
    result = div(scalar(a), scalar(b), fmt, guard)
    assert result.quotient.tolist() == [book_division(a, b, fmt, out_fmt)]


def test_division_by_zero_saturates_to_the_sign_of_the_dividend() -> None:
    result = div(np.array([5, -5, 0]), np.zeros(3, dtype=np.int64), BOOK)
    assert result.quotient.tolist() == [BOOK.max, BOOK.min, 0]
    assert result.div_by_zero.all()


def test_smallest_number_divided_by_one_is_itself_and_by_minus_one_the_largest() -> None:
    result = div(scalar(BOOK.min), np.array([BOOK.one, -BOOK.one]), BOOK)
    assert result.quotient.tolist() == [BOOK.min, BOOK.max]
    assert not result.div_by_zero.any()


def test_long_division_of_every_narrow_dividend_gives_quotient_and_remainder() -> None:
    den_bits, quot_bits = 4, 5
    num, den = every_pair(Format(den_bits + quot_bits, 0, False), Format(den_bits, 0, False))
    fits = (num >> quot_bits) < den
    num, den = num[fits], den[fits]
    result = div_core(num >> quot_bits, num & ((1 << quot_bits) - 1), den, den_bits, quot_bits)
    assert np.array_equal(result.quotient, num // den)
    assert np.array_equal(result.remainder, num % den)


@given(st.integers(1, (1 << 24) - 1), st.data())
def test_long_division_of_any_width_gives_quotient_and_remainder(den: int, data: st.DataObject) -> None:
    quot_bits = data.draw(st.integers(1, 39))
    upper, lower = data.draw(st.integers(0, den - 1)), data.draw(st.integers(0, (1 << quot_bits) - 1))
    result = div_core(scalar(upper), scalar(lower), scalar(den), 24, quot_bits)
    expected = divmod((upper << quot_bits) | lower, den)
    assert (int(result.quotient[0]), int(result.remainder[0])) == expected


def test_the_steps_of_the_long_division_give_what_the_division_gives() -> None:
    den_bits, quot_bits = 3, 4
    num, den = every_pair(Format(den_bits + quot_bits, 0, False), Format(den_bits, 0, False))
    fits = (num >> quot_bits) < den
    num, den = num[fits], den[fits]
    steps = _step_by_step(num >> quot_bits, num & ((1 << quot_bits) - 1), den, den_bits, quot_bits)
    assert np.array_equal(steps.quotient, num // den)
    assert np.array_equal(steps.remainder, num % den)


def test_iterative_division_of_every_narrow_pair_and_by_zero() -> None:
    num_fmt, den_fmt = Format(7, 0, False), Format(4, 0, False)
    num, den = every_pair(num_fmt, den_fmt)
    result = div_iter(num, den, num_fmt.width, den_fmt.width)
    expected = [
        divmod(int(x), int(y)) if y else (num_fmt.max, int(x) & den_fmt.max)
        for x, y in zip(num, den, strict=True)
    ]
    assert list(zip(result.quotient.tolist(), result.remainder.tolist(), strict=True)) == expected


def test_a_dividend_too_wide_for_64_bit_arithmetic_is_refused() -> None:
    with pytest.raises(ValueError, match="does not fit"):
        div(scalar(1), scalar(1), Format(20, 20), guard=10)
    with pytest.raises(ValueError, match="does not fit"):
        div_core(scalar(0), scalar(0), scalar(1), 32, 32)
    with pytest.raises(ValueError, match="does not fit"):
        truncating_divide(scalar(1), scalar(1), shift=63)


def test_dividing_leaves_its_operands_alone() -> None:
    a, b = every(Format(3, 0)), every(Format(3, 0))[::-1].copy()
    before = a.copy(), b.copy()
    div(a, b, Format(3, 0))
    assert np.array_equal(a, before[0])
    assert np.array_equal(b, before[1])
