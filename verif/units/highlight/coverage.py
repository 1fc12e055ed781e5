"""What must have been seen of the sixteenth power: where it saturates, where it vanishes, residues."""

from collections.abc import Callable

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

from models.arith import vec_mul
from models.fixed import Raw
from models.header import selected
from verif.env.coverage.classes import operand
from verif.env.coverage.points import Coverage, Holds, Samples
from verif.env.coverage.rounding import Floored
from verif.env.coverage.sieve import Sieve
from verif.env.fields import Operands
from verif.env.unit import Parameters
from verif.units.highlight.unit import UNIT

SQUARINGS = 4


def _every_cosine(p: Parameters, generator: Generator, _size: int) -> Operands:
    """In any order; there are few enough."""
    return {"cosine": generator.permutation(UNIT.inputs(p)[0].high + 1)}


SIEVE = Sieve(UNIT, "every cosine", _every_cosine)


def _squared(p: Parameters, s: Samples, times: int) -> Raw:
    """What so many squarings give."""
    fmt, value = selected(p).cosine, s["cosine"]
    for _ in range(times):
        value = vec_mul(value, value, fmt, fmt, fmt)
    return value


def _exact(p: Parameters, s: Samples) -> Raw:
    """The last square, before it is rounded."""
    return np.asarray(_squared(p, s, SQUARINGS - 1) ** 2)


POWER = Floored(SIEVE, "power", _exact, lambda p: selected(p).cosine.frac_bits)


def _first_at(step: int, limit: Callable[[Parameters], int]) -> Holds:
    """The squaring after which the value is at a limit, and was not before."""

    def holds(p: Parameters, s: Samples) -> NDArray[np.bool_]:
        before, after = _squared(p, s, step - 1), _squared(p, s, step)
        return np.asarray((after == limit(p)) & (before != limit(p)))

    return holds


def _highest(p: Parameters) -> int:
    return int(selected(p).cosine.max)


def _beside_one(step: int) -> Holds:
    def holds(p: Parameters, s: Samples) -> NDArray[np.bool_]:
        return np.asarray(s["cosine"] == selected(p).cosine.one + step)

    return holds


ONE = SIEVE.point(
    "one",
    "cosines beside 1, which is its own power",
    {"step_below": _beside_one(-1), "one": _beside_one(0), "step_above": _beside_one(1)},
)

SATURATES = SIEVE.point(
    "saturates",
    "the squaring that is the first to saturate",
    {f"in_squaring_{step}": _first_at(step, _highest) for step in range(1, SQUARINGS + 1)},
)

VANISHES = SIEVE.point(
    "vanishes",
    "the squaring that is the first to leave nothing",
    {f"in_squaring_{step}": _first_at(step, lambda _p: 0) for step in range(1, SQUARINGS + 1)},
)


def _power(least: float, most: float) -> Holds:
    """Between two shares of 1, the upper one not included."""

    def holds(p: Parameters, s: Samples) -> NDArray[np.bool_]:
        one = selected(p).cosine.one
        return np.asarray((s["power"] >= least * one) & (s["power"] < most * one) & (s["power"] > 0))

    return holds


SIZES = SIEVE.point(
    "sizes",
    "how bright the highlight is",
    {
        "a_step": lambda _p, s: s["power"] == 1,
        "faint": _power(0.0, 1 / 256),
        "dim": _power(1 / 256, 0.5),
        "bright": _power(0.5, 1.0),
        "more_than_full": _power(1.0, 2.0),
    },
)

COVERAGE = Coverage(
    (
        operand(UNIT.inputs, "cosine", signed=False),
        ONE,
        SIZES,
        SATURATES,
        VANISHES,
        # A square of a square ends at no other place near the limit, and no other residue is one: all
        # cosines of both builds were tried.
        POWER.limits(negative=False, leave_out=("next_to_highest", "highest", "above_next_bit_agrees")),
        POWER.residue(negative=False, leave_out=("half_positive", "most_positive")),
    )
)
