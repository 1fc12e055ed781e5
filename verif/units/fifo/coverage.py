"""What must have been seen of the queue: levels, moves at each of them, wraps, waits, resets."""

from models.fixed import Raw
from verif.env.coverage.classes import before, scenario
from verif.env.coverage.handshake import Found, handshake, lasting, was
from verif.env.coverage.points import Bin, Coverage, Holds, Point, Samples, cross
from verif.env.unit import Parameters

FILLS, TRICKLES, STEADY, RESETS = map(scenario, ("fills", "trickles", "steady", "resets"))


def _level(p: Parameters, s: Samples) -> Raw:
    return p["DEPTH"] - s["room_reg"]


def _push(s: Samples) -> Found:
    return (s["in_valid"] == 1) & (s["room_reg"] > 0) & (s["rst"] == 0)


def _pop(s: Samples) -> Found:
    return (s["valid_reg"] == 1) & (s["out_ready"] == 1) & (s["rst"] == 0)


def _wraps(s: Samples, pointer: str) -> Found:
    return (s[pointer] == 0) & (before(s[pointer]) > 0) & (before(s["rst"]) == 0)


LEVEL = Point(
    "level",
    "items held",
    (
        Bin("empty", TRICKLES, lambda p, s: _level(p, s) == 0),
        Bin("one", TRICKLES, lambda p, s: _level(p, s) == 1),
        Bin("some", STEADY, lambda p, s: (_level(p, s) > 1) & (s["room_reg"] > 1)),
        Bin("room_for_one", FILLS, lambda _p, s: s["room_reg"] == 1),
        Bin("full", FILLS, lambda _p, s: s["room_reg"] == 0),
    ),
)

MOVES = Point(
    "moves",
    "what happens in one clock",
    (
        Bin("push", FILLS, lambda _p, s: _push(s) & ~_pop(s)),
        Bin("pop", FILLS, lambda _p, s: _pop(s) & ~_push(s)),
        Bin("both", STEADY, lambda _p, s: _push(s) & _pop(s)),
        Bin("neither", TRICKLES, lambda _p, s: ~_push(s) & ~_pop(s)),
    ),
)


def _impossible(level: str, moves: str) -> bool:
    return (level == "empty" and moves in ("pop", "both")) or (level == "full" and moves in ("push", "both"))


def _on_its_way(s: Samples) -> Found:
    """Held, and not at the output: an item that has just come in."""
    return s["valid_reg"] == 0


def _reset(level: str) -> Bin:
    holds = {found.name: found.holds for found in LEVEL.bins}[level]
    assert holds is not None
    at_level: Holds = holds
    return Bin(level, RESETS, lambda p, s: (s["rst"] == 1) & at_level(p, s))


COVERAGE = Coverage(
    signals=("rst", "in_valid", "out_ready", "room_reg", "valid_reg", "head_reg", "tail_reg"),
    points=(
        LEVEL,
        cross(LEVEL, MOVES, name="moves_at_level", recipe=STEADY, leave_out=_impossible),
        handshake("out", "valid_reg", "out_ready", TRICKLES),
        Point(
            "edges",
            "ways into full and empty, and out of them",
            (
                Bin("refused_while_full", FILLS, lambda _p, s: (s["room_reg"] == 0) & (s["in_valid"] == 1)),
                Bin("full_for_long", FILLS, lambda _p, s: lasting(s["room_reg"] == 0)),
                Bin(
                    "refused_although_one_leaves",
                    STEADY,
                    lambda _p, s: (s["room_reg"] == 0) & (s["in_valid"] == 1) & _pop(s),
                ),
                Bin(
                    "full_again",
                    FILLS,
                    lambda _p, s: (
                        (s["room_reg"] == 0) & was(s["room_reg"] == 0, 2) & (before(s["room_reg"]) == 1)
                    ),
                ),
                Bin(
                    "drained",
                    FILLS,
                    lambda p, s: (_level(p, s) == 0) & was(_pop(s)) & (before(s["rst"]) == 0),
                ),
                Bin("on_its_way_alone", TRICKLES, lambda p, s: (_level(p, s) == 1) & _on_its_way(s)),
            ),
        ),
        Point(
            "wraps",
            "a pointer comes to the first place again",
            (
                Bin("head", FILLS, lambda _p, s: _wraps(s, "head_reg")),
                Bin("tail", FILLS, lambda _p, s: _wraps(s, "tail_reg")),
            ),
        ),
        Point(
            "reset",
            "what was held",
            (
                *map(_reset, ("empty", "one", "some", "full")),
                Bin(
                    "item_on_its_way",
                    RESETS,
                    lambda p, s: (s["rst"] == 1) & (_level(p, s) > 0) & _on_its_way(s),
                ),
            ),
        ),
    ),
)
