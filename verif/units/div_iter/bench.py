"""Tests of the iterative division: those of every valid/ready unit, and the definition of a quotient."""

from verif.env.definitions import Holds
from verif.env.fields import Operands
from verif.env.stream_tests import standard_stream_tests
from verif.env.unit import Parameters
from verif.units.div_iter.unit import UNIT


def quotient_times_denominator_and_remainder_are_the_numerator(
    _: Parameters, given: Operands, got: Operands
) -> Holds:
    """num = q den + r with r < den, where den is not 0."""
    exact = got["quotient"] * given["den"] + got["remainder"] == given["num"]
    return (exact & (got["remainder"] < given["den"])) | (given["den"] == 0)


def division_by_zero_gives_all_ones_and_the_low_bits(p: Parameters, given: Operands, got: Operands) -> Holds:
    """What the header promises for den = 0."""
    ones = got["quotient"] == (1 << p["NUM_W"]) - 1
    low = got["remainder"] == given["num"] % (1 << p["DEN_W"])
    return (ones & low) | (given["den"] != 0)


globals().update(
    standard_stream_tests(
        UNIT,
        quotient_times_denominator_and_remainder_are_the_numerator,
        division_by_zero_gives_all_ones_and_the_low_bits,
    )
)
