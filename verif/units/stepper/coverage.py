"""What must have been seen of the stepper: spans and counts of each kind, both carries, lines cut short."""

import numpy as np

from verif.env.coverage.classes import before, scenario
from verif.env.coverage.handshake import Found, lasting, was
from verif.env.coverage.points import Bin, Coverage, Point, Samples, cross

LINES, CUTS, LONGEST = map(scenario, ("lines", "cut lines", "longest line"))


def _steps(s: Samples) -> Found:
    return (s["step"] == 1) & (s["load"] == 0)


def _idle(s: Samples) -> Found:
    return (s["step"] == 0) & (s["load"] == 0)


def _even(s: Samples) -> Found:
    """Twice the remainder is below the count: the increment does not carry."""
    return 2 * s["remainder"] < s["count"]


def _loaded(s: Samples) -> Found:
    """A clock behind a load: the value is the quotient."""
    return was(s["load"] == 1)


def _carries(s: Samples) -> Found:
    """The rest and what it grows by reach the count."""
    growth = np.where(_even(s), 2 * s["remainder"], 2 * s["remainder"] - s["count"])
    return s["rest_reg"] + growth >= s["count"]


CARRY = Point(
    "carry",
    "of the rest, in a step",
    (
        Bin("none", LINES, lambda _p, s: _steps(s) & ~_carries(s)),
        Bin("one", LINES, lambda _p, s: _steps(s) & _carries(s)),
    ),
)
INCREMENT = Point(
    "increment",
    "of the doubled span",
    (
        Bin("plain", LINES, lambda _p, s: _even(s)),
        Bin("carries", LINES, lambda _p, s: ~_even(s)),
        Bin("carries_exactly", LINES, lambda _p, s: 2 * s["remainder"] == s["count"]),
    ),
)


def _cannot_carry(increment: str, carry: str) -> bool:
    """Where the increment leaves no rest, that of the value stays."""
    return increment == "carries_exactly" and carry == "one"


COVERAGE = Coverage(
    signals=("load", "step", "remainder", "count", "rest_reg", "value_reg"),
    points=(
        Point(
            "count",
            "pixels of the line",
            (
                Bin("one", LINES, lambda _p, s: (s["load"] == 1) & (s["count"] == 1)),
                Bin("two", LINES, lambda _p, s: (s["load"] == 1) & (s["count"] == 2)),
                Bin("odd", LINES, lambda _p, s: (s["load"] == 1) & (s["count"] > 2) & (s["count"] % 2 == 1)),
                Bin(
                    "power_of_two",
                    LINES,
                    lambda _p, s: (s["load"] == 1) & (s["count"] > 2) & (s["count"] & (s["count"] - 1) == 0),
                ),
                Bin("most", LINES, lambda p, s: (s["load"] == 1) & (s["count"] == (1 << p["COUNT_W"]) - 1)),
            ),
        ),
        Point(
            "span",
            "of the line",
            (
                Bin(
                    "zero",
                    LINES,
                    lambda _p, s: _loaded(s) & (s["value_reg"] == 0) & (s["remainder"] == 0),
                ),
                Bin(
                    "below_count",
                    LINES,
                    lambda _p, s: _loaded(s) & (s["value_reg"] == 0) & (s["remainder"] > 0),
                ),
                Bin(
                    "multiple_of_count",
                    LINES,
                    lambda _p, s: _loaded(s) & (s["value_reg"] > 0) & (s["remainder"] == 0),
                ),
                Bin(
                    "with_remainder",
                    LINES,
                    lambda _p, s: _loaded(s) & (s["value_reg"] > 0) & (s["remainder"] > 0),
                ),
                Bin(
                    "largest_remainder",
                    LINES,
                    lambda _p, s: _loaded(s) & (s["remainder"] > 1) & (s["remainder"] == s["count"] - 1),
                ),
                Bin(
                    "most",
                    LINES,
                    lambda p, s: (
                        _loaded(s) & (s["value_reg"] * s["count"] + s["remainder"] == (1 << p["SPAN_W"]) - 1)
                    ),
                ),
            ),
        ),
        CARRY,
        INCREMENT,
        cross(INCREMENT, CARRY, recipe=LINES, leave_out=_cannot_carry),
        Point(
            "rest",
            "what is left below a step",
            (
                Bin(
                    "zero_after_a_carry",
                    LINES,
                    lambda _p, s: (s["rest_reg"] == 0) & was(_steps(s) & _carries(s)),
                ),
                Bin(
                    "largest",
                    LINES,
                    lambda _p, s: (s["rest_reg"] == s["count"] - 1) & (s["count"] > 1) & _steps(s),
                ),
            ),
        ),
        Point(
            "flow",
            "loads, steps and clocks without either",
            (
                Bin("load_beats_step", LINES, lambda _p, s: (s["load"] == 1) & (s["step"] == 1)),
                Bin("step_in_every_clock", LINES, lambda _p, s: lasting(_steps(s))),
                Bin("one_idle_clock", LINES, lambda _p, s: _steps(s) & was(_idle(s)) & was(_steps(s), 2)),
                Bin("long_idle", LINES, lambda _p, s: lasting(_idle(s))),
                Bin("load_after_load", CUTS, lambda _p, s: (s["load"] == 1) & was(s["load"] == 1)),
                Bin(
                    "load_in_a_line",
                    CUTS,
                    lambda _p, s: (s["load"] == 1) & was(_steps(s)) & (s["rest_reg"] != s["remainder"]),
                ),
                Bin(
                    "value_wraps",
                    LONGEST,
                    lambda _p, s: (s["value_reg"] < before(s["value_reg"])) & was(_steps(s)),
                ),
            ),
        ),
    ),
)
