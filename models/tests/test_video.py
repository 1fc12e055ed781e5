"""The mode is the standard's, stored colours are those of 565 hardware, the picture is in its place."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from models.images import Rgb
from models.video import STORE, VGA, Axis, Mode, Store, factor, screen, waveform

DEPTHS = st.integers(3, 24)


def _noise(seed: int, width: int, height: int) -> Rgb:
    return np.random.default_rng(seed).integers(0, 256, (height, width, 3), dtype=np.uint8)


def test_the_mode_is_the_industrys_640_x_480_at_60_hz() -> None:
    assert VGA.size == (640, 480)
    assert (VGA.horizontal.total, VGA.vertical.total, VGA.clocks) == (800, 525, 420_000)
    assert VGA.line_hz == pytest.approx(31_469, abs=0.5)
    assert VGA.refresh_hz == pytest.approx(59.940, abs=5e-4)
    assert (VGA.horizontal.lead, VGA.vertical.lead) == (144, 35)
    assert not VGA.horizontal.positive and not VGA.vertical.positive


@pytest.mark.parametrize("parts", [(0, 1, 1, 1), (1, 0, 1, 1), (1, 1, 0, 1), (1, 1, 1, 0)])
def test_a_mode_without_one_of_its_parts_is_refused(parts: tuple[int, int, int, int]) -> None:
    with pytest.raises(ValueError, match="1 or more"):
        Axis(*parts)


def test_two_stored_pictures_are_as_large_as_promised() -> None:
    assert (STORE.width, STORE.height, STORE.depth_bits) == (320, 240, 16)
    assert STORE.channel_bits == (5, 6, 5)


@pytest.mark.parametrize(
    ("depth", "bits"),
    [(24, (8, 8, 8)), (16, (5, 6, 5)), (15, (5, 5, 5)), (12, (4, 4, 4)), (8, (3, 3, 2)), (3, (1, 1, 1))],
)
def test_depths_are_shared_as_hardware_usually_does(depth: int, bits: tuple[int, int, int]) -> None:
    assert Store(depth_bits=depth).channel_bits == bits


def test_a_colour_in_565_is_the_known_one() -> None:
    colours = np.array([[0xFF, 0x80, 0x08], [0x07, 0x03, 0x07], [0x12, 0x34, 0x56]], np.uint8)
    assert STORE.codes(colours).tolist() == [0xFC01, 0x0000, 0x11AA]
    assert STORE.colours(STORE.codes(colours)).tolist() == [[255, 130, 8], [0, 0, 0], [16, 52, 82]]


@given(DEPTHS)
def test_colours_grow_with_codes_from_0_to_255_and_keep_their_top_bits(depth: int) -> None:
    store = Store(depth_bits=depth)
    ramp = np.repeat(np.arange(256, dtype=np.uint8)[:, np.newaxis], 3, axis=1)
    shown = store.colours(store.codes(ramp)).astype(int)
    assert shown[0].tolist() == [0, 0, 0] and shown[-1].tolist() == [255, 255, 255]
    assert (np.diff(shown, axis=0) >= 0).all()
    for channel, bits in enumerate(store.channel_bits):
        assert len(np.unique(shown[:, channel])) == 1 << bits
        assert (shown[:, channel] >> (8 - bits) == ramp[:, channel] >> (8 - bits)).all()


@given(DEPTHS, st.integers(0, 99))
def test_a_stored_colour_stores_as_itself(depth: int, seed: int) -> None:
    store = Store(depth_bits=depth)
    codes = store.codes(_noise(seed, 5, 4))
    assert np.array_equal(store.codes(store.colours(codes)), codes)


def _pixel(picture: Rgb, mode: Mode, store: Store, x: int, y: int) -> list[int]:
    """One pixel of the screen, from the words of the rule."""
    times = min(mode.horizontal.active // store.width, mode.vertical.active // store.height)
    width, height = min(picture.shape[1], store.width), min(picture.shape[0], store.height)
    left = (mode.horizontal.active - width * times) // 2
    top = (mode.vertical.active - height * times) // 2
    column, row = (x - left) // times, (y - top) // times
    if not (0 <= column < width and 0 <= row < height):
        return [0, 0, 0]
    colour = []
    for byte, bits in zip(picture[row, column], store.channel_bits, strict=True):
        digits = f"{int(byte):08b}"[:bits]
        colour.append(int((digits * 8)[:8], 2))
    return colour


@given(
    st.tuples(st.integers(1, 9), st.integers(1, 9)),
    st.tuples(st.integers(1, 9), st.integers(1, 9)),
    st.tuples(st.integers(0, 12), st.integers(0, 12)),
    DEPTHS,
)
def test_every_pixel_of_the_screen_is_the_rules(
    picture_size: tuple[int, int], store_size: tuple[int, int], more: tuple[int, int], depth: int
) -> None:
    store = Store(*store_size, depth)
    sides = (Axis(size + extra, 1, 1, 1) for size, extra in zip(store_size, more, strict=True))
    mode = Mode("drawn", 1, *sides)
    picture = _noise(depth, *picture_size)
    seen = screen(picture, mode, store)
    assert seen.shape[:2] == mode.size[::-1]
    for y, row in enumerate(seen):
        assert row.tolist() == [_pixel(picture, mode, store, x, y) for x in range(len(row))]


def test_the_default_picture_fills_the_default_screen() -> None:
    assert factor(VGA, STORE) == 2
    picture = _noise(1, 320, 240)
    seen = screen(picture)
    assert np.array_equal(seen[::2, ::2], seen[1::2, 1::2])
    assert (seen[::2, ::2] ^ picture < 8).all()


def test_there_is_black_before_the_first_picture() -> None:
    assert not screen(None).any()


def test_a_screen_smaller_than_the_stored_picture_is_refused() -> None:
    with pytest.raises(ValueError, match="does not fit"):
        factor(Mode("small", 1, Axis(319, 1, 1, 1), Axis(240, 1, 1, 1)), STORE)
    with pytest.raises(ValueError, match="depth_bits"):
        Store(depth_bits=2)


def _drawn(levels: NDArray[np.bool_]) -> str:
    return "".join("+" if level else "-" for level in levels)


def test_the_waveform_is_the_modes_figures_in_order() -> None:
    mode = Mode("tiny", 1, Axis(4, 1, 2, 3), Axis(2, 1, 1, 2, positive=True))
    picture = _noise(1, 4, 2)
    wave = waveform(mode, picture)
    assert _drawn(wave.hsync[:20]) == "--++++++++--++++++++"
    assert _drawn(wave.vsync) == "+" * 10 + "-" * 50
    assert _drawn(wave.de[30:50]) == "-----++++------++++-"
    assert wave.de.sum() == 8
    assert np.array_equal(wave.rgb[wave.de], picture.reshape(-1, 3))
    assert not wave.rgb[~wave.de].any()
    assert not waveform(mode).rgb.any()
