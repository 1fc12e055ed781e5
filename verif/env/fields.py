"""Named ports as arrays of numbers: how operands are packed on a bus and read back.

An `Operands` maps field names to ``int64`` arrays of shape ``(lanes, n)``, or ``(n,)`` where the
field has one lane; lane 0 is in the most significant bits, as x is in a vector.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from models.fixed import Format, Raw

Operands = Mapping[str, Raw]


@dataclass(frozen=True)
class Field:
    """One port: ``lanes`` numbers of ``width`` bits (at most 63) each, ``frac_bits`` of them fraction."""

    name: str
    width: int
    lanes: int = 1
    signed: bool = True
    frac_bits: int = 0

    @classmethod
    def of(cls, name: str, fmt: Format, lanes: int = 1) -> "Field":
        """A port that carries numbers of a format."""
        return cls(name, fmt.width, lanes, fmt.signed, fmt.frac_bits)

    @property
    def bits(self) -> int:
        """Width of the port."""
        return self.width * self.lanes

    @property
    def low(self) -> int:
        """Smallest value of a lane."""
        return -(1 << (self.width - 1)) if self.signed else 0

    @property
    def high(self) -> int:
        """Largest value of a lane."""
        return (1 << (self.width - int(self.signed))) - 1


def join(fields: Sequence[Field], operands: Operands) -> list[int]:
    """One word an operand, the first field in the most significant bits."""
    words = np.zeros(count(operands), dtype=object)
    for field in fields:
        mask = (1 << field.width) - 1
        for lane in operands[field.name].reshape(field.lanes, -1):
            words = (words << field.width) | (lane & mask)
    return [int(word) for word in words]


def split(fields: Sequence[Field], words: Sequence[int]) -> Operands:
    """The operands that `join` made words of."""
    packed = np.array(words, dtype=object)
    low = sum(field.bits for field in fields)
    operands: dict[str, Raw] = {}
    for field in fields:
        lanes = np.empty((field.lanes, len(words)), dtype=np.int64)
        mask = (1 << field.width) - 1
        for lane in range(field.lanes):
            low -= field.width
            lanes[lane] = ((packed >> low) & mask).astype(np.int64)
        if field.signed:
            lanes -= (lanes > field.high).astype(np.int64) << field.width
        operands[field.name] = lanes if field.lanes > 1 else lanes[0]
    return operands


def bit(name: str) -> Field:
    """A port of one bit."""
    return Field(name, 1, signed=False)


def count(operands: Operands) -> int:
    """How many operands there are."""
    return int(next(iter(operands.values())).shape[-1])


def select(operands: Operands, index: slice | NDArray[np.int64]) -> Operands:
    """Some of the operands."""
    return {name: values[..., index] for name, values in operands.items()}


def concatenate(parts: Iterable[Operands]) -> Operands:
    """All operands of all parts, in order."""
    collected = list(parts)
    return {name: np.concatenate([part[name] for part in collected], axis=-1) for name in collected[0]}


def every(fields: Sequence[Field]) -> Operands:
    """Each combination of all values of all fields, once."""
    return split(fields, range(1 << sum(field.bits for field in fields)))


def describe(field: Field, values: Raw, index: int) -> str:
    """One operand, as a person reads it: each lane's raw integer, its bits, and the number it means."""
    lanes = [int(lane[index]) for lane in values.reshape(field.lanes, -1)]
    return f"{field.name} = {', '.join(_describe_lane(field, lane) for lane in lanes)}"


def _describe_lane(field: Field, raw: int) -> str:
    number = f" = {raw / (1 << field.frac_bits)}" if field.frac_bits else ""
    return f"{raw} (0x{raw & ((1 << field.width) - 1):x}{number})"


def describe_all(fields: Sequence[Field], operands: Operands, index: int) -> str:
    """One operand with all its fields, one a line, indented."""
    return "\n".join(f"  {describe(field, operands[field.name], index)}" for field in fields)
