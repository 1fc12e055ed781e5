"""Tests of the unit vector: the standard ones, and geometry in float64 with derived bounds.

The mantissa m has the vector's components times a power of two, floored by less than 1 each where
bits are dropped, so m is off by less than sqrt 3. Its longest component is 2**(W-2) or more for W
bits, one step u = 2**(2-W) of its length. The norm is floored by less than 1 and the quotient by
less than a step, so a component is off by less than (2 + sqrt 3) u, or 2 u where nothing is dropped.
"""

import numpy as np

from models.fixed import Raw
from verif.env import vectors
from verif.env.definitions import Holds, all_lanes
from verif.env.fields import Operands
from verif.env.pipelined_tests import standard_tests
from verif.env.unit import Parameters
from verif.env.vectors import SLACK, Floats
from verif.units.unit_vector.unit import FMTS, UNIT

_STEP = 1.0 / FMTS.unit.one
_MANTISSA_W = FMTS.mantissa.width


def _lost(p: Parameters, shift: Raw) -> Floats:
    """By how much the mantissa may be off in length."""
    return np.where(shift < p["IN_W"] - _MANTISSA_W, np.sqrt(3.0), 0.0)


def direction_is_that_of_the_vector(p: Parameters, given: Operands, got: Operands) -> Holds:
    """Each component within the bound, short vectors as good as long ones."""
    exact = vectors.unit(given["vector"].astype(np.float64))
    off = np.abs(FMTS.unit.to_float(got["unit"]) - exact)
    return all_lanes(off < (2.0 + 1.001 * _lost(p, got["shift"])) * _STEP + SLACK)


def norm_and_shift_give_the_length_of_the_vector(p: Parameters, given: Operands, got: Operands) -> Holds:
    """norm * 2**(E - shift) with the scale of the header, within what was floored."""
    scale = 2.0 ** (p["IN_W"] - _MANTISSA_W - got["shift"])
    exact = vectors.length(given["vector"].astype(np.float64)) / scale
    lost = _lost(p, got["shift"])
    slack = SLACK * (1.0 + exact)
    above, below = got["norm"] < exact + lost + slack, got["norm"] > exact - lost - 1.0 - slack
    return np.asarray(above & below)


def length_of_the_result_is_one(p: Parameters, given: Operands, got: Operands) -> Holds:
    """At most 1 but for the norm's floor, and never more than three truncated components below it."""
    size = vectors.length(FMTS.unit.to_float(got["unit"]))
    nonzero = (given["vector"] != 0).any(axis=0)
    within = (size < 1.0 + _STEP + SLACK) & (size > 1.0 - np.sqrt(3.0) * _STEP - SLACK)
    return np.asarray(~nonzero | within)


def only_the_zero_vector_is_degenerate_and_gives_zero(_: Parameters, given: Operands, got: Operands) -> Holds:
    """The flag says so, and the result is zero only then."""
    zero = (given["vector"] == 0).all(axis=0)
    nothing = (got["unit"] == 0).all(axis=0)
    return np.asarray(((got["degenerate"] == 1) == zero) & (nothing == zero))


def no_component_points_the_other_way(_: Parameters, given: Operands, got: Operands) -> Holds:
    """A component has the vector's sign, or is zero."""
    return all_lanes(np.sign(got["unit"]) * np.sign(given["vector"]) >= 0)


globals().update(
    standard_tests(
        UNIT,
        direction_is_that_of_the_vector,
        norm_and_shift_give_the_length_of_the_vector,
        length_of_the_result_is_one,
        only_the_zero_vector_is_degenerate_and_gives_zero,
        no_component_points_the_other_way,
    )
)
