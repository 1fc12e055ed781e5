"""The way to a light: model of ``hdl/shade/light_vector.v`` (book 8.2.3)."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from models.core.unit_vector import unit_vector
from models.fixed import Raw
from models.formats import Formats
from models.limits import INFINITY


class LightVector(NamedTuple):
    """Direction to the light (3, n) in `unit`, distance (n,) in `point`, at most infinity; light at the
    point."""

    direction: Raw
    limit: Raw
    degenerate: NDArray[np.bool_]


def light_vector(point: Raw, light: Raw, fmts: Formats) -> LightVector:
    """From hit points (3, n) to a light (3, 1) or lights."""
    reach = (light << (fmts.point.frac_bits - fmts.coord.frac_bits)) - point
    unit, norm, shift, degenerate = unit_vector(reach, fmts.reach.width, fmts)
    grow = fmts.reach.int_bits - 2 + fmts.point.frac_bits - fmts.unit.frac_bits
    length = (norm << grow) >> shift
    return LightVector(unit, np.minimum(length, int(INFINITY * fmts.point.one)), degenerate)
