"""What must have been seen of colours as bytes: the edges of bytes, the clamp at 255, channels apart."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from models.core.pixel import FULL
from models.fixed import Raw
from verif.env.coverage.classes import all_lanes, any_lane, operand
from verif.env.coverage.points import Coverage, Holds, Samples
from verif.env.coverage.rounding import Floored, lanes_apart
from verif.env.coverage.sieve import Sieve
from verif.env.unit import Parameters
from verif.units.rgb888.unit import FMTS, UNIT

SIEVE = Sieve(UNIT)
ONE = FMTS.shade.one


def _exact(_p: Parameters, s: Samples) -> Raw:
    return np.asarray(FULL * s["colour"])


PIXEL = Floored(SIEVE, "pixel", _exact, lambda _p: FMTS.shade.frac_bits)


def _colour(matches: Callable[[Raw], NDArray[np.bool_]]) -> Holds:
    def holds(_p: Parameters, s: Samples) -> NDArray[np.bool_]:
        return any_lane(matches(s["colour"]))

    return holds


def _byte(matches: Callable[[Raw], NDArray[np.bool_]]) -> Holds:
    """A byte of a colour that is not clamped."""

    def holds(_p: Parameters, s: Samples) -> NDArray[np.bool_]:
        return any_lane(matches(s["pixel"]) & (s["colour"] < ONE))

    return holds


def _first(s: Samples) -> NDArray[np.bool_]:
    """The darkest colours of their bytes."""
    return np.asarray(FULL * (s["colour"] - 1) >> FMTS.shade.frac_bits < s["pixel"])


CLAMP = SIEVE.point(
    "clamp",
    "around the brightest byte",
    {
        "step_below_one": _colour(lambda colour: colour == ONE - 1),
        "one": _colour(lambda colour: colour == ONE),
        "step_above_one": _colour(lambda colour: colour == ONE + 1),
        "first_that_is_more_than_255": _colour(lambda colour: colour == -(-256 * ONE // FULL)),
        "twice_one": _colour(lambda colour: colour == 2 * ONE),
        "far_above": _colour(lambda colour: colour > 16 * ONE),
        "pixel_white": lambda _p, s: all_lanes(s["colour"] >= ONE),
        "pixel_black": lambda _p, s: all_lanes(s["pixel"] == 0) & all_lanes(s["colour"] > 0),
        "black_and_clamped": lambda _p, s: any_lane(s["colour"] > ONE) & any_lane(s["colour"] == 0),
    },
)

BYTES = SIEVE.point(
    "bytes",
    "bytes below the clamp, and the colours at their edges",
    {
        "one": _byte(lambda byte: byte == 1),
        "127": _byte(lambda byte: byte == 127),
        "128": _byte(lambda byte: byte == 128),
        "254": _byte(lambda byte: byte == 254),
        "darkest_of_its_byte": lambda _p, s: any_lane(_first(s) & (s["pixel"] > 0) & (s["colour"] < ONE)),
        "brightest_of_its_byte": lambda _p, s: any_lane(
            (FULL * (s["colour"] + 1) >> FMTS.shade.frac_bits > s["pixel"]) & (s["colour"] < ONE)
        ),
    },
)

COVERAGE = Coverage(
    (
        operand(UNIT.inputs, "colour", signed=False),
        CLAMP,
        BYTES,
        PIXEL.limits(negative=False),
        PIXEL.residue(negative=False),
        lanes_apart(SIEVE, "pixel", signed=False),
    )
)
