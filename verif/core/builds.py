"""The core's builds: formats by name, top module, what stays visible to Python."""

from dataclasses import replace

from models.formats import BUILDS
from models.header import defines
from verif.env.build import Build
from verif.env.simulators import Simulator

TOP = "core_tb"

CONTROL = f"""\
`verilator_config
public_flat_rw -module "{TOP}" -var "*"
"""
"""Just the bench's own signals: with every signal visible the core simulates slower."""


def core_build(name: str, simulator: Simulator, waves: bool = False) -> Build:
    """The core in a named build of the table of formats."""
    return Build(
        TOP,
        simulator,
        defines=defines(BUILDS[name]),
        waves=waves,
        control=CONTROL,
        optimise="-O3",
        timing=True,
        label=f"core-{name}",
    )


def stepped_build(name: str, simulator: Simulator, waves: bool = False, slots: int | None = None) -> Build:
    """The core for benches that look at every clock: cocotb makes the clock, see `core_tb.v`.

    slots: pixels in flight, where it is not the usual number. Such a bench waits for Python more than for
    the core, so that a quicker compilation is worth more than quicker code.
    """
    usual = core_build(name, simulator, waves)
    return replace(
        usual,
        parameters={} if slots is None else {"PIXELS_IN_FLIGHT": slots},
        defines={**usual.defines, "RT_CLOCK_FROM_OUTSIDE": 1},
        optimise="-O1",
        timing=False,
    )
