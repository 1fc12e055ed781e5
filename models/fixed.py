"""Fixed-point formats: the one meaning of ``[int.frac]`` in models, benches and generated headers.

Values are raw integers (``value * 2**frac``) held in ``numpy.int64`` arrays; a vector is an array of
shape ``(3, n)``, lanes x, y, z first, so that each lane is contiguous.
Source: project book, chapters 7.1 and 10.1.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

Raw = NDArray[np.int64]

MAX_BITS = 63
"""Widest intermediate that ``int64`` holds exactly; a format that needs more is refused."""


@dataclass(frozen=True)
class Format:
    """``[int_bits.frac_bits]``, two's complement where ``signed`` (the sign counts as an integer bit)."""

    int_bits: int
    frac_bits: int
    signed: bool = True

    def __post_init__(self) -> None:
        if self.frac_bits < 0 or not 1 <= self.width <= MAX_BITS:
            raise ValueError(f"format {self} does not fit 1 to {MAX_BITS} bits")

    def __str__(self) -> str:
        return f"{'' if self.signed else 'u'}[{self.int_bits}.{self.frac_bits}]"

    @property
    def width(self) -> int:
        """Bits on the wire."""
        return self.int_bits + self.frac_bits

    @property
    def min(self) -> int:
        """Smallest raw value."""
        return -(1 << (self.width - 1)) if self.signed else 0

    @property
    def max(self) -> int:
        """Largest raw value."""
        return (1 << (self.width - (1 if self.signed else 0))) - 1

    @property
    def one(self) -> int:
        """Raw value of 1.0."""
        return 1 << self.frac_bits

    def saturate(self, raw: ArrayLike) -> Raw:
        """Raw integers of this format's fraction, clamped to its range."""
        return np.clip(np.asarray(raw, dtype=np.int64), self.min, self.max)

    def resize(self, raw: ArrayLike, frac_bits: int) -> Raw:
        """Raw integers with ``frac_bits`` fraction bits in this format: floor, then saturate.

        The rule of the book's multiplier (10.1.3): low bits are dropped, high bits are checked.
        """
        values = np.asarray(raw, dtype=np.int64)
        drop = frac_bits - self.frac_bits
        return self.saturate(values >> drop if drop >= 0 else values << -drop)

    def to_float(self, raw: ArrayLike) -> NDArray[np.float64]:
        """Raw integers as numbers."""
        return np.asarray(raw, dtype=np.float64) / self.one


BOOK = Format(9, 10)
"""The book's signed number: coordinates and vector components."""
COLOUR = Format(9, 10, signed=False)
"""The book's unsigned number: intensities and coefficients; 1.0 is full intensity."""
RADIUS = Format(2, 3, signed=False)
"""Radius of a sphere, 0.125 to 3.875; 0 is invalid."""
