"""Tests of the dot product, as every pipelined unit has them."""

from verif.env.pipelined_tests import standard_tests
from verif.units.dot.unit import UNIT

globals().update(standard_tests(UNIT))
