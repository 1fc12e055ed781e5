"""Tests of the multiplier: those of every pipelined unit, and long multiplication by digits."""

import numpy as np

from verif.env.definitions import Holds, all_lanes
from verif.env.fields import Operands
from verif.env.pipelined_tests import standard_tests
from verif.env.unit import Parameters
from verif.units.mul.unit import UNIT

_DIGIT = 8


def product_is_that_of_long_multiplication(p: Parameters, given: Operands, got: Operands) -> Holds:
    """The sum of a times each byte of b, with the sign counted apart."""
    a, b = np.abs(given["a"]), np.abs(given["b"])
    total = np.zeros_like(a)
    for place in range(0, p["B_W"], _DIGIT):
        total = total + ((a * ((b >> place) % (1 << _DIGIT))) << place)
    return all_lanes(got["p"] == total * np.sign(given["a"]) * np.sign(given["b"]))


globals().update(standard_tests(UNIT, product_is_that_of_long_multiplication))
