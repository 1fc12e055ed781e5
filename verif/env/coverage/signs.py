"""The same cases of positive and of negative numbers: truncation and floor differ in nothing else."""

from collections.abc import Callable, Mapping
from typing import TypeVar

from verif.env.coverage.points import Holds

C = TypeVar("C")


def by_sign(holds: Callable[[int, C], Holds], cases: Mapping[str, C]) -> dict[str, Holds]:
    """Bins ``<case>_positive`` and ``<case>_negative``; holds: makes a bin of a sign, 1 or -1, and a case."""
    return {
        f"{name}_{side}": holds(sign, case)
        for side, sign in (("positive", 1), ("negative", -1))
        for name, case in cases.items()
    }
