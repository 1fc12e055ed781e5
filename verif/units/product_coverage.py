"""What must have been seen of every unit that multiplies, floors once and saturates once."""

from verif.env.coverage.classes import Ports, operand, sign
from verif.env.coverage.points import Point, cross
from verif.env.coverage.rounding import Exact, Floored
from verif.env.coverage.sieve import Sieve
from verif.units.products import dropped_bits


def factors(inputs: Ports, a: str, b: str) -> tuple[Point, ...]:
    """Classes of both factors, and their signs together."""
    signs = cross(sign(inputs, a), sign(inputs, b), name="signs")
    return (operand(inputs, a), operand(inputs, b), signs)


def rounded(sieve: Sieve, exact: Exact) -> tuple[Point, ...]:
    """Limits and residue of the port `p`, the floor of an exact sum of products."""
    product = Floored(sieve, "p", exact, dropped_bits)
    return (product.limits(), product.residue())
