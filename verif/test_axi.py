"""The core behind its AXI ports, against independent AXI masters and sinks."""

import pytest

from verif.core.builds import axi_build
from verif.env.run import run
from verif.env.simulators import MissingTool, Simulator, version

_EXAMPLES = {Simulator.VERILATOR: 200, Simulator.ICARUS: 20}
"""The bench divides them by the cost of a frame."""


@pytest.mark.parametrize("simulator", list(Simulator), ids=str)
def test_the_core_behind_its_axi_ports(simulator: Simulator, pytestconfig: pytest.Config) -> None:
    """The bench passes; a simulator that is not there skips."""
    try:
        version(simulator)
    except MissingTool as missing:
        if simulator is Simulator.VERILATOR:
            raise
        pytest.skip(str(missing))
    outcome = run(
        axi_build(simulator),
        "verif.core.axi_bench",
        f"axi-{simulator}",
        seed=pytestconfig.option.seed,
        settings={"examples": _EXAMPLES[simulator]},
    )
    assert outcome.passed, outcome.complaint()
