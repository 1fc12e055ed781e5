"""Tests of the long division: those of every pipelined unit, and the definition of a quotient."""

from verif.env.definitions import Holds, all_lanes
from verif.env.fields import Operands
from verif.env.pipelined_tests import standard_tests
from verif.env.unit import Parameters
from verif.units.div_core.unit import UNIT


def quotient_times_denominator_and_remainder_are_the_dividend(
    p: Parameters, given: Operands, got: Operands
) -> Holds:
    """{upper, lower} = q den + r with r < den, where upper < den."""
    dividend = (given["upper"] << p["QUOT_W"]) + given["lower"]
    exact = got["quotient"] * given["den"] + got["remainder"] == dividend
    return all_lanes((exact & (got["remainder"] < given["den"])) | (given["upper"] >= given["den"]))


globals().update(standard_tests(UNIT, quotient_times_denominator_and_remainder_are_the_dividend))
