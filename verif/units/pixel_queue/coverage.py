"""What must have been seen of the queue of pixels: levels, orders of return, waits, shapes, wraps, resets."""

import numpy as np

from models.fixed import Raw
from verif.env.coverage.classes import before, scenario
from verif.env.coverage.handshake import Found, handshake, lasting, was
from verif.env.coverage.points import Bin, Coverage, Point, Samples
from verif.env.unit import Parameters

SHAPES, FILLS, ORDERS, WAITS, RESETS = map(scenario, ("shapes", "fills", "orders", "waits", "resets"))


def _level(p: Parameters, s: Samples) -> Raw:
    """Slots that are handed out."""
    return np.asarray((s["tail_reg"] - s["head_reg"]) % (2 * p["SLOTS"]))


def _ahead(p: Parameters, s: Samples) -> Raw:
    """Slots that were handed out before that of the pixel that comes back, and are not sent."""
    return np.asarray((s["in_slot"] - s["head_reg"]) % p["SLOTS"])


def _back(s: Samples) -> Found:
    return s["in_valid"] == 1


def _asks(s: Samples) -> Found:
    return s["slot_ready"] == 1


def _leaves(s: Samples) -> Found:
    """The head's pixel went to the output in the clock before."""
    return (
        (s["head_reg"] != before(s["head_reg"]))
        & (before(s["head_reg"]) >= 0)
        & was(s["start"] + s["rst"] == 0)
    )


def _wraps(p: Parameters, s: Samples, pointer: str) -> Found:
    place = s[pointer] % p["SLOTS"]
    return (place == 0) & (before(place) == p["SLOTS"] - 1) & was(s["start"] + s["rst"] == 0)


def _sent(s: Samples) -> Found:
    return (s["valid_reg"] == 1) & (s["out_ready"] == 1)


COVERAGE = Coverage(
    signals=(
        "rst",
        "start",
        "slot_valid",
        "slot_ready",
        "in_valid",
        "in_slot",
        "head_reg",
        "tail_reg",
        "valid_reg",
        "out_ready",
        "out_user",
        "out_last",
        "done",
    ),
    points=(
        Point(
            "level",
            "slots that are handed out",
            (
                Bin("none", SHAPES, lambda p, s: _level(p, s) == 0),
                Bin("one", SHAPES, lambda p, s: _level(p, s) == 1),
                Bin("some", FILLS, lambda p, s: (_level(p, s) > 1) & (_level(p, s) < p["SLOTS"] - 1)),
                Bin("all_but_one", FILLS, lambda p, s: _level(p, s) == p["SLOTS"] - 1),
                Bin("all", FILLS, lambda p, s: _level(p, s) == p["SLOTS"]),
                Bin("all_for_long", FILLS, lambda p, s: lasting(_level(p, s) == p["SLOTS"])),
                Bin(
                    "all_again",
                    FILLS,
                    lambda p, s: (
                        (_level(p, s) == p["SLOTS"])
                        & (before(_level(p, s)) == p["SLOTS"] - 1)
                        & was(_leaves(s))
                    ),
                ),
            ),
        ),
        handshake("slots", "slot_valid", "slot_ready", WAITS, leave_out=("starved",)),
        Point(
            "full",
            "slots are asked for and none is left",
            (
                Bin("refused", FILLS, lambda _p, s: _asks(s) & (s["slot_valid"] == 0)),
                Bin(
                    "served_as_one_is_left",
                    FILLS,
                    lambda _p, s: _asks(s) & (s["slot_valid"] == 1) & was(_asks(s) & (s["slot_valid"] == 0)),
                ),
            ),
        ),
        Point(
            "order",
            "which pixel comes back",
            (
                Bin("oldest", ORDERS, lambda p, s: _back(s) & (_ahead(p, s) == 0) & (_level(p, s) > 1)),
                Bin(
                    "youngest",
                    ORDERS,
                    lambda p, s: _back(s) & (_ahead(p, s) == _level(p, s) - 1) & (_level(p, s) > 1),
                ),
                Bin(
                    "between",
                    ORDERS,
                    lambda p, s: _back(s) & (_ahead(p, s) > 0) & (_ahead(p, s) < _level(p, s) - 1),
                ),
                Bin("only_one", SHAPES, lambda p, s: _back(s) & (_level(p, s) == 1)),
                Bin("many_overtake", ORDERS, lambda p, s: lasting(_back(s) & (_ahead(p, s) > 0), 4)),
                Bin(
                    "oldest_behind_others",
                    ORDERS,
                    lambda p, s: _back(s) & (_ahead(p, s) == 0) & was(_back(s) & (_ahead(p, s) > 0)),
                ),
                Bin("as_a_slot_is_taken", ORDERS, lambda _p, s: _back(s) & _asks(s) & (s["slot_valid"] == 1)),
                Bin("as_one_leaves", ORDERS, lambda _p, s: was(_back(s)) & _leaves(s)),
                Bin(
                    "while_the_output_waits",
                    WAITS,
                    lambda _p, s: _back(s) & (s["valid_reg"] == 1) & (s["out_ready"] == 0),
                ),
            ),
        ),
        handshake("out", "valid_reg", "out_ready", WAITS),
        Point(
            "place",
            "of the pixel that is taken",
            (
                Bin("first", SHAPES, lambda _p, s: _sent(s) & (s["out_user"] == 1)),
                Bin(
                    "within_a_line",
                    SHAPES,
                    lambda _p, s: _sent(s) & (s["out_user"] == 0) & (s["out_last"] == 0),
                ),
                Bin(
                    "end_of_a_line", SHAPES, lambda _p, s: _sent(s) & (s["out_last"] == 1) & (s["done"] == 0)
                ),
                Bin("end_of_the_picture", SHAPES, lambda _p, s: s["done"] == 1),
                Bin("only_one_of_the_picture", SHAPES, lambda _p, s: (s["done"] == 1) & (s["out_user"] == 1)),
                Bin(
                    "first_is_a_line",
                    SHAPES,
                    lambda _p, s: _sent(s) & (s["out_user"] == 1) & (s["out_last"] == 1) & (s["done"] == 0),
                ),
                Bin(
                    "last_waits",
                    WAITS,
                    lambda _p, s: (s["done"] == 1) & was((s["valid_reg"] == 1) & (s["out_ready"] == 0)),
                ),
            ),
        ),
        Point(
            "wraps",
            "a pointer comes to the first slot again",
            (
                Bin("head", FILLS, lambda p, s: _wraps(p, s, "head_reg")),
                Bin("tail", FILLS, lambda p, s: _wraps(p, s, "tail_reg")),
            ),
        ),
        Point(
            "start",
            "a picture begins",
            (
                Bin(
                    "first_slot_again",
                    SHAPES,
                    lambda p, s: (s["start"] == 1) & (s["head_reg"] % p["SLOTS"] == 0) & (s["rst"] == 0),
                ),
                Bin(
                    "in_another_slot",
                    SHAPES,
                    lambda p, s: (s["start"] == 1) & (s["head_reg"] % p["SLOTS"] > 0),
                ),
            ),
        ),
        Point(
            "reset",
            "what was under way",
            (
                Bin(
                    "nothing",
                    RESETS,
                    lambda p, s: (s["rst"] == 1) & (_level(p, s) == 0) & (s["valid_reg"] == 0),
                ),
                Bin(
                    "slots", RESETS, lambda p, s: (s["rst"] == 1) & (_level(p, s) > 0) & (s["valid_reg"] == 0)
                ),
                Bin(
                    "slots_and_the_output",
                    RESETS,
                    lambda p, s: (s["rst"] == 1) & (_level(p, s) > 0) & (s["valid_reg"] == 1),
                ),
                Bin("all_slots", RESETS, lambda p, s: (s["rst"] == 1) & (_level(p, s) == p["SLOTS"])),
            ),
        ),
    ),
)
