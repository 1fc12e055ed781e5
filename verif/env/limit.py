"""A limit of simulated time, held inside the simulator: a run that never ends is stopped, and it is told why.

cocotb calls `start` before the tests. The limit is of the whole simulation, all tests of a bench together,
so that it holds whatever a bench awaits.
"""

import os
import sys
from pathlib import Path

from cocotb import simulator

NANOSECONDS = "RAYTRACER_SIMULATED_NS"
"""Variable with the most simulated nanoseconds of a run; without it there is no limit."""

MARK = "simulated_time_limit"
"""File that a simulation leaves in its folder where it was stopped by its limit: a sentence."""

USERS = (
    "cocotb_tools._coverage:start_cocotb_library_coverage",
    "cocotb.logging:_configure",
    "cocotb._init:init_package_from_simulation",
    "verif.env.limit:start",
    "cocotb.regression:_run_regression",
)
"""What cocotb 2.1 starts in the simulator (`PYGPI_USERS`), and the limit among it."""

_STOPPED = 3


def start() -> None:
    """Registers the limit with the simulator."""
    nanoseconds = float(os.environ[NANOSECONDS])
    steps = round(nanoseconds * 10 ** (-9 - simulator.get_precision()))
    simulator.register_timed_callback(steps, _stop, nanoseconds)


def _stop(nanoseconds: float) -> None:
    # Not through cocotb's shutdown: a property's thread may wait for the design and would never end.
    (Path(os.environ["RAYTRACER_RUN"]) / MARK).write_text(f"{nanoseconds:.0f} ns of simulated time are over")
    sys.stdout.flush()
    os._exit(_STOPPED)
