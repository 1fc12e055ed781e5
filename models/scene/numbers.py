"""Numbers of scene files as raw integers: rounded to the nearest step, refused with a remedy out of range."""

import math
from fractions import Fraction

from models.fixed import BOOK, COLOUR, RADIUS, Format
from models.limits import INDEX_STEP
from models.scene.types import INDEX

_LARGEST_INDEX = 1 + INDEX.max * INDEX_STEP


def nearest(value: float | Fraction, fmt: Format) -> int:
    """Raw integer nearest to a finite number, halves upward; it may lie outside the format."""
    return math.floor(Fraction(value) * fmt.one + Fraction(1, 2))


def coordinate(value: float | Fraction) -> int:
    """Signed [9.10]; ValueError says what to do about a number outside it."""
    return _within(value, BOOK, "coordinate", "scale the scene down")


def colour(value: float | Fraction) -> int:
    """Unsigned [9.10]; ValueError for a number outside it."""
    return _within(value, COLOUR, "colour value", "1.0 is full intensity")


def radius(value: float | Fraction) -> int:
    """Unsigned [2.3]; ValueError where it is outside or between two steps: a radius is not rounded."""
    exact = Fraction(value)
    smallest, largest = Fraction(1, RADIUS.one), Fraction(RADIUS.max, RADIUS.one)
    if exact > largest:
        raise ValueError(f"{show(value)} is above {show(largest)}, the largest radius; scale the scene down")
    if exact < smallest:
        raise ValueError(f"{show(value)} is below {show(smallest)}, the smallest radius; scale the scene up")
    raw = nearest(exact, RADIUS)
    if Fraction(raw, RADIUS.one) != exact:
        raise ValueError(
            f"{show(value)} is not a multiple of {show(smallest)}; the nearest radius is {raw / RADIUS.one:g}"
        )
    return raw


def refractive_index(value: float | Fraction) -> int:
    """Code of the nearest refractive index; ValueError outside 1 to 2.875."""
    exact = Fraction(value)
    if not 1 <= exact <= _LARGEST_INDEX:
        raise ValueError(f"{show(value)} is not a refractive index from 1 to {show(_LARGEST_INDEX)}")
    return math.floor((exact - 1) / INDEX_STEP + Fraction(1, 2))


def show(value: float | Fraction) -> str:
    """A number as a reader of a message wants it."""
    if isinstance(value, int):
        return str(value) if abs(value) < 10**9 else f"an integer of {len(str(abs(value)))} digits"
    return f"{float(value):.10g}"


def _within(value: float | Fraction, fmt: Format, name: str, remedy: str) -> int:
    raw = nearest(value, fmt)
    if raw > fmt.max:
        raise ValueError(f"{show(value)} is above {fmt.max / fmt.one:.10g}, the largest {name}; {remedy}")
    if raw < fmt.min:
        raise ValueError(f"{show(value)} is below {fmt.min / fmt.one:.10g}, the smallest {name}; {remedy}")
    return raw
