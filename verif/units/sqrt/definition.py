"""What a square root is, for the bench of either unit that takes one."""

from verif.env.definitions import Holds
from verif.env.fields import Operands
from verif.env.unit import Parameters


def root_squared_and_remainder_are_the_radicand(_: Parameters, given: Operands, got: Operands) -> Holds:
    """D = Q² + R."""
    return got["root"] * got["root"] + got["remainder"] == given["radicand"]


def remainder_is_at_most_twice_the_root(_: Parameters, given: Operands, got: Operands) -> Holds:
    """0 <= R <= 2 Q, so no larger root fits."""
    return (got["remainder"] >= 0) & (got["remainder"] <= 2 * got["root"])
