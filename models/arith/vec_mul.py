"""Point-wise product of vectors: model of ``hdl/arith/vec_mul.v`` (book 10.1.3)."""

import numpy as np

from models.arith.resize import resize_in_place
from models.fixed import Format, Raw


def vec_mul(a: Raw, b: Raw, a_fmt: Format, b_fmt: Format, out_fmt: Format) -> Raw:
    """``a * b`` component by component, truncated (floor) and saturated; shapes broadcast.

    Raises ValueError where the full product needs more than 63 bits, and where signed and unsigned
    formats are mixed, which the unit cannot do.
    """
    if not a_fmt.signed == b_fmt.signed == out_fmt.signed:
        raise ValueError(f"formats {a_fmt}, {b_fmt} and {out_fmt} must all be signed or all unsigned")
    product_fmt = Format(
        a_fmt.int_bits + b_fmt.int_bits, a_fmt.frac_bits + b_fmt.frac_bits, signed=a_fmt.signed
    )
    return resize_in_place(np.asarray(np.multiply(a, b)), product_fmt, out_fmt)
