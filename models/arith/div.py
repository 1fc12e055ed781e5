"""Signed division: model of ``hdl/arith/div.v`` (book 10.1.4)."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from models.arith.divide import truncating_divide
from models.fixed import Format, Raw


class Quotient(NamedTuple):
    """Saturated quotient, and where the denominator was 0."""

    quotient: Raw
    div_by_zero: NDArray[np.bool_]


def div(a: Raw, b: Raw, fmt: Format, guard: int = 0) -> Quotient:
    """``a / b`` of signed numbers in ``fmt``, truncated toward zero and saturated; shapes broadcast.

    The quotient has ``guard`` more fraction bits. x/0 saturates to the sign of x, 0/0 is 0.
    Raises ValueError where the dividend needs more than 63 bits.
    """
    out_fmt = Format(fmt.int_bits, fmt.frac_bits + guard)
    shift = out_fmt.frac_bits
    by_zero = np.asarray(np.equal(b, 0))
    quotient = truncating_divide(a, np.where(by_zero, 1, b), shift, bits=fmt.width + shift)
    np.clip(quotient, out_fmt.min, out_fmt.max, out=quotient)
    if by_zero.any():
        limits = np.where(np.greater(a, 0), out_fmt.max, np.where(np.less(a, 0), out_fmt.min, 0))
        np.copyto(quotient, limits, where=by_zero)
    return Quotient(quotient, by_zero)
