"""Exact products: model of ``hdl/arith/mul.v`` (book 10.1.3)."""

import numpy as np

from models.fixed import Format, Raw


def mul(a: Raw, b: Raw, a_bits: int = 19, b_bits: int = 19, signed: bool = True) -> Raw:
    """Point-wise products of ``a_bits + b_bits`` bits; any shape.

    Raises ValueError where a product needs more than 63 bits.
    """
    Format(a_bits + b_bits, 0, signed)
    return np.asarray(np.multiply(a, b))
