"""Scalar times vector: model of ``hdl/arith/vec_scale.v`` (book 10.1.3)."""

from models.arith.vec_mul import vec_mul
from models.fixed import Format, Raw


def vec_scale(s: Raw, a: Raw, a_fmt: Format, b_fmt: Format, out_fmt: Format) -> Raw:
    """``s * a`` truncated (floor) and saturated: ``s`` of shape (n,) in ``b_fmt``, ``a`` of shape (3, n).

    Raises ValueError as `vec_mul` does.
    """
    return vec_mul(a, s, a_fmt, b_fmt, out_fmt)
