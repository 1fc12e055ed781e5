"""Tests of the format conversion: those of every pipelined unit, at latency 0, and what rounding down is."""

import numpy as np

from verif.env.definitions import Holds, is_floor
from verif.env.fields import Operands
from verif.env.pipelined_tests import standard_tests
from verif.env.unit import Parameters
from verif.units.resize.unit import UNIT, input_format


def every_format_gets_the_floor_or_the_limit_it_passed(
    p: Parameters, given: Operands, got: Operands
) -> Holds:
    """In each of the output formats, signed and unsigned."""
    fmt = input_format(p)
    ports = UNIT.outputs(p)
    rows = [is_floor(given["number"], fmt.frac_bits - port.frac_bits, port, got[port.name]) for port in ports]
    return np.asarray(np.all(rows, axis=0))


globals().update(standard_tests(UNIT, every_format_gets_the_floor_or_the_limit_it_passed))
