"""Every unit, in every parameter set, on every simulator: one test each, which runs the unit's bench."""

from dataclasses import dataclass

import pytest

from verif.env import units
from verif.env.simulators import MissingTool, Simulator, version


@dataclass(frozen=True)
class Case:
    """One run of a bench."""

    unit: str
    parameter_set: str
    simulator: Simulator

    def __str__(self) -> str:
        return f"{self.unit}-{self.parameter_set}-{self.simulator}"

    def command(self, config: pytest.Config) -> str:
        """What repeats this run; only what differs from the defaults is named."""
        words = [f"make unit UNIT={self.unit} SIM={self.simulator}"]
        if self.parameter_set != "default":
            words.append(f"SET={self.parameter_set}")
        words.append(f"SEED={config.option.seed}")
        if config.option.examples != units.EXAMPLES:
            words.append(f"EXAMPLES={config.option.examples}")
        if config.option.operands is not None:
            words.append(f"OPERANDS={config.option.operands}")
        return " ".join(words)


def _cases(config: pytest.Config) -> list[Case]:
    option = config.option
    names = units.names() if option.unit is None else (option.unit,)
    simulators = tuple(Simulator) if option.sim is None else (Simulator(option.sim),)
    return [
        Case(name, parameter_set, simulator)
        for name in names
        for parameter_set in _sets(name)
        if option.parameter_set in (None, parameter_set)
        for simulator in simulators
    ]


def _sets(name: str) -> list[str]:
    try:
        return list(units.find(name).parameter_sets())
    except KeyError as error:
        raise pytest.UsageError(str(error.args[0])) from None


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    """A test for each run."""
    if "case" in metafunc.fixturenames:
        metafunc.parametrize("case", _cases(metafunc.config), ids=str)


def _missing(simulator: Simulator) -> str:
    """What keeps a simulator from running, as a sentence; empty where nothing does."""
    try:
        version(simulator)
    except MissingTool as missing:
        return str(missing)
    return ""


def test_unit(case: Case, pytestconfig: pytest.Config) -> None:
    """The bench passes. A simulator that is not there skips, unless it was asked for."""
    option = pytestconfig.option
    if missing := _missing(case.simulator):
        if option.sim is not None or case.simulator is Simulator.VERILATOR:
            pytest.fail(missing, pytrace=False)
        pytest.skip(missing)
    outcome = units.simulate(
        case.unit,
        case.simulator,
        case.parameter_set,
        seed=option.seed,
        effort=units.Effort(option.examples, option.operands),
        waves=option.waves,
        coverage=option.code_coverage and case.simulator is Simulator.VERILATOR,
    )
    if not outcome.passed:
        pytest.fail(f"{outcome.complaint()}\nrepeat with: {case.command(pytestconfig)}", pytrace=False)
