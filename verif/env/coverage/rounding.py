"""Cover points of rounding: numbers that are floored and held in a range, and what divisions leave."""

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from models.fixed import Raw
from verif.env.coverage.classes import all_lanes, any_lane, port
from verif.env.coverage.points import Holds, Point, Samples
from verif.env.coverage.sieve import Sieve
from verif.env.fields import Field
from verif.env.unit import Parameters

Exact = Callable[[Parameters, Samples], Raw]
"""A number before it is rounded, of operands: ``(n,)`` or ``(lanes, n)``."""

_OnValue = Callable[[Field, Raw], NDArray[np.bool_]]


def _next_bit_agrees(field: Field, value: Raw) -> NDArray[np.bool_]:
    """Whether the lowest bit that says that a value is out of range looks as if it were not."""
    place = field.width - int(field.signed)
    return np.asarray((value >> place & 1 == 1) == (value < 0))


_ABOVE: Mapping[str, _OnValue] = {
    "next_to_highest": lambda field, value: value == field.high - 1,
    "highest": lambda field, value: value == field.high,
    "just_above": lambda field, value: value == field.high + 1,
    "above": lambda field, value: (value > field.high + 1) & ~_next_bit_agrees(field, value),
    "above_next_bit_agrees": lambda field, value: (value > field.high) & _next_bit_agrees(field, value),
}
_BELOW: Mapping[str, _OnValue] = {
    "next_to_lowest": lambda field, value: value == field.low + 1,
    "lowest": lambda field, value: value == field.low,
    "just_below": lambda field, value: value == field.low - 1,
    "below": lambda field, value: (value < field.low - 1) & ~_next_bit_agrees(field, value),
    "below_next_bit_agrees": lambda field, value: (value < field.low) & _next_bit_agrees(field, value),
}

ONE_BIT_WIDER = ("above_next_bit_agrees", "below_next_bit_agrees")
"""Bins that a number of one bit more than its port cannot reach."""


@dataclass(frozen=True)
class Floored:
    """A port that has the floor of an exact number over ``2**drop``, held within its range.

    name: of the port. drop: of the exact number's fraction bits, negative where zeros are appended.
    """

    sieve: Sieve
    name: str
    exact: Exact
    drop: Callable[[Parameters], int]

    def limits(self, *, negative: bool = True, leave_out: Collection[str] = ()) -> Point:
        """Just within and just beyond each limit, and far beyond, so that upper bits look right, too.

        negative: the exact number has a sign.
        """
        cases = {**_ABOVE, **(_BELOW if negative else {})}
        kept = {name: self._on_value(case) for name, case in cases.items() if name not in leave_out}
        return self.sieve.point(f"limits_of_{self.name}", f"{self.name} at and beyond its limits", kept)

    def _field(self, parameters: Parameters) -> Field:
        return port(self.sieve.unit.outputs, parameters, self.name)

    def _value(self, parameters: Parameters, samples: Samples) -> Raw:
        drop, exact = self.drop(parameters), self.exact(parameters, samples)
        return np.asarray(exact >> drop if drop >= 0 else exact << -drop)

    def _on_value(self, case: _OnValue) -> Holds:
        def holds(parameters: Parameters, samples: Samples) -> NDArray[np.bool_]:
            return any_lane(case(self._field(parameters), self._value(parameters, samples)))

        return holds

    def residue(self, *, negative: bool = True, leave_out: Collection[str] = ()) -> Point:
        """What is dropped of a number in range: nothing, least, half, most; and results less than a step.

        negative: the exact number has a sign, so that the floor is not the number cut off.
        """
        cases = {"positive": 1, "negative": -1} if negative else {"positive": 1}
        found: dict[str, Holds] = {}
        for name, sign in cases.items():
            found[f"none_{name}"] = self._dropped(sign, lambda _drop: 0)
            found[f"least_{name}"] = self._dropped(sign, lambda _drop: 1)
            found[f"half_{name}"] = self._dropped(sign, lambda drop: 1 << drop >> 1)
            found[f"most_{name}"] = self._dropped(sign, lambda drop: (1 << drop) - 1)
            found[f"less_than_a_step_{name}"] = self._less_than_a_step(sign)
        kept = {name: holds for name, holds in found.items() if name not in leave_out}
        return self.sieve.point(f"residue_of_{self.name}", f"bits dropped of {self.name}", kept)

    def _dropped(self, sign: int, residue: Callable[[int], int]) -> Holds:
        def holds(parameters: Parameters, samples: Samples) -> NDArray[np.bool_]:
            drop, exact = self.drop(parameters), self.exact(parameters, samples)
            if drop < 1:
                return np.zeros(exact.shape[-1], dtype=np.bool_)
            field, value = self._field(parameters), exact >> drop
            in_range = (value >= field.low) & (value <= field.high) & (exact * sign >> drop != 0)
            is_residue = exact & ((1 << drop) - 1) == residue(drop)
            return any_lane(is_residue & in_range & (np.sign(exact) == sign))

        return holds

    def _less_than_a_step(self, sign: int) -> Holds:
        def holds(parameters: Parameters, samples: Samples) -> NDArray[np.bool_]:
            exact = self.exact(parameters, samples) * sign
            return any_lane((exact > 0) & (exact < 1 << max(self.drop(parameters), 0)))

        return holds


Division = Callable[[Parameters, Samples], tuple[Raw, Raw]]
"""Dividend and divisor of operands as whole numbers that are not negative; a divisor of 0 is no division."""


def remainders(sieve: Sieve, name: str, division: Division) -> Point:
    """What a division leaves: nothing, least, half, most, and where the dividend is less than the divisor."""

    def case(matches: Callable[[Raw, Raw, Raw], NDArray[np.bool_]]) -> Holds:
        def holds(parameters: Parameters, samples: Samples) -> NDArray[np.bool_]:
            dividend, divisor = np.broadcast_arrays(*division(parameters, samples))
            quotient, rest = np.divmod(dividend, np.maximum(divisor, 1))
            return any_lane(matches(quotient, rest, divisor) & (divisor > 2))

        return holds

    cases = {
        "none": case(lambda quotient, rest, _divisor: (rest == 0) & (quotient > 1)),
        "least": case(lambda quotient, rest, _divisor: (rest == 1) & (quotient > 0)),
        "half": case(lambda quotient, rest, divisor: (2 * rest == divisor) & (quotient > 0)),
        "most": case(lambda quotient, rest, divisor: (rest == divisor - 1) & (quotient > 0)),
        "all_of_it": case(lambda quotient, rest, _divisor: (rest > 0) & (quotient == 0)),
        "quotient_of_one": case(lambda quotient, rest, _divisor: (rest == 0) & (quotient == 1)),
    }
    return sieve.point(name, "what the division leaves", cases)


def lanes_apart(sieve: Sieve, name: str, *, signed: bool = True) -> Point:
    """Limits in lanes side by side: in one alone, in all, both at once: lanes share no bit and no sign."""

    def case(matches: Callable[[NDArray[np.bool_], NDArray[np.bool_]], NDArray[np.bool_]]) -> Holds:
        def holds(parameters: Parameters, samples: Samples) -> NDArray[np.bool_]:
            field = port(sieve.unit.outputs, parameters, name)
            values = samples[name].reshape(field.lanes, -1)
            if field.lanes < 2:
                return np.zeros(values.shape[-1], dtype=np.bool_)
            return np.asarray(matches(values == field.high, values == field.low))

        return holds

    cases = {
        "only_first_highest": case(lambda high, _low: high[0] & (high.sum(axis=0) == 1)),
        "only_last_highest": case(lambda high, _low: high[-1] & (high.sum(axis=0) == 1)),
        "all_but_first_highest": case(lambda high, _low: ~high[0] & all_lanes(high[1:])),
        "all_highest": case(lambda high, _low: all_lanes(high)),
    }
    if signed:
        cases |= {
            "only_first_lowest": case(lambda _high, low: low[0] & (low.sum(axis=0) == 1)),
            "only_last_lowest": case(lambda _high, low: low[-1] & (low.sum(axis=0) == 1)),
            "all_lowest": case(lambda _high, low: all_lanes(low)),
            "highest_and_lowest": case(lambda high, low: any_lane(high) & any_lane(low)),
        }
    return sieve.point(f"lanes_of_{name}", f"limits of {name} in lanes side by side", cases)
