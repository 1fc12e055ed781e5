"""What must have been seen of the ray generator: sizes, signs of the spans, gaps, resets."""

import numpy as np
from numpy.typing import NDArray

from verif.env.coverage.classes import before, scenario
from verif.env.coverage.points import Bin, Coverage, Holds, Point, Samples
from verif.env.unit import Parameters

PICTURES, SIGNS, RESETS, WIDE = (scenario(name) for name in ("pictures", "signs", "resets", "wide"))


def _starts(s: Samples) -> NDArray[np.bool_]:
    return np.asarray(s["start"] == 1)


def _size(width: str, height: str) -> Holds:
    def holds(p: Parameters, s: Samples) -> NDArray[np.bool_]:
        fits = _starts(s)
        for side, wanted in ((s["width"], width), (s["height"], height)):
            cases = {"one": side == 1, "some": side > 1, "most": side == (1 << p.get("SIZE_W", 12)) - 1}
            fits &= cases[wanted]
        return np.asarray(fits)

    return holds


def _sign(side: str, lane: int, negative: int) -> Holds:
    def holds(_p: Parameters, s: Samples) -> NDArray[np.bool_]:
        return np.asarray(_starts(s) & (s[f"{side}_negative"] >> (2 - lane) & 1 == negative))

    return holds


def _gap(case: str) -> Holds:
    def holds(_p: Parameters, s: Samples) -> NDArray[np.bool_]:
        taken = (s["slot_valid"] == 1) & (s["slot_ready"] == 1)
        cases = {
            "none": taken & (before(taken.astype(np.int64)) == 1),
            "in_a_picture": (s["slot_valid"] == 0) & (s["slot_ready"] == 1),
            "slot_without_a_picture": (s["slot_valid"] == 1) & (s["slot_ready"] == 0),
        }
        return np.asarray(cases[case] & (s["rst"] == 0))

    return holds


def _reset(case: str) -> Holds:
    def holds(_p: Parameters, s: Samples) -> NDArray[np.bool_]:
        begins = (s["rst"] == 1) & (before(s["rst"]) == 0)
        drawing = before(s["slot_ready"]) == 1
        return np.asarray(begins & (drawing if case == "in_a_picture" else ~drawing))

    return holds


_SIGNS = tuple(
    Bin(f"{side}_{axis}_{'negative' if negative else 'positive'}", SIGNS, _sign(side, lane, negative))
    for side in ("column", "row")
    for lane, axis in enumerate("xyz")
    for negative in (0, 1)
)

COVERAGE = Coverage(
    signals=(
        "rst",
        "start",
        "width",
        "height",
        "column_negative",
        "row_negative",
        "slot_valid",
        "slot_ready",
    ),
    points=(
        Point(
            "size",
            "width and height",
            (
                Bin("one_one", PICTURES, _size("one", "one")),
                Bin("one_some", PICTURES, _size("one", "some")),
                Bin("some_one", PICTURES, _size("some", "one")),
                Bin("some_some", PICTURES, _size("some", "some")),
                Bin("most_one", WIDE, _size("most", "one")),
                Bin("one_most", WIDE, _size("one", "most")),
            ),
        ),
        Point("sign", "signs of the spans", _SIGNS),
        Point(
            "gap",
            "slots and pictures",
            tuple(
                Bin(case, PICTURES, _gap(case)) for case in ("none", "in_a_picture", "slot_without_a_picture")
            ),
        ),
        Point(
            "reset",
            "reset",
            tuple(Bin(case, RESETS, _reset(case)) for case in ("in_a_picture", "between_pictures")),
        ),
    ),
)
