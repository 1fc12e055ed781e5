"""What must have been seen of the ray generator: shapes, places in a picture, slots, signs, resets."""

from verif.env.coverage.classes import scenario
from verif.env.coverage.handshake import Found, handshake, was
from verif.env.coverage.points import Bin, Coverage, Holds, Point, Samples
from verif.env.unit import Parameters

SHAPES, LINES, WAITS, RESETS = map(scenario, ("shapes", "longest lines", "waits", "resets"))


def _cast(s: Samples) -> Found:
    return (s["slot_ready"] == 1) & (s["slot_valid"] == 1)


def _starts(s: Samples) -> Found:
    return (s["start"] == 1) & (s["rst"] == 0)


def _line_end(s: Samples) -> Found:
    return s["x_reg"] == s["width"] - 1


def _last_line(s: Samples) -> Found:
    return s["y_reg"] == s["height"] - 1


def _largest(p: Parameters) -> int:
    return (1 << p["SIZE_W"]) - 1


def _signs(name: str) -> Point:
    def case(lane: int, negative: int) -> Holds:
        return lambda _p, s: _cast(s) & (s[name] >> lane & 1 == negative)

    bins = tuple(
        Bin(f"{axis}_{'negative' if negative else 'positive'}", SHAPES, case(2 - place, negative))
        for place, axis in enumerate("xyz")
        for negative in (0, 1)
    )
    return Point(name, "signs of the span's components", bins)


COVERAGE = Coverage(
    signals=(
        "rst",
        "start",
        "slot_valid",
        "slot_ready",
        "slot",
        "out_valid",
        "width",
        "height",
        "x_reg",
        "y_reg",
        "column_negative",
        "row_negative",
    ),
    points=(
        Point(
            "shape",
            "of the picture",
            (
                Bin("one_pixel", SHAPES, lambda _p, s: _starts(s) & (s["width"] == 1) & (s["height"] == 1)),
                Bin("one_line", SHAPES, lambda _p, s: _starts(s) & (s["width"] > 1) & (s["height"] == 1)),
                Bin("one_column", SHAPES, lambda _p, s: _starts(s) & (s["width"] == 1) & (s["height"] > 1)),
                Bin("lines", SHAPES, lambda _p, s: _starts(s) & (s["width"] > 1) & (s["height"] > 1)),
                Bin("widest", LINES, lambda p, s: _starts(s) & (s["width"] == _largest(p))),
                Bin("highest", LINES, lambda p, s: _starts(s) & (s["height"] == _largest(p))),
            ),
        ),
        Point(
            "place",
            "of a ray that is cast",
            (
                Bin("first", SHAPES, lambda _p, s: _cast(s) & (s["x_reg"] == 0) & (s["y_reg"] == 0)),
                Bin("within_a_line", SHAPES, lambda _p, s: _cast(s) & (s["x_reg"] > 0) & ~_line_end(s)),
                Bin(
                    "end_of_a_line",
                    SHAPES,
                    lambda _p, s: _cast(s) & _line_end(s) & ~_last_line(s) & (s["x_reg"] > 0),
                ),
                Bin("begin_of_a_line", SHAPES, lambda _p, s: _cast(s) & (s["x_reg"] == 0) & (s["y_reg"] > 0)),
                Bin(
                    "begin_and_end_of_a_line",
                    SHAPES,
                    lambda _p, s: _cast(s) & (s["x_reg"] == 0) & _line_end(s) & ~_last_line(s),
                ),
                Bin("last", SHAPES, lambda _p, s: _cast(s) & _line_end(s) & _last_line(s)),
                Bin("last_of_the_widest", LINES, lambda p, s: _cast(s) & (s["x_reg"] == _largest(p) - 1)),
                Bin("last_of_the_highest", LINES, lambda p, s: _cast(s) & (s["y_reg"] == _largest(p) - 1)),
            ),
        ),
        handshake("slots", "slot_valid", "slot_ready", WAITS, leave_out=("stalled",)),
        Point(
            "line",
            "its first ray",
            (
                Bin(
                    "at_once",
                    SHAPES,
                    lambda _p, s: _cast(s) & (s["x_reg"] == 0) & (s["y_reg"] > 0) & was(_cast(s)),
                ),
                Bin(
                    "behind_a_wait",
                    WAITS,
                    lambda _p, s: _cast(s) & (s["x_reg"] == 0) & (s["y_reg"] > 0) & ~was(_cast(s)),
                ),
            ),
        ),
        Point(
            "slot",
            "of a ray",
            (
                Bin("first", SHAPES, lambda _p, s: _cast(s) & (s["slot"] == 0)),
                Bin("last", SHAPES, lambda p, s: _cast(s) & (s["slot"] == (1 << p["SLOT_W"]) - 1)),
            ),
        ),
        _signs("column_negative"),
        _signs("row_negative"),
        Point(
            "start",
            "of a picture",
            (
                Bin("behind_another", SHAPES, lambda _p, s: _starts(s) & (s["y_reg"] > 0)),
                Bin("slot_waits_for_it", WAITS, lambda _p, s: _starts(s) & was(s["slot_valid"] == 1)),
            ),
        ),
        Point(
            "reset",
            "what was under way",
            (
                Bin(
                    "nothing",
                    RESETS,
                    lambda _p, s: (s["rst"] == 1) & (s["slot_ready"] == 0) & (s["out_valid"] == 0),
                ),
                Bin(
                    "first_pixel",
                    RESETS,
                    lambda _p, s: (
                        (s["rst"] == 1) & (s["slot_ready"] == 1) & (s["x_reg"] == 0) & (s["y_reg"] == 0)
                    ),
                ),
                Bin(
                    "within_a_line",
                    RESETS,
                    lambda _p, s: (s["rst"] == 1) & (s["slot_ready"] == 1) & (s["x_reg"] > 0),
                ),
                Bin(
                    "begin_of_a_line",
                    RESETS,
                    lambda _p, s: (
                        (s["rst"] == 1) & (s["slot_ready"] == 1) & (s["x_reg"] == 0) & (s["y_reg"] > 0)
                    ),
                ),
                Bin("a_ray", RESETS, lambda _p, s: (s["rst"] == 1) & (s["out_valid"] == 1)),
                Bin(
                    "last_ray",
                    RESETS,
                    lambda _p, s: (s["rst"] == 1) & (s["out_valid"] == 1) & (s["slot_ready"] == 0),
                ),
            ),
        ),
    ),
)
