"""Tests of colours as bytes: the standard ones, and the byte's definition in whole numbers."""

import numpy as np

from verif.env.definitions import Holds, all_lanes
from verif.env.fields import Operands, count
from verif.env.pipelined_tests import standard_tests
from verif.env.unit import Parameters
from verif.units.rgb888.unit import FMTS, UNIT

_LONG = 2_000
"""Half of so many operands are all edges of bytes and their neighbours."""


def byte_is_255_times_the_colour_truncated(_: Parameters, given: Operands, got: Operands) -> Holds:
    """byte <= 255 c < byte + 1 with c the colour's fraction, exactly; 255 from there on."""
    scaled, byte = 255 * given["colour"], got["pixel"]
    below_next = scaled < (byte + 1) * FMTS.shade.one
    return all_lanes((byte * FMTS.shade.one <= scaled) & (below_next | (byte == 255)))


def colours_of_one_and_more_are_full_and_darker_ones_are_not(
    _: Parameters, given: Operands, got: Operands
) -> Holds:
    """255 from 1.0 up, and only from there."""
    return all_lanes((got["pixel"] == 255) == (given["colour"] >= FMTS.shade.one))


def every_byte_occurs(_: Parameters, given: Operands, got: Operands) -> Holds:
    """A stream that is long enough reaches every byte in every lane."""
    reached = all(np.unique(lane).size == 256 for lane in got["pixel"])
    return np.full(count(given), reached or count(given) < _LONG)


globals().update(
    standard_tests(
        UNIT,
        byte_is_255_times_the_colour_truncated,
        colours_of_one_and_more_are_full_and_darker_ones_are_not,
        every_byte_occurs,
    )
)
