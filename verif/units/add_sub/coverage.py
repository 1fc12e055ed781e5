"""What must have been seen of the saturating sum: operands, signs, limits, lanes apart, what cancels."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from models.fixed import Raw
from verif.env.coverage.classes import any_lane
from verif.env.coverage.points import Coverage, Holds, Samples
from verif.env.coverage.rounding import ONE_BIT_WIDER, Floored, lanes_apart
from verif.env.coverage.sieve import Sieve
from verif.env.unit import Parameters
from verif.units.add_sub.unit import UNIT
from verif.units.product_coverage import factors

SIEVE = Sieve(UNIT)


def _exact(p: Parameters, s: Samples) -> Raw:
    return s["a"] - s["b"] if p["SUBTRACT"] else s["a"] + s["b"]


def _operands(matches: Callable[[Raw, Raw], NDArray[np.bool_]]) -> Holds:
    def holds(_p: Parameters, s: Samples) -> NDArray[np.bool_]:
        return any_lane(matches(s["a"], s["b"]))

    return holds


SUM = Floored(SIEVE, "sum", _exact, lambda _p: 0)

PAIRS = SIEVE.point(
    "pairs",
    "operands that belong together",
    {
        "equal": _operands(lambda a, b: (a == b) & (a != 0)),
        "opposite": _operands(lambda a, b: (a == -b) & (a != 0)),
        "complements": _operands(lambda a, b: (a == ~b) & (b > 0)),
        "neighbours": _operands(lambda a, b: (np.abs(a - b) == 1) & (a != 0) & (b != 0)),
    },
)

COVERAGE = Coverage(
    (
        *factors(UNIT.inputs, "a", "b"),
        SUM.limits(leave_out=ONE_BIT_WIDER),
        lanes_apart(SIEVE, "sum"),
        PAIRS,
    )
)
