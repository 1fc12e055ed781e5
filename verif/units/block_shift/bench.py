"""Tests of the block shift: those of every pipelined unit, and what a normalised block is."""

from verif.env.definitions import Holds, all_lanes
from verif.env.fields import Operands
from verif.env.pipelined_tests import standard_tests
from verif.env.unit import Parameters
from verif.units.block_shift.unit import UNIT


def result_is_the_floor_of_the_scaled_vector(p: Parameters, given: Operands, got: Operands) -> Holds:
    """p <= a 2^shift 2^(OUT_W - IN_W) < p + 1, in every lane."""
    scaled, drop = given["a"] << got["shift"], p["IN_W"] - p["OUT_W"]
    if drop <= 0:
        return all_lanes(got["p"] == scaled << -drop)
    return all_lanes((got["p"] << drop <= scaled) & (scaled < (got["p"] + 1) << drop))


def no_lane_overflows_and_one_more_shift_would(p: Parameters, given: Operands, got: Operands) -> Holds:
    """The shift is the largest that every lane allows, or IN_W - 1 where all are 0 or -1."""
    half = 1 << (p["IN_W"] - 1)
    scaled = given["a"] << got["shift"]
    fits = all_lanes((scaled >= -half) & (scaled < half))
    one_more_fits = all_lanes((2 * scaled >= -half) & (2 * scaled < half))
    least = all_lanes((given["a"] == 0) | (given["a"] == -1))
    return fits & ((least & (got["shift"] == p["IN_W"] - 1)) | (~least & ~one_more_fits))


globals().update(
    standard_tests(UNIT, result_is_the_floor_of_the_scaled_vector, no_lane_overflows_and_one_more_shift_would)
)
