"""What must have been seen of the dispatch: who asks, who is free, who gets the only unit, rays in a row."""

from collections.abc import Callable

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

from models.fixed import Raw
from verif.env.coverage.classes import before
from verif.env.coverage.flow import IDLE
from verif.env.coverage.points import Bin, Coverage, Holds, Point, Recipe, Samples
from verif.env.coverage.sieve import Sieve
from verif.env.fields import Operands
from verif.env.unit import Parameters
from verif.units.dispatch.unit import MOST, UNIT

SIEVE = Sieve(UNIT)
KINDS = ("ray", "shadow")


def _asks(ray: int, shadow: int, ray_room: bool, shadow_room: bool) -> Holds:
    def holds(_p: Parameters, s: Samples) -> NDArray[np.bool_]:
        asked = (s["ray_valid"] == ray) & (s["shadow_valid"] == shadow)
        return asked & ((s["ray_free"] > 0) == ray_room) & ((s["shadow_free"] > 0) == shadow_room)

    return holds


ASKS = SIEVE.point(
    "asks",
    "who wants to start, and for whom any unit is free",
    {
        f"{asked}_room_for_{room}": _asks(*kinds, *rooms)
        for asked, kinds in {"nobody": (0, 0), "ray": (1, 0), "shadow": (0, 1), "both": (1, 1)}.items()
        for room, rooms in {
            "nobody": (False, False),
            "ray": (True, False),
            "shadow": (False, True),
            "both": (True, True),
        }.items()
    },
)


def _starts(kind: str, units: int, unit: int) -> Holds:
    def holds(_p: Parameters, s: Samples) -> NDArray[np.bool_]:
        return np.asarray(s[f"{kind}_start_{units}"] == 1 << unit)

    return holds


STARTS = SIEVE.point(
    "starts",
    "each unit of the largest dispatch that takes a ray of each kind",
    {f"{kind}_in_{unit}": _starts(kind, MOST, unit) for kind in KINDS for unit in range(MOST)},
)


def _among(units: int, matches: Callable[[Raw, Raw, int], NDArray[np.bool_]]) -> Holds:
    """Of the units that are free for a ray and for a shadow ray, and all of so many, where both ask."""
    every = (1 << units) - 1

    def holds(_p: Parameters, s: Samples) -> NDArray[np.bool_]:
        ray, shadow = (s[f"{kind}_free"] & every for kind in KINDS)
        return np.asarray(matches(ray, shadow, every) & (s["ray_valid"] == 1) & (s["shadow_valid"] == 1))

    return holds


def _one(free: Raw) -> NDArray[np.bool_]:
    return np.asarray((free > 0) & (free & (free - 1) == 0))


CONTENTION = SIEVE.point(
    "contention",
    "both ask for the same units, of so many",
    {
        **{
            f"only_one_of_{units}": _among(units, lambda ray, shadow, _every: (ray == shadow) & _one(ray))
            for units in range(1, MOST + 1)
        },
        **{
            f"shadow_takes_the_last_one_for_a_ray_of_{units}": _among(
                units, lambda ray, shadow, _every: _one(ray) & (ray == shadow & -shadow) & ~_one(shadow)
            )
            for units in range(2, MOST + 1)
        },
        **{
            f"all_of_{units}_free": _among(
                units, lambda ray, shadow, every: (ray == every) & (shadow == every)
            )
            for units in range(2, MOST + 1)
        },
    },
)


def _any_clocks(_p: Parameters, _generator: Generator, operands: Operands) -> Operands:
    return operands


def _in_a_row(matches: Callable[[dict[str, Raw], dict[str, Raw]], NDArray[np.bool_]]) -> Holds:
    """Of what started a clock ago and now, units by kind."""

    def holds(_p: Parameters, s: Samples) -> NDArray[np.bool_]:
        now = {kind: s[f"{kind}_start_{MOST}"] for kind in KINDS}
        last = {kind: np.maximum(before(started), 0) for kind, started in now.items()}
        return np.asarray(matches(last, now) & (s[IDLE] == 0))

    return holds


TURNS = {
    "ray_then_ray": _in_a_row(lambda last, now: (last["ray"] > 0) & (now["ray"] > 0)),
    "ray_then_shadow": _in_a_row(
        lambda last, now: (last["ray"] > 0) & (last["shadow"] == 0) & (now["shadow"] > 0) & (now["ray"] == 0)
    ),
    "shadow_then_ray": _in_a_row(
        lambda last, now: (last["shadow"] > 0) & (last["ray"] == 0) & (now["ray"] > 0) & (now["shadow"] == 0)
    ),
    "both_then_both": _in_a_row(
        lambda last, now: (np.minimum(last["ray"], last["shadow"]) > 0) & (now["ray"] * now["shadow"] > 0)
    ),
    "same_unit_again": _in_a_row(lambda last, now: (last["ray"] == now["ray"]) & (now["ray"] > 0)),
    "unit_of_the_other_kind": _in_a_row(lambda last, now: (last["ray"] == now["shadow"]) & (last["ray"] > 0)),
}

COVERAGE = Coverage(
    (
        ASKS,
        STARTS,
        CONTENTION,
        Point(
            "turns",
            "starts in clocks one after the other",
            tuple(
                Bin(name, Recipe("clock after clock", _any_clocks), holds) for name, holds in TURNS.items()
            ),
        ),
    )
)
