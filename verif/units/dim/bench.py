"""Tests of light behind an object: the standard ones, and what its definition says."""

import numpy as np

from models.header import selected
from verif.env.definitions import Holds, all_lanes, is_floor
from verif.env.fields import Operands
from verif.env.pipelined_tests import standard_tests
from verif.env.unit import Parameters
from verif.units.dim.unit import UNIT


def each_channel_is_the_product_floored_and_held(p: Parameters, given: Operands, got: Operands) -> Holds:
    """Lane by lane."""
    exact = given["colour"] * given["share"]
    return all_lanes(is_floor(exact, selected(p).coeff.frac_bits, UNIT.outputs(p)[0], got["dimmed"]))


def an_opaque_object_lets_nothing_through_and_a_clear_one_everything(
    p: Parameters, given: Operands, got: Operands
) -> Holds:
    """Channel by channel; a share of at most 1 never makes light."""
    share, one = given["share"], selected(p).coeff.one
    black = (share != 0) | (got["dimmed"] == 0)
    same = (share != one) | (got["dimmed"] == given["colour"])
    return all_lanes(np.asarray(black & same & ((share > one) | (got["dimmed"] <= given["colour"]))))


globals().update(
    standard_tests(
        UNIT,
        each_channel_is_the_product_floored_and_held,
        an_opaque_object_lets_nothing_through_and_a_clear_one_everything,
    )
)
