"""Format conversion: model of ``hdl/arith/resize.v`` (book 10.1.3)."""

import numpy as np

from models.fixed import Format, Raw


def resize(raw: Raw, in_fmt: Format, out_fmt: Format) -> Raw:
    """Numbers of ``in_fmt`` in ``out_fmt``: low bits are dropped (floor), the rest saturates.

    Any shape. Raises ValueError where the number with both fractions needs more than 63 bits.
    """
    return resize_in_place(np.array(raw, dtype=np.int64), in_fmt, out_fmt)


def resize_in_place(values: Raw, in_fmt: Format, out_fmt: Format) -> Raw:
    """`resize` that overwrites and returns ``values``: a product is not needed twice."""
    drop = in_fmt.frac_bits - out_fmt.frac_bits
    low, high = in_fmt.min, in_fmt.max
    if drop > 0:
        np.right_shift(values, drop, out=values)
        low, high = low >> drop, high >> drop
    elif drop < 0:
        shifted = Format(in_fmt.int_bits, out_fmt.frac_bits, in_fmt.signed)
        np.left_shift(values, -drop, out=values)
        low, high = shifted.min, shifted.max
    if low < out_fmt.min or high > out_fmt.max:
        np.clip(values, out_fmt.min, out_fmt.max, out=values)
    return values
