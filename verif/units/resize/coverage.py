"""What must have been seen of the format conversion, over the formats that stand side by side in its wrapper.

A limit is one thing for formats that lose integer bits, keep them or gain one, signed or not; a residue is
one thing for all that lose fraction bits.
"""

import numpy as np
from numpy.typing import NDArray

from verif.env.coverage.classes import operand
from verif.env.coverage.points import Coverage, Holds, Samples
from verif.env.coverage.rounding import ONE_BIT_WIDER, Floored
from verif.env.coverage.sieve import Sieve
from verif.env.unit import Parameters
from verif.units.resize.unit import UNIT, input_format, output_formats

SIEVE = Sieve(UNIT)


def _to(name: str) -> Floored:
    """One of the output ports."""

    def drop(p: Parameters) -> int:
        return input_format(p).frac_bits - output_formats(p)[name].frac_bits

    return Floored(SIEVE, name, lambda _p, s: s["number"], drop)


def _below_zero(p: Parameters, s: Samples) -> NDArray[np.bool_]:
    """Unsigned formats hold a negative number at 0, however wide they are."""
    return np.asarray((s["number"] < -1) & (s["u_i3_f4"] == 0))


def _appended(sign: int) -> Holds:
    def holds(_p: Parameters, s: Samples) -> NDArray[np.bool_]:
        return np.asarray((s["s_i3_f4"] == s["number"] << 2) & (np.sign(s["number"]) == sign))

    return holds


WIDER = SIEVE.point(
    "wider",
    "formats with more bits",
    {
        "zeros_appended_to_positive": _appended(1),
        "zeros_appended_to_negative": _appended(-1),
        "negative_held_at_zero": _below_zero,
        "fits_only_with_a_bit_more": lambda _p, s: s["s_i3_f2"] != s["s_i1_f2"],
        "fits_unsigned_alone": lambda _p, s: (s["u_i1_f2"] != s["s_i1_f2"]) & (s["u_i1_f2"] == s["number"]),
    },
)

COVERAGE = Coverage(
    (
        operand(UNIT.inputs, "number"),
        _to("s_i0_f2").limits(),
        _to("s_i1_f2").limits(leave_out=ONE_BIT_WIDER),
        _to("u_i0_f2").limits(leave_out=("above_next_bit_agrees", "below")),
        _to("s_i2_f0").residue(),
        _to("u_i2_f0").residue(negative=False),
        WIDER,
    )
)
