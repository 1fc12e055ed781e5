"""What must have been seen of the children of hits: why each comes or does not, where places stay empty."""

import numpy as np

from models.fixed import Raw
from verif.env.coverage.classes import scenario, told
from verif.env.coverage.handshake import Found
from verif.env.coverage.points import Bin, Coverage, Holds, Point, Samples, cross
from verif.env.unit import Parameters

RAYS, ENDS, RESETS = map(scenario, ("rays", "ends of the table", "resets"))


def _deepest(s: Samples) -> Found:
    return s["depth"] >= s["max_depth"]


def _may(s: Samples) -> Found:
    """A hit whose depth allows children."""
    return (s["hit"] == 1) & ~_deepest(s)


def _transmitted(s: Samples) -> Found:
    return (s["step"] == 1) & (s["branching"] == 1)


def _most(s: Samples) -> Raw:
    return np.asarray(s["child_weights"].max(axis=0))


def _decides(channel: int) -> Holds:
    """A channel's weight alone is enough."""

    def holds(p: Parameters, s: Samples) -> Found:
        enough = s["child_weights"] >= p["MIN_WEIGHT"]
        return np.asarray(_may(s) & enough[channel] & (enough.sum(axis=0) == 1))

    return holds


KIND = Point(
    "kind",
    "of the child that may come",
    (
        Bin("reflected", RAYS, lambda _p, s: _may(s) & (s["step"] == 0)),
        Bin("transmitted", RAYS, lambda _p, s: _may(s) & _transmitted(s)),
    ),
)
WEIGHT = Point(
    "weight",
    "the largest channel of its weight, against the least",
    (
        Bin("none", RAYS, lambda _p, s: _most(s) == 0),
        Bin("just_not", RAYS, lambda p, s: _most(s) == p["MIN_WEIGHT"] - 1),
        Bin("just", RAYS, lambda p, s: _most(s) == p["MIN_WEIGHT"]),
        Bin("above", RAYS, lambda p, s: _most(s) > p["MIN_WEIGHT"]),
    ),
)
FRAME = Point(
    "frame",
    "what its objects do",
    (
        Bin("neither", RAYS, lambda _p, s: (s["reflects"] == 0) & (s["transmits"] == 0)),
        Bin("reflect", RAYS, lambda _p, s: (s["reflects"] == 1) & (s["transmits"] == 0)),
        Bin("transmit", RAYS, lambda _p, s: (s["reflects"] == 0) & (s["transmits"] == 1)),
        Bin("both", RAYS, lambda _p, s: (s["reflects"] == 1) & (s["transmits"] == 1)),
    ),
)
DEPTH = Point(
    "depth",
    "of the ray",
    (
        Bin("first", RAYS, lambda _p, s: (s["depth"] == 1) & ~_deepest(s)),
        Bin("between", RAYS, lambda _p, s: (s["depth"] > 1) & (s["depth"] < s["max_depth"] - 1)),
        Bin("above_the_deepest", RAYS, lambda _p, s: (s["depth"] > 1) & (s["depth"] == s["max_depth"] - 1)),
        Bin("deepest", RAYS, lambda _p, s: _deepest(s) & (s["depth"] > 1)),
        Bin("first_and_deepest", RAYS, lambda _p, s: _deepest(s) & (s["depth"] == 1)),
    ),
)
HIT = Point(
    "hit",
    "what the ray met",
    (Bin("miss", RAYS, lambda _p, s: s["hit"] == 0), Bin("hit", RAYS, lambda _p, s: s["hit"] == 1)),
)

COVERAGE = Coverage(
    (
        FRAME,
        DEPTH,
        cross(KIND, WEIGHT, recipe=RAYS),
        cross(HIT, DEPTH, recipe=RAYS),
        Point(
            "enough",
            "a channel that alone makes a child",
            tuple(Bin(f"channel_{lane}", RAYS, _decides(lane)) for lane in range(3)),
        ),
        Point(
            "step",
            "of a hit",
            (
                Bin("only", RAYS, lambda _p, s: (s["hit"] == 1) & (s["more"] == 0)),
                Bin("later_light", RAYS, lambda _p, s: s["step"] > 1),
                Bin("second_without_glass", RAYS, lambda _p, s: (s["step"] == 1) & (s["branching"] == 0)),
                Bin("more_than_the_lights", RAYS, lambda _p, s: _transmitted(s) & (s["more"] == 1)),
            ),
        ),
        Point(
            "settled",
            "places that stay empty",
            (
                Bin(
                    "none_of_a_child", RAYS, lambda _p, s: (s["settle_valid"] == 0) & (s["child_valid"] == 1)
                ),
                Bin(
                    "none_of_the_deepest",
                    RAYS,
                    lambda _p, s: (
                        (s["settle_valid"] == 0) & _deepest(s) & (s["step"] == 0) & (s["reflects"] == 1)
                    ),
                ),
                Bin(
                    "one_of_the_reflected",
                    RAYS,
                    lambda _p, s: (s["settle_count"] == 1) & (s["step"] == 0) & (s["child_valid"] == 0),
                ),
                Bin(
                    "one_of_the_transmitted", RAYS, lambda _p, s: (s["settle_count"] == 1) & (s["step"] == 1)
                ),
                Bin(
                    "one_beside_a_child",
                    RAYS,
                    lambda _p, s: (s["settle_count"] == 1) & (s["child_valid"] == 1),
                ),
                Bin("two_of_a_hit", RAYS, lambda _p, s: (s["settle_count"] == 2) & (s["hit"] == 1)),
                Bin("two_of_a_miss", RAYS, lambda _p, s: (s["settle_count"] == 2) & (s["hit"] == 0)),
            ),
        ),
        Point(
            "work",
            "that is announced",
            (
                Bin("none", RAYS, lambda _p, s: s["more_count"] == 0),
                Bin("steps", RAYS, lambda _p, s: (s["more_count"] > 0) & (s["child_valid"] == 0)),
                Bin("a_child", RAYS, lambda _p, s: (s["more_count"] == 1) & (s["child_valid"] == 1)),
                Bin("steps_and_a_child", RAYS, lambda _p, s: (s["more_count"] > 1) & (s["child_valid"] == 1)),
                Bin("most", RAYS, lambda p, s: s["more_count"] == (1 << p["LIGHT_W"]) - 1),
            ),
        ),
        Point(
            "turned",
            "the transmitted ray",
            (
                Bin(
                    "entering",
                    RAYS,
                    lambda _p, s: (s["child_valid"] == 1) & _transmitted(s) & (s["leaving"] == 0),
                ),
                Bin(
                    "leaving",
                    RAYS,
                    lambda _p, s: (s["child_valid"] == 1) & _transmitted(s) & (s["leaving"] == 1),
                ),
                Bin(
                    "totally_reflected",
                    RAYS,
                    lambda _p, s: (
                        (s["child_valid"] == 1)
                        & _transmitted(s)
                        & (s["child_direction"] == s["mirrored"]).all(axis=0)
                    ),
                ),
            ),
        ),
        Point(
            "object",
            "that was hit",
            (
                Bin("first", ENDS, lambda _p, s: (s["own"] == 0) & (s["hit"] == 1)),
                Bin("last", ENDS, lambda p, s: (s["own"] == p["OBJECTS"] - 1) & (s["hit"] == 1)),
                Bin("triangle", RAYS, lambda _p, s: (s["child_valid"] == 1) & (s["owned"] == 1)),
                Bin("no_triangle", RAYS, lambda _p, s: (s["child_valid"] == 1) & (s["owned"] == 0)),
            ),
        ),
        told("reset", "what was under way", {"busy": RESETS.name, "idle": RESETS.name}),
    )
)
