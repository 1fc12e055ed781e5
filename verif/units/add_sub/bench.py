"""Tests of the sum and difference: those of every pipelined unit, and the sum of whole numbers."""

import numpy as np

from verif.env.definitions import Holds, all_lanes
from verif.env.fields import Operands
from verif.env.pipelined_tests import standard_tests
from verif.env.unit import Parameters
from verif.units.add_sub.unit import UNIT


def sum_is_that_of_the_integers_or_the_limit_it_passed(
    p: Parameters, given: Operands, got: Operands
) -> Holds:
    """Exact in range, the nearest limit beyond it, on both sides."""
    exact = given["a"] - given["b"] if p["SUBTRACT"] else given["a"] + given["b"]
    largest = 1 << (p["INT"] + p["FRAC"] - 1)
    wanted = np.where(exact >= largest, largest - 1, np.where(exact < -largest, -largest, exact))
    return all_lanes(got["sum"] == wanted)


globals().update(standard_tests(UNIT, sum_is_that_of_the_integers_or_the_limit_it_passed))
