"""Division of integers toward zero, as the dividing units share it."""

from typing import NamedTuple

import numpy as np

from models.fixed import MAX_BITS, Raw

_EXACT_BITS = 53
"""Below 2**53 a quotient that is no integer is further from one than float64 rounds: it truncates right."""


class Division(NamedTuple):
    """Quotient and remainder."""

    quotient: Raw
    remainder: Raw


def truncating_divide(num: Raw, den: Raw, shift: int = 0, bits: int | None = None) -> Raw:
    """``num * 2**shift / den`` truncated toward zero, exact; shapes broadcast.

    ``bits`` bounds the dividend, ``abs(num * 2**shift) < 2**bits``; it is measured where it is not given.
    Raises ZeroDivisionError where a ``den`` is 0 and ValueError where the dividend needs more than 63 bits.
    """
    if not np.all(den):
        raise ZeroDivisionError("a denominator is 0")
    if bits is None:
        bits = _magnitude_bits(num) + shift
    if bits > MAX_BITS:
        raise ValueError(f"a dividend of {bits} bits does not fit {MAX_BITS}")
    if bits <= _EXACT_BITS:
        # A power of two scales exactly, so the quotient rounds as that of the shifted dividend does. The
        # cast to integers truncates; made within the division, it needs no array of floats.
        quotient = np.empty(np.broadcast_shapes(np.shape(num), np.shape(den)), dtype=np.int64)
        np.divide(num, np.multiply(den, 2.0**-shift), out=quotient, casting="unsafe")
        return quotient
    dividend = np.left_shift(num, shift)
    floored = np.floor_divide(dividend, den)
    return np.asarray(floored + ((floored < 0) & (floored * den != dividend)))


def _magnitude_bits(num: Raw) -> int:
    """Bits of the largest magnitude, 0 where there is none."""
    if not np.size(num):
        return 0
    return max(int(np.max(num)), -int(np.min(num)), 0).bit_length()
