"""Tests of the unit vector: those of every pipelined unit, and what it is to be one."""

import numpy as np

from verif.env.definitions import Holds, all_lanes
from verif.env.fields import Operands
from verif.env.pipelined_tests import standard_tests
from verif.env.unit import Parameters
from verif.units.normalise.unit import UNIT


def norm_is_the_length_rounded_down(p: Parameters, given: Operands, got: Operands) -> Holds:
    """norm² <= (x² + y² + z²) 2^(2 GUARD) < (norm + 1)²."""
    square = (given["a"] ** 2).sum(axis=0) << (2 * p["GUARD"])
    return (got["norm"] ** 2 <= square) & (square < (got["norm"] + 1) ** 2)


def components_times_the_norm_are_the_vector_truncated_toward_zero(
    p: Parameters, given: Operands, got: Operands
) -> Holds:
    """|unit| norm <= |a| 2^k < (|unit| + 1) norm, with the sign of a."""
    scaled = np.abs(given["a"]) << (p["OUT_FRAC"] + p["GUARD"])
    magnitude = np.abs(got["unit"])
    quotient = (magnitude * got["norm"] <= scaled) & (scaled < (magnitude + 1) * got["norm"])
    sign = (got["unit"] == 0) | (np.sign(got["unit"]) == np.sign(given["a"]))
    return all_lanes(quotient & sign) | (got["norm"] == 0)


def no_component_is_larger_than_one(p: Parameters, given: Operands, got: Operands) -> Holds:
    """So a unit component never needs the limits of its format."""
    return all_lanes(np.abs(got["unit"]) <= 1 << p["OUT_FRAC"])


def zero_vector_and_no_other_is_degenerate_and_gives_zero(
    _: Parameters, given: Operands, got: Operands
) -> Holds:
    """The flag is raised for the zero vector alone; its unit vector and norm are zero."""
    zero = all_lanes(given["a"] == 0)
    is_zero = all_lanes(got["unit"] == 0) & (got["norm"] == 0)
    return ((got["degenerate"] == 1) == zero) & (is_zero | ~zero)


globals().update(
    standard_tests(
        UNIT,
        norm_is_the_length_rounded_down,
        components_times_the_norm_are_the_vector_truncated_toward_zero,
        no_component_is_larger_than_one,
        zero_vector_and_no_other_is_degenerate_and_gives_zero,
    )
)
