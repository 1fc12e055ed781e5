"""Tests of the length of a vector: those of every pipelined unit, and Pythagoras."""

from verif.env.definitions import Holds
from verif.env.fields import Operands
from verif.env.pipelined_tests import standard_tests
from verif.env.unit import Parameters
from verif.units.norm.unit import UNIT


def length_is_the_largest_whose_square_is_no_more_than_that_of_the_vector(
    p: Parameters, given: Operands, got: Operands
) -> Holds:
    """length² <= (x² + y² + z²) 2^(2 GUARD) < (length + 1)²."""
    x, y, z = given["a"]
    square = (x * x + y * y + z * z) << (2 * p["GUARD"])
    length = got["length"]
    return (length * length <= square) & (square < (length + 1) * (length + 1))


globals().update(standard_tests(UNIT, length_is_the_largest_whose_square_is_no_more_than_that_of_the_vector))
