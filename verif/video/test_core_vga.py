"""The core with its screen: from packed frames to what a monitor sees."""

import pytest

from verif.env.run import run
from verif.env.simulators import MissingTool, Simulator, version
from verif.video.builds import SCREEN, core_vga_build

_EXAMPLES = {Simulator.VERILATOR: 100, Simulator.ICARUS: 10}
"""The bench divides them by the cost of a film."""
_TESTS = {Simulator.ICARUS: "reset_of_the_core_in_the_middle_of_a_picture_is_not_seen"}
"""What Icarus, where an X would be seen, runs: the others take it minutes."""


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
        core_vga_build(simulator),
        "verif.video.core_bench",
        f"core-vga-{simulator}",
        seed=pytestconfig.option.seed,
        settings={"parameters": SCREEN, "examples": _EXAMPLES[simulator]},
        tests=_TESTS.get(simulator),
    )
    assert outcome.passed, outcome.complaint()
