"""Cover points of a block's valid/ready streams, and what lasts: conditions clock by clock."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from verif.env.coverage.classes import before
from verif.env.coverage.flow import LONG
from verif.env.coverage.points import Bin, Holds, Point, Recipe, Samples
from verif.env.unit import Parameters

Found = NDArray[np.bool_]
"""A condition, clock by clock."""


def lasting(found: Found, clocks: int = LONG) -> Found:
    """Clocks in which a condition has held for so many, that one among them."""
    held = found.copy()
    for earlier in range(1, clocks):
        held[earlier:] &= found[:-earlier]
        held[:earlier] = False
    return held


def was(found: Found, clocks: int = 1) -> Found:
    """Whether a condition held so many clocks ago; False where that was not sampled."""
    return np.asarray(before(found.astype(np.int64), clocks) == 1)


def handshake(
    name: str, valid: str, ready: str, recipe: Recipe, *, bit: int = 0, leave_out: Sequence[str] = ()
) -> Point:
    """How items of a stream move: at once, after one clock, after a long wait, clock by clock, late.

    valid, ready: signals of which ``bit`` is the stream's. `starved`: ready for long without an item.
    """

    def moves(samples: Samples) -> tuple[Found, Found]:
        return (samples[valid] >> bit) & 1 == 1, (samples[ready] >> bit) & 1 == 1

    def at_once(_p: Parameters, samples: Samples) -> Found:
        offers, takes = moves(samples)
        return offers & takes & ~was(offers & ~takes)

    def stalled(_p: Parameters, samples: Samples) -> Found:
        offers, takes = moves(samples)
        return offers & takes & was(offers & ~takes)

    def stalled_long(_p: Parameters, samples: Samples) -> Found:
        offers, takes = moves(samples)
        return lasting(offers & ~takes)

    def back_to_back(_p: Parameters, samples: Samples) -> Found:
        offers, takes = moves(samples)
        return offers & takes & was(offers & takes)

    def starved(_p: Parameters, samples: Samples) -> Found:
        offers, takes = moves(samples)
        return lasting(~offers & takes)

    cases: dict[str, Holds] = {
        "at_once": at_once,
        "stalled": stalled,
        "stalled_long": stalled_long,
        "back_to_back": back_to_back,
        "starved": starved,
    }
    bins = tuple(Bin(found, recipe, holds) for found, holds in cases.items() if found not in leave_out)
    return Point(name, f"how items move from {valid} to {ready}", bins)
