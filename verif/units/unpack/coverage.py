"""What must have been seen of the unpacker: bits that wait, words and fields together, ends, resets."""

from verif.env.coverage.classes import scenario
from verif.env.coverage.handshake import Found, handshake, lasting, was
from verif.env.coverage.points import Bin, Coverage, Point, Samples

FRAMES, WAITS, RESETS = map(scenario, ("frames", "waits", "resets"))

_WORD, _BUFFER = 32, 64


def _push(s: Samples) -> Found:
    return (s["in_valid"] == 1) & (s["in_ready"] == 1)


def _takes(s: Samples) -> Found:
    return s["field_take"] == 1


def _there(s: Samples) -> Found:
    return s["count_reg"] >= s["field_width"]


COVERAGE = Coverage(
    signals=(
        "rst",
        "in_valid",
        "in_ready",
        "in_last",
        "field_width",
        "field_take",
        "count_reg",
        "ended_reg",
        "flush",
    ),
    points=(
        Point(
            "bits",
            "that wait",
            (
                Bin("none", FRAMES, lambda _p, s: s["count_reg"] == 0),
                Bin("some", FRAMES, lambda _p, s: (s["count_reg"] > 0) & (s["count_reg"] < _WORD)),
                Bin("a_word", FRAMES, lambda _p, s: s["count_reg"] == _WORD),
                Bin("more", FRAMES, lambda _p, s: (s["count_reg"] > _WORD) & (s["count_reg"] < _BUFFER)),
                Bin("two_words", WAITS, lambda _p, s: s["count_reg"] == _BUFFER),
            ),
        ),
        Point(
            "width",
            "of a field that is taken",
            (
                Bin("one", FRAMES, lambda _p, s: _takes(s) & (s["field_width"] == 1)),
                Bin(
                    "some",
                    FRAMES,
                    lambda p, s: _takes(s) & (s["field_width"] > 1) & (s["field_width"] < p["FIELD_W"]),
                ),
                Bin("widest", FRAMES, lambda p, s: _takes(s) & (s["field_width"] == p["FIELD_W"])),
                Bin(
                    "all_that_is_there",
                    FRAMES,
                    lambda _p, s: _takes(s) & (s["field_width"] == s["count_reg"]),
                ),
                Bin("just_too_wide", FRAMES, lambda _p, s: s["field_width"] == s["count_reg"] + 1),
            ),
        ),
        Point(
            "moves",
            "in one clock",
            (
                Bin("word", FRAMES, lambda _p, s: _push(s) & ~_takes(s)),
                Bin("field", FRAMES, lambda _p, s: _takes(s) & ~_push(s)),
                Bin("both", FRAMES, lambda _p, s: _takes(s) & _push(s)),
                Bin(
                    "word_fits_because_of_the_field",
                    FRAMES,
                    lambda _p, s: _push(s) & _takes(s) & (s["count_reg"] > _WORD),
                ),
                Bin(
                    "word_just_fits",
                    FRAMES,
                    lambda _p, s: _push(s) & _takes(s) & (s["count_reg"] - s["field_width"] == _WORD),
                ),
                Bin("field_in_every_clock", FRAMES, lambda _p, s: lasting(_takes(s))),
            ),
        ),
        handshake("words", "in_valid", "in_ready", WAITS),
        Point(
            "reader",
            "that waits, or is waited for",
            (
                Bin("waits_for_a_word", WAITS, lambda _p, s: ~_there(s) & (s["ended_reg"] == 0)),
                Bin("waits_for_long", WAITS, lambda _p, s: lasting(~_there(s) & (s["ended_reg"] == 0))),
                Bin("does_not_take", WAITS, lambda _p, s: lasting(_there(s) & ~_takes(s))),
            ),
        ),
        Point(
            "end",
            "of a frame",
            (
                Bin("last_word", FRAMES, lambda _p, s: _push(s) & (s["in_last"] == 1)),
                Bin(
                    "last_word_with_a_field", FRAMES, lambda _p, s: _push(s) & (s["in_last"] == 1) & _takes(s)
                ),
                Bin("fields_behind_it", FRAMES, lambda _p, s: (s["ended_reg"] == 1) & _takes(s)),
                Bin("lacking", FRAMES, lambda _p, s: (s["ended_reg"] == 1) & ~_there(s)),
                Bin(
                    "lacking_one_bit",
                    FRAMES,
                    lambda _p, s: (s["ended_reg"] == 1) & (s["field_width"] == s["count_reg"] + 1),
                ),
                Bin(
                    "just_enough",
                    FRAMES,
                    lambda _p, s: (s["ended_reg"] == 1) & (s["field_width"] == s["count_reg"]),
                ),
                Bin("surplus", FRAMES, lambda _p, s: (s["ended_reg"] == 1) & (s["count_reg"] >= _WORD)),
                Bin("surplus_just", FRAMES, lambda _p, s: (s["ended_reg"] == 1) & (s["count_reg"] == _WORD)),
                Bin(
                    "surplus_just_not",
                    FRAMES,
                    lambda _p, s: (s["ended_reg"] == 1) & (s["count_reg"] == _WORD - 1),
                ),
                Bin("flushed_with_bits_left", FRAMES, lambda _p, s: (s["flush"] == 1) & (s["count_reg"] > 0)),
                Bin("flushed_without", FRAMES, lambda _p, s: (s["flush"] == 1) & (s["count_reg"] == 0)),
                Bin("word_behind_the_flush", FRAMES, lambda _p, s: _push(s) & was(s["flush"] == 1, 2)),
            ),
        ),
        Point(
            "reset",
            "what was there",
            (
                Bin("nothing", RESETS, lambda _p, s: (s["rst"] == 1) & (s["count_reg"] == 0)),
                Bin(
                    "bits",
                    RESETS,
                    lambda _p, s: (s["rst"] == 1) & (s["count_reg"] > 0) & (s["ended_reg"] == 0),
                ),
                Bin("end_of_a_frame", RESETS, lambda _p, s: (s["rst"] == 1) & (s["ended_reg"] == 1)),
            ),
        ),
    ),
)
