"""Block floating point: model of ``hdl/arith/block_shift.v``."""

from typing import NamedTuple

import numpy as np

from models.fixed import Format, Raw

_FLOAT_BITS = 53
_FLOAT_FRACTION_BITS = 52
_FLOAT_BIAS = 1022
"""The exponent field of a float64 is the bit length of a whole number plus this."""


class Shifted(NamedTuple):
    """Vectors of the shape that came in, and the shift of each, shape (n,)."""

    vector: Raw
    shift: Raw


def block_shift(a: Raw, in_bits: int = 19, out_bits: int = 18) -> Shifted:
    """Signed vectors (lanes, n) shifted left as far as all lanes allow, then cut to ``out_bits``.

    ``shift`` is the number of redundant sign bits of the largest component, ``in_bits - 1`` where all are
    0 or -1. The top ``out_bits`` bits are kept (floor), zeros are appended where there are not as many.
    Raises ValueError where either width is more than 63 bits.
    """
    Format(in_bits, 0)
    Format(out_bits, 0)
    shift = (in_bits - 1) - bit_length(_significant(a), in_bits - 1)
    vector = np.asarray(np.left_shift(a, shift))
    drop = in_bits - out_bits
    if drop >= 0:
        return Shifted(np.right_shift(vector, drop, out=vector), shift)
    return Shifted(np.left_shift(vector, -drop, out=vector), shift)


def _significant(a: Raw) -> Raw:
    """Bits that differ from the sign in any lane, shape (n,)."""
    significant = np.zeros(a.shape[1:], dtype=np.int64)
    bits = np.empty_like(significant)
    for lane in a:
        np.right_shift(lane, 63, out=bits)
        np.bitwise_xor(lane, bits, out=bits)
        np.bitwise_or(significant, bits, out=significant)
    return significant


def bit_length(values: Raw, bits: int) -> Raw:
    """Bits of whole numbers ``0 <= values < 2**bits`` without leading zeros; 0 has none."""
    if bits > _FLOAT_BITS:
        # With the bit below the leading one cleared, no rounding can carry into the exponent.
        values = values & ~(values >> 1)
    exponent = values.astype(np.float64).view(np.int64)
    np.right_shift(exponent, _FLOAT_FRACTION_BITS, out=exponent)
    np.subtract(exponent, _FLOAT_BIAS, out=exponent)
    return np.maximum(exponent, 0, out=exponent)
