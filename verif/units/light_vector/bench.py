"""Tests of direction and distance of a light: the standard ones, and geometry with derived bounds.

Before the square root a vector has as many bits as a unit vector: its longest component is 2**(W-2)
or more for W bits, so a step there is at most u = 2**(2-W) of its length. Each component is floored
by less than a step, the root by another: the length is off by less than (1 + sqrt 3) u of itself,
and its own floor. The quotient of the direction is truncated by one more step.
"""

import numpy as np

from models.limits import INFINITY
from verif.env import vectors
from verif.env.definitions import Holds, all_lanes
from verif.env.fields import Operands
from verif.env.pipelined_tests import standard_tests
from verif.env.unit import Parameters
from verif.env.vectors import SLACK, Floats
from verif.units.light_vector.unit import FMTS, UNIT

_STEP = 1.0 / FMTS.unit.one
_ROOT_3 = float(np.sqrt(3.0))
_INFINITY = float(INFINITY) * FMTS.point.one


def _reach(given: Operands) -> Floats:
    """Light minus point, in steps of a point, exact."""
    shift = FMTS.point.frac_bits - FMTS.coord.frac_bits
    return np.asarray((given["light"] << shift) - given["point"], dtype=np.float64)


def direction_points_from_the_point_to_the_light(_: Parameters, given: Operands, got: Operands) -> Holds:
    """Each component within the bound, as good a step away as far away."""
    off = np.abs(FMTS.unit.to_float(got["direction"]) - vectors.unit(_reach(given)))
    return all_lanes(off < (2.0 + 1.001 * _ROOT_3) * _STEP + SLACK)


def no_component_points_the_other_way(_: Parameters, given: Operands, got: Operands) -> Holds:
    """In all octants."""
    return all_lanes(np.sign(got["direction"]) * np.sign(_reach(given)) >= 0)


def limit_is_the_distance_to_the_light_or_infinity(_: Parameters, given: Operands, got: Operands) -> Holds:
    """Within the bound; infinity is the most there is."""
    exact = vectors.length(_reach(given))
    bound = 1.001 * (1.0 + _ROOT_3) * _STEP * exact + 1.0
    off = np.abs(got["limit"] - np.minimum(exact, _INFINITY))
    return np.asarray((got["limit"] <= _INFINITY) & (off <= bound))


def light_beyond_infinity_has_the_limit_of_infinity(_: Parameters, given: Operands, got: Operands) -> Holds:
    """Beyond the bound, exactly."""
    far = vectors.length(_reach(given)) * (1.0 - 1.001 * (1.0 + _ROOT_3) * _STEP) > _INFINITY + 1.0
    return vectors.where(far, got["limit"] == int(_INFINITY))


def only_a_light_at_the_point_is_degenerate(_: Parameters, given: Operands, got: Operands) -> Holds:
    """A step away it has a direction."""
    at_point = (_reach(given) == 0).all(axis=0)
    return vectors.where(at_point, got["degenerate"] == 1) & (at_point | (got["degenerate"] == 0))


globals().update(
    standard_tests(
        UNIT,
        direction_points_from_the_point_to_the_light,
        no_component_points_the_other_way,
        limit_is_the_distance_to_the_light_or_infinity,
        light_beyond_infinity_has_the_limit_of_infinity,
        only_a_light_at_the_point_is_degenerate,
    )
)
