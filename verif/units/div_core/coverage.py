"""What must have been seen of the long division: operands, quotients, remainders, what does not fit."""

import numpy as np
from numpy.typing import NDArray

from models.fixed import Raw
from verif.env.coverage.classes import any_lane, operand
from verif.env.coverage.points import Coverage, Samples
from verif.env.coverage.rounding import remainders
from verif.env.coverage.sieve import Sieve
from verif.env.unit import Parameters
from verif.units.div_core.unit import UNIT
from verif.units.division_coverage import quotients

SIEVE = Sieve(UNIT)


def _division(p: Parameters, s: Samples) -> tuple[Raw, Raw]:
    """Dividend and divisor; none where the quotient does not fit."""
    dividend = (s["upper"] << p["QUOT_W"]) + s["lower"]
    return dividend, np.where(s["upper"] < s["den"], s["den"], 0)


FIT = SIEVE.point(
    "fit",
    "the upper half of the dividend against the divisor: less where the quotient fits",
    {
        "far_less": lambda _p, s: any_lane((s["upper"] < s["den"] >> 2) & (s["upper"] > 0)),
        "just_less": lambda _p, s: any_lane((s["upper"] == s["den"] - 1) & (s["upper"] > 0)),
        "equal": lambda _p, s: any_lane((s["upper"] == s["den"]) & (s["den"] > 0)),
        "more": lambda _p, s: any_lane((s["upper"] > s["den"]) & (s["den"] > 0)),
        "divisor_zero": lambda _p, s: any_lane((s["den"] == 0) & (s["upper"] > 0)),
        "all_zero": lambda _p, s: any_lane((s["den"] == 0) & (s["upper"] == 0) & (s["lower"] == 0)),
    },
)


def _lanes_differ(_p: Parameters, s: Samples) -> NDArray[np.bool_]:
    """One divisor, and a quotient with and one without a remainder."""
    rest = s["remainder"].reshape(-1, s["den"].shape[-1])
    fits = (s["upper"] < s["den"]).reshape(rest.shape)
    return np.asarray(any_lane(fits & (rest == 0)) & any_lane(fits & (rest > 0)))


def _last_step_restores(_p: Parameters, s: Samples) -> NDArray[np.bool_]:
    """The last bit is 0, so the divisor is added once more: the remainder needs it."""
    return any_lane((s["quotient"] % 2 == 0) & (s["remainder"] > 0) & (s["upper"] < s["den"]))


STEPS = SIEVE.point(
    "steps",
    "what the last step does, and what lanes share",
    {
        "last_restores": _last_step_restores,
        "last_does_not": lambda _p, s: any_lane((s["quotient"] % 2 == 1) & (s["upper"] < s["den"])),
        "lanes_with_and_without_remainder": _lanes_differ,
    },
)

COVERAGE = Coverage(
    (
        operand(UNIT.inputs, "upper", signed=False),
        operand(UNIT.inputs, "lower", signed=False),
        operand(UNIT.inputs, "den", signed=False),
        FIT,
        quotients(SIEVE, _division),
        remainders(SIEVE, "remainder", _division),
        STEPS,
    )
)
