"""What must have been seen of both unsigned divisions: the quotient's sizes, special divisors."""

from collections.abc import Callable, Mapping

import numpy as np
from numpy.typing import NDArray

from models.fixed import Raw
from verif.env.coverage.classes import any_lane, port
from verif.env.coverage.points import Holds, Point, Samples
from verif.env.coverage.rounding import Division
from verif.env.coverage.sieve import Sieve
from verif.env.unit import Parameters

_Matches = Callable[[Raw, Raw, int, int], NDArray[np.bool_]]
"""Of quotient, divisor, and the most that each can be."""


def quotients(sieve: Sieve, division: Division) -> Point:
    """Sizes of the quotient, and divisors that make it easy, where the divisor is not 0."""

    def case(matches: _Matches) -> Holds:
        def holds(p: Parameters, s: Samples) -> NDArray[np.bool_]:
            _, den = np.broadcast_arrays(*division(p, s))
            most = port(sieve.unit.outputs, p, "quotient").high, port(sieve.unit.inputs, p, "den").high
            return any_lane(matches(s["quotient"], den, *most) & (den > 0))

        return holds

    cases: Mapping[str, _Matches] = {
        "zero": lambda quotient, _den, _q, _d: quotient == 0,
        "one": lambda quotient, _den, _q, _d: quotient == 1,
        "just_below_highest": lambda quotient, _den, most, _d: quotient == most - 1,
        "highest": lambda quotient, _den, most, _d: quotient == most,
        "only_top_bit": lambda quotient, _den, most, _d: quotient == most // 2 + 1,
        "top_bit_clear_and_all_others_set": lambda quotient, _den, most, _d: quotient == most // 2,
        "over_one": lambda quotient, den, _q, _d: (den == 1) & (quotient > 1),
        "over_power_of_two": lambda quotient, den, _q, _d: (
            (den & (den - 1) == 0) & (den > 1) & (quotient > 1)
        ),
        "over_the_largest": lambda quotient, den, _q, most: (den == most) & (quotient > 0),
    }
    found = {name: case(matches) for name, matches in cases.items()}
    return sieve.point("quotient", "sizes of the quotient, divisors that make it easy", found)
