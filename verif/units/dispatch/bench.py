"""Tests of the dispatch: those of every pipelined unit, at latency 0, and what the header says."""

from collections.abc import Callable

import numpy as np

from models.fixed import Raw
from verif.env.definitions import Holds
from verif.env.fields import Operands
from verif.env.pipelined_tests import standard_tests
from verif.env.unit import Parameters
from verif.units.dispatch.unit import MOST, UNIT


def _for_each(given: Operands, got: Operands, says: Callable[[dict[str, Raw]], Holds]) -> Holds:
    """What is said of each number of units, of the bits that belong to it."""
    holds = np.ones_like(given["ray_valid"], dtype=np.bool_)
    for units in range(1, MOST + 1):
        seen = {name: given[name] == 1 for name in ("ray_valid", "shadow_valid")}
        for kind in ("ray", "shadow"):
            seen[f"{kind}_free"] = given[f"{kind}_free"] & ((1 << units) - 1)
            seen[f"{kind}_start"] = got[f"{kind}_start_{units}"]
            seen[f"{kind}_ready"] = (got[f"{kind}_ready"] >> (units - 1)) & 1 == 1
        holds &= says(seen)
    return holds


def a_ray_starts_in_one_unit_that_is_free_for_it_or_in_none(
    _: Parameters, given: Operands, got: Operands
) -> Holds:
    """Exactly where it is valid and ready."""

    def says(seen: dict[str, Raw]) -> Holds:
        holds = np.ones_like(seen["ray_valid"], dtype=np.bool_)
        for kind in ("ray", "shadow"):
            start = seen[f"{kind}_start"]
            one, none = (start & (start - 1)) == 0, start == 0
            allowed = (start & ~seen[f"{kind}_free"]) == 0
            taken = seen[f"{kind}_valid"] & seen[f"{kind}_ready"]
            holds &= one & allowed & (none != taken)
        return holds

    return _for_each(given, got, says)


def two_rays_start_in_different_units(_: Parameters, given: Operands, got: Operands) -> Holds:
    """One of each kind in a clock."""
    return _for_each(given, got, lambda seen: (seen["ray_start"] & seen["shadow_start"]) == 0)


def a_shadow_ray_waits_for_no_ray(_: Parameters, given: Operands, got: Operands) -> Holds:
    """It is ready where any unit is free for it; a ray where any is that no shadow ray takes."""

    def says(seen: dict[str, Raw]) -> Holds:
        left = seen["ray_free"] & ~seen["shadow_start"]
        return (seen["shadow_ready"] == (seen["shadow_free"] != 0)) & (seen["ray_ready"] == (left != 0))

    return _for_each(given, got, says)


globals().update(
    standard_tests(
        UNIT,
        a_ray_starts_in_one_unit_that_is_free_for_it_or_in_none,
        two_rays_start_in_different_units,
        a_shadow_ray_waits_for_no_ray,
    )
)
