"""Cover points of vectors in space: the octants they point to, the axes and planes they lie in."""

from collections.abc import Callable, Mapping
from itertools import product

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

from models.fixed import Raw
from verif.env.coverage.classes import all_lanes, port
from verif.env.coverage.points import Bin, Holds, Point, Recipe, Samples, Shape
from verif.env.fields import Operands
from verif.env.unit import ArithmeticUnit, Parameters

_AXES = "xyz"
_SIGNS = {1: "plus", -1: "minus", 0: "no"}


Signs = tuple[int, int, int]
_OCTANTS: tuple[Signs, ...] = tuple((x, y, z) for x, y, z in product((1, -1), repeat=3))
_ALONE: tuple[Signs, ...] = tuple(
    (x, y, z) for x, y, z in product((1, 0, -1), repeat=3) if abs(x) + abs(y) + abs(z) <= 1
)
_PLANES: tuple[Signs, ...] = ((1, 1, 0), (0, 1, -1), (-1, 0, 1))

Vector = Callable[[Samples], Raw]
"""A vector (3, n) of operands."""


def _label(signs: Signs) -> str:
    return "_".join(f"{_SIGNS[sign]}_{axis}" for sign, axis in zip(signs, _AXES, strict=True))


def _has(vector: Vector, signs: Signs) -> Holds:
    wanted = np.array(signs)[:, None]

    def holds(_parameters: Parameters, samples: Samples) -> NDArray[np.bool_]:
        return all_lanes(np.sign(vector(samples)) == wanted)

    return holds


def octant_cases(vector: Vector) -> Mapping[str, Holds]:
    """Each octant, no component zero, of what is no operand itself."""
    return {_label(signs): _has(vector, signs) for signs in _OCTANTS}


def axis_cases(vector: Vector) -> Mapping[str, Holds]:
    """Along each axis, either way, in each plane of two of them, and the zero vector; likewise."""
    return {_label(signs): _has(vector, signs) for signs in (*_ALONE, *_PLANES)}


def _turned(unit: ArithmeticUnit, name: str, signs: Signs) -> Shape:
    """Vectors as they were drawn, their components turned to these signs."""
    wanted = np.array(signs)[:, None]

    def shape(parameters: Parameters, _generator: Generator, operands: Operands) -> Operands:
        field = port(unit.inputs, parameters, name)
        size = np.clip(np.abs(operands[name]), 1, field.high)
        return {**operands, name: size * wanted}

    return shape


def _of_operand(unit: ArithmeticUnit, name: str, what: str, every: tuple[Signs, ...]) -> Point:
    bins = []
    for signs in every:
        label = _label(signs)
        recipe = Recipe(f"{name} of {label}", _turned(unit, name, signs))
        bins.append(Bin(label, recipe, _has(lambda samples: samples[name], signs)))
    return Point(f"{what}_of_{name}", f"{what} of {name}", tuple(bins))


def octants(unit: ArithmeticUnit, name: str) -> Point:
    """`octant_cases` of an operand."""
    return _of_operand(unit, name, "octants", _OCTANTS)


def axes(unit: ArithmeticUnit, name: str) -> Point:
    """`axis_cases` of an operand."""
    return _of_operand(unit, name, "axes", (*_ALONE, *_PLANES))
