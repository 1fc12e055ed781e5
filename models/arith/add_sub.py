"""Saturating sum and difference: model of ``hdl/arith/add_sub.v`` (book 10.1.1, 10.1.2)."""

import numpy as np

from models.arith.resize import resize_in_place
from models.fixed import Format, Raw


def add_sub(a: Raw, b: Raw, fmt: Format, subtract: bool = False) -> Raw:
    """``a + b`` or ``a - b``, one bit wider and then saturated; any shape, all in ``fmt``.

    Raises ValueError where the sum needs more than 63 bits.
    """
    wide = Format(fmt.int_bits + 1, fmt.frac_bits)
    total = np.asarray(np.subtract(a, b) if subtract else np.add(a, b))
    return resize_in_place(total, wide, fmt)
