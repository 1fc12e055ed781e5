"""The core's builds: top module, what stays visible to Python."""

from collections.abc import Mapping
from dataclasses import replace

from models.cores import CORES
from models.header import defines
from verif.env.build import Build
from verif.env.harness import control
from verif.env.simulators import Simulator

TOP = "core_tb"
AXI_TOP = "raytracer_axi"


def core_build(
    name: str, simulator: Simulator, waves: bool = False, parameters: Mapping[str, int] | None = None
) -> Build:
    """The core in a named build of `models.cores`; parameters: changes to that build's."""
    core = CORES[name]
    return Build(
        TOP,
        simulator,
        parameters={**core.parameters(), **(parameters or {})},
        defines=defines(core.knobs),
        waves=waves,
        control=control(TOP),
        optimise="-O3",
        timing=True,
        label=f"core-{name}",
    )


def stepped_build(
    name: str, simulator: Simulator, waves: bool = False, parameters: Mapping[str, int] | None = None
) -> Build:
    """The core for benches that look at every clock: cocotb makes the clock, see `core_tb.v`.

    Such a bench waits for Python more than for the core, so that a quicker compilation is worth more than
    quicker code.
    """
    usual = core_build(name, simulator, waves, parameters)
    return replace(
        usual,
        defines={**usual.defines, "RT_CLOCK_FROM_OUTSIDE": 1},
        optimise="-O1",
        timing=False,
    )


def axi_build(simulator: Simulator, waves: bool = False) -> Build:
    """The core behind its AXI ports, for benches that look at every clock.

    It has more pixels in flight than room for primary rays, so that these must wait for it.
    """
    core = CORES["default"]
    return Build(
        AXI_TOP,
        simulator,
        parameters={**core.parameters(), "PIXELS_IN_FLIGHT": 128, "LEVEL_ROOM": 64},
        defines=defines(core.knobs),
        waves=waves,
        control=control(AXI_TOP),
        label="axi",
    )
