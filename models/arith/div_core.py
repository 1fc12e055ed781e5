"""Unsigned long division: model of ``hdl/arith/div_core.v``."""

import numpy as np

from models.arith.divide import Division, truncating_divide
from models.fixed import Format, Raw


def div_core(upper: Raw, lower: Raw, den: Raw, den_bits: int, quot_bits: int) -> Division:
    """``{upper, lower} / den`` of unsigned numbers of shape (n,): quotient and remainder.

    ``upper``, ``den`` and the remainder have ``den_bits`` bits, ``lower`` and the quotient ``quot_bits``.
    Where ``upper >= den`` the quotient does not fit and the answer is that of the unit's steps, without
    meaning. Raises ValueError where the dividend needs more than 63 bits.
    """
    dividend_fmt = Format(den_bits + quot_bits, 0, signed=False)
    upper, lower, den = np.broadcast_arrays(upper, lower, den)
    invalid = upper >= den
    num = np.where(invalid, 0, (upper << quot_bits) | lower)
    safe_den = np.where(invalid, 1, den)
    quotient = truncating_divide(num, safe_den, bits=dividend_fmt.width)
    remainder = num - quotient * safe_den
    if invalid.any():
        steps = _step_by_step(upper[invalid], lower[invalid], den[invalid], den_bits, quot_bits)
        quotient[invalid], remainder[invalid] = steps
    return Division(quotient, remainder)


def _step_by_step(upper: Raw, lower: Raw, den: Raw, den_bits: int, quot_bits: int) -> Division:
    """The non-restoring steps themselves, modulo ``2**(den_bits + 1)``."""
    modulus_mask = (1 << (den_bits + 1)) - 1
    partial, quotient = upper, np.zeros_like(lower)
    for bit in reversed(range(quot_bits)):
        shifted = ((partial << 1) & modulus_mask) | ((lower >> bit) & 1)
        negative = partial >> den_bits
        partial = (shifted + np.where(negative, den, -den)) & modulus_mask
        quotient = (quotient << 1) | (1 - (partial >> den_bits))
    remainder = (partial + np.where(partial >> den_bits, den, 0)) & (modulus_mask >> 1)
    return Division(quotient, remainder)
