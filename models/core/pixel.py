"""Colours as bytes: model of ``hdl/pixel/rgb888.v`` (book 8.2.6)."""

import numpy as np

from models.fixed import Raw
from models.formats import Formats

FULL = 255


def rgb888(colour: Raw, fmts: Formats) -> Raw:
    """Channels 0 to 255 of colours in `shade`: times 255, truncated, clamped."""
    return np.asarray(np.minimum((colour * FULL) >> fmts.shade.frac_bits, FULL))
