"""Tests of the dot product: those of every pipelined unit, and its rounding."""

from verif.env.definitions import Holds, is_floor
from verif.env.fields import Operands
from verif.env.pipelined_tests import standard_tests
from verif.env.unit import Parameters
from verif.units.dot.unit import UNIT
from verif.units.products import dropped_bits


def sum_of_products_is_rounded_down_and_saturated_once(
    p: Parameters, given: Operands, got: Operands
) -> Holds:
    """The floor of the exact sum or the limit it passed: products that cancel do not saturate before."""
    a, b = given["a"], given["b"]
    exact = a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
    return is_floor(exact, dropped_bits(p), UNIT.outputs(p)[0], got["p"])


globals().update(standard_tests(UNIT, sum_of_products_is_rounded_down_and_saturated_once))
