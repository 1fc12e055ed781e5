"""Recipes that draw many operands and keep the few that reach a bin, as the unit's model tells.

Nothing has to be solved for: a source only has to make the bin common enough, one in some thousands. What
is drawn costs no clock; what is kept does.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.random import Generator

from verif.env.coverage.points import Bin, Holds, Point, Recipe, Samples, Shape, Stages
from verif.env.fields import Operands, concatenate, count, select
from verif.env.operands import stream
from verif.env.unit import ArithmeticUnit, Parameters

_TIMES = 64
"""Operands that are drawn for one that is asked for."""
_MOST = 1 << 16
"""But no more than so many."""
_FEW = 4
"""Operands that are kept at most: they are known to reach the bin."""

Draw = Callable[[Parameters, Generator, int], Operands]
"""About so many operands, as a unit's `directed` draws them."""


def with_results(unit: ArithmeticUnit, parameters: Parameters, operands: Operands) -> Samples:
    """Operands and what the model makes of them, as a bench samples both."""
    results = unit.model(parameters, operands)
    return {**operands, **{name: np.asarray(values, dtype=np.int64) for name, values in results.items()}}


def mixed(unit: ArithmeticUnit) -> Draw:
    """What a fast stream is mixed of: operands of all classes and the unit's own directed ones."""

    def draw(parameters: Parameters, generator: Generator, size: int) -> Operands:
        classes = stream(generator, unit.inputs(parameters), size)
        if unit.directed is None:
            return classes
        return concatenate([classes, unit.directed(parameters, generator, size)])

    return draw


@dataclass(frozen=True)
class Sieve:
    """Makes bins of a unit whose recipes keep what reaches them.

    source: what is drawn, and its name. stages: those of the unit's coverage.
    """

    unit: ArithmeticUnit
    name: str = "mixed operands"
    source: Draw | None = field(default=None)
    stages: Stages | None = field(default=None)

    def of(self, name: str, source: Draw) -> "Sieve":
        """The same with another source."""
        return replace(self, name=name, source=source)

    def directed(self, name: str) -> "Sieve":
        """The same with the unit's directed operands alone. Raises ValueError where it has none."""
        if self.unit.directed is None:
            raise ValueError(f"{self.unit.name} has no directed operands")
        return self.of(name, self.unit.directed)

    def shape(self, holds: Holds) -> Shape:
        """Operands for which something holds; a few that were drawn, where it holds for none."""
        draw = self.source or mixed(self.unit)

        def shape(parameters: Parameters, generator: Generator, operands: Operands) -> Operands:
            wanted = draw(parameters, generator, min(_TIMES * count(operands), _MOST))
            drawn = self.unit.legal(parameters, wanted)
            samples = with_results(self.unit, parameters, drawn)
            if self.stages is not None:
                samples = {**samples, **self.stages(parameters, samples)}
            reached = np.flatnonzero(holds(parameters, samples))
            return select(drawn, reached[:_FEW] if reached.size else slice(0, _FEW))

        return shape

    def bin(self, point: str, name: str, holds: Holds) -> Bin:
        """A bin of a point."""
        return Bin(name, Recipe(f"{self.name}: {point} {name}", self.shape(holds)), holds)

    def point(self, name: str, doc: str, cases: Mapping[str, Holds]) -> Point:
        """A bin a case."""
        return Point(name, doc, tuple(self.bin(name, case, holds) for case, holds in cases.items()))

    def again(self, point: Point) -> Point:
        """A point, such as a cross, with recipes of this source instead of its own."""
        cases = {found.name: found.holds for found in point.bins if found.holds is not None}
        return self.point(point.name, point.doc, cases)
