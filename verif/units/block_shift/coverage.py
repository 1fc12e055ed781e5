"""What must have been seen of the block shift: each stage, each lane that decides, what is dropped."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from models.fixed import Raw
from verif.env.coverage.classes import all_lanes, any_lane, operand
from verif.env.coverage.points import Coverage, Holds, Samples
from verif.env.coverage.sieve import Sieve
from verif.env.coverage.signs import by_sign
from verif.env.unit import Parameters
from verif.units.block_shift.unit import UNIT

SIEVE = Sieve(UNIT)
STAGES = 5
"""Bits of the shift of the widest unit."""


def _significant(s: Samples) -> Raw:
    """Components without their sign: what redundant sign bits are counted of."""
    return np.asarray(s["a"] ^ (s["a"] >> 63))


def _stage(bit: int, value: int) -> Holds:
    def holds(p: Parameters, s: Samples) -> NDArray[np.bool_]:
        exists = bit < (p["IN_W"] - 1).bit_length()
        return np.asarray((s["shift"] >> bit & 1 == value) & exists)

    return holds


STAGE = SIEVE.point(
    "stage",
    "bits of the shift, a stage each",
    {
        f"{'shifts' if value else 'passes'}_{1 << bit}": _stage(bit, value)
        for bit in range(STAGES)
        for value in (0, 1)
    },
)


def _shift(matches: Callable[[Raw, int], NDArray[np.bool_]]) -> Holds:
    """Of the shift, and the most that it can be."""

    def holds(p: Parameters, s: Samples) -> NDArray[np.bool_]:
        return matches(s["shift"], p["IN_W"] - 1)

    return holds


SHIFT = SIEVE.point(
    "shift",
    "the shift at its limits",
    {
        "none": _shift(lambda shift, _most: shift == 0),
        "one": _shift(lambda shift, _most: shift == 1),
        "one_less_than_most": _shift(lambda shift, most: shift == most - 1),
        "most": _shift(lambda shift, most: shift == most),
    },
)


def _only(lane: int) -> Holds:
    """The lane alone does not allow a larger shift."""

    def holds(p: Parameters, s: Samples) -> NDArray[np.bool_]:
        sizes = np.frexp(_significant(s).astype(np.float64))[1]
        least = p["IN_W"] - 1 - s["shift"]
        decides = sizes == least
        if lane >= p["LANES"]:
            return np.zeros(least.shape, dtype=np.bool_)
        return np.asarray(decides[lane] & (decides.sum(axis=0) == 1) & (least > 0))

    return holds


def _power(sign: int) -> Holds:
    """The longest component is a power of two: a negative one allows a larger shift than a positive one."""

    def holds(_p: Parameters, s: Samples) -> NDArray[np.bool_]:
        longest = np.abs(s["a"]).max(axis=0)
        power = (longest & (longest - 1) == 0) & (longest > 1)
        return np.asarray(power & any_lane(s["a"] == sign * longest) & ~any_lane(s["a"] == -sign * longest))

    return holds


DECIDES = SIEVE.point(
    "decides",
    "what the shift is decided by",
    {
        "first_lane": _only(0),
        "second_lane": _only(1),
        "third_lane": _only(2),
        "all_lanes": lambda _p, s: (np.ptp(_significant(s), axis=0) == 0) & any_lane(_significant(s) > 1),
        "power_of_two": _power(1),
        "minus_power_of_two": _power(-1),
        "all_zero": lambda _p, s: all_lanes(s["a"] == 0),
        "all_minus_one": lambda _p, s: all_lanes(s["a"] == -1),
        "zeros_and_minus_ones": lambda _p, s: (
            all_lanes(_significant(s) == 0) & any_lane(s["a"] == 0) & any_lane(s["a"] == -1)
        ),
    },
)


def _dropped(sign: int, matches: Callable[[Raw, int], NDArray[np.bool_]]) -> Holds:
    """Of what is dropped of a component of a sign, and of all ones there."""

    def holds(p: Parameters, s: Samples) -> NDArray[np.bool_]:
        ones = (1 << max(p["IN_W"] - p["OUT_W"], 0)) - 1
        rest = (s["a"] << s["shift"]) & ones
        return any_lane(matches(rest, ones) & (np.sign(s["a"]) == sign) & (ones > 0))

    return holds


DROPPED = SIEVE.point(
    "dropped",
    "low bits of a component that are dropped: floor, whatever the sign",
    by_sign(
        _dropped,
        {
            "nothing": lambda rest, _ones: rest == 0,
            "least": lambda rest, _ones: rest == 1,
            "most": lambda rest, ones: rest == ones,
        },
    ),
)


def _appended(p: Parameters, s: Samples) -> NDArray[np.bool_]:
    return np.asarray((p["OUT_W"] > p["IN_W"]) & any_lane(s["p"] != 0))


def _vanishes(sign: int) -> Holds:
    """A short component beside a long one: nothing of it is left, or of a negative one the floor."""

    def holds(_p: Parameters, s: Samples) -> NDArray[np.bool_]:
        return any_lane((np.sign(s["a"]) == sign) & (s["p"] == min(sign, 0)))

    return holds


RESULT = SIEVE.point(
    "result",
    "what becomes of components",
    {
        "zeros_appended": _appended,
        "short_positive_vanishes": _vanishes(1),
        "short_negative_becomes_minus_one": _vanishes(-1),
    },
)

COVERAGE = Coverage((operand(UNIT.inputs, "a"), STAGE, SHIFT, DECIDES, DROPPED, RESULT))
