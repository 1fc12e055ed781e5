"""What must have been seen of a square root: radicands of every class, remainders at their limits."""

from collections.abc import Callable, Mapping

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

from models.fixed import Raw
from verif.env.coverage.classes import operand
from verif.env.coverage.points import Bin, Coverage, Holds, Point, Recipe, Samples, Shape
from verif.env.fields import Operands
from verif.env.unit import Parameters
from verif.units.sqrt.unit import radicand


def _square_plus(offset: int, *, twice: bool = False) -> Shape:
    """Radicands a root's square plus ``offset``, or plus twice the root too."""

    def shape(p: Parameters, generator: Generator, operands: Operands) -> Operands:
        bits = p["D_W"] // 2
        size = operands["radicand"].shape[-1]
        root = generator.integers(2, 1 << bits, size) >> generator.integers(0, bits - 1, size)
        found = root * root + offset + (2 * root if twice else 0)
        return {"radicand": np.asarray(np.clip(found, 0, (1 << p["D_W"]) - 1))}

    return shape


RootAndRest = Callable[[Parameters, Samples], tuple[Raw, Raw]]
"""A root, and what it leaves of its radicand."""


def remainder_cases(taken: RootAndRest) -> Mapping[str, Holds]:
    """The remainder at its limits 0 and twice the root, beside them, and between: no case is another one."""

    def case(wanted: Callable[[Raw], Raw]) -> Holds:
        def holds(p: Parameters, s: Samples) -> NDArray[np.bool_]:
            root, rest = taken(p, s)
            return np.asarray((rest == wanted(root)) & (root > 1))

        return holds

    return {
        "zero": case(lambda root: 0 * root),
        "one": case(lambda root: 0 * root + 1),
        "half": case(lambda root: root),
        "just_below_twice_the_root": case(lambda root: 2 * root - 1),
        "twice_the_root": case(lambda root: 2 * root),
    }


def _half(p: Parameters, generator: Generator, operands: Operands) -> Operands:
    squares = _square_plus(0)(p, generator, operands)["radicand"]
    root = np.sqrt(squares).astype(np.int64)
    return {"radicand": squares + root}


_RADICANDS = {
    "zero": Recipe("perfect squares", _square_plus(0)),
    "one": Recipe("squares and one", _square_plus(1)),
    "half": Recipe("squares and their roots", _half),
    "just_below_twice_the_root": Recipe("two below the next square", _square_plus(-1, twice=True)),
    "twice_the_root": Recipe("one below the next square", _square_plus(0, twice=True)),
}

REMAINDER = Point(
    "remainder",
    "what the root leaves, of 0 to twice the root",
    tuple(
        Bin(name, _RADICANDS[name], holds)
        for name, holds in remainder_cases(lambda _p, s: (s["root"], s["remainder"])).items()
    ),
)


def _parity(odd: bool) -> Holds:
    def holds(_p: Parameters, s: Samples) -> NDArray[np.bool_]:
        return np.asarray(s["root"] % 2 == odd)

    return holds


LAST_STEP = Point(
    "last_step",
    "the last bit of the root: the last step adds after it, or subtracts",
    (
        Bin("subtracted", Recipe("perfect squares", _square_plus(0)), _parity(True)),
        Bin("restored", Recipe("perfect squares", _square_plus(0)), _parity(False)),
    ),
)

POINTS = (operand(radicand, "radicand", signed=False), REMAINDER, LAST_STEP)
COVERAGE = Coverage(POINTS)
