"""Tests of the cross product: those of every pipelined unit, and the determinant's cofactors."""

import numpy as np

from verif.env.definitions import Holds, all_lanes, is_floor
from verif.env.fields import Operands
from verif.env.pipelined_tests import standard_tests
from verif.env.unit import Parameters
from verif.units.cross_product.unit import UNIT
from verif.units.products import dropped_bits


def components_are_cofactors_rounded_down_and_saturated_once(
    p: Parameters, given: Operands, got: Operands
) -> Holds:
    """The floor of each exact difference of two products, or the limit it passed."""
    (ax, ay, az), (bx, by, bz) = given["a"], given["b"]
    exact = np.stack([ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx])
    return all_lanes(is_floor(exact, dropped_bits(p), UNIT.outputs(p)[0], got["p"]))


globals().update(standard_tests(UNIT, components_are_cofactors_rounded_down_and_saturated_once))
