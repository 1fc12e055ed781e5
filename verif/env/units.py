"""The units there are, how each is built, and how its bench is run; imports no cocotb bench."""

import importlib
import os
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from verif.env import harness, sources
from verif.env.build import CACHE, Build
from verif.env.run import Outcome, run
from verif.env.simulators import Simulator
from verif.env.unit import Parameters, PipelinedUnit, StreamUnit, Unit, macros, of_module

UNITS = sources.VERIF / "units"

OPERANDS = {Simulator.VERILATOR: 100_000, Simulator.ICARUS: 3_000}
"""Operands of a fast stream. Icarus takes 3,000 to 5,000 clocks/s on large units."""

OTHER_SET_OPERANDS = 20_000
"""In parameter sets beside the default one: same rules, other widths."""

EXHAUSTIVE_SET_OPERANDS = 5_000
"""Where every operand is tried anyhow, random ones only vary their order."""

EXAMPLES = 50


@dataclass(frozen=True)
class Effort:
    """How much a run does: Hypothesis examples a property, operands of a fast stream (None: as above)."""

    examples: int = EXAMPLES
    operands: int | None = None

    def operands_of(self, unit: Unit, simulator: Simulator, parameter_set: str) -> int:
        """Length of the fast stream of one run."""
        if self.operands is not None:
            return self.operands
        if parameter_set == "default":
            return OPERANDS[simulator]
        most = EXHAUSTIVE_SET_OPERANDS if parameter_set == unit.exhaustive else OTHER_SET_OPERANDS
        return min(OPERANDS[simulator], most)


@cache
def names() -> tuple[str, ...]:
    """Every folder of `verif/units` that holds a unit."""
    return tuple(sorted(path.parent.name for path in UNITS.glob("*/unit.py")))


@cache
def find(name: str) -> Unit:
    """A unit by the name of its folder. Raises KeyError where there is none."""
    if name not in names():
        raise KeyError(f"no unit is called {name}: there are {', '.join(names())}")
    unit = importlib.import_module(f"verif.units.{name}.unit").UNIT
    if not isinstance(unit, Unit):
        raise TypeError(f"verif/units/{name}/unit.py: UNIT is no Unit")
    return unit


def build(
    unit: Unit,
    simulator: Simulator,
    parameters: Parameters,
    *,
    waves: bool = False,
    replacements: Mapping[Path, str] | None = None,
    coverage: bool = False,
) -> Build:
    """The build of a unit with complete parameters."""
    changed = replacements or {}
    defines = {**unit.defines, **macros(parameters)}
    if isinstance(unit, PipelinedUnit):
        return Build(
            harness.TOP,
            simulator,
            defines=defines,
            waves=waves,
            harness=harness.verilog(unit, parameters),
            control=harness.CONTROL,
            label=unit.name,
            replacements=changed,
            coverage=coverage,
        )
    return Build(
        unit.module,
        simulator,
        parameters=of_module(parameters),
        defines=defines,
        waves=waves,
        control=harness.control(unit.module) if isinstance(unit, StreamUnit) else None,
        label=unit.name,
        replacements=changed,
        coverage=coverage,
    )


def simulate(
    name: str,
    simulator: Simulator,
    parameter_set: str,
    *,
    seed: int,
    effort: Effort,
    waves: bool = False,
    replacements: Mapping[Path, str] | None = None,
    run_name: str = "",
    shrink: bool = True,
    coverage: bool = False,
    functional: bool = True,
) -> Outcome:
    """Builds a unit where need be and runs its bench; coverage: of the code, see `verif.env.build.Build`;
    functional: its cover points are sampled, unless the design is changed on purpose.

    At a desk examples that failed come back from `build/hypothesis/<unit>`; in CI, and where the
    design is changed on purpose, the seed alone decides.
    """
    unit = find(name)
    parameters = unit.parameter_sets()[parameter_set]
    database = None if in_ci() or replacements else str(CACHE / "hypothesis" / name)
    return run(
        build(unit, simulator, parameters, waves=waves, replacements=replacements, coverage=coverage),
        f"verif.units.{name}.bench",
        run_name or f"{name}-{simulator}-{parameter_set}",
        seed=seed,
        settings={
            "parameters": dict(parameters),
            "parameter_set": parameter_set,
            "examples": effort.examples,
            "operands": effort.operands_of(unit, simulator, parameter_set),
            "database": database,
            "extra": {} if shrink else {"shrink": False},
            "unit": name if functional and not replacements else "",
        },
        tests=unit.tests.get(parameter_set),
    )


def in_ci() -> bool:
    """Whether this runs in continuous integration, where runs must repeat."""
    return os.environ.get("CI", "").lower() in ("true", "1")
