"""What must have been seen of the iterative division: operands, quotients, remainders, division by zero."""

import numpy as np
from numpy.typing import NDArray

from models.fixed import Raw
from verif.env.coverage.classes import operand, port
from verif.env.coverage.points import Coverage, Samples
from verif.env.coverage.rounding import remainders
from verif.env.coverage.sieve import Sieve
from verif.env.unit import Parameters
from verif.units.div_iter.unit import UNIT
from verif.units.division_coverage import quotients

SIEVE = Sieve(UNIT)


def _division(_p: Parameters, s: Samples) -> tuple[Raw, Raw]:
    return s["num"], s["den"]


def _high_bits(p: Parameters, s: Samples) -> NDArray[np.bool_]:
    return np.asarray(s["num"] > port(UNIT.inputs, p, "den").high)


BY_ZERO = SIEVE.point(
    "by_zero",
    "divisions by zero: all ones, and the low bits of the numerator",
    {
        "zero": lambda _p, s: (s["den"] == 0) & (s["num"] == 0),
        "all_that_fits_a_remainder": lambda p, s: (s["den"] == 0) & (s["num"] > 0) & ~_high_bits(p, s),
        "more": lambda p, s: (s["den"] == 0) & _high_bits(p, s),
    },
)

COVERAGE = Coverage(
    (
        operand(UNIT.inputs, "num", signed=False),
        operand(UNIT.inputs, "den", signed=False),
        BY_ZERO,
        quotients(SIEVE, _division),
        remainders(SIEVE, "remainder", _division),
    )
)
