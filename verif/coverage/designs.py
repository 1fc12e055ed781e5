"""What has functional coverage: every unit, and the core; how a closure of each is run."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from verif.core import cases
from verif.core.coverage import COVERAGE
from verif.env import sources, units
from verif.env.coverage.declared import coverage_of
from verif.env.coverage.points import Coverage
from verif.env.run import Outcome, run
from verif.env.simulators import Simulator

_MODULE = "verif.coverage.closing"

CORE = "core"

Run = Callable[[str, int, Sequence[str], Mapping[str, Any]], Outcome]
"""Runs the closing test: parameter set, seed, known bins, what `extra` tells it."""


@dataclass(frozen=True)
class Design:
    """Something with cover points. sets: parameter sets, in the order in which they are tried."""

    name: str
    coverage: Coverage
    sets: tuple[str, ...]
    exclusions: Path
    run: Run


def names() -> tuple[str, ...]:
    """All designs."""
    return (*units.names(), CORE)


def find(name: str) -> Design:
    """A design by name. Raises KeyError with a sentence where there is none."""
    return _core() if name == CORE else _unit(name)


def _settings(name: str, known: Sequence[str], extra: Mapping[str, Any]) -> dict[str, Any]:
    return {"unit": name, "known": list(known), "extra": extra}


def _unit(name: str) -> Design:
    unit = units.find(name)

    def play(parameter_set: str, seed: int, known: Sequence[str], extra: Mapping[str, Any]) -> Outcome:
        parameters = unit.parameter_sets()[parameter_set]
        settings = {
            **_settings(name, known, {**extra, "scenarios": f"verif.units.{name}.scenarios"}),
            "parameters": dict(parameters),
            "parameter_set": parameter_set,
        }
        built = units.build(unit, Simulator.VERILATOR, parameters)
        return run(built, _MODULE, f"closure-{name}-{parameter_set}", seed=seed, settings=settings)

    exclusions = sources.VERIF / "units" / name / "exclusions.toml"
    return Design(name, coverage_of(unit), tuple(unit.parameter_sets()), exclusions, play)


def _core() -> Design:
    builds = {"one": cases.ONE, "default": cases.DEFAULT, "wide": cases.WIDE}

    def play(parameter_set: str, seed: int, known: Sequence[str], extra: Mapping[str, Any]) -> Outcome:
        case = cases.Case("closing", builds[parameter_set])
        built = case.design.made()
        told = {**cases.extra(case), **extra, "scenarios": "verif.core.scenarios"}
        settings = {
            **_settings(CORE, known, told),
            "parameters": dict(built.parameters),
            "parameter_set": parameter_set,
        }
        return run(built, _MODULE, f"closure-core-{parameter_set}", seed=seed, settings=settings)

    return Design(CORE, COVERAGE, tuple(builds), sources.VERIF / "core" / "exclusions.toml", play)
