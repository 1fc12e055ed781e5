"""What must have been seen of the sum of colours: operands, the limit on either side, channels apart."""

import numpy as np

from models.fixed import Raw
from verif.env.coverage.classes import any_lane, operand, port, sign
from verif.env.coverage.points import Coverage, Samples, cross
from verif.env.coverage.rounding import ONE_BIT_WIDER, Floored, lanes_apart
from verif.env.coverage.sieve import Sieve
from verif.env.unit import Parameters
from verif.units.colour_add.unit import UNIT

SIEVE = Sieve(UNIT)


def _exact(_p: Parameters, s: Samples) -> Raw:
    return np.asarray(s["a"] + s["b"])


SUM = Floored(SIEVE, "sum", _exact, lambda _p: 0)

CARRY = SIEVE.point(
    "carry",
    "how far a carry runs",
    {
        "all_the_way_to_the_top": lambda p, s: any_lane(
            ((s["a"] ^ s["b"]) == port(UNIT.inputs, p, "a").high - 1) & (s["a"] & s["b"] == 1)
        ),
        "nowhere": lambda _p, s: any_lane((s["a"] & s["b"] == 0) & (s["a"] > 1) & (s["b"] > 1)),
        "to_the_top_bit_alone": lambda p, s: any_lane(
            _exact(p, s) == 1 << port(UNIT.inputs, p, "a").width - 1
        ),
    },
)

COLOURS = cross(
    sign(UNIT.inputs, "a"),
    sign(UNIT.inputs, "b"),
    name="light",
    leave_out=lambda first, second: "negative" in (first, second),
)

COVERAGE = Coverage(
    (
        operand(UNIT.inputs, "a", signed=False),
        operand(UNIT.inputs, "b", signed=False),
        COLOURS,
        SUM.limits(negative=False, leave_out=ONE_BIT_WIDER),
        lanes_apart(SIEVE, "sum", signed=False),
        CARRY,
    )
)
