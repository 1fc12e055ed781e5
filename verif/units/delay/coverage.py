"""What must have been seen of the delay lines: words of each kind, the ring's wraps, resets within it."""

import numpy as np

from verif.env.coverage.classes import before, scenario
from verif.env.coverage.handshake import Found, lasting, was
from verif.env.coverage.points import Bin, Coverage, Point, Samples
from verif.env.unit import Parameters

WORDS, RESETS = scenario("words"), scenario("resets")

_RING = "g_depth[11].u_delay.g_ring.pointer_reg"
"""Of the line of depth 11, which both builds have."""
_LAST = 9


def _runs(s: Samples) -> Found:
    return (s["rst"] == 0) & (before(s["rst"]) == 0)


def _changes(s: Samples) -> Found:
    return np.asarray((s["in"] != before(s["in"])) & (before(s["in"]) >= 0))


def _all_ones(p: Parameters) -> int:
    return (1 << p["WIDTH"]) - 1


COVERAGE = Coverage(
    signals=("rst", "in", _RING),
    points=(
        Point(
            "word",
            "what goes in",
            (
                Bin("zero", WORDS, lambda _p, s: s["in"] == 0),
                Bin("all_ones", WORDS, lambda p, s: s["in"] == _all_ones(p)),
                Bin("changes", WORDS, lambda _p, s: _changes(s)),
                Bin(
                    "all_bits_change",
                    WORDS,
                    lambda p, s: _changes(s) & (s["in"] ^ before(s["in"]) == _all_ones(p)),
                ),
                Bin("stays_for_long", WORDS, lambda _p, s: lasting(~_changes(s))),
                Bin("changes_for_long", WORDS, lambda _p, s: lasting(_changes(s))),
            ),
        ),
        Point(
            "ring",
            "the pointer of a line of depth 11",
            (
                Bin("first", WORDS, lambda _p, s: (s[_RING] == 0) & _runs(s)),
                Bin("last", WORDS, lambda _p, s: s[_RING] == _LAST),
                Bin("wraps", WORDS, lambda _p, s: (s[_RING] == 0) & (before(s[_RING]) == _LAST) & _runs(s)),
                Bin(
                    "wraps_twice",
                    WORDS,
                    lambda _p, s: was((s[_RING] == _LAST) & _runs(s), _LAST + 1) & (s[_RING] == _LAST),
                ),
            ),
        ),
        Point(
            "reset",
            "where the pointer was",
            (
                Bin("first", RESETS, lambda _p, s: (s["rst"] == 1) & (s[_RING] == 0)),
                Bin("within", RESETS, lambda _p, s: (s["rst"] == 1) & (s[_RING] > 0) & (s[_RING] < _LAST)),
                Bin("last", RESETS, lambda _p, s: (s["rst"] == 1) & (s[_RING] == _LAST)),
            ),
        ),
    ),
)
