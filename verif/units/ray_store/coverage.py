"""What must have been seen of the store of rays: levels and moves of each depth, choices, waits, resets."""

from collections.abc import Callable

from models.fixed import Raw
from verif.env.coverage.classes import before, scenario
from verif.env.coverage.handshake import Found, handshake, lasting, was
from verif.env.coverage.points import Bin, Coverage, Holds, Point, Recipe, Samples
from verif.env.unit import Parameters

FRAMES, FILLS, STALLS, RESETS = map(scenario, ("frames", "full levels", "stalls", "resets"))

DEPTHS = (2, 3, 4, 5)
"""That are watched: all of the core's; a build of fewer has no others, one of more has the same."""


def free(depth: int) -> str:
    """The signal of the places that are neither taken nor reserved."""
    return f"g_level[{depth}].free_reg"


def _goes(s: Samples, depth: int) -> Found:
    return s["goes"] >> (depth - 1) & 1 == 1


def _stored(s: Samples, depth: int) -> Found:
    return s["holds"] >> (depth - 2) & 1 == 1


def _comes(s: Samples, depth: int) -> Found:
    return (s["child_valid"] == 1) & (s["child_depth"] == depth)


def _settles(s: Samples, depth: int, places: int) -> Found:
    return (s["settle_valid"] == 1) & (s["settle_depth"] == depth) & (s["settle_count"] == places)


def _short(s: Samples, depth: int) -> Found:
    """A ray of this depth is there and finds no places for its children."""
    there = _stored(s, depth) if depth > 1 else s["primary_valid"] == 1
    below = s[free(depth + 1)]
    return there & (s["max_depth"] > depth) & (below >= 0) & (below < s["branches"])


def _by_depth(
    name: str, doc: str, recipe: Recipe, case: Callable[[int], Holds], depths: tuple[int, ...] = DEPTHS
) -> Point:
    return Point(name, doc, tuple(Bin(f"depth_{depth}", recipe, case(depth)) for depth in depths))


def _of(case: Callable[[Samples, int], Found]) -> Callable[[int], Holds]:
    return lambda depth: lambda _p, s: case(s, depth)


def _all_free(p: Parameters, s: Samples, depth: int) -> Found:
    return s[free(depth)] == p["LEVEL_ROOM"]


def _again_free(depth: int) -> Holds:
    """All places are free, as they were not a clock ago."""
    return lambda p, s: (
        _all_free(p, s, depth) & (before(s[free(depth)]) < p["LEVEL_ROOM"]) & was(s["rst"] == 0)
    )


def _deeper_waits(s: Samples) -> Found:
    """A stored ray waits for places while a less deep one goes, whose children have theirs."""
    found = s["goes"] < 0
    for depth in DEPTHS[1:-1]:
        for less in range(1, depth):
            found |= _short(s, depth) & _goes(s, less)
    return found


def _primary_waits(s: Samples) -> Found:
    return (s["primary_valid"] == 1) & (s["primary_ready"] == 0)


def _waiting(s: Samples) -> Raw:
    """Rays at the output."""
    return s["read_valid_reg"] + s["skid_valid_reg"]


def _outstanding(p: Parameters, s: Samples) -> Found:
    """Places of depth 2 that are reserved, with nothing stored anywhere."""
    return (s["idle"] == 1) & (s[free(2)] < p["LEVEL_ROOM"])


def _frame(max_depth: int, branches: int) -> Holds:
    return lambda _p, s: (s["max_depth"] == max_depth) & (s["branches"] == branches) & _goes(s, 1)


COVERAGE = Coverage(
    signals=(
        "rst",
        "max_depth",
        "branches",
        "primary_valid",
        "primary_ready",
        "child_valid",
        "child_depth",
        "settle_valid",
        "settle_depth",
        "settle_count",
        "ray_valid",
        "ray_ready",
        "idle",
        "goes",
        "holds",
        "read_valid_reg",
        "skid_valid_reg",
        *map(free, DEPTHS),
    ),
    points=(
        Point(
            "frame",
            "a primary ray goes, of a frame of this depth and so many children a ray",
            tuple(
                Bin(f"depth_{depth}_branches_{branches}", FRAMES, _frame(depth, branches))
                for depth in (1, 2, 5)
                for branches in range(3)
            ),
        ),
        _by_depth("goes", "a ray of this depth is chosen", FRAMES, _of(_goes), (1, *DEPTHS)),
        _by_depth("comes", "a child of this depth", FRAMES, _of(_comes)),
        _by_depth(
            "settles_one",
            "a place of this depth stays empty",
            FRAMES,
            _of(lambda s, depth: _settles(s, depth, 1)),
        ),
        _by_depth(
            "settles_two",
            "two places of this depth stay empty",
            FRAMES,
            _of(lambda s, depth: _settles(s, depth, 2)),
        ),
        _by_depth(
            "no_place",
            "all places of this depth are taken or reserved",
            FILLS,
            _of(lambda s, depth: s[free(depth)] == 0),
        ),
        _by_depth(
            "all_free_again",
            "the last place of this depth is given back",
            FRAMES,
            lambda depth: _again_free(depth),
        ),
        _by_depth(
            "waits_for_places",
            "a ray of this depth waits for those of its children",
            FILLS,
            _of(_short),
            (1, *DEPTHS[:-1]),
        ),
        Point(
            "choice",
            "who goes first",
            (
                Bin("deeper_before_primary", FRAMES, lambda _p, s: _primary_waits(s) & (s["goes"] > 1)),
                Bin("deeper_before_stored", FRAMES, lambda _p, s: _goes(s, 3) & _stored(s, 2)),
                Bin("deeper_waits_for_places", FILLS, lambda _p, s: _deeper_waits(s)),
                Bin("one_in_every_clock", FRAMES, lambda _p, s: lasting(s["goes"] > 0)),
                Bin("child_goes_at_once", FRAMES, lambda _p, s: _goes(s, 2) & was(_comes(s, 2))),
            ),
        ),
        Point(
            "together",
            "answers of one clock",
            (
                Bin(
                    "child_and_settle_of_one_depth",
                    FRAMES,
                    lambda _p, s: (
                        (s["child_valid"] == 1)
                        & (s["settle_valid"] == 1)
                        & (s["child_depth"] == s["settle_depth"])
                    ),
                ),
                Bin(
                    "child_and_settle_of_two_depths",
                    FRAMES,
                    lambda _p, s: (
                        (s["child_valid"] == 1)
                        & (s["settle_valid"] == 1)
                        & (s["child_depth"] != s["settle_depth"])
                    ),
                ),
                Bin(
                    "settle_of_no_place",
                    FRAMES,
                    lambda _p, s: (s["settle_valid"] == 1) & (s["settle_count"] == 0),
                ),
                Bin("child_as_one_of_its_depth_goes", FRAMES, lambda _p, s: _comes(s, 2) & _goes(s, 2)),
                Bin(
                    "settle_as_one_reserves",
                    FRAMES,
                    lambda _p, s: _settles(s, 2, 1) & _goes(s, 1) & (s["branches"] > 0),
                ),
            ),
        ),
        handshake("primary", "primary_valid", "primary_ready", STALLS),
        handshake("ray", "ray_valid", "ray_ready", STALLS),
        Point(
            "output",
            "rays that wait at the output",
            (
                Bin("one", STALLS, lambda _p, s: _waiting(s) == 1),
                Bin("two", STALLS, lambda _p, s: _waiting(s) == 2),
                Bin("two_and_primary_waits", STALLS, lambda _p, s: (_waiting(s) == 2) & _primary_waits(s)),
                Bin(
                    "second_behind_a_stall",
                    STALLS,
                    lambda _p, s: (_waiting(s) == 1) & was((_waiting(s) == 2) & (s["ray_ready"] == 1)),
                ),
                Bin("idle_with_places_reserved", STALLS, lambda p, s: _outstanding(p, s)),
            ),
        ),
        Point(
            "reset",
            "what was under way",
            (
                Bin("nothing", RESETS, lambda p, s: (s["rst"] == 1) & (s["idle"] == 1) & _all_free(p, s, 2)),
                Bin("places_reserved", RESETS, lambda p, s: (s["rst"] == 1) & _outstanding(p, s)),
                Bin("rays_stored", RESETS, lambda _p, s: (s["rst"] == 1) & (s["holds"] > 0)),
                Bin("one_ray_at_the_output", RESETS, lambda _p, s: (s["rst"] == 1) & (_waiting(s) == 1)),
                Bin("two_rays_at_the_output", RESETS, lambda _p, s: (s["rst"] == 1) & (_waiting(s) == 2)),
            ),
        ),
    ),
)
