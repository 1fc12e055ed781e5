"""Properties that define a unit, checked against its results without its model.

A definition takes parameters, operands and results, and says of each operand whether the results
are right. It is written from the unit's header and the book, never from the model: it finds what
model and design have wrong alike. Its name reads as a statement, and becomes the test's.
"""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from models.fixed import Raw
from verif.env.fields import Field, Operands, count, describe_all
from verif.env.pipelined import Mismatch
from verif.env.unit import ArithmeticUnit, Parameters

Holds = NDArray[np.bool_]
Definition = Callable[[Parameters, Operands, Operands], Holds]


def check(
    definition: Definition,
    unit: ArithmeticUnit,
    parameters: Parameters,
    operands: Operands,
    results: Operands,
) -> None:
    """Raises Mismatch with the first operand for which the definition does not hold."""
    wrong = np.flatnonzero(~definition(parameters, operands, results))
    if wrong.size:
        index = int(wrong[0])
        given = describe_all(unit.inputs(parameters), operands, index)
        got = describe_all(unit.outputs(parameters), results, index)
        statement = definition.__name__.replace("_", " ")
        number = f"operand {index} of {count(operands)} ({wrong.size} wrong)"
        raise Mismatch(f"not so: {statement}; {number}:\n{given}\ngot\n{got}")


def lanes(values: Raw) -> Raw:
    """Values with a lane axis in front, whether they had one or not."""
    return values.reshape(-1, values.shape[-1])


def all_lanes(holds: Holds) -> Holds:
    """Per operand: holds in every lane."""
    return np.asarray(holds.reshape(-1, holds.shape[-1]).all(axis=0))


def is_floor(exact: Raw, drop: int, field: Field, got: Raw) -> Holds:
    """``got`` is ``exact / 2**drop``, rounded down and held within the limits of its port.

    Stated with inequalities: within the limits got * 2**drop <= exact < (got + 1) * 2**drop, and at
    a limit just the one that points inward. ``drop`` may be negative.
    """
    step = 1 << max(drop, 0)
    wide = exact << max(-drop, 0)
    not_above = (got * step <= wide) | (got == field.low)
    not_below = (wide < (got + 1) * step) | (got == field.high)
    return np.asarray(not_above & not_below)
