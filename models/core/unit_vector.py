"""Direction and length of a vector of any length: model of ``hdl/trace/unit_vector.v`` (book 11.1)."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from models.arith import block_shift, normalise
from models.fixed import Raw
from models.formats import Formats


class UnitVector(NamedTuple):
    """Unit vector (3, n), norm and shift of the block floating point vector (n,), where it was 0."""

    unit: Raw
    norm: Raw
    shift: Raw
    degenerate: NDArray[np.bool_]


def unit_vector(vector: Raw, bits: int, fmts: Formats) -> UnitVector:
    """Directions of vectors (3, n) of ``bits`` bits a component, whatever their binary point."""
    shifted = block_shift(vector, bits, fmts.mantissa.width)
    unit, norm, degenerate = normalise(shifted.vector, fmts.mantissa, fmts.unit.frac_bits)
    return UnitVector(unit, norm, shifted.shift, degenerate)
