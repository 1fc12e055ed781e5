"""Integer square root: model of ``hdl/arith/sqrt.v`` and ``sqrt_iter.v`` (book 10.1.6, figure 19).

The hardware finds a bit of the root at a time. Its result is defined without the steps,
``radicand = root**2 + remainder`` and ``0 <= remainder <= 2 * root``, and that is what is modelled.
"""

from typing import NamedTuple

import numpy as np

from models.fixed import Format, Raw

_EXACT_BITS = 52
"""Below 2**52 the correctly rounded float64 root of n**2 - 1 is still less than n, so it truncates right."""


class SquareRoot(NamedTuple):
    """Root and remainder of a radicand, both unsigned."""

    root: Raw
    remainder: Raw


def isqrt(radicand: Raw, bits: int = 63) -> Raw:
    """``floor(sqrt(radicand))`` of integers ``0 <= radicand < 2**bits``, any shape, exact up to 63 bits.

    Raises ValueError where ``bits`` is more.
    """
    Format(bits, 0, signed=False)
    root = np.empty(np.shape(radicand), dtype=np.int64)
    np.sqrt(radicand, out=root, casting="unsafe")
    if bits <= _EXACT_BITS:
        return root
    # The float64 root is off by at most one; the remainder is small, so it survives a wrap of root**2.
    remainder = radicand - root * root
    return np.asarray(root + (remainder > 2 * root) - (remainder < 0))


def sqrt(radicand: Raw, bits: int = 40) -> SquareRoot:
    """Root (``bits / 2`` bits) and remainder (one more) of unsigned radicands of ``bits`` bits.

    Raises ValueError where ``bits`` is odd or more than 63.
    """
    if bits % 2:
        raise ValueError(f"a radicand of {bits} bits: the width must be even")
    root = isqrt(radicand, bits)
    return SquareRoot(root, np.asarray(radicand - root * root))


def sqrt_iter(radicand: Raw, bits: int = 40) -> SquareRoot:
    """What the iterative unit answers: the same numbers as `sqrt`."""
    return sqrt(radicand, bits)
