"""What the benches of all products share: formats by parameter, and operands whose product is at a limit."""

import numpy as np
from numpy.random import Generator

from models.fixed import Format, Raw
from verif.env.unit import Parameters


def formats(p: Parameters) -> tuple[Format, Format, Format]:
    """Of a, b and the result; all unsigned where SIGNED is 0."""
    signed = bool(p.get("SIGNED", 1))
    return (
        Format(p["A_INT"], p["A_FRAC"], signed),
        Format(p["B_INT"], p["B_FRAC"], signed),
        Format(p["OUT_INT"], p["OUT_FRAC"], signed),
    )


def dropped_bits(p: Parameters) -> int:
    """Fraction bits of the full product that the result does not have."""
    return p["A_FRAC"] + p["B_FRAC"] - p["OUT_FRAC"]


def pairs_at_the_limit(
    p: Parameters, generator: Generator, shape: tuple[int, ...], addends: int = 1
) -> tuple[Raw, Raw]:
    """Factors whose product, times ``addends``, is next to a limit of the result where b can reach it."""
    a_fmt, b_fmt, out_fmt = formats(p)
    a = generator.integers(a_fmt.min, a_fmt.max + 1, shape)
    a = np.where(a == 0, 1, a)
    limit = generator.choice(np.array([out_fmt.min, out_fmt.max + 1]), shape)
    scale = 2.0 ** dropped_bits(p) / addends
    b = np.floor(limit * scale / a) + generator.integers(-1, 2, shape)
    return a, b_fmt.saturate(np.clip(b, b_fmt.min, b_fmt.max).astype(np.int64))
