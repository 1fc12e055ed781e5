"""The build of the core with a small screen; imports no cocotb bench."""

from models.cores import CORES
from models.header import defines
from models.video import Store
from verif.env.build import Build
from verif.env.harness import control
from verif.env.simulators import Simulator
from verif.video.modes import SMALL, mode_parameters, store_parameters

CORE_TOP = "core_vga_tb"
SCREEN = {**store_parameters(Store(16, 12)), **mode_parameters(SMALL)}
"""Parameters of the screen."""


def core_vga_build(simulator: Simulator) -> Build:
    """The core with its screen, few pixels in flight."""
    core = CORES["default"]
    return Build(
        CORE_TOP,
        simulator,
        parameters={**core.parameters(), "PIXELS_IN_FLIGHT": 64, "LEVEL_ROOM": 16, **SCREEN},
        defines=defines(core.knobs),
        control=control(CORE_TOP),
        label="core-vga",
    )
