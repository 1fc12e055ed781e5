"""A vector divided by its norm: model of ``hdl/arith/normalise.v`` (book 10.1.5.3)."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from models.arith.divide import truncating_divide
from models.arith.norm import norm
from models.fixed import Format, Raw


class Normalised(NamedTuple):
    """Unit vector (3, n) in signed ``[2.out_frac]``, norm (n,) in `norm_format`, and where it was 0."""

    unit: Raw
    norm: Raw
    degenerate: NDArray[np.bool_]


def normalise(a: Raw, fmt: Format, out_frac: int = 10, guard: int = 0) -> Normalised:
    """Vectors (3, n) in ``fmt`` over their norm with ``guard`` bits, each component truncated toward zero.

    The zero vector gives zero and is ``degenerate``. Raises ValueError where an intermediate needs more
    than 63 bits.
    """
    Format(2, out_frac)
    length = norm(a, fmt, guard)
    shift = out_frac + guard
    unit = truncating_divide(a, np.maximum(length, 1), shift, bits=fmt.width + shift)
    return Normalised(unit, length, np.asarray(np.equal(length, 0)))
