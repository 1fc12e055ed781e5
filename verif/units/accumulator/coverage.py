"""What must have been seen of the sums of pixels: work and terms that meet, saturation, clearing, resets."""

from models.formats import Knobs, formats
from verif.env.coverage.classes import before, scenario
from verif.env.coverage.handshake import Found, lasting, was
from verif.env.coverage.points import Bin, Coverage, Holds, Point, Samples
from verif.env.unit import Parameters

PIXELS, MEETINGS, BRIGHT, RESETS = map(scenario, ("pixels", "meetings", "bright terms", "resets"))

_MOST = formats(Knobs()).shade.max
_LANES = tuple(f"g_lane[{lane}].wide" for lane in range(3))
_MANY = 6


def _term(s: Samples) -> Found:
    return s["term_valid"] == 1


def _ends(s: Samples) -> Found:
    return _term(s) & (s["complete"] == 1)


def _more(s: Samples) -> Found:
    return s["more_valid"] == 1


def _meet(s: Samples) -> Found:
    """Work and a term of one slot in one clock."""
    return _more(s) & _term(s) & (s["more_slot"] == s["term_slot"])


def _again(s: Samples, clocks: int) -> Found:
    """The term's slot is that of a term so many clocks ago, and of none between."""
    found = _term(s) & was(_term(s), clocks) & (before(s["term_slot"], clocks) == s["term_slot"])
    for nearer in range(1, clocks):
        found &= ~was(_term(s), nearer) | (before(s["term_slot"], nearer) != s["term_slot"])
    return found


def _saturates(lane: str) -> Holds:
    return lambda _p, s: (s["add_reg"] == 1) & (s[lane] > _MOST)


def _most_work(p: Parameters) -> int:
    return (1 << p["COUNT_W"]) - 1


COVERAGE = Coverage(
    signals=(
        "rst",
        "clear_reg",
        "more_valid",
        "more_slot",
        "more_count",
        "term_valid",
        "term_slot",
        "complete",
        "add_reg",
        "valid_reg",
        *_LANES,
    ),
    points=(
        Point(
            "work",
            "that is announced",
            (
                Bin("none", PIXELS, lambda _p, s: _more(s) & (s["more_count"] == 0)),
                Bin("one", PIXELS, lambda _p, s: _more(s) & (s["more_count"] == 1)),
                Bin(
                    "some",
                    PIXELS,
                    lambda p, s: _more(s) & (s["more_count"] > 1) & (s["more_count"] < _most_work(p)),
                ),
                Bin("most", PIXELS, lambda p, s: _more(s) & (s["more_count"] == _most_work(p))),
                Bin(
                    "twice_for_one_slot",
                    MEETINGS,
                    lambda _p, s: _more(s) & was(_more(s)) & (s["more_slot"] == before(s["more_slot"])),
                ),
            ),
        ),
        Point(
            "term",
            "what becomes of a term",
            (
                Bin("adds", PIXELS, lambda _p, s: _term(s) & ~_ends(s)),
                Bin("completes", PIXELS, lambda _p, s: _ends(s)),
                Bin("many_add", PIXELS, lambda _p, s: lasting(_term(s) & ~_ends(s), _MANY)),
                Bin("completes_in_every_clock", PIXELS, lambda _p, s: lasting(_ends(s))),
                Bin(
                    "completes_one_slot_in_every_clock",
                    MEETINGS,
                    lambda _p, s: lasting(_ends(s) & (s["term_slot"] == before(s["term_slot"]))),
                ),
                Bin("first_slot", PIXELS, lambda _p, s: _ends(s) & (s["term_slot"] == 0)),
                Bin("last_slot", PIXELS, lambda p, s: _ends(s) & (s["term_slot"] == p["SLOTS"] - 1)),
            ),
        ),
        Point(
            "meeting",
            "work and a term in one clock",
            (
                Bin("of_one_slot", MEETINGS, lambda _p, s: _meet(s) & ~_ends(s)),
                Bin("as_the_pixel_is_complete", MEETINGS, lambda _p, s: _meet(s) & _ends(s)),
                Bin("of_two_slots", MEETINGS, lambda _p, s: _more(s) & _term(s) & ~_meet(s)),
                Bin(
                    "term_behind_work",
                    MEETINGS,
                    lambda _p, s: _term(s) & was(_more(s)) & (before(s["more_slot"]) == s["term_slot"]),
                ),
                Bin(
                    "work_behind_term",
                    MEETINGS,
                    lambda _p, s: _more(s) & was(_term(s)) & (before(s["term_slot"]) == s["more_slot"]),
                ),
            ),
        ),
        Point(
            "again",
            "terms of one slot, one behind the other",
            (
                Bin("next_clock", MEETINGS, lambda _p, s: _again(s, 1) & ~was(_ends(s))),
                Bin("next_clock_behind_the_last", MEETINGS, lambda _p, s: _again(s, 1) & was(_ends(s))),
                Bin("two_clocks", MEETINGS, lambda _p, s: _again(s, 2) & ~was(_ends(s), 2)),
                Bin("two_clocks_behind_the_last", MEETINGS, lambda _p, s: _again(s, 2) & was(_ends(s), 2)),
                Bin("three_clocks", MEETINGS, lambda _p, s: _again(s, 3)),
                Bin("other_slot_between", MEETINGS, lambda _p, s: _again(s, 2) & was(_term(s))),
                Bin("idle_between", MEETINGS, lambda _p, s: _again(s, 2) & ~was(_term(s))),
            ),
        ),
        Point(
            "saturates",
            "a channel of a sum",
            tuple(Bin(f"channel_{lane}", BRIGHT, _saturates(name)) for lane, name in enumerate(_LANES)),
        ),
        Point(
            "sum",
            "the lowest channel",
            (
                Bin("zero", BRIGHT, lambda _p, s: (s["add_reg"] == 1) & (s[_LANES[0]] == 0)),
                Bin("just_most", BRIGHT, lambda _p, s: (s["add_reg"] == 1) & (s[_LANES[0]] == _MOST)),
                Bin(
                    "just_above_most", BRIGHT, lambda _p, s: (s["add_reg"] == 1) & (s[_LANES[0]] == _MOST + 1)
                ),
                Bin(
                    "saturates_twice",
                    BRIGHT,
                    lambda _p, s: (
                        (s["add_reg"] == 1)
                        & (s[_LANES[0]] > _MOST)
                        & was((s["add_reg"] == 1) & (s[_LANES[0]] > _MOST))
                        & was(_again(s, 1))
                    ),
                ),
                Bin(
                    "saturates_as_it_is_complete",
                    BRIGHT,
                    lambda _p, s: was(_ends(s)) & (s[_LANES[0]] > _MOST),
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
                    lambda p, s: (
                        (s["rst"] == 1)
                        & (s["clear_reg"] == p["SLOTS"])
                        & (s["add_reg"] == 0)
                        & (s["valid_reg"] == 0)
                    ),
                ),
                Bin(
                    "clearing",
                    RESETS,
                    lambda p, s: (s["rst"] == 1) & (s["clear_reg"] > 0) & (s["clear_reg"] < p["SLOTS"]),
                ),
                Bin(
                    "last_clock_of_clearing",
                    RESETS,
                    lambda p, s: (s["rst"] == 1) & (s["clear_reg"] == p["SLOTS"] - 1),
                ),
                Bin("a_term", RESETS, lambda _p, s: (s["rst"] == 1) & (s["add_reg"] == 1)),
                Bin("a_pixel", RESETS, lambda _p, s: (s["rst"] == 1) & (s["valid_reg"] == 1)),
            ),
        ),
    ),
)
