"""The core's builds: formats by name, top module, what stays visible to Python."""

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
