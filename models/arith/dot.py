"""Dot product: model of ``hdl/arith/dot.v`` (book 10.1.5.1)."""

import numpy as np

from models.arith.resize import resize_in_place
from models.fixed import Format, Raw


def exact_dot(a: Raw, b: Raw) -> Raw:
    """Sum of the three full products of vectors of shape (3, n); nothing is dropped."""
    total = np.asarray(np.multiply(a[0], b[0]))
    product = np.asarray(np.multiply(a[1], b[1]))
    np.add(total, product, out=total)
    np.multiply(a[2], b[2], out=product)
    np.add(total, product, out=total)
    return total


def dot(a: Raw, b: Raw, a_fmt: Format, b_fmt: Format, out_fmt: Format) -> Raw:
    """``a . b`` of shape (n,): summed exactly, truncated (floor) and saturated once.

    ``a`` and ``b`` have shape (3, n) or (3, 1). Raises ValueError where the sum needs more than 63 bits.
    """
    sum_fmt = Format(a_fmt.int_bits + b_fmt.int_bits + 2, a_fmt.frac_bits + b_fmt.frac_bits)
    return resize_in_place(exact_dot(a, b), sum_fmt, out_fmt)
