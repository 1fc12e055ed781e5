"""What must have been seen of the exact multiplier: factors, extreme products, pieces at their edges."""

from collections.abc import Callable

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

from models.fixed import Raw
from verif.env.coverage.classes import any_lane, port
from verif.env.coverage.points import Coverage, Holds, Point, Samples
from verif.env.coverage.sieve import Sieve
from verif.env.fields import Operands
from verif.env.operands import stream
from verif.env.unit import Parameters
from verif.units.mul.unit import UNIT
from verif.units.product_coverage import factors

PIECE = 17
"""Bits of a piece that is not the last one, see hdl/arith/mul.v."""
LOW = (1 << PIECE) - 1


def _at_piece_edges(p: Parameters, generator: Generator, size: int) -> Operands:
    """Factors whose pieces are all zeros, all ones, or anything; every fourth is a square where it can be."""
    found = {}
    for field in UNIT.inputs(p):
        drawn = stream(generator, (field,), size)[field.name]
        piece = generator.choice([0, 1, LOW, LOW - 1], drawn.shape)
        kept = np.where(generator.random(drawn.shape) < 0.5, drawn & LOW, piece)
        upper = np.where(generator.random(drawn.shape) < 0.5, drawn >> PIECE, -1)
        edge = (upper << PIECE) + kept if field.signed else (np.abs(upper) << PIECE) + kept
        found[field.name] = np.clip(edge, field.low, field.high)
    square = np.arange(size) % 4 == 0
    b = port(UNIT.inputs, p, "b")
    return {**found, "b": np.where(square, np.clip(found["a"], b.low, b.high), found["b"])}


SIEVE = Sieve(UNIT)
EDGES = SIEVE.of("pieces at their edges", _at_piece_edges)


def _extremes(first: str, second: str) -> Holds:
    def holds(p: Parameters, s: Samples) -> NDArray[np.bool_]:
        a, b = port(UNIT.inputs, p, "a"), port(UNIT.inputs, p, "b")
        return any_lane((s["a"] == getattr(a, first)) & (s["b"] == getattr(b, second)))

    return holds


EXTREMES = SIEVE.point(
    "extremes",
    "both factors at a limit: the largest and the smallest products",
    {f"{a}_{b}": _extremes(a, b) for a in ("low", "high") for b in ("low", "high")},
)


def _pieces(name: str) -> Point:
    """Of one factor where it has more than one."""

    def case(matches: Callable[[Raw, Raw], NDArray[np.bool_]]) -> Holds:
        def holds(p: Parameters, s: Samples) -> NDArray[np.bool_]:
            if port(UNIT.inputs, p, name).width <= PIECE + 1:
                return np.zeros(s[name].shape[-1], dtype=np.bool_)
            return any_lane(matches(s[name] >> PIECE, s[name] & LOW))

        return holds

    cases = {
        "lower_zero": case(lambda upper, lower: (lower == 0) & (upper > 0)),
        "lower_zero_of_negative": case(lambda upper, lower: (lower == 0) & (upper < 0)),
        "lower_all_ones": case(lambda upper, lower: (lower == LOW) & (upper > 0)),
        "lower_all_ones_of_negative": case(lambda upper, lower: (lower == LOW) & (upper < -1)),
        "upper_zero": case(lambda upper, lower: (upper == 0) & (lower > 1)),
        "upper_all_ones": case(lambda upper, lower: (upper == -1) & (lower > 1) & (lower < LOW)),
    }
    return EDGES.point(f"pieces_of_{name}", f"pieces of 17 bits of {name}, and what is above", cases)


def _squares(sign: int) -> Holds:
    def holds(_p: Parameters, s: Samples) -> NDArray[np.bool_]:
        return any_lane((s["a"] == s["b"]) & (s["a"] * sign > 1))

    return holds


SQUARES = EDGES.point("squares", "equal factors", {"positive": _squares(1), "negative": _squares(-1)})

COVERAGE = Coverage((*factors(UNIT.inputs, "a", "b"), EXTREMES, _pieces("a"), _pieces("b"), SQUARES))
