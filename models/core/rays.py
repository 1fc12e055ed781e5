"""Directions of pixels: model of ``hdl/trace/ray_generator.v`` (book 8.2.1)."""

from models.core.camera import Basis
from models.fixed import Raw


def ray_generator(basis: Basis, width: int, height: int, x: Raw, y: Raw) -> Raw:
    """Directions (3, n) of pixels (x, y), not normalised, in the format `screen`.

    ``base + floor((2 x + 1) / width * |span|) * sign`` and so for the rows, each exact: the hardware
    steps and carries a remainder, the model divides.
    """
    column = (2 * x + 1) * basis.column_span // width
    row = (2 * y + 1) * basis.row_span // height
    return basis.base + basis.column_sign * column + basis.row_sign * row
