"""What must have been seen of the trace unit: tables of all sizes, what rays find, and waits of each kind."""

import numpy as np
from numpy.typing import NDArray

from verif.env.coverage.classes import before, scenario, told
from verif.env.coverage.points import Bin, Coverage, Holds, Point, Samples
from verif.env.unit import Parameters

FRAMES, STALLS, RESETS = scenario("frames"), scenario("stalls"), scenario("resets")


def _objects(least: int, most: int) -> Holds:
    """A ray starts on a table of so many objects; negative counts are less than the table has room for."""

    def holds(p: Parameters, s: Samples) -> NDArray[np.bool_]:
        starts = (s["ray_valid"] == 1) | (s["shadow_valid"] == 1)
        low, high = (count if count >= 0 else p["OBJECTS"] + 1 + count for count in (least, most))
        return np.asarray(starts & (s["objects"] >= low) & (s["objects"] <= high))

    return holds


def _free(ray: int, shadow: int) -> Holds:
    def holds(_p: Parameters, s: Samples) -> NDArray[np.bool_]:
        return np.asarray((s["ray_free"] == ray) & (s["shadow_free"] == shadow) & (s["rst"] == 0))

    return holds


def _behind(first: str, second: str) -> Holds:
    """A ray starts in the first clock in which that may be, the one before it was of another kind or not."""

    def holds(_p: Parameters, s: Samples) -> NDArray[np.bool_]:
        starts = (s[f"{first}_valid"] == 1) & (s["tested"] == 1)
        return np.asarray(starts & (before(s[f"{second}_free"]) == 0))

    return holds


def _waits(result: str) -> Holds:
    def holds(_p: Parameters, s: Samples) -> NDArray[np.bool_]:
        return np.asarray((s[f"{result}_valid"] == 1) & (s[f"{result}_ready"] == 0) & (s["rst"] == 0))

    return holds


def _both(s: Samples) -> NDArray[np.bool_]:
    return np.asarray((s["hit_valid"] == 1) & (s["term_valid"] == 1))


def _reset(case: str) -> Holds:
    def holds(_p: Parameters, s: Samples) -> NDArray[np.bool_]:
        begins = (s["rst"] == 1) & (before(s["rst"]) == 0)
        cases = {
            "testing": before(s["tested"]) == 1,
            "hit_waits": before(s["hit_valid"]) == 1,
            "term_waits": before(s["term_valid"]) == 1,
        }
        return np.asarray(begins & cases[case])

    return holds


_FOUND = ("nothing", "sphere", "triangle", "leaving", "glass", "opaque", "starts_on_one")

COVERAGE = Coverage(
    signals=(
        "rst",
        "ray_valid",
        "shadow_valid",
        "ray_free",
        "shadow_free",
        "tested",
        "objects",
        "hit_valid",
        "hit_ready",
        "term_valid",
        "term_ready",
    ),
    points=(
        Point(
            "objects",
            "size of the table",
            (
                Bin("none", FRAMES, _objects(0, 0)),
                Bin("one", FRAMES, _objects(1, 1)),
                Bin("some", FRAMES, _objects(2, -2)),
                Bin("all", FRAMES, _objects(-1, -1)),
            ),
        ),
        Point(
            "free",
            "kinds of rays that may start",
            (
                Bin("both", FRAMES, _free(1, 1)),
                Bin("none", FRAMES, _free(0, 0)),
                Bin("rays_alone", STALLS, _free(1, 0)),
                Bin("shadow_rays_alone", STALLS, _free(0, 1)),
            ),
        ),
        Point(
            "behind",
            "a ray without a gap behind another",
            tuple(Bin(kind, FRAMES, _behind(kind, kind)) for kind in ("ray", "shadow")),
        ),
        Point(
            "waits", "results that wait", tuple(Bin(name, STALLS, _waits(name)) for name in ("hit", "term"))
        ),
        Point("together", "results of both kinds in a clock", (Bin("both", FRAMES, lambda _p, s: _both(s)),)),
        Point(
            "reset",
            "reset while",
            tuple(Bin(case, RESETS, _reset(case)) for case in ("testing", "hit_waits", "term_waits")),
        ),
        told(
            "ray",
            "what a ray finds",
            dict.fromkeys(
                ("nothing", "sphere", "triangle", "leaving", "glass", "opaque", "starts_on_one"), "frames"
            ),
        ),
        told("light", "what is left of light", dict.fromkeys(("nothing", "some"), "frames")),
    ),
)
