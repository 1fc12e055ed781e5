"""Operands that have a shape in space, and numbers for definitions that speak of space.

Random raw vectors are almost never unit vectors, and two of them almost never stand at a right
angle; these make such classes common. Numbers are float64, whose error is far below any step.
"""

from typing import Any

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

from models.fixed import Format, Raw
from verif.env.definitions import Holds

Floats = NDArray[np.float64]

_ENOUGH, _RARE = 1_000, 0.01

SLACK = 1e-9
"""What float64 itself may be off in an oracle; a step of the core is 1e-5 and more."""


def dot(a: Floats, b: Floats) -> Floats:
    """Of vectors (3, n)."""
    return np.asarray((a * b).sum(axis=0))


def length(a: Floats) -> Floats:
    """Of vectors (3, n)."""
    return np.sqrt(dot(a, a))


def unit(a: Floats) -> Floats:
    """Vectors (3, n) over their length; the zero vector stays zero."""
    return a / np.maximum(length(a), np.finfo(np.float64).tiny)


def truncated(values: Floats, fmt: Format) -> Raw:
    """Numbers as raw integers of a format, truncated toward zero and kept in range."""
    return fmt.saturate(np.trunc(values * fmt.one).astype(np.int64))


def pick(generator: Generator, *choices: NDArray[Any]) -> NDArray[Any]:
    """For each operand, the last axis, one of the choices; they have the same shape."""
    chosen = generator.integers(0, len(choices), choices[0].shape[-1])
    return np.asarray(np.choose(chosen, choices))


def directions(generator: Generator, size: int) -> Floats:
    """Unit vectors (3, n): anywhere, along an axis, and almost along or across one."""
    anywhere = generator.standard_normal((3, size))
    axis = np.eye(3)[:, generator.integers(0, 3, size)] * generator.choice([-1.0, 1.0], size)
    tiny = 2.0 ** -generator.integers(4, 18, (3, size))
    across = np.where(generator.random((3, size)) < 1 / 3, anywhere * tiny, anywhere)
    return unit(pick(generator, anywhere, anywhere, axis, axis + anywhere * tiny, across))


def across(generator: Generator, direction: Floats) -> Floats:
    """A unit vector (3, n) at a right angle to each direction."""
    other = generator.standard_normal(direction.shape)
    return unit(np.cross(direction, other, axis=0))


def at_cosine(generator: Generator, direction: Floats, cosine: Floats) -> Floats:
    """Unit vectors (3, n) that make angles of these cosines (n,) with the directions."""
    sine = np.sqrt(np.maximum(0.0, 1.0 - cosine * cosine))
    return cosine * direction + sine * across(generator, direction)


def cosines(generator: Generator, size: int) -> Floats:
    """Cosines (n,): anything, and close to 0, to 1 and to -1."""
    anything = generator.uniform(-1.0, 1.0, size)
    step = generator.choice([-1.0, 0.0, 1.0], size) * 2.0 ** -generator.integers(6, 18, size)
    end = generator.choice([-1.0, 1.0], size) * (1.0 - np.abs(step))
    return pick(generator, anything, anything, step, end)


def where(premise: Holds, holds: Holds) -> Holds:
    """A definition that speaks only of some operands; refused where of many it speaks of hardly any."""
    if premise.size >= _ENOUGH and premise.mean() < _RARE:
        share = f"{premise.sum()} of {premise.size} operands"
        raise ValueError(f"the premise holds for {share}: that checks nothing")
    return np.asarray(~premise | holds)
