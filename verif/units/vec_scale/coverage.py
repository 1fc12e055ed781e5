"""What must have been seen of scalar times vector: factors, residues, limits, lanes apart."""

import numpy as np

from models.fixed import Raw
from verif.env.coverage.points import Coverage, Samples
from verif.env.coverage.rounding import lanes_apart
from verif.env.coverage.sieve import Sieve
from verif.env.unit import Parameters
from verif.units.product_coverage import factors, rounded
from verif.units.vec_scale.unit import UNIT

SIEVE = Sieve(UNIT)


def _exact(_p: Parameters, s: Samples) -> Raw:
    return np.asarray(s["s"] * s["a"])


COVERAGE = Coverage((*factors(UNIT.inputs, "s", "a"), *rounded(SIEVE, _exact), lanes_apart(SIEVE, "p")))
