"""Operands worth trying: corners, powers of two and their neighbours, and everything between.

Undirected uniform operands leave most of a saturating unit untried; these strategies mix classes,
for Hypothesis (properties that shrink) and for NumPy (fast streams) alike.
"""

from collections.abc import Sequence

import numpy as np
from hypothesis import strategies as st

from models.fixed import Raw
from verif.env.fields import Field, Operands

CLASSES = ("corner", "power", "small", "uniform")


def corners(field: Field) -> tuple[int, ...]:
    """Extremes, zero, one and their neighbours."""
    wanted = {field.low, field.low + 1, -1, 0, 1, field.high - 1, field.high}
    return tuple(sorted((value for value in wanted if field.low <= value <= field.high), key=abs))


def powers(field: Field) -> tuple[int, ...]:
    """Powers of two of either sign, and their neighbours."""
    magnitudes = {(1 << k) + d for k in range(field.width) for d in (-1, 0, 1)}
    wanted = magnitudes | {-value for value in magnitudes}
    return tuple(sorted((value for value in wanted if field.low <= value <= field.high), key=abs))


def integers(field: Field) -> st.SearchStrategy[int]:
    """One lane; shrinks to zero."""
    special = st.sampled_from((*corners(field), *powers(field)))
    return special | st.integers(field.low, field.high)


def batches(fields: Sequence[Field], most: int = 16) -> st.SearchStrategy[Operands]:
    """1 to ``most`` operands; one failing operand shrinks to a batch of one."""
    row = st.tuples(*[integers(field) for field in fields for _ in range(field.lanes)])
    rows = st.integers(1, most).flatmap(lambda size: st.lists(row, min_size=size, max_size=size))
    return rows.map(lambda drawn: from_rows(fields, drawn))


def from_rows(fields: Sequence[Field], rows: Sequence[Sequence[int]]) -> Operands:
    """Operands from one tuple of lanes each."""
    table = np.array(rows, dtype=np.int64).T
    operands: dict[str, Raw] = {}
    start = 0
    for field in fields:
        lanes = table[start : start + field.lanes]
        operands[field.name] = lanes if field.lanes > 1 else lanes[0]
        start += field.lanes
    return operands


def stream(generator: np.random.Generator, fields: Sequence[Field], size: int) -> Operands:
    """``size`` operands, each lane of a class of its own."""
    return {field.name: _lanes(generator, field, size) for field in fields}


def uniform(generator: np.random.Generator, fields: Sequence[Field], size: int) -> Operands:
    """``size`` operands, each lane uniform: what is drawn by who looks for nothing."""
    return {field.name: _uniform(generator, field, size) for field in fields}


def _uniform(generator: np.random.Generator, field: Field, size: int) -> Raw:
    shape = (field.lanes, size) if field.lanes > 1 else (size,)
    return generator.integers(field.low, field.high, shape, dtype=np.int64, endpoint=True)


def _lanes(generator: np.random.Generator, field: Field, size: int) -> Raw:
    uniform = _uniform(generator, field, size)
    shape = uniform.shape
    corner = generator.choice(np.array(corners(field), dtype=np.int64), shape)
    power = generator.choice(np.array(powers(field), dtype=np.int64), shape)
    small = uniform >> generator.integers(0, field.width, shape)
    chosen = generator.integers(0, len(CLASSES), shape)
    return np.choose(chosen, [corner, power, small, uniform])
