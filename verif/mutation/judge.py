"""Judges the mutants of a unit with the unit's own bench, all in one build and one simulation."""

import json
import threading
from collections.abc import Callable, Collection, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from verif.env import run, units
from verif.env.build import Build
from verif.env.simulators import Simulator
from verif.env.unit import Unit, macros
from verif.mutation import protocol
from verif.mutation.netlist import SELECT, Netlist
from verif.mutation.record import Judged, Mutant, Status


class JudgeError(RuntimeError):
    """The judge cannot judge: the unmutated netlist fails, or the simulation broke down. The text says
    what."""


@dataclass(frozen=True)
class NetlistBuild(Build):
    """A build of a netlist that stands for itself: it needs none of the design's files.

    beside: the modules that it only names.
    """

    beside: tuple[Path, ...] = ()

    @property
    def files(self) -> tuple[Path, ...]:
        """All else is in the harness."""
        return self.beside


@dataclass(frozen=True)
class Effort:
    """What a bench may spend on one mutant: Hypothesis examples a property, operands of a fast stream."""

    examples: int = 25
    operands: int = 4_000


@dataclass(frozen=True)
class Session:
    """The judgement of one unit: status by mutant, and the project's files that it depends on."""

    judged: tuple[Judged, ...]
    files: tuple[str, ...]


def build(unit: Unit, parameter_set: str, mutated: Netlist) -> Build:
    """The build with all mutants in it; only what the bench may use stays visible."""
    ports = "\n".join(f'public_flat_rw -module "{mutated.top}" -var "{port}"' for port in mutated.visible)
    return NetlistBuild(
        mutated.top,
        Simulator.VERILATOR,
        defines={**unit.defines, **macros(unit.parameter_sets()[parameter_set])},
        harness=mutated.verilog,
        control=f"`verilator_config\n{ports}\n",
        label=f"{unit.name}-mutants",
        beside=mutated.beside,
    )


def judge(
    unit: Unit,
    parameter_set: str,
    mutated: Netlist,
    *,
    only: Collection[int] | None = None,
    seed: int,
    effort: Effort,
    jobs: int = 1,
    bench: str = "",
    progress: Callable[[int], None] = lambda _: None,
) -> Session:
    """Runs ``bench``, the unit's own where it is not named, on every mutant, or on ``only`` those of some
    numbers.

    ``progress`` is told how many are done.

    Raises JudgeError where the netlist without a mutant does not pass, and BuildError where it does not
    build.
    """
    module = bench or f"verif.units.{unit.name}.bench"
    name = f"mutation-{mutated.folder.name}"
    chosen = [one for one in mutated.mutants if only is None or one.number in only]
    # Beside the netlist: where runs lie is not the judge's to know.
    told = mutated.folder / protocol.JUDGED
    told.unlink(missing_ok=True)
    with _followed(told, progress):
        outcome = run.run(
            build(unit, parameter_set, mutated),
            protocol.SERVER,
            name,
            seed=seed,
            settings={
                "parameters": dict(unit.parameter_sets()[parameter_set]),
                "parameter_set": parameter_set,
                "examples": effort.examples,
                "operands": effort.operands,
                "corpus": str(units.UNITS / unit.name / "corpus"),
                "extra": {
                    "shrink": False,
                    "bench": module,
                    "select": SELECT,
                    "mutants": [one.number for one in chosen],
                    "jobs": jobs,
                    "folder": str(mutated.folder),
                },
            },
        )
    return _session(mutated, chosen, outcome.directory / "sim.log")


def _session(mutated: Netlist, chosen: Sequence[Mutant], log: Path) -> Session:
    told = {line["mutant"]: line for line in _lines(mutated.folder / protocol.JUDGED)}
    itself = told.get(0, {}).get("test")
    if itself is None:
        raise JudgeError(f"{mutated.folder.name}: the simulation did not start; {log}")
    if itself != protocol.SURVIVED:
        raise JudgeError(f"{mutated.folder.name}: without a mutant, {itself} ends it; {log}")
    missing = [one.number for one in chosen if one.number not in told]
    if missing:
        raise JudgeError(f"{mutated.folder.name}: {len(missing)} mutants unjudged; {log}")
    judged = []
    for one in chosen:
        test, seconds = told[one.number]["test"], told[one.number]["seconds"]
        judged.append(Judged(one, _status(test), "" if test == protocol.SURVIVED else test, seconds))
    return Session(tuple(judged), tuple(json.loads((mutated.folder / protocol.FILES).read_text())))


def _status(test: str) -> Status:
    return {protocol.SURVIVED: Status.SURVIVED, protocol.TIMED_OUT: Status.TIMED_OUT}.get(test, Status.KILLED)


def _lines(path: Path) -> list[dict[str, Any]]:
    return [json.loads(line) for line in path.read_text().splitlines()] if path.exists() else []


@contextmanager
def _followed(path: Path, progress: Callable[[int], None]) -> Iterator[None]:
    """Tells how many lines a file has, twice a second, while the body runs."""
    over = threading.Event()

    def follow() -> None:
        while not over.wait(0.5):
            progress(path.read_bytes().count(b"\n") - 1 if path.exists() else 0)

    thread = threading.Thread(target=follow, daemon=True)
    thread.start()
    try:
        yield
    finally:
        over.set()
        thread.join()
