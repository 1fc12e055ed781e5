"""Tests of the point-wise product: those of every pipelined unit, and the rule of the book's multiplier."""

from verif.env.definitions import Holds, all_lanes, is_floor
from verif.env.fields import Operands
from verif.env.pipelined_tests import standard_tests
from verif.env.unit import Parameters
from verif.units.products import dropped_bits
from verif.units.vec_mul.unit import UNIT


def product_is_rounded_down_and_saturates_on_both_sides(
    p: Parameters, given: Operands, got: Operands
) -> Holds:
    """Each lane is the floor of the exact product, or the limit that it passed."""
    port = UNIT.outputs(p)[0]
    return all_lanes(is_floor(given["a"] * given["b"], dropped_bits(p), port, got["p"]))


globals().update(standard_tests(UNIT, product_is_rounded_down_and_saturates_on_both_sides))
