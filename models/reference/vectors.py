"""Vector arithmetic on arrays of shape (3, n), x, y, z first; (3, 1) broadcasts."""

import numpy as np
from numpy.typing import NDArray

from models.fixed import BOOK
from models.scene.types import Vec3

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
Ints = NDArray[np.int64]


def column(raw: Vec3) -> Floats:
    """A raw vector of 10 fraction bits as a column (3, 1) of numbers; the conversion is exact."""
    return np.array(raw, dtype=np.float64)[:, None] / BOOK.one


def dot(a: Floats, b: Floats) -> Floats:
    """(n,)"""
    product: Floats = a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
    return product


def cross(a: Floats, b: Floats) -> Floats:
    """(3, n)"""
    return np.stack([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


def normalise(a: Floats) -> Floats:
    """Unit vectors; the zero vector stays zero."""
    length = np.sqrt(dot(a, a))
    return a / np.where(length > 0, length, 1.0)
