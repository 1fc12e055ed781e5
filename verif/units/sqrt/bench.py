"""Tests of the square root: those of every pipelined unit, and the definition of a root."""

from verif.env.pipelined_tests import standard_tests
from verif.units.sqrt import definition
from verif.units.sqrt.unit import UNIT

globals().update(
    standard_tests(
        UNIT,
        definition.root_squared_and_remainder_are_the_radicand,
        definition.remainder_is_at_most_twice_the_root,
    )
)
