"""Length of a vector: model of ``hdl/arith/norm.v`` (book 10.1.5.3)."""

import numpy as np

from models.arith.dot import exact_dot
from models.arith.sqrt import isqrt
from models.fixed import Format, Raw


def norm_format(fmt: Format, guard: int = 0) -> Format:
    """Format of the norm of vectors of ``fmt``: unsigned, an integer and ``guard`` fraction bits more."""
    return Format(fmt.int_bits + 1, fmt.frac_bits + guard, signed=False)


def norm(a: Raw, fmt: Format, guard: int = 0) -> Raw:
    """``floor(sqrt(x*x + y*y + z*z))`` of shape (n,) in `norm_format`, of vectors (3, n) in ``fmt``.

    Raises ValueError where the radicand, twice as wide as the norm, needs more than 63 bits.
    """
    root_fmt = norm_format(fmt, guard)
    radicand_fmt = Format(2 * root_fmt.int_bits, 2 * root_fmt.frac_bits, signed=False)
    radicand = exact_dot(a, a)
    if guard:
        np.left_shift(radicand, 2 * guard, out=radicand)
    # The two top bits of the radicand are always 0: a square is at most 2**(2 * width - 2).
    return isqrt(radicand, radicand_fmt.width - 2)
