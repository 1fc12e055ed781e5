"""Tests of the sum of colours: the standard ones, and the sum itself."""

import numpy as np

from verif.env.definitions import Holds, all_lanes
from verif.env.fields import Operands
from verif.env.pipelined_tests import standard_tests
from verif.env.unit import Parameters
from verif.units.colour_add.unit import FMTS, UNIT


def sum_is_exact_until_it_does_not_fit(_: Parameters, given: Operands, got: Operands) -> Holds:
    """The whole sum, or the largest colour where that is less."""
    total = given["a"] + given["b"]
    fits = total < 1 << FMTS.shade.width
    return all_lanes(np.where(fits, got["sum"] == total, got["sum"] == (1 << FMTS.shade.width) - 1))


globals().update(standard_tests(UNIT, sum_is_exact_until_it_does_not_fit))
