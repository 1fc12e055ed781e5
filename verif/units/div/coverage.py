"""What must have been seen of the signed division: by zero, limits, remainders, truncation, guard bits."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from models.fixed import Raw
from verif.env.coverage.points import Coverage, Holds, Samples
from verif.env.coverage.rounding import remainders
from verif.env.coverage.sieve import Sieve
from verif.env.coverage.signs import by_sign
from verif.env.unit import Parameters
from verif.units.div.unit import UNIT
from verif.units.product_coverage import factors

SIEVE = Sieve(UNIT)


def _division(p: Parameters, s: Samples) -> tuple[Raw, Raw]:
    """Magnitudes of the shifted dividend and of the divisor."""
    return np.abs(s["a"]) << (p["FRAC"] + p["GUARD"]), np.abs(s["b"])


def _quotient(sign: int, matches: Callable[[Parameters, Raw, Raw], NDArray[np.bool_]]) -> Holds:
    """Of the magnitude before it is held, and its remainder, of quotients of a sign."""

    def holds(p: Parameters, s: Samples) -> NDArray[np.bool_]:
        dividend, divisor = _division(p, s)
        quotient, rest = np.divmod(dividend, np.maximum(divisor, 1))
        signed = np.sign(s["a"]) * np.sign(s["b"]) == sign
        return np.asarray(signed & matches(p, quotient, rest))

    return holds


def _largest(p: Parameters) -> int:
    """Magnitude of the smallest number, which is the first that no positive quotient can have."""
    return 1 << (p["INT"] + p["FRAC"] + p["GUARD"] - 1)


LIMITS = SIEVE.point(
    "limits",
    "the quotient's magnitude at its limit, which is in range where it is negative",
    by_sign(
        _quotient,
        {
            "next_to_last": lambda p, quotient, _rest: quotient == _largest(p) - 2,
            "last": lambda p, quotient, _rest: quotient == _largest(p) - 1,
            "just_at_limit": lambda p, quotient, _rest: quotient == _largest(p),
            "beyond": lambda p, quotient, _rest: quotient > _largest(p),
            "far_beyond": lambda p, quotient, _rest: quotient >= 8 * _largest(p),
        },
    ),
)


def _by_zero(sign: int) -> Holds:
    def holds(_p: Parameters, s: Samples) -> NDArray[np.bool_]:
        return np.asarray((s["b"] == 0) & (np.sign(s["a"]) == sign))

    return holds


BY_ZERO = SIEVE.point(
    "by_zero",
    "divisions by zero, by the sign of the dividend",
    {"positive": _by_zero(1), "zero": _by_zero(0), "negative": _by_zero(-1)},
)

TRUNCATION = SIEVE.point(
    "truncation",
    "quotients of which a rest is cut off: toward zero, not down",
    by_sign(
        _quotient,
        {
            "to_zero": lambda _p, quotient, rest: (quotient == 0) & (rest > 0),
            "to_one_step": lambda _p, quotient, rest: (quotient == 1) & (rest > 0),
            "nothing": lambda _p, quotient, rest: (quotient > 1) & (rest == 0),
        },
    ),
)


def _guard(matches: Callable[[Raw, int], NDArray[np.bool_]]) -> Holds:
    """Of the quotient's guard bits, where there are any and the quotient is in range."""

    def holds(p: Parameters, s: Samples) -> NDArray[np.bool_]:
        mask = (1 << p["GUARD"]) - 1
        quotient = np.abs(s["quotient"])
        inside = (quotient < _largest(p) - 1) & (quotient > mask) & (s["b"] != 0)
        return np.asarray(inside & matches(quotient & mask, mask) & (mask > 0))

    return holds


GUARD = SIEVE.point(
    "guard",
    "the quotient's guard bits",
    {
        "zero": _guard(lambda bits, _mask: bits == 0),
        "one": _guard(lambda bits, _mask: bits == 1),
        "all_ones": _guard(lambda bits, mask: bits == mask),
    },
)

COVERAGE = Coverage(
    (
        *factors(UNIT.inputs, "a", "b"),
        BY_ZERO,
        LIMITS,
        TRUNCATION,
        remainders(SIEVE, "remainder", _division),
        GUARD,
    )
)
