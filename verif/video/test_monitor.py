"""The monitor sees what it is shown, locks from anywhere, and refuses and reports what is not the mode's."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from models.images import Rgb
from models.video import VGA, Axis, Mode, waveform
from verif.video.modes import MIXED, SMALL, TIGHT
from verif.video.monitor import Monitor, NoLock, Samples, sample

_MODES = (SMALL, MIXED, TIGHT)
_PARTS = ("active", "front", "sync", "back")


def _noise(mode: Mode, seed: int) -> Rgb:
    width, height = mode.size
    return np.random.default_rng(seed).integers(0, 256, (height, width, 3), dtype=np.uint8)


def _signal(mode: Mode, pictures: list[Rgb]) -> Samples:
    return np.concatenate([sample(waveform(mode, picture)) for picture in pictures])


@given(st.sampled_from(_MODES), st.integers(1, 3), st.data())
def test_frames_are_seen_as_they_are_sent_wherever_the_monitor_is_plugged_in(
    mode: Mode, number: int, data: st.DataObject
) -> None:
    pictures = [_noise(mode, seed) for seed in range(number + 2)]
    signal = _signal(mode, pictures)
    start = data.draw(st.integers(0, mode.clocks - 1))
    parts = data.draw(st.lists(st.integers(start, len(signal)), max_size=4).map(sorted))
    monitor = Monitor(_MODES)
    frames = []
    for part in np.split(signal[start:], np.array(parts, dtype=np.int64) - start):
        frames += monitor.feed(part)
    # The frame under way is not seen, and the last one ends with a pulse that does not come.
    wanted = pictures[1:-1]
    assert [frame.start + start for frame in frames] == [mode.clocks * (n + 1) for n in range(number)]
    assert all(np.array_equal(frame.picture, picture) for frame, picture in zip(frames, wanted, strict=True))
    assert monitor.mode == mode or not frames
    assert [frame.faults(mode) for frame in frames] == [[]] * number


def test_the_default_mode_is_seen() -> None:
    pictures = [_noise(VGA, seed) for seed in range(3)]
    frames = Monitor((VGA,)).feed(_signal(VGA, [*pictures, pictures[0]]))
    assert [frame.faults(VGA) for frame in frames] == [[], []]
    assert np.array_equal(frames[0].picture, pictures[1])


def _other(mode: Mode, direction: str, part: str, change: int) -> Mode:
    axis: Axis = getattr(mode, direction)
    lengths = {name: getattr(axis, name) for name in _PARTS}
    changed = Axis(**{**lengths, part: lengths[part] + change}, positive=axis.positive)
    if direction == "horizontal":
        return replace(mode, horizontal=changed)
    return replace(mode, vertical=changed)


_NAMES = {
    ("horizontal", "active"): "line's active part",
    ("horizontal", "front"): "line's front porch",
    ("horizontal", "sync"): "hsync",
    ("horizontal", "back"): "line's back porch",
    ("vertical", "active"): "frame's active lines",
    ("vertical", "front"): "frame's front porch in lines",
    ("vertical", "back"): "frame's back porch in lines",
}
"""What the default mode has room for by one; a vertical pulse of 1 or 3 lines instead of 2 is refused."""


@pytest.mark.parametrize(("part", "name"), _NAMES.items())
@pytest.mark.parametrize("change", [-1, 1])
def test_each_figure_that_is_off_by_one_within_the_tolerance_is_reported(
    part: tuple[str, str], name: str, change: int
) -> None:
    """Each by its name, and the whole line or frame."""
    other = _other(VGA, *part, change)
    (frame,) = Monitor((VGA,)).feed(_signal(other, [_noise(other, 0)] * 3))
    faults = frame.faults(VGA)
    named = {fault.partition(":")[0] for fault in faults}
    assert name in named
    assert ("line" in named) == (part[0] == "horizontal")
    assert ("frame in lines" in named) == (part[0] == "vertical")


@pytest.mark.parametrize(
    "other",
    [
        _other(VGA, "horizontal", "back", 8),
        _other(VGA, "horizontal", "front", -6),
        _other(VGA, "vertical", "back", 4),
        _other(VGA, "vertical", "sync", 1),
        replace(VGA, horizontal=replace(VGA.horizontal, positive=True)),
        replace(VGA, vertical=replace(VGA.vertical, positive=True)),
        SMALL,
    ],
    ids=["line", "shorter line", "lines", "vsync", "hsync's polarity", "vsync's polarity", "other"],
)
def test_a_signal_outside_of_the_tolerance_is_refused(other: Mode) -> None:
    with pytest.raises(NoLock, match="the signal is that of no mode: line "):
        Monitor((VGA,)).feed(_signal(other, [_noise(other, 0)] * 3))


def test_no_signal_is_refused() -> None:
    with pytest.raises(NoLock, match="no vsync"):
        Monitor((SMALL,)).feed(np.zeros(4 * SMALL.clocks, dtype=np.uint32))


def test_one_line_that_is_longer_and_the_next_one_shorter_are_reported() -> None:
    """In the sum nothing is wrong."""
    signal = _signal(VGA, [_noise(VGA, 0)] * 3)
    line = VGA.horizontal.total
    place = VGA.clocks + 100 * line
    # A clock of the front porch moves from one line to the other: the pulse between is a clock early.
    moved = np.concatenate((signal[: place - 1], signal[place : place + line], signal[place - 1 : place]))
    frames = Monitor((VGA,)).feed(np.concatenate((moved, signal[place + line :])))
    faults = "\n".join(frames[0].faults(VGA))
    assert "line: 799 to 801, promised 800" in faults
    assert "line's front porch: 15 to 17, promised 16" in faults


def test_a_pixel_in_blank_is_reported() -> None:
    signal = _signal(SMALL, [_noise(SMALL, 0)] * 3)
    signal[SMALL.clocks + 5] |= 1
    (frame,) = Monitor((SMALL,)).feed(signal)
    assert frame.faults(SMALL) == ["pixels in blank that are not black: 1, promised 0"]


def test_a_mode_is_picked_by_what_is_measured() -> None:
    for mode in _MODES:
        monitor = Monitor(_MODES)
        assert len(monitor.feed(_signal(mode, [_noise(mode, 0)] * 3))) == 1
        assert monitor.mode == mode
