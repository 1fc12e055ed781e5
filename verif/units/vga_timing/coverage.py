"""What must have been seen of the timing: edges of the pulses, corners of the screen, resets."""

import numpy as np
from numpy.typing import NDArray

from verif.env.coverage.classes import before, scenario
from verif.env.coverage.points import Bin, Coverage, Holds, Point, Samples
from verif.env.unit import Parameters

FRAMES, RESETS = scenario("frames"), scenario("resets")

_Rule = dict[str, Holds]


def _edge(pulse: str, rises: bool, *, in_lines_seen: bool | None = None) -> Holds:
    def holds(p: Parameters, s: Samples) -> NDArray[np.bool_]:
        changed = (s[pulse] == rises) & (before(s[pulse]) == (not rises)) & _runs(s)
        seen = s["y"] < p["V_ACTIVE"]
        return np.asarray(changed if in_lines_seen is None else changed & (seen == in_lines_seen))

    return holds


def _runs(s: Samples) -> NDArray[np.bool_]:
    return np.asarray((s["rst"] == 0) & (before(s["rst"]) == 0))


def _corner(last_column: bool, last_row: bool) -> Holds:
    def holds(p: Parameters, s: Samples) -> NDArray[np.bool_]:
        column = s["x"] == (p["H_ACTIVE"] - 1 if last_column else 0)
        row = s["y"] == (p["V_ACTIVE"] - 1 if last_row else 0)
        return np.asarray((s["active"] == 1) & column & row)

    return holds


def _wraps(name: str) -> Holds:
    def holds(_p: Parameters, s: Samples) -> NDArray[np.bool_]:
        return np.asarray((s[name] == 0) & (before(s[name]) > 0) & _runs(s))

    return holds


def _reset_in(part: str) -> Holds:
    """Reset begins behind a clock in a part of the frame."""

    def holds(p: Parameters, s: Samples) -> NDArray[np.bool_]:
        was = {name: before(values) for name, values in s.items()}
        begins = (s["rst"] == 1) & (was["rst"] == 0)
        parts = {
            "active": was["active"] == 1,
            "hsync": was["hsync"] == (p["H_POSITIVE"] != 0),
            "vsync": was["vsync"] == (p["V_POSITIVE"] != 0),
            "vertical_blank": (was["y"] >= p["V_ACTIVE"]) & (was["active"] == 0),
            "horizontal_blank": (was["y"] < p["V_ACTIVE"]) & (was["active"] == 0),
        }
        return np.asarray(begins & parts[part])

    return holds


def _high(name: str) -> Holds:
    def holds(_p: Parameters, s: Samples) -> NDArray[np.bool_]:
        return np.asarray((s[name] == 1) & _runs(s))

    return holds


_EDGES: _Rule = {
    "hsync_rises_in_lines_seen": _edge("hsync", True, in_lines_seen=True),
    "hsync_falls_in_lines_seen": _edge("hsync", False, in_lines_seen=True),
    "hsync_rises_in_blank": _edge("hsync", True, in_lines_seen=False),
    "hsync_falls_in_blank": _edge("hsync", False, in_lines_seen=False),
    "vsync_rises": _edge("vsync", True),
    "vsync_falls": _edge("vsync", False),
    "blank_starts": _high("blank_start"),
    "line_ends": _wraps("x"),
    "frame_ends": _wraps("y"),
}
_CORNERS: _Rule = {
    f"{row}_{column}": _corner(column == "right", row == "lower")
    for row in ("upper", "lower")
    for column in ("left", "right")
}
_PARTS = ("active", "hsync", "vsync", "vertical_blank", "horizontal_blank")

COVERAGE = Coverage(
    signals=("rst", "hsync", "vsync", "active", "blank_start", "x", "y"),
    points=(
        Point("edge", "changes", tuple(Bin(name, FRAMES, holds) for name, holds in _EDGES.items())),
        Point("corner", "places seen", tuple(Bin(name, FRAMES, holds) for name, holds in _CORNERS.items())),
        Point("reset", "reset in each part", tuple(Bin(part, RESETS, _reset_in(part)) for part in _PARTS)),
    ),
)
