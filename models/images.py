"""Pictures: saving and comparing RGB arrays, uint8 of shape (h, w, 3)."""

import math
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

Rgb = NDArray[np.uint8]
_FULL = 255


def save_png(path: Path, rgb: Rgb) -> None:
    """Write a picture; folders above it are made."""
    path.parent.mkdir(parents=True, exist_ok=True)
    Image.fromarray(rgb, "RGB").save(path, format="PNG")


def load_png(path: Path) -> Rgb:
    """Read a picture as RGB."""
    with Image.open(path) as image:
        return np.asarray(image.convert("RGB"), dtype=np.uint8)


def psnr_db(a: Rgb, b: Rgb) -> float:
    """Peak signal-to-noise ratio over all channels in dB; infinite where the pictures are equal."""
    error = float(np.mean(np.square(_difference(a, b))))
    return 10 * math.log10(_FULL * _FULL / error) if error else math.inf


def difference(a: Rgb, b: Rgb, gain: float = 1.0) -> Rgb:
    """Absolute difference of each channel, amplified and clamped: black where the pictures agree."""
    return np.clip(np.abs(_difference(a, b)) * gain, 0, _FULL).astype(np.uint8)


def hit_mismatch_percent(a: NDArray[np.int32], b: NDArray[np.int32]) -> float:
    """Share of the pixels whose primary rays hit different objects, in percent."""
    _same_shape(a, b)
    return 100 * float(np.mean(a != b))


def _difference(a: Rgb, b: Rgb) -> NDArray[np.float64]:
    _same_shape(a, b)
    return a.astype(np.float64) - b.astype(np.float64)


def _same_shape(a: NDArray[np.generic], b: NDArray[np.generic]) -> None:
    """Broadcasting would compare pictures of different sizes without a word."""
    if a.shape != b.shape or a.size == 0:
        raise ValueError(f"pictures of shapes {a.shape} and {b.shape} cannot be compared")
