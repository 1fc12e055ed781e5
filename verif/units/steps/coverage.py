"""What must have been seen of the steps of a hit: how many and why, places short of each kind, resets."""

from verif.env.coverage.classes import scenario
from verif.env.coverage.handshake import Found, handshake, lasting, was
from verif.env.coverage.points import Bin, Coverage, Holds, Point, Recipe, Samples, cross
from verif.env.unit import Parameters

HITS, SCARCE, RESETS = map(scenario, ("hits", "scarce places", "resets"))
_PLACES = ("direct", "shadow")


def _taken(s: Samples) -> Found:
    return (s["in_valid"] == 1) & (s["in_ready"] == 1)


def _of_hit(hit: int, branching: int) -> Holds:
    return lambda _p, s: _taken(s) & (s["in_hit"] == hit) & (s["in_branching"] == branching)


KIND = Point(
    "kind",
    "what is taken",
    (
        Bin("miss", HITS, lambda _p, s: _taken(s) & (s["in_hit"] == 0)),
        Bin("plain_hit", HITS, _of_hit(1, 0)),
        Bin("branching_hit", HITS, _of_hit(1, 1)),
    ),
)
LIGHTS = Point(
    "lights",
    "of the frame",
    (
        Bin("none", HITS, lambda _p, s: s["lights"] == 0),
        Bin("one", HITS, lambda _p, s: s["lights"] == 1),
        Bin("two", HITS, lambda _p, s: s["lights"] == 2),
        Bin("most", HITS, lambda p, s: s["lights"] == (1 << p["LIGHT_W"]) - 1),
    ),
)


def _short(kind: str, other: str) -> Holds:
    """A step waits for a place of one kind alone."""

    def holds(_p: Parameters, s: Samples) -> Found:
        rooms = (s[f"{kind}_room_reg"] == 0) & (s[f"{other}_room_reg"] > 0)
        return (s["valid_reg"] == 1) & rooms

    return holds


def _room(kind: str, recipe: Recipe) -> Point:
    """Places of one kind that are free, and how they come back."""
    room = f"{kind}_room_reg"
    return Point(
        f"{kind}_room",
        f"places free for {kind} terms or rays, and how they come back",
        (
            Bin("all", recipe, lambda p, s: s[room] == p["ROOM"]),
            Bin("last_one_taken", recipe, lambda _p, s: (s[room] == 1) & (s["out_valid"] == 1)),
            Bin("none", recipe, lambda _p, s: s[room] == 0),
            Bin(
                "taken_as_one_comes_back",
                recipe,
                lambda _p, s: (s["out_valid"] == 1) & (s[f"{kind}_back"] == 1),
            ),
            Bin(
                "taken_as_two_come_back",
                recipe,
                lambda _p, s: (s["out_valid"] == 1) & (s[f"{kind}_back"] == 2),
            ),
            Bin("two_come_back_to_none", recipe, lambda _p, s: (s[room] == 0) & (s[f"{kind}_back"] == 2)),
        ),
    )


COVERAGE = Coverage(
    signals=(
        "rst",
        "lights",
        "in_valid",
        "in_ready",
        "in_hit",
        "in_branching",
        "valid_reg",
        "out_valid",
        "out_step",
        "out_more",
        "direct_back",
        "shadow_back",
        "direct_room_reg",
        "shadow_room_reg",
    ),
    points=(
        cross(KIND, LIGHTS, name="hits", recipe=HITS),
        Point(
            "step",
            "of a hit",
            (
                Bin("only", HITS, lambda _p, s: (s["out_valid"] == 1) & (s["out_more"] == 0)),
                Bin(
                    "first",
                    HITS,
                    lambda _p, s: (s["out_valid"] == 1) & (s["out_more"] > 0) & (s["out_step"] == 0),
                ),
                Bin(
                    "middle",
                    HITS,
                    lambda _p, s: (
                        (s["out_valid"] == 1) & (s["out_step"] > 0) & (s["out_step"] < s["out_more"])
                    ),
                ),
                Bin(
                    "last",
                    HITS,
                    lambda _p, s: (
                        (s["out_valid"] == 1) & (s["out_more"] > 0) & (s["out_step"] == s["out_more"])
                    ),
                ),
                Bin("in_every_clock", HITS, lambda _p, s: lasting(s["out_valid"] == 1)),
                Bin(
                    "behind_a_wait",
                    SCARCE,
                    lambda _p, s: (
                        (s["out_valid"] == 1)
                        & (s["out_step"] > 0)
                        & was((s["out_valid"] == 0) & (s["valid_reg"] == 1))
                    ),
                ),
            ),
        ),
        handshake("in", "in_valid", "in_ready", HITS, leave_out=("stalled_long",)),
        Point(
            "short",
            "a step waits for places",
            (
                Bin("of_direct_terms", SCARCE, _short("direct", "shadow")),
                Bin("of_shadow_rays", SCARCE, _short("shadow", "direct")),
                Bin(
                    "of_both",
                    SCARCE,
                    lambda _p, s: (
                        (s["valid_reg"] == 1) & (s["direct_room_reg"] == 0) & (s["shadow_room_reg"] == 0)
                    ),
                ),
                Bin("for_long", SCARCE, lambda _p, s: lasting((s["valid_reg"] == 1) & (s["out_valid"] == 0))),
                Bin(
                    "while_a_hit_is_offered",
                    SCARCE,
                    lambda _p, s: (s["valid_reg"] == 1) & (s["out_valid"] == 0) & (s["in_valid"] == 1),
                ),
            ),
        ),
        *(_room(kind, SCARCE) for kind in _PLACES),
        Point(
            "reset",
            "what was under way",
            (
                Bin(
                    "nothing",
                    RESETS,
                    lambda p, s: (
                        (s["rst"] == 1) & (s["valid_reg"] == 0) & (s["direct_room_reg"] == p["ROOM"])
                    ),
                ),
                Bin(
                    "places_owed",
                    RESETS,
                    lambda p, s: (s["rst"] == 1) & (s["valid_reg"] == 0) & (s["direct_room_reg"] < p["ROOM"]),
                ),
                Bin(
                    "first_step",
                    RESETS,
                    lambda _p, s: (s["rst"] == 1) & (s["valid_reg"] == 1) & (s["out_step"] == 0),
                ),
                Bin(
                    "later_step",
                    RESETS,
                    lambda _p, s: (s["rst"] == 1) & (s["valid_reg"] == 1) & (s["out_step"] > 0),
                ),
                Bin(
                    "no_place",
                    RESETS,
                    lambda _p, s: (s["rst"] == 1) & (s["valid_reg"] == 1) & (s["direct_room_reg"] == 0),
                ),
            ),
        ),
    ),
)
