"""A monitor that knows only the sync pulses, as a real one: it locks, finds the picture, and measures.

It is fed samples, one a pixel clock, from wherever they come (see `verif.video.samples`), and gives
the frames seen. It looks for a mode whose periods, pulses and polarities are those of the signal
within a tolerance, refuses a signal of no mode, and takes the pixels behind the back porches. Data
enable is measured and not used. Imports no cocotb.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from models.images import Rgb
from models.video import Axis, Mode, Waveform

Samples = NDArray[np.uint32]
"""Of each pixel clock {de, vsync, hsync, r, g, b}, three bits and three bytes, see `screen_recorder`."""

Range = tuple[int, int]
"""Smallest and largest value."""

_HSYNC, _VSYNC, _DE, _RGB = (np.uint32(mask) for mask in (1 << 24, 1 << 25, 1 << 26, (1 << 24) - 1))

TOLERANCE = 0.005
"""Share by which a period may differ from that of a mode: half a percent, as monitors have it."""

_PULSE_TOLERANCE = 0.1
"""The same of a pulse, which is so much shorter."""

_FRAMES_WITHOUT_SYNC = 3
"""Of the longest mode; after so many there is no signal."""


class NoLock(Exception):
    """There is no signal, or it is none of the modes; the text says what was measured."""


def sample(wave: Waveform) -> Samples:
    """The samples of a frame."""
    red, green, blue = wave.rgb.astype(np.uint32).T
    flags = wave.de.astype(np.uint32) << 26 | wave.vsync.astype(np.uint32) << 25
    return np.asarray(flags | wave.hsync.astype(np.uint32) << 24 | red << 16 | green << 8 | blue)


def _runs(level: NDArray[np.bool_]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Where a signal rises and where it falls; high ends at the array's ends count."""
    padded = np.concatenate(([False], level, [False]))
    changes = np.flatnonzero(padded[1:] != padded[:-1])
    return changes[::2], changes[1::2]


def _range(values: NDArray[np.int64]) -> Range:
    """Of no values (0, 0), which no mode promises."""
    return (int(values.min()), int(values.max())) if values.size else (0, 0)


def _exactly(value: int) -> Range:
    return value, value


@dataclass(frozen=True)
class _Signal:
    """One frame of samples, from the beginning of a vertical pulse to that of the next one."""

    samples: Samples
    vertical_positive: bool

    @property
    def horizontal_positive(self) -> bool:
        """The pulse is the level that is rarer."""
        return 2 * int(np.count_nonzero(self.samples & _HSYNC)) < len(self.samples)

    def pulses(self) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        """Where the horizontal pulses begin and end."""
        return _runs(((self.samples & _HSYNC) != 0) == self.horizontal_positive)

    def vertical_pulse(self) -> int:
        """Clocks that it lasts."""
        other = ((self.samples & _VSYNC) != 0) != self.vertical_positive
        return int(other.argmax())


def measure(samples: Samples, vertical_positive: bool) -> dict[str, Range]:
    """Every figure of one frame, in clocks unless it says lines: smallest and largest value of all lines."""
    signal = _Signal(samples, vertical_positive)
    starts, ends = signal.pulses()
    periods = np.diff(np.append(starts, len(samples)))
    width = signal.vertical_pulse()
    pulse_lines = int(np.count_nonzero(starts < width))
    de = (samples & _DE) != 0
    left, right = _runs(de)
    rows = np.searchsorted(starts, left, side="right") - 1
    known = rows >= 0
    left, right, rows = left[known], right[known], rows[known]
    following = np.append(starts, len(samples))[rows + 1]
    edge = np.isin([0, width], starts)
    return {
        "line": _range(periods),
        "hsync": _range(ends - starts),
        "hsync is positive": _exactly(int(signal.horizontal_positive)),
        "line's back porch": _range(left - ends[rows]),
        "line's active part": _range(right - left),
        "line's front porch": _range(following - right),
        "frame": _exactly(len(samples)),
        "frame in lines": _exactly(len(starts)),
        "vsync": _exactly(width),
        "vsync in lines": _exactly(pulse_lines),
        "vsync is positive": _exactly(int(vertical_positive)),
        "vsync begins with hsync": _exactly(int(edge[0])),
        "vsync ends with hsync": _exactly(int(edge[1])),
        "frame's back porch in lines": _exactly(int(rows[0]) - pulse_lines if rows.size else -1),
        "frame's active lines": _exactly(len(np.unique(rows))),
        "frame's front porch in lines": _exactly(len(starts) - 1 - int(rows[-1]) if rows.size else -1),
        "pixels in blank that are not black": _exactly(int(np.count_nonzero(samples[~de] & _RGB))),
    }


def promised(mode: Mode) -> dict[str, Range]:
    """What `measure` finds where a signal is the mode's in every clock."""
    across, down = mode.horizontal, mode.vertical
    figures = {
        "line": across.total,
        "hsync": across.sync,
        "hsync is positive": int(across.positive),
        "line's back porch": across.back,
        "line's active part": across.active,
        "line's front porch": across.front,
        "frame": mode.clocks,
        "frame in lines": down.total,
        "vsync": down.sync * across.total,
        "vsync in lines": down.sync,
        "vsync is positive": int(down.positive),
        "vsync begins with hsync": 1,
        "vsync ends with hsync": 1,
        "frame's back porch in lines": down.back,
        "frame's active lines": down.active,
        "frame's front porch in lines": down.front,
        "pixels in blank that are not black": 0,
    }
    return {name: _exactly(value) for name, value in figures.items()}


@dataclass(frozen=True)
class Frame:
    """A frame that was seen: its picture, its figures, and its first sample since the monitor began."""

    picture: Rgb
    figures: Mapping[str, Range]
    start: int

    def faults(self, mode: Mode) -> list[str]:
        """Each figure that is not exactly the mode's."""
        return [
            f"{name}: {_told(self.figures[name])}, promised {_told(value)}"
            for name, value in promised(mode).items()
            if self.figures[name] != value
        ]


def _told(value: Range) -> str:
    return str(value[0]) if value[0] == value[1] else f"{value[0]} to {value[1]}"


def _near(value: Range, wanted: int, tolerance: float) -> bool:
    return all(abs(end - wanted) <= tolerance * wanted for end in value)


class Monitor:
    """Give it samples with `feed`. modes: those that it knows; tolerance: see TOLERANCE."""

    def __init__(self, modes: Sequence[Mode], tolerance: float = TOLERANCE) -> None:
        self._modes, self._tolerance = modes, tolerance
        self._samples: Samples = np.empty(0, dtype=np.uint32)
        self._first = 0
        self._positive: bool | None = None
        self._aligned = False
        self.mode: Mode | None = None

    def feed(self, samples: Samples) -> list[Frame]:
        """The frames that these samples complete. Raises NoLock; nothing before a first pulse is seen."""
        self._samples = np.concatenate((self._samples, samples))
        if self._positive is None:
            self._find_polarity()
        frames: list[Frame] = []
        if self._positive is not None:
            starts, _ = _runs(((self._samples & _VSYNC) != 0) == self._positive)
            # A pulse that is under way in the very first sample tells nothing of its beginning.
            starts = starts if self._aligned else starts[starts > 0]
            frames = [self._frame(begin, end) for begin, end in pairwise(starts.tolist())]
            if starts.size:
                self._aligned = True
                self._drop(int(starts[-1]))
        if len(self._samples) > _FRAMES_WITHOUT_SYNC * max(mode.clocks for mode in self._modes):
            raise NoLock(f"no vsync in {len(self._samples)} clocks")
        return frames

    def _drop(self, number: int) -> None:
        self._samples = self._samples[number:]
        self._first += number

    def _find_polarity(self) -> None:
        """From two changes and one more: the shorter of the two times between is the pulse."""
        level = (self._samples & _VSYNC) != 0
        changes = np.flatnonzero(level[1:] != level[:-1]) + 1
        if changes.size >= 3:
            first, second = np.diff(changes[:3])
            self._positive = bool(level[changes[0]]) == bool(first < second)

    def _frame(self, begin: int, end: int) -> Frame:
        assert self._positive is not None
        samples = self._samples[begin:end]
        figures = measure(samples, self._positive)
        self.mode = self._lock(figures)
        return Frame(self._picture(samples, self.mode), figures, self._first + begin)

    def _lock(self, figures: Mapping[str, Range]) -> Mode:
        """The mode of a frame."""
        for mode in self._modes:
            if self._is(mode.horizontal, figures, "line", "hsync") and self._is(
                mode.vertical, figures, "frame in lines", "vsync in lines", "vsync is positive"
            ):
                return mode
        text = ", ".join(f"{name} {_told(value)}" for name, value in figures.items())
        raise NoLock(f"the signal is that of no mode: {text}")

    def _is(
        self,
        axis: Axis,
        figures: Mapping[str, Range],
        period: str,
        pulse: str,
        positive: str = "hsync is positive",
    ) -> bool:
        return (
            _near(figures[period], axis.total, self._tolerance)
            and _near(figures[pulse], axis.sync, _PULSE_TOLERANCE)
            and figures[positive] == _exactly(int(axis.positive))
        )

    def _picture(self, samples: Samples, mode: Mode) -> Rgb:
        """The pixels behind the back porches."""
        _, ends = _Signal(samples, mode.vertical.positive).pulses()
        lines = ends[mode.vertical.lead :][: mode.vertical.active] + mode.horizontal.back
        # A line may be short by the tolerance, the last one too.
        places = np.minimum(lines[:, np.newaxis] + np.arange(mode.horizontal.active), len(samples) - 1)
        pixels = samples[places]
        return np.stack([pixels >> 16 & 255, pixels >> 8 & 255, pixels & 255], axis=-1).astype(np.uint8)
