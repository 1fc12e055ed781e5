"""Tests of the signed division: those of every pipelined unit, and the definition of a quotient."""

import numpy as np

from models.fixed import Raw
from verif.env.definitions import Holds
from verif.env.fields import Operands
from verif.env.pipelined_tests import standard_tests
from verif.env.unit import Parameters
from verif.units.div.unit import UNIT


def _limits(p: Parameters) -> tuple[int, int]:
    largest = 1 << (p["INT"] + p["FRAC"] + p["GUARD"] - 1)
    return -largest, largest - 1


def _magnitudes(p: Parameters, given: Operands) -> tuple[Raw, Raw, Raw]:
    """|a| * 2^k, |b|, and the sign of the quotient."""
    sign = np.sign(given["a"]) * np.sign(given["b"])
    return np.abs(given["a"]) << (p["FRAC"] + p["GUARD"]), np.abs(given["b"]), sign


def quotient_is_truncated_toward_zero(p: Parameters, given: Operands, got: Operands) -> Holds:
    """|a| 2^k = q |b| + r with 0 <= r < |b|, and q has the sign of a / b, where it is in range."""
    dividend, divisor, sign = _magnitudes(p, given)
    magnitude = got["quotient"] * sign
    remainder = dividend - magnitude * divisor
    low, high = _limits(p)
    in_range = (divisor > 0) & (dividend < divisor << (p["INT"] + p["FRAC"] + p["GUARD"] - 1))
    exact = (magnitude >= 0) & (remainder >= 0) & (remainder < divisor)
    zero = (got["quotient"] == 0) & (given["a"] == 0)
    return exact & (got["quotient"] >= low) & (got["quotient"] <= high) | zero | ~in_range


def quotient_out_of_range_saturates_to_its_sign(p: Parameters, given: Operands, got: Operands) -> Holds:
    """From |a| 2^k = |b| 2^(bits - 1) on, the result is a limit, that of the sign."""
    dividend, divisor, sign = _magnitudes(p, given)
    low, high = _limits(p)
    out_of_range = (divisor > 0) & (dividend >= divisor << (p["INT"] + p["FRAC"] + p["GUARD"] - 1))
    return (got["quotient"] == np.where(sign < 0, low, high)) | ~out_of_range


def division_by_zero_is_flagged_and_saturates_to_the_sign_of_a(
    p: Parameters, given: Operands, got: Operands
) -> Holds:
    """x/0 is a limit, 0/0 is 0; the flag is raised there and nowhere else."""
    low, high = _limits(p)
    a, by_zero = given["a"], given["b"] == 0
    wanted = np.where(a > 0, high, np.where(a < 0, low, 0))
    flagged = (got["div_by_zero"] == 1) == by_zero
    return flagged & ((got["quotient"] == wanted) | ~by_zero)


globals().update(
    standard_tests(
        UNIT,
        quotient_is_truncated_toward_zero,
        quotient_out_of_range_saturates_to_its_sign,
        division_by_zero_is_flagged_and_saturates_to_the_sign_of_a,
    )
)
