"""Cross product: model of ``hdl/arith/cross_product.v`` (book 10.1.5.2)."""

import numpy as np

from models.arith.resize import resize_in_place
from models.fixed import Format, Raw

_PLUS, _MINUS = (1, 2, 0), (2, 0, 1)
"""Lanes of the factors of each component: p_x = a_y b_z - a_z b_y, and so on round."""


def cross_product(a: Raw, b: Raw, a_fmt: Format, b_fmt: Format, out_fmt: Format) -> Raw:
    """``a x b`` of shape (3, n): exact differences, truncated (floor) and saturated once.

    Raises ValueError where a difference needs more than 63 bits.
    """
    wide = Format(a_fmt.int_bits + b_fmt.int_bits + 1, a_fmt.frac_bits + b_fmt.frac_bits)
    differences = np.empty(np.broadcast_shapes(a.shape, b.shape), dtype=np.int64)
    for lane, i, j in zip(differences, _PLUS, _MINUS, strict=True):
        np.multiply(a[i], b[j], out=lane)
        np.subtract(lane, a[j] * b[i], out=lane)
    return resize_in_place(differences, wide, out_fmt)
