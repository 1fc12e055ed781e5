"""Cover points of a unit's handshake and reset, the same for all arithmetic units.

Their benches sample, beside operands and results, how long each operand kept the unit waiting and each
result its consumer, and tell of resets.
"""

import numpy as np
from numpy.typing import NDArray

from verif.env.coverage.classes import told
from verif.env.coverage.points import Bin, Coverage, Holds, Point, Recipe, Samples
from verif.env.unit import Parameters, PipelinedUnit, StreamUnit, Unit

IDLE, STALL = "idle_clocks", "stall_clocks"
"""Columns: clocks without an operand before this one, beyond what the rate takes; clocks that this
result waited for ready. -1: not known, it is the first."""

IDLES, STALLS = "idle clocks", "stalls"
RESET_BUSY, RESET_IDLE = "reset while busy", "reset while idle"
"""Scenarios that benches of arithmetic units play."""

LONG = 8
"""Clocks that are a long wait."""


def _waits(name: str, least: int, most: int | None) -> Holds:
    def holds(_parameters: Parameters, samples: Samples) -> NDArray[np.bool_]:
        waited = samples[name]
        return np.asarray((waited >= least) & (True if most is None else waited <= most))

    return holds


def _lengths(name: str, doc: str, recipe: Recipe) -> Point:
    lengths = {"none": (0, 0), "one": (1, 1), "few": (2, LONG - 1), "long": (LONG, None)}
    return Point(name, doc, tuple(Bin(found, recipe, _waits(name, *span)) for found, span in lengths.items()))


_RESET = told("reset", "what was under way", {"busy": RESET_BUSY, "idle": RESET_IDLE})
_RESET_OF_NOTHING = told("reset", "what was under way", {"idle": RESET_IDLE})
_IDLE = _lengths(IDLE, "clocks without an operand", Recipe(IDLES))
_STALL = _lengths(STALL, "clocks that a result waits", Recipe(STALLS))


def flow(unit: Unit) -> tuple[Point, ...]:
    """The points of a unit's kind; none of a block, whose ports are its own.

    In a unit that is combinational nothing is ever under way.
    """
    if isinstance(unit, PipelinedUnit):
        latencies = [unit.latency(parameters) for parameters in unit.parameter_sets().values()]
        return (_IDLE, _RESET if any(latencies) else _RESET_OF_NOTHING)
    return (_IDLE, _STALL, _RESET) if isinstance(unit, StreamUnit) else ()


def with_flow(coverage: Coverage, unit: Unit) -> Coverage:
    """A unit's own points and those of its kind."""
    return coverage.with_points(flow(unit))
