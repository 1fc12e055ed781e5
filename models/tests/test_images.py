"""Pictures are saved without loss, and their distances are the textbook's."""

import math
from pathlib import Path

import numpy as np
import pytest

from models.images import difference, hit_mismatch_percent, load_png, psnr_db, save_png

RAMP = np.arange(48, dtype=np.uint8).reshape(4, 4, 3)


def test_a_saved_picture_reads_back_as_itself(tmp_path: Path) -> None:
    path = tmp_path / "new" / "folder" / "ramp.png"
    save_png(path, RAMP)
    np.testing.assert_array_equal(load_png(path), RAMP)


def test_the_psnr_of_equal_pictures_is_infinite() -> None:
    assert psnr_db(RAMP, RAMP) == math.inf


def test_the_psnr_is_the_textbooks() -> None:
    white, black = np.full((2, 2, 3), 255, np.uint8), np.zeros((2, 2, 3), np.uint8)
    assert psnr_db(white, black) == 0
    assert psnr_db(RAMP, RAMP + np.uint8(1)) == pytest.approx(48.1308, abs=1e-4)
    one = black.copy()
    one[0, 0, 0] = 1
    assert psnr_db(one, black) == pytest.approx(48.1308 + 10 * math.log10(12), abs=1e-4)


def test_the_difference_picture_is_absolute_amplified_and_clamped() -> None:
    a, b = np.array([[[10, 0, 255]]], np.uint8), np.array([[[13, 200, 255]]], np.uint8)
    assert difference(a, b).tolist() == difference(b, a).tolist() == [[[3, 200, 0]]]
    assert difference(a, b, 8).tolist() == [[[24, 255, 0]]]


def test_the_mismatch_is_a_share_of_the_pixels() -> None:
    a = np.array([[0, 1], [-1, -1]], np.int32)
    b = np.array([[0, 0], [-1, -1]], np.int32)
    assert hit_mismatch_percent(a, b) == 25
    assert hit_mismatch_percent(a, a) == 0


def test_pictures_of_different_sizes_are_not_compared() -> None:
    with pytest.raises(ValueError, match="cannot be compared"):
        psnr_db(RAMP, RAMP[:1])
    with pytest.raises(ValueError, match="cannot be compared"):
        difference(RAMP, RAMP[:, :1])
    with pytest.raises(ValueError, match="cannot be compared"):
        hit_mismatch_percent(np.zeros((2, 2), np.int32), np.zeros((1, 2), np.int32))
