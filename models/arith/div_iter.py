"""Iterative unsigned division: model of ``hdl/arith/div_iter.v``."""

import numpy as np

from models.arith.divide import Division, truncating_divide
from models.fixed import Format, Raw


def div_iter(num: Raw, den: Raw, num_bits: int = 24, den_bits: int = 12) -> Division:
    """``num / den`` of unsigned numbers: quotient (``num_bits``) and remainder (``den_bits``).

    ``den`` = 0 gives a quotient of all ones and the low bits of ``num`` as the remainder.
    Raises ValueError where an operand needs more than 63 bits.
    """
    num_fmt = Format(num_bits, 0, signed=False)
    den_fmt = Format(den_bits, 0, signed=False)
    by_zero = np.equal(den, 0)
    quotient = truncating_divide(num, np.where(by_zero, 1, den), bits=num_bits)
    remainder = np.where(by_zero, np.bitwise_and(num, den_fmt.max), num - quotient * den)
    return Division(np.where(by_zero, num_fmt.max, quotient), remainder)
