"""Options of the tests that simulate: which unit and simulator, which seed, how much."""

import time

import pytest

from verif.env import units
from verif.env.build import CACHE
from verif.env.simulators import Simulator

_CI_SEED = 1


def pytest_addoption(parser: pytest.Parser) -> None:
    """Registers the options."""
    group = parser.getgroup("simulation")
    group.addoption("--unit", help="only this unit (a folder of verif/units)")
    group.addoption("--sim", choices=[str(simulator) for simulator in Simulator], help="only this simulator")
    group.addoption("--set", dest="parameter_set", help="only this parameter set")
    group.addoption("--seed", type=int, help="root of all randomness; default: 1 in CI, else the time")
    group.addoption("--waves", action="store_true", help="record all signals")
    group.addoption("--code-coverage", action="store_true", help="count what is reached in the code")
    group.addoption("--examples", type=int, default=units.EXAMPLES, help="Hypothesis examples a property")
    group.addoption("--operands", type=int, help="length of a fast stream; default: as the simulator allows")


def pytest_configure(config: pytest.Config) -> None:
    """Chooses the seed, once for all workers: they get the options of the process that starts them."""
    if config.option.seed is None:
        config.option.seed = _CI_SEED if units.in_ci() else int(time.time())


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter, config: pytest.Config) -> None:
    """Where the waves are, if any were asked for."""
    if config.option.waves:
        for path in sorted((CACHE / "runs").glob(f"{config.option.unit or '*'}-*/dump.*")):
            terminalreporter.write_line(f"waves: {path}")


def pytest_report_header(config: pytest.Config) -> str:
    """The seed, so that a run can be repeated."""
    return f"seed: {config.option.seed}"
