"""What has functional coverage: every unit, and the core; how a closure of each is run."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from verif.env import sources, units
from verif.env.coverage.declared import coverage_of
from verif.env.coverage.points import Coverage
from verif.env.run import Outcome, run
from verif.env.simulators import Simulator

_MODULE = "verif.coverage.closing"

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
    return units.names()


def find(name: str) -> Design:
    """A design by name. Raises KeyError with a sentence where there is none."""
    unit = units.find(name)

    def play(parameter_set: str, seed: int, known: Sequence[str], extra: Mapping[str, Any]) -> Outcome:
        parameters = unit.parameter_sets()[parameter_set]
        settings = {
            "parameters": dict(parameters),
            "parameter_set": parameter_set,
            "unit": name,
            "known": list(known),
            "extra": {**extra, "scenarios": f"verif.units.{name}.scenarios"},
        }
        built = units.build(unit, Simulator.VERILATOR, parameters)
        return run(built, _MODULE, f"closure-{name}-{parameter_set}", seed=seed, settings=settings)

    return Design(
        name,
        coverage_of(unit),
        tuple(unit.parameter_sets()),
        sources.VERIF / "units" / name / "exclusions.toml",
        play,
    )
