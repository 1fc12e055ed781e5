"""Tests of the iterative square root: those of every valid/ready unit, and the definition of a root."""

from verif.env.stream_tests import standard_stream_tests
from verif.units.sqrt import definition
from verif.units.sqrt_iter.unit import UNIT

globals().update(
    standard_stream_tests(
        UNIT,
        definition.root_squared_and_remainder_are_the_radicand,
        definition.remainder_is_at_most_twice_the_root,
    )
)
