"""The core with its screen: from packed frames to what a monitor sees."""

import pytest

from models.cores import CORES
from models.header import defines
from models.video import Store
from verif.env.build import Build
from verif.env.harness import control
from verif.env.run import run
from verif.env.simulators import MissingTool, Simulator, version
from verif.video.modes import SMALL, mode_parameters, store_parameters

_TOP = "core_vga_tb"
_PARAMETERS = {**store_parameters(Store(16, 12)), **mode_parameters(SMALL)}
_EXAMPLES = {Simulator.VERILATOR: 100, Simulator.ICARUS: 10}
"""The bench divides them by the cost of a film."""
_TESTS = {Simulator.ICARUS: "reset_of_the_core_in_the_middle_of_a_picture_is_not_seen"}
"""What Icarus, where an X would be seen, runs: the others take it minutes."""


def _build(simulator: Simulator) -> Build:
    core = CORES["default"]
    return Build(
        _TOP,
        simulator,
        parameters={**core.parameters(), "PIXELS_IN_FLIGHT": 64, "LEVEL_ROOM": 16, **_PARAMETERS},
        defines=defines(core.knobs),
        control=control(_TOP),
        label="core-vga",
    )


@pytest.mark.parametrize("simulator", list(Simulator), ids=str)
def test_the_core_with_its_screen(simulator: Simulator, pytestconfig: pytest.Config) -> None:
    """The bench passes; a simulator that is not there skips."""
    try:
        version(simulator)
    except MissingTool as missing:
        if simulator is Simulator.VERILATOR:
            raise
        pytest.skip(str(missing))
    outcome = run(
        _build(simulator),
        "verif.video.core_bench",
        f"core-vga-{simulator}",
        seed=pytestconfig.option.seed,
        settings={"parameters": _PARAMETERS, "examples": _EXAMPLES[simulator]},
        tests=_TESTS.get(simulator),
    )
    assert outcome.passed, outcome.complaint()
