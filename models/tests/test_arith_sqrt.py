"""Square root against `math.isqrt`, and against the book's own algorithm."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from models.arith import isqrt, sqrt, sqrt_iter
from models.tests.arith_oracles import scalar


def figure_19(radicand: int, bits: int) -> tuple[int, int]:
    """The pseudo code of the book's figure 19, line by line."""
    q, r = 0, 0
    for i in reversed(range(bits // 2)):
        pair = (radicand >> (2 * i)) & 3
        r = ((r << 2) | pair) - ((q << 2) | 1) if r >= 0 else ((r << 2) | pair) + ((q << 2) | 3)
        q = (q << 1) | (1 if r >= 0 else 0)
    if r < 0:
        r += (q << 1) | 1
    return q, r


def radicands(bits: int) -> st.SearchStrategy[int]:
    """Radicands: squares and their neighbours, and all the rest."""
    largest = (1 << bits) - 1
    near_squares = st.builds(
        lambda root, d: min(max(root * root + d, 0), largest),
        st.integers(0, math.isqrt(largest)),
        st.integers(-1, 1),
    )
    return st.one_of(near_squares, st.integers(0, largest))


def test_root_and_remainder_are_exact_for_every_radicand_of_16_bits() -> None:
    numbers = np.arange(1 << 16)
    root, remainder = sqrt(numbers, 16)
    assert root.tolist() == [math.isqrt(x) for x in range(1 << 16)]
    assert np.array_equal(root * root + remainder, numbers)
    assert np.all((remainder >= 0) & (remainder <= 2 * root))


@given(st.sampled_from([2, 8, 40, 50, 52, 54, 60, 62]).flatmap(lambda b: st.tuples(st.just(b), radicands(b))))
def test_root_and_remainder_are_exact_for_every_width(case: tuple[int, int]) -> None:
    bits, radicand = case
    root = math.isqrt(radicand)
    for unit in (sqrt, sqrt_iter):
        result = unit(scalar(radicand), bits)
        assert (result.root.tolist(), result.remainder.tolist()) == ([root], [radicand - root * root])


@given(radicands(40))
def test_the_steps_of_the_book_give_the_same_root_and_remainder(radicand: int) -> None:
    result = sqrt(scalar(radicand))
    assert (int(result.root[0]), int(result.remainder[0])) == figure_19(radicand, 40)


@pytest.mark.parametrize("bits", [40, 51, 52, 53, 61, 62, 63])
def test_isqrt_is_exact_beside_the_largest_squares(bits: int) -> None:
    largest_root = math.isqrt((1 << bits) - 1)
    numbers = [(largest_root - k) ** 2 + d for k in range(2000) for d in (-1, 0, 1)]
    numbers = [x for x in [*numbers, (1 << bits) - 1] if 0 <= x < 1 << bits]
    assert isqrt(np.array(numbers), bits).tolist() == [math.isqrt(x) for x in numbers]


def test_an_odd_or_too_wide_radicand_is_refused() -> None:
    with pytest.raises(ValueError, match="must be even"):
        sqrt(scalar(1), 41)
    with pytest.raises(ValueError, match="does not fit"):
        sqrt(scalar(1), 64)
