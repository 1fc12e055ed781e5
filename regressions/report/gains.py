"""What each test adds: what it hits, what nobody else hits, and what nobody before it hit."""

from collections.abc import Collection, Sequence
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Gain:
    """hit: things that a test hits. only: of these, those that no other test hits. more: of these, those that
    no test before it hits."""

    hit: int
    only: int
    more: int


def gains(hitters: Sequence[Collection[int]], tests: int) -> tuple[Gain, ...]:
    """What each of so many tests adds; hitters: of each thing the tests that hit it, as places from 0."""
    sizes = np.array([len(set(found)) for found in hitters], dtype=np.int64)
    flat = np.array([test for found in hitters for test in sorted(set(found))], dtype=np.int64)
    first = np.array([min(found) for found in hitters if found], dtype=np.int64)
    alone = flat[np.repeat(sizes == 1, sizes)]
    counts = (np.bincount(found, minlength=tests).tolist() for found in (flat, alone, first))
    return tuple(Gain(*of_test) for of_test in zip(*counts, strict=True))
