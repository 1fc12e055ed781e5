"""What must have been seen of the frame buffer and the video block: pictures, clocks, resets."""

from typing import Any

from models.video import Store
from verif.env.context import Context
from verif.env.coverage.classes import told
from verif.env.coverage.collector import Collector
from verif.env.coverage.declared import coverage_of_name
from verif.env.coverage.points import Point
from verif.env.coverage.sampling import clock_number, collector
from verif.video.clocks import Clocks, Ratio
from verif.video.pictures import Shot
from verif.video.sender import Sender

PICTURES, CLOCKS, RESETS = "pictures", "clocks", "resets"
"""Scenarios."""

_PAIRS = {
    (True, True): "whole_whole",
    (True, False): "whole_broken",
    (False, True): "broken_whole",
    (False, False): "two_broken",
}
"""Whether a picture is whole, and the next one."""

POINTS: tuple[Point, ...] = (
    told(
        "clocks",
        "the core's clock against the pixel clock",
        dict.fromkeys(("core_faster", "nearly_equal", "core_slower"), CLOCKS),
    ),
    told(
        "picture",
        "pictures in the stream",
        dict.fromkeys(
            ("stored_size", "narrower", "lower", "wider", "higher", "one_pixel", "cut_short", "line_slips"),
            PICTURES,
        ),
    ),
    told(
        "behind",
        "a picture behind another",
        dict.fromkeys(_PAIRS.values(), PICTURES),
    ),
    told(
        "core_reset",
        "what the core's reset drops",
        {"in_a_picture": RESETS, "between_pictures": RESETS},
    ),
    told("screen_reset", "what the screen's reset drops", {"pictures": RESETS, "nothing": RESETS}),
)

_NEARLY = 0.02


class Seen:
    """Hears of the clocks and of the stream's sender, and tells the bins."""

    def __init__(self, made: Collector, store: Store, sender: Sender) -> None:
        self.coverage = made
        self._store, self._sender = store, sender
        self._before: Shot | None = None

    def tell(self, name: str) -> None:
        """A bin has been hit."""
        self.coverage.tell(name, clock_number())

    def restarted(self, ratio: Ratio) -> None:
        """Both sides begin with these clocks."""
        self._before = None
        apart = ratio.core_ps / ratio.pixel_ps - 1
        nearly = abs(apart) < _NEARLY
        self.tell(f"clocks.{'nearly_equal' if nearly else 'core_slower' if apart > 0 else 'core_faster'}")

    def reset(self, side: str) -> None:
        """One side alone is reset."""
        assembler = self._sender.assembler
        if side == "core":
            self.tell(f"core_reset.{'in_a_picture' if assembler.receiving else 'between_pictures'}")
        else:
            self.tell(f"screen_reset.{'pictures' if assembler.pictures else 'nothing'}")

    def sent(self, shot: Shot) -> None:
        """A picture is queued."""
        store = self._store
        cases = {
            "stored_size": shot.whole and (shot.width, shot.height) == (store.width, store.height),
            "narrower": shot.whole and shot.width < store.width,
            "lower": shot.whole and shot.height < store.height,
            "wider": shot.whole and shot.width > store.width,
            "higher": shot.whole and shot.height > store.height,
            "one_pixel": shot.whole and shot.width * shot.height == 1,
            "cut_short": shot.cut is not None,
            "line_slips": shot.slip is not None,
        }
        for name, holds in cases.items():
            if holds:
                self.tell(f"picture.{name}")
        if self._before is not None:
            pair = self._before.whole, shot.whole
            self.tell(f"behind.{_PAIRS[pair]}")
        self._before = shot


def watch(run: Context, store: Store, clocks: Clocks, sender: Sender) -> Seen | None:
    """Begins to listen, where the run samples coverage."""
    if not run.unit:
        return None
    seen = Seen(collector(run, coverage_of_name(run.unit)), store, sender)
    clocks.restarted.append(seen.restarted)
    clocks.resets.append(seen.reset)
    sender.listeners.append(seen.sent)
    return seen


def known(seen: Seen | None) -> Any:
    """The collector. Raises ValueError where the run samples no coverage."""
    if seen is None:
        raise ValueError("this run samples no coverage: its settings name no unit")
    return seen.coverage
