"""Tests of scalar times vector: those of every pipelined unit, and the rule of the book's multiplier."""

from verif.env.definitions import Holds, all_lanes, is_floor
from verif.env.fields import Operands
from verif.env.pipelined_tests import standard_tests
from verif.env.unit import Parameters
from verif.units.products import dropped_bits
from verif.units.vec_scale.unit import UNIT


def every_component_is_scaled_rounded_down_and_saturated(
    p: Parameters, given: Operands, got: Operands
) -> Holds:
    """Each lane is the floor of s times the component, or the limit that it passed."""
    port = UNIT.outputs(p)[0]
    return all_lanes(is_floor(given["s"] * given["a"], dropped_bits(p), port, got["p"]))


globals().update(standard_tests(UNIT, every_component_is_scaled_rounded_down_and_saturated))
