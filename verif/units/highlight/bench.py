"""Tests of the sixteenth power: the standard ones, and the power in float64 with a derived bound.

A square of c that is off by e is off by at most 2 c e, and floored by less than a step more.
Nothing is rounded up, so no result is above the power.
"""

import numpy as np

from models.header import selected
from models.limits import SHININESS
from verif.env.definitions import Holds
from verif.env.fields import Operands
from verif.env.pipelined_tests import standard_tests
from verif.env.unit import Parameters
from verif.env.vectors import SLACK, Floats, where
from verif.units.highlight.unit import UNIT

_SQUARINGS = SHININESS.bit_length() - 1


def power_bound(cosine: Floats, step: float, error: Floats | float = 0.0) -> Floats:
    """By how much the power may be below that of a cosine which is itself below by ``error``."""
    bound, power = np.broadcast_to(error, cosine.shape), cosine
    for _ in range(_SQUARINGS):
        bound, power = 2.0 * power * bound + step, power * power
    return bound + SLACK


def result_is_the_sixteenth_power_within_the_bound(p: Parameters, given: Operands, got: Operands) -> Holds:
    """Never above it; saturated where it does not fit."""
    fmt = selected(p).cosine
    cosine, power = fmt.to_float(given["cosine"]), fmt.to_float(got["power"])
    step, exact = 1.0 / fmt.one, cosine**SHININESS
    most = fmt.max * step
    least = np.minimum(exact - power_bound(cosine, step), most)
    return np.asarray((power <= np.minimum(exact, most) + SLACK) & (power >= least))


def one_and_zero_are_their_own_powers(p: Parameters, given: Operands, got: Operands) -> Holds:
    """Exactly, and a step below 1 is below 1."""
    one = selected(p).cosine.one
    fixed = (given["cosine"] == 0) | (given["cosine"] == one)
    return where(fixed, got["power"] == given["cosine"]) & ((given["cosine"] >= one) | (got["power"] < one))


def larger_cosines_never_have_smaller_powers(_: Parameters, given: Operands, got: Operands) -> Holds:
    """Over all operands of the stream, sorted."""
    order = np.argsort(given["cosine"], kind="stable")
    rises = np.diff(got["power"][order], prepend=0) >= 0
    holds = np.empty_like(rises)
    holds[order] = rises
    return holds


globals().update(
    standard_tests(
        UNIT,
        result_is_the_sixteenth_power_within_the_bound,
        one_and_zero_are_their_own_powers,
        larger_cosines_never_have_smaller_powers,
    )
)
