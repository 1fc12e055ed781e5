"""Functional coverage as it is declared: points, their bins, and the recipe that reaches each bin.

A unit's `coverage.py` holds one `Coverage`, named COVERAGE. What is sampled is a table of numbers: of an
arithmetic unit operands and results together, a column an operand; of a clocked block its signals, a
column a clock. A bin is a predicate on such a table, so a hundred thousand operands cost as many calls as
one. This module imports no cocotb.
"""

from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

from models.fixed import Raw
from verif.env.fields import Operands
from verif.env.unit import Parameters

Samples = Mapping[str, Raw]
"""Values by name, each ``(n,)`` or ``(lanes, n)``; a signal with unknown bits is sampled as -1."""

Holds = Callable[[Parameters, Samples], NDArray[np.bool_]]
"""Per column, whether the bin is hit."""

Shape = Callable[[Parameters, Generator, Operands], Operands]
"""Turns operands of any kind into as many that reach a bin, or are likely to."""


@dataclass(frozen=True)
class Recipe:
    """How a bin is reached: by operands of a shape, or, without one, by the bench's scenario of this name."""

    name: str
    shape: Shape | None = None

    def then(self, other: "Recipe") -> "Recipe":
        """Both, this one first. Raises ValueError where one is a scenario."""
        first, second = self.shape, other.shape
        if first is None or second is None:
            raise ValueError(f"{self.name} and {other.name}: only recipes of operands can be joined")

        def shape(parameters: Parameters, generator: Generator, operands: Operands) -> Operands:
            return second(parameters, generator, first(parameters, generator, operands))

        return Recipe(f"{self.name}, {other.name}", shape)


@dataclass(frozen=True)
class Bin:
    """One case that must have been seen. holds: None where the bench tells of it by name instead."""

    name: str
    recipe: Recipe
    holds: Holds | None = None


@dataclass(frozen=True)
class Point:
    """Bins that belong together; doc says what they are cases of."""

    name: str
    doc: str
    bins: tuple[Bin, ...]


Stages = Callable[[Parameters, Samples], Samples]
"""What a design computes on its way, of samples, by names that no port has."""


@dataclass(frozen=True)
class Coverage:
    """All that must have been seen of one unit.

    stages: computed once for all bins, beside what is sampled.
    signals: what is sampled of a clocked block every clock, by name below its top (`fifo.level_reg`);
    an arithmetic unit's operands and results are sampled without being named.
    """

    points: tuple[Point, ...]
    signals: tuple[str, ...] = ()
    stages: Stages | None = None

    def __post_init__(self) -> None:
        twice = [name for name, number in Counter(name for name, _ in self.bins()).items() if number > 1]
        if twice:
            raise ValueError(f"cover bins are named twice: {', '.join(twice)}")

    def bins(self) -> Iterable[tuple[str, Bin]]:
        """Every bin with its name, `point.bin`."""
        return ((f"{point.name}.{found.name}", found) for point in self.points for found in point.bins)

    def seen(self, parameters: Parameters, samples: Samples) -> Samples:
        """What bins are asked about: samples, and the stages between them."""
        return samples if self.stages is None else {**samples, **self.stages(parameters, samples)}

    def with_points(self, more: Sequence[Point]) -> "Coverage":
        """These points and others."""
        return replace(self, points=(*self.points, *more))


def cross(
    first: Point,
    second: Point,
    *,
    name: str = "",
    recipe: Recipe | None = None,
    leave_out: Callable[[str, str], bool] = lambda _first, _second: False,
) -> Point:
    """Every bin of one point together with every bin of another.

    leave_out: says of two names that they exclude each other. recipe: for all bins; without it each has
    both of its bins' recipes, the first's first.
    """
    bins = tuple(
        Bin(f"{one.name}_and_{other.name}", recipe or one.recipe.then(other.recipe), _both(one, other))
        for one in first.bins
        for other in second.bins
        if not leave_out(one.name, other.name)
    )
    return Point(name or f"{first.name}_x_{second.name}", f"{first.doc}, with {second.doc}", bins)


def _both(one: Bin, other: Bin) -> Holds:
    if one.holds is None or other.holds is None:
        raise ValueError(f"{one.name} and {other.name}: a bin that the bench tells of cannot be crossed")
    first, second = one.holds, other.holds

    def holds(parameters: Parameters, samples: Samples) -> NDArray[np.bool_]:
        return np.asarray(first(parameters, samples) & second(parameters, samples))

    return holds
