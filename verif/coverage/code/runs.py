"""The runs that code coverage is collected from: every unit in every parameter set, and the larger benches.

A run is a name, so that a process of its own can be given it; `simulate` knows what it means.
"""

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import cache, partial

from verif.core import cases
from verif.core.builds import axi_build
from verif.env import units
from verif.env.run import Outcome, run
from verif.env.simulators import Simulator
from verif.video.builds import SCREEN, core_vga_build

_EFFORT = units.Effort(examples=30, operands=5_000)
"""A twentieth of what tests of units do: operands of every class come by the thousand."""
_CORE_EXAMPLES = 15
_CORE_SCENES = 50
_CORE_BENCHES = ("pictures", "frames", "faults", "rooms", "streams")
_SEED = 1


def _run_name(name: str) -> str:
    return f"code-coverage-{name}"


def _unit(unit: str, parameter_set: str, coverage: bool) -> Outcome:
    name = _run_name(f"{unit}-{parameter_set}")
    return units.simulate(
        unit,
        Simulator.VERILATOR,
        parameter_set,
        seed=_SEED,
        effort=_EFFORT,
        run_name=name,
        shrink=False,
        coverage=coverage,
        functional=False,
    )


def _case(case: cases.Case, coverage: bool) -> Outcome:
    return cases.simulate(
        case,
        seed=_SEED,
        examples=_CORE_EXAMPLES,
        run_name=_run_name(f"core-{case}"),
        shrink=False,
        coverage=coverage,
    )


def _axi(coverage: bool) -> Outcome:
    return run(
        replace(axi_build(Simulator.VERILATOR), coverage=coverage),
        "verif.core.axi_bench",
        _run_name("axi"),
        seed=_SEED,
        settings={"examples": 2 * _CORE_EXAMPLES},
    )


def _core_vga(coverage: bool) -> Outcome:
    return run(
        replace(core_vga_build(Simulator.VERILATOR), coverage=coverage),
        "verif.video.core_bench",
        _run_name("core-vga"),
        seed=_SEED,
        settings={"parameters": SCREEN, "examples": _CORE_EXAMPLES},
    )


def _unit_runs() -> dict[str, Callable[[bool], Outcome]]:
    pairs = [(unit, chosen) for unit in units.names() for chosen in units.find(unit).parameter_sets()]
    return {f"{unit}-{chosen}": partial(_unit, unit, chosen) for unit, chosen in pairs}


def _core_runs() -> dict[str, Callable[[bool], Outcome]]:
    """The core with one unit, in all that its benches do; a build for it is made in bearable time."""
    chosen = [case for case in cases.CASES if case.design == cases.ONE and case.bench in _CORE_BENCHES]
    return {f"core-{case}": partial(_case, replace(case, scenes=_CORE_SCENES)) for case in chosen}


@cache
def _all() -> Mapping[str, Callable[[bool], Outcome]]:
    return {"axi": _axi, "core-vga": _core_vga, **_unit_runs(), **_core_runs()}


def of_unit(unit: str) -> tuple[str, ...]:
    """The runs of one unit. Raises KeyError where there is none."""
    return tuple(f"{unit}-{chosen}" for chosen in units.find(unit).parameter_sets())


def of_core() -> tuple[str, ...]:
    """The runs of the whole core."""
    return ("axi", "core-vga", *_core_runs())


def everything() -> tuple[str, ...]:
    """All runs: those that build longest first, and those that share a build last."""
    return tuple(_all())


def simulate(name: str, coverage: bool = True) -> Outcome:
    """Builds where need be and runs. Raises KeyError where no run is called so."""
    return _all()[name](coverage)
