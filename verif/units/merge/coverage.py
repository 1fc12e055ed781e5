"""What must have been seen of the merge: each stream alone and with others, turns, a full output, resets."""

from verif.env.coverage.classes import before, scenario
from verif.env.coverage.flow import LONG
from verif.env.coverage.handshake import Found, handshake, lasting, was
from verif.env.coverage.points import Bin, Coverage, Holds, Point, Samples
from verif.env.unit import Parameters

CHOICES, STALLS, RESETS = map(scenario, ("choices", "stalls", "resets"))


def _all(p: Parameters) -> int:
    return (1 << p["PORTS"]) - 1


def _served(s: Samples, stream: int) -> Found:
    """A transfer of this stream."""
    return (s["in_valid"] & s["in_ready"]) >> stream & 1 == 1


def _moves(s: Samples) -> Found:
    return s["in_valid"] & s["in_ready"] != 0


def _alone(stream: int) -> Holds:
    return lambda _p, s: _served(s, stream) & (s["in_valid"] == 1 << stream)


def _contended(stream: int) -> Holds:
    return lambda _p, s: _served(s, stream) & (s["in_valid"] != 1 << stream)


def _highest(p: Parameters, s: Samples) -> Found:
    return _served(s, p["PORTS"] - 1)


_CONTENDED = "taken while others wait"

COVERAGE = Coverage(
    signals=("rst", "in_valid", "in_ready", "valid_reg", "out_ready", "served_reg"),
    points=(
        Point(
            "alone",
            "a stream that alone has an item",
            tuple(Bin(f"stream_{n}", CHOICES, _alone(n)) for n in range(2)),
        ),
        Point("contended", _CONTENDED, tuple(Bin(f"stream_{n}", CHOICES, _contended(n)) for n in range(2))),
        Point(
            "offers",
            "streams that have an item",
            (
                Bin("none", CHOICES, lambda _p, s: s["in_valid"] == 0),
                Bin("all", CHOICES, lambda p, s: s["in_valid"] == _all(p)),
                Bin(
                    "all_for_long",
                    CHOICES,
                    lambda p, s: lasting((s["in_valid"] == _all(p)) & (p["PORTS"] > 1)),
                ),
                Bin("some", CHOICES, lambda p, s: (s["in_valid"] != 0) & (s["in_valid"] != _all(p))),
            ),
        ),
        Point(
            "turns",
            "who is served, and who was before",
            (
                Bin("higher_after_lower", CHOICES, lambda _p, s: _served(s, 1) & was(_served(s, 0))),
                Bin("lower_after_higher", CHOICES, lambda _p, s: _served(s, 0) & was(_served(s, 1))),
                Bin("same_again_alone", CHOICES, lambda _p, s: _served(s, 0) & was(_served(s, 0))),
                Bin(
                    "new_round",
                    CHOICES,
                    lambda p, s: (s["in_valid"] == _all(p)) & (s["served_reg"] == _all(p)) & _moves(s),
                ),
                Bin(
                    "lower_passed_over",
                    CHOICES,
                    lambda _p, s: _served(s, 1) & (s["in_valid"] & 1 == 1),
                ),
                Bin("highest", CHOICES, _highest),
            ),
        ),
        handshake("in_0", "in_valid", "in_ready", STALLS, leave_out=("starved",)),
        handshake("in_1", "in_valid", "in_ready", STALLS, bit=1, leave_out=("starved",)),
        handshake("out", "valid_reg", "out_ready", STALLS),
        Point(
            "output",
            "the place at the output",
            (
                Bin("filled", CHOICES, lambda _p, s: _moves(s) & (s["valid_reg"] == 0)),
                Bin("replaced", CHOICES, lambda _p, s: _moves(s) & (s["valid_reg"] == 1)),
                Bin(
                    "emptied",
                    CHOICES,
                    lambda _p, s: (s["in_valid"] == 0) & (s["valid_reg"] == 1) & (s["out_ready"] == 1),
                ),
                Bin(
                    "full_and_all_wait",
                    STALLS,
                    lambda p, s: (s["in_valid"] == _all(p)) & (s["in_ready"] == 0),
                ),
                Bin(
                    "turn_kept_over_a_stall",
                    STALLS,
                    lambda _p, s: (
                        _moves(s)
                        & was(lasting((s["in_valid"] != 0) & (s["in_ready"] == 0), LONG))
                        & (before(s["served_reg"]) == s["served_reg"])
                    ),
                ),
            ),
        ),
        Point(
            "reset",
            "what was under way",
            (
                Bin("idle", RESETS, lambda _p, s: (s["rst"] == 1) & (s["valid_reg"] == 0)),
                Bin("item_at_the_output", RESETS, lambda _p, s: (s["rst"] == 1) & (s["valid_reg"] == 1)),
                Bin(
                    "within_a_round",
                    RESETS,
                    lambda p, s: (s["rst"] == 1) & (s["served_reg"] != 0) & (s["served_reg"] != _all(p)),
                ),
                Bin("end_of_a_round", RESETS, lambda p, s: (s["rst"] == 1) & (s["served_reg"] == _all(p))),
            ),
        ),
    ),
)
