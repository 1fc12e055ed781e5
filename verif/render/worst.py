"""The pixels of a picture that are farthest from the reference, and what the reference shows around them.

A pixel at an edge, a glint or the rim of a reflection changes much within a small part of a pixel. There the
core's ray, which is off by a few millionths, may show the other side of it. Where the core's colour lies
within what the reference shows within an eighth of a pixel, that is what has happened. The others are rays
through glass that graze its surface: a rounding of the root's argument decides whether they get out.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from models.reference import sample
from models.scene.types import Scene, View

AROUND = 1 / 8
"""How far around a pixel's center the reference is looked at, in pixels."""

SHOWN = 8
_STEPS = 9
_SLACK = 2
"""Steps of a channel by which rounding alone may take a colour out of that range."""

Rgb = NDArray[np.uint8]


@dataclass(frozen=True)
class WorstPixel:
    """A pixel: the RTL's colour, the reference's, and the least and the most that the reference shows in each
    channel within an eighth of a pixel; at_an_edge: the RTL's lies between them."""

    x: int
    y: int
    rtl: tuple[int, ...]
    reference: tuple[int, ...]
    darkest: tuple[int, ...]
    brightest: tuple[int, ...]
    at_an_edge: bool

    def __str__(self) -> str:
        around = f"{list(self.darkest)} to {list(self.brightest)} within 1/8 pixel"
        what = "an edge" if self.at_an_edge else "no edge"
        return f"{self.x},{self.y}: RTL {list(self.rtl)}, reference {list(self.reference)}, {around}: {what}"


def _tuple(values: NDArray[Any]) -> tuple[int, ...]:
    return tuple(int(value) for value in values)


def worst_pixels(scene: Scene, view: View, depth: int, rtl: Rgb, ideal: Rgb) -> list[WorstPixel]:
    """The pixels (h, w, 3) with the largest differences in a channel, at most `SHOWN`, the worst first."""
    difference = np.abs(rtl.astype(np.int16) - ideal.astype(np.int16)).max(axis=-1)
    order = np.argsort(-difference.ravel(), kind="stable")[:SHOWN]
    places = [
        (int(index) % view.width, int(index) // view.width) for index in order if difference.flat[index]
    ]
    return [_look(scene, view, depth, rtl, ideal, x, y) for x, y in places]


def _look(scene: Scene, view: View, depth: int, rtl: Rgb, ideal: Rgb, x: int, y: int) -> WorstPixel:
    offsets = np.linspace(-AROUND, AROUND, _STEPS)
    right, down = (grid.ravel() for grid in np.meshgrid(x + offsets, y + offsets))
    seen = sample(scene, view, right, down, max_depth=depth).astype(np.int16)
    low, high, own = seen.min(axis=0), seen.max(axis=0), rtl[y, x].astype(np.int16)
    within = bool(((own >= low - _SLACK) & (own <= high + _SLACK)).all())
    return WorstPixel(x, y, _tuple(own), _tuple(ideal[y, x]), _tuple(low), _tuple(high), within)
