"""What the screen shows: timing of a mode, depth of the stored colours, place of the picture (`hdl/video`).

Pictures are uint8 arrays (h, w, 3). A stored colour is a code {r, g, b} of `Store.depth_bits` bits; 16 of
them are the usual 565.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from models.images import Rgb

Codes = NDArray[np.uint32]
_CHANNEL_BITS = 8


@dataclass(frozen=True)
class Axis:
    """One direction of a mode, in pixel clocks or in lines, in the order of time from the first active one.

    active: what is seen; front: porch before the pulse; sync: the pulse; back: porch behind it;
    positive: the pulse is high.
    """

    active: int
    front: int
    sync: int
    back: int
    positive: bool = False

    def __post_init__(self) -> None:
        if min(self.active, self.front, self.sync, self.back) < 1:
            raise ValueError(f"{self}: active part, porches and pulse are 1 or more")

    @property
    def total(self) -> int:
        """From one pulse to the next."""
        return self.active + self.front + self.sync + self.back

    @property
    def lead(self) -> int:
        """From the beginning of the pulse to the first active one: what a monitor waits for."""
        return self.sync + self.back


@dataclass(frozen=True)
class Mode:
    """A mode of the screen. Lines begin with their pulse, and the vertical pulse with that of a line."""

    name: str
    pixel_clock_hz: int
    horizontal: Axis
    vertical: Axis

    @property
    def clocks(self) -> int:
        """Pixel clocks of a frame."""
        return self.horizontal.total * self.vertical.total

    @property
    def line_hz(self) -> float:
        """Lines a second."""
        return self.pixel_clock_hz / self.horizontal.total

    @property
    def refresh_hz(self) -> float:
        """Frames a second."""
        return self.pixel_clock_hz / self.clocks

    @property
    def size(self) -> tuple[int, int]:
        """Width and height of what is seen."""
        return self.horizontal.active, self.vertical.active


VGA = Mode("640 x 480 at 60 Hz", 25_175_000, Axis(640, 16, 96, 48), Axis(480, 10, 2, 33))
"""The industry's standard mode; both pulses are low."""


@dataclass(frozen=True)
class Store:
    """The frame buffer: size of a stored picture and bits of a pixel."""

    width: int = 320
    height: int = 240
    depth_bits: int = 16

    def __post_init__(self) -> None:
        if min(self.width, self.height) < 1 or not 3 <= self.depth_bits <= 3 * _CHANNEL_BITS:
            raise ValueError(f"{self}: width and height are 1 or more, depth_bits is 3 to 24")

    @property
    def channel_bits(self) -> tuple[int, int, int]:
        """Bits of red, green and blue: a third each; one that is left over is green's, a second red's."""
        return (self.depth_bits + 1) // 3, (self.depth_bits + 2) // 3, self.depth_bits // 3

    def crop(self, picture: Rgb) -> Rgb:
        """What of a picture is kept: its upper left part, where it is too large."""
        return picture[: self.height, : self.width]

    def codes(self, picture: Rgb) -> Codes:
        """The stored colours: the top bits of each channel."""
        packed: Codes = np.zeros(picture.shape[:-1], dtype=np.uint32)
        for channel, bits in enumerate(self.channel_bits):
            top = picture[..., channel] >> (_CHANNEL_BITS - bits)
            packed = packed << np.uint32(bits) | top.astype(np.uint32)
        return packed

    def colours(self, codes: Codes) -> Rgb:
        """Bytes of stored colours: the bits of a channel, repeated from the top until there are eight.

        So 0 stays 0 and the largest code becomes 255.
        """
        channels = []
        left = self.depth_bits
        for bits in self.channel_bits:
            left -= bits
            code = codes >> np.uint32(left) & np.uint32((1 << bits) - 1)
            repeats = -(-_CHANNEL_BITS // bits)
            repeated = code * np.uint32(sum(1 << bits * number for number in range(repeats)))
            channels.append(repeated >> np.uint32(bits * repeats - _CHANNEL_BITS))
        return np.stack(channels, axis=-1).astype(np.uint8)


STORE = Store()
"""Two of these, in 16 bits a pixel, fit the block memory of a mid-size FPGA."""


def factor(mode: Mode, store: Store) -> int:
    """How often a stored pixel is repeated in either direction. ValueError where the screen is too small."""
    found = min(mode.horizontal.active // store.width, mode.vertical.active // store.height)
    if found < 1:
        raise ValueError(f"{store.width} x {store.height} does not fit {mode.name}")
    return found


def screen(picture: Rgb | None, mode: Mode = VGA, store: Store = STORE) -> Rgb:
    """What is seen while this picture is shown, or before the first one: black around what there is."""
    seen = np.zeros((mode.vertical.active, mode.horizontal.active, 3), dtype=np.uint8)
    if picture is None:
        return seen
    times = factor(mode, store)
    shown = store.colours(store.codes(store.crop(picture)))
    shown = shown.repeat(times, axis=0).repeat(times, axis=1)
    height, width = shown.shape[:2]
    top, left = (seen.shape[0] - height) // 2, (seen.shape[1] - width) // 2
    seen[top : top + height, left : left + width] = shown
    return seen


@dataclass(frozen=True)
class Waveform:
    """The signals of a whole frame, clock by clock from the beginning of the vertical pulse.

    hsync, vsync, de: levels, bool (clocks,); rgb: uint8 (clocks, 3), 0 where de is low.
    """

    hsync: NDArray[np.bool_]
    vsync: NDArray[np.bool_]
    de: NDArray[np.bool_]
    rgb: Rgb


def _pulse_and_active(axis: Axis) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Of one direction, from the beginning of its pulse: level of the pulse, and whether it is active."""
    time = np.arange(axis.total)
    active = (time >= axis.lead) & (time < axis.lead + axis.active)
    return (time < axis.sync) == axis.positive, active


def waveform(mode: Mode, seen: Rgb | None = None) -> Waveform:
    """What a frame of a mode looks like on the wires while this is seen, or black."""
    hsync, column = _pulse_and_active(mode.horizontal)
    vsync, line = _pulse_and_active(mode.vertical)
    de = line[:, np.newaxis] & column
    rgb = np.zeros((*de.shape, 3), dtype=np.uint8)
    if seen is not None:
        rgb[de] = seen.reshape(-1, 3)
    return Waveform(
        hsync=np.tile(hsync, mode.vertical.total),
        vsync=vsync.repeat(mode.horizontal.total),
        de=de.ravel(),
        rgb=rgb.reshape(-1, 3),
    )
