"""What must have been seen of the light of a step: where it goes, its base, its light, limits, resets."""

from models.header import selected
from models.limits import INFINITY
from verif.env.coverage.classes import scenario, told
from verif.env.coverage.handshake import Found
from verif.env.coverage.points import Bin, Coverage, Holds, Point, Samples, cross
from verif.env.unit import Parameters

STEPS, DIM, FAR, RESETS = map(scenario, ("steps", "dim steps", "far lights", "resets"))


def _shadow(s: Samples) -> Found:
    return s["shadow_valid"] == 1


def _is(name: str, value: int) -> Holds:
    return lambda _p, s: s[name] == value


def _only(channel: int) -> Holds:
    """A shadow ray that carries light of one channel alone."""

    def holds(_p: Parameters, s: Samples) -> Found:
        light = s["shadow_light"]
        return _shadow(s) & (light[channel] > 0) & ((light > 0).sum(axis=0) == 1)

    return holds


def _most(p: Parameters) -> int:
    return selected(p).shade.max


def _farthest(p: Parameters) -> int:
    """Distances from here on are none."""
    return int(INFINITY * selected(p).point.one) - 1


END = Point(
    "end",
    "what a step becomes",
    (
        Bin("shadow_ray", STEPS, lambda _p, s: _shadow(s)),
        Bin("direct_term", STEPS, lambda _p, s: s["direct_valid"] == 1),
    ),
)
HIT = Point("hit", "what the ray met", (Bin("miss", STEPS, _is("hit", 0)), Bin("hit", STEPS, _is("hit", 1))))
FIRST = Point(
    "first", "which step it is", (Bin("first", STEPS, _is("first", 1)), Bin("later", STEPS, _is("first", 0)))
)
LIT = Point(
    "lit", "whether there is a light", (Bin("lit", STEPS, _is("lit", 1)), Bin("dark", STEPS, _is("lit", 0)))
)

COVERAGE = Coverage(
    (
        cross(HIT, LIT, recipe=STEPS),
        cross(HIT, FIRST, recipe=STEPS, leave_out=lambda hit, first: hit == "miss" and first == "later"),
        cross(FIRST, END, recipe=STEPS),
        Point(
            "light",
            "that a shadow ray carries",
            (
                *(Bin(f"of_channel_{lane}_alone", DIM, _only(lane)) for lane in range(3)),
                Bin("of_all_channels", STEPS, lambda _p, s: _shadow(s) & (s["shadow_light"] > 0).all(axis=0)),
                Bin("least", DIM, lambda _p, s: _shadow(s) & (s["shadow_light"].max(axis=0) == 1)),
                Bin("most", STEPS, lambda p, s: _shadow(s) & (s["shadow_light"].max(axis=0) == _most(p))),
            ),
        ),
        Point(
            "dark",
            "a hit with a light that adds nothing",
            (
                Bin("at_the_point", STEPS, lambda _p, s: s["light_at_point"] == 1),
                Bin(
                    "no_weight",
                    DIM,
                    lambda _p, s: (
                        (s["hit"] == 1)
                        & (s["lit"] == 1)
                        & (s["direct_valid"] == 1)
                        & (s["weight"].max(axis=0) == 0)
                    ),
                ),
                Bin(
                    "too_little_weight",
                    DIM,
                    lambda _p, s: (
                        (s["hit"] == 1)
                        & (s["lit"] == 1)
                        & (s["direct_valid"] == 1)
                        & (s["weight"].max(axis=0) == 1)
                    ),
                ),
                Bin(
                    "behind_the_surface",
                    STEPS,
                    lambda p, s: (
                        (s["hit"] == 1)
                        & (s["lit"] == 1)
                        & (s["direct_valid"] == 1)
                        & (s["light_at_point"] == 0)
                        & (s["weight"].min(axis=0) >= selected(p).shade.one >> 1)
                    ),
                ),
            ),
        ),
        Point(
            "base",
            "of a direct term",
            (
                Bin("ambient", STEPS, lambda _p, s: (s["hit"] == 1) & (s["direct_base"] > 0).any(axis=0)),
                Bin("background", STEPS, lambda _p, s: (s["hit"] == 0) & (s["direct_base"] > 0).any(axis=0)),
                Bin(
                    "none",
                    STEPS,
                    lambda _p, s: (s["direct_valid"] == 1) & (s["direct_base"] == 0).all(axis=0),
                ),
                Bin("saturated", STEPS, lambda p, s: (s["direct_base"] == _most(p)).any(axis=0)),
            ),
        ),
        Point(
            "shadow_base",
            "of a shadow ray",
            (
                Bin("none", STEPS, lambda _p, s: _shadow(s) & (s["shadow_base"] == 0).all(axis=0)),
                Bin("some", STEPS, lambda _p, s: _shadow(s) & (s["shadow_base"] > 0).any(axis=0)),
                Bin("saturated", STEPS, lambda p, s: _shadow(s) & (s["shadow_base"] == _most(p)).any(axis=0)),
            ),
        ),
        Point(
            "limit",
            "how far the light is",
            (
                Bin("near", STEPS, lambda p, s: _shadow(s) & (s["shadow_limit"] <= selected(p).point.one)),
                Bin(
                    "far",
                    STEPS,
                    lambda p, s: (
                        _shadow(s)
                        & (s["shadow_limit"] > 100 * selected(p).point.one)
                        & (s["shadow_limit"] < _farthest(p))
                    ),
                ),
                Bin("farthest", FAR, lambda p, s: _shadow(s) & (s["shadow_limit"] >= _farthest(p))),
            ),
        ),
        Point(
            "object",
            "that was hit",
            (
                Bin("first", STEPS, lambda _p, s: (s["own"] == 0) & (s["hit"] == 1)),
                Bin("last", STEPS, lambda p, s: (s["own"] == p["OBJECTS"] - 1) & (s["hit"] == 1)),
                Bin("triangle", STEPS, lambda _p, s: _shadow(s) & (s["owned"] == 1)),
                Bin("no_triangle", STEPS, lambda _p, s: _shadow(s) & (s["owned"] == 0)),
            ),
        ),
        told("reset", "what was under way", {"busy": RESETS.name, "idle": RESETS.name}),
    )
)
