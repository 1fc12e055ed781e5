"""What must have been seen of the counters: each event alone and with others, frames, carries, resets."""

import numpy as np

from models.fixed import Raw
from verif.env.coverage.classes import before, scenario
from verif.env.coverage.handshake import Found, was
from verif.env.coverage.points import Bin, Coverage, Holds, Point, Samples
from verif.env.unit import Parameters

EVENTS, LONG_FRAMES, RESETS = map(scenario, ("events", "long frames", "resets"))

_FLAGS = ("busy", "primary", "secondary", "shadow", "at_point", "flat")


def _number(s: Samples) -> Raw:
    """Kinds of events in each clock."""
    happen = np.stack([s[name] != 0 for name in (*_FLAGS, "tested")])
    return np.asarray(happen.sum(axis=0), dtype=np.int64)


def _alone(event: str) -> Holds:
    def holds(_p: Parameters, s: Samples) -> Found:
        return np.asarray((s[event] != 0) & (_number(s) == 1))

    return holds


def _with_frame_start(event: str) -> Holds:
    return lambda _p, s: (s["frame_start"] == 1) & (s[event] != 0)


COVERAGE = Coverage(
    signals=("rst", "frame_start", *_FLAGS, "tested", "cycles", "lights_at_point"),
    points=(
        Point(
            "alone",
            "one event and no other",
            tuple(Bin(name, EVENTS, _alone(name)) for name in (*_FLAGS, "tested")),
        ),
        Point(
            "with_frame_start",
            "events in the clock in which a frame begins",
            tuple(Bin(name, EVENTS, _with_frame_start(name)) for name in (*_FLAGS, "tested")),
        ),
        Point(
            "events",
            "events of one clock",
            (
                Bin("none", EVENTS, lambda _p, s: _number(s) == 0),
                Bin(
                    "all",
                    EVENTS,
                    lambda _p, s: _number(s) == len(_FLAGS) + 1,
                ),
            ),
        ),
        Point(
            "tested",
            "trace units that have tested",
            (
                Bin("none", EVENTS, lambda _p, s: s["tested"] == 0),
                Bin("first", EVENTS, lambda _p, s: s["tested"] == 1),
                Bin("last", EVENTS, lambda p, s: s["tested"] == 1 << p["UNITS"] - 1),
                Bin("all", EVENTS, lambda p, s: s["tested"] == (1 << p["UNITS"]) - 1),
            ),
        ),
        Point(
            "frames",
            "a frame begins",
            (
                Bin("first", EVENTS, lambda _p, s: (s["frame_start"] == 1) & (s["cycles"] == 0)),
                Bin("again", EVENTS, lambda _p, s: (s["frame_start"] == 1) & (s["cycles"] > 0)),
                Bin(
                    "twice_in_a_row",
                    EVENTS,
                    lambda _p, s: (s["frame_start"] == 1) & was(s["frame_start"] == 1),
                ),
                Bin(
                    "keeps_those_since_reset",
                    EVENTS,
                    lambda _p, s: (s["frame_start"] == 1) & (s["lights_at_point"] > 0),
                ),
                Bin(
                    "not_busy",
                    EVENTS,
                    lambda _p, s: (s["cycles"] > 0) & (s["busy"] == 0) & (before(s["busy"]) == 1),
                ),
            ),
        ),
        Point(
            "carries",
            "low bits of a counter wrap",
            (
                Bin(
                    "of_4_bits", LONG_FRAMES, lambda _p, s: (s["cycles"] == 16) & (before(s["cycles"]) == 15)
                ),
                Bin(
                    "of_8_bits",
                    LONG_FRAMES,
                    lambda _p, s: (s["cycles"] == 256) & (before(s["cycles"]) == 255),
                ),
                Bin("of_8_bits_since_reset", LONG_FRAMES, lambda _p, s: s["lights_at_point"] == 256),
            ),
        ),
        Point(
            "reset",
            "what was counted",
            (
                Bin(
                    "nothing",
                    RESETS,
                    lambda _p, s: (s["rst"] == 1) & (s["cycles"] == 0) & (s["lights_at_point"] == 0),
                ),
                Bin("of_a_frame", RESETS, lambda _p, s: (s["rst"] == 1) & (s["cycles"] > 0)),
                Bin("since_reset", RESETS, lambda _p, s: (s["rst"] == 1) & (s["lights_at_point"] > 0)),
            ),
        ),
    ),
)
