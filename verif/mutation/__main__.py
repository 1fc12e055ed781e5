"""Qualifies benches by mutation.

    python -m verif.mutation unit|core-control|all ... [--mutants 200] [--jobs N]     (make mutate UNIT=sqrt)

Exit code 1 where a bench kills less than 99 % of the mutants that are not proven equivalent, where more than
2 % are undecided, where a survivor is not explained in explained.toml or an explanation is stale; 2 for a
unit that is not there.
"""

import argparse
import os
import sys
from collections.abc import Iterator, Sequence
from concurrent.futures import Future, ProcessPoolExecutor, as_completed

from verif.env import units
from verif.env.build import BuildError, locked
from verif.mutation import record
from verif.mutation.explained import ExplanationError, Explanations
from verif.mutation.judge import JudgeError
from verif.mutation.netlist import NetlistError
from verif.mutation.qualify import Plan, Progress, known, qualify
from verif.mutation.record import SCORE, UNDECIDED, Judged, Result, Verdict

CORE_CONTROL = (
    "control",
    "counters",
    "loader",
    "scene_memory",
    "unpack",
    "ray_generator",
    "ray_store",
    "dispatch",
    "fifo",
    "merge",
    "stepper",
    "steps",
    "children",
    "pixel_queue",
    "accumulator",
)
"""The units that control the core: the life of a frame, of a ray and of a pixel, and the queues between."""

_FAILURES = (NetlistError, BuildError, JudgeError)


def wanted(names: Sequence[str]) -> tuple[str, ...]:
    """Units by name, `core-control` or `all`. Raises KeyError where there is no such unit."""
    found: dict[str, None] = {}
    for name in names:
        group = {"all": units.names(), "core-control": CORE_CONTROL}.get(name, (name,))
        found.update(dict.fromkeys(group))
    for name in found:
        units.find(name)
    return tuple(found)


def _show(text: str) -> None:
    if sys.stderr.isatty():
        print(f"\r\x1b[K{text}", end="", file=sys.stderr, flush=True)


def _alone(plan: Plan) -> Result:
    """One unit, with a live line."""

    def progress(what: str, done: int, number: int) -> None:
        _show(f"{plan.unit}: {what} {done} of {number}")

    return _qualified(plan, progress)


def _quietly(plan: Plan) -> Result:
    return _qualified(plan)


def _qualified(plan: Plan, progress: Progress = lambda *_: None) -> Result:
    """The result, kept. One process at a time judges a unit: its netlist and its runs have one folder."""
    with locked(record.FOLDER / f"{plan.unit}.lock"):
        result = known(plan) or qualify(plan, progress)
        record.write(result)
    return result


def _results(plans: Sequence[Plan], jobs: int) -> Iterator[tuple[str, Result | str]]:
    """Of each unit its result, or what kept it from having one; those that are known already first."""
    fresh = []
    for plan in plans:
        if (found := known(plan)) is not None:
            yield plan.unit, found
        else:
            fresh.append(plan)
    if len(fresh) == 1:
        plan = Plan(fresh[0].unit, fresh[0].mutants, fresh[0].seed, jobs)
        try:
            yield plan.unit, _alone(plan)
        except _FAILURES as error:
            yield plan.unit, str(error)
        return
    with ProcessPoolExecutor(jobs) as pool:
        running: dict[Future[Result], str] = {pool.submit(_quietly, plan): plan.unit for plan in fresh}
        for done, future in enumerate(as_completed(running), 1):
            _show("")
            try:
                yield running[future], future.result()
            except _FAILURES as error:
                yield running[future], str(error)
            _show(f"{done} of {len(running)} units")


def row(result: Result) -> str:
    """A line of the table."""
    counts = [len(result.mutants), result.killed, *map(result.count, _VERDICTS)]
    numbers = "".join(f"{number:11}" for number in counts)
    return f"{result.unit:16} {result.score:7.2%}{numbers} {result.seconds:9.0f} s"


_VERDICTS = (Verdict.EQUIVALENT, Verdict.SHOWN, Verdict.UNDECIDED)
_COLUMNS = ("mutants", "killed", *_VERDICTS, "processor")
_HEAD = f"{'unit':16} {'score':>7}" + "".join(f"{name:>11}" for name in _COLUMNS)


def details(one: Judged, reason: str) -> Iterator[str]:
    """Lines about a survivor."""
    yield f"    {one.mutant.source}: {one.mutant.text}"
    yield f"      {one.mutant.number}: {one.mutant.mode} {one.mutant.place}; {one.verdict}: {one.why}"
    if one.witness:
        last = ", ".join(f"{name}={value}" for name, value in one.witness[-1].items())
        yield f"      {len(one.witness)} clocks, the last: {last[:200]}"
    yield f"      {'explained: ' + reason if reason else 'NOT EXPLAINED'}"


def _summary(results: Sequence[Result]) -> str:
    """The same line, of all units together."""
    mutants = tuple(one for result in results for one in result.mutants)
    return row(Result("all", "", mutants, sum(result.seconds for result in results)))


def main(arguments: Sequence[str]) -> int:
    """Command line; see the module's docstring."""
    parser = argparse.ArgumentParser(prog="make mutate", description="Qualify the benches by mutation.")
    parser.add_argument("units", nargs="+", metavar="unit|core-control|all")
    parser.add_argument("--mutants", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1)
    options = parser.parse_args(arguments)
    try:
        names = wanted(options.units)
        explanations = Explanations.read()
    except (KeyError, ExplanationError) as error:
        print(error.args[0], file=sys.stderr)
        return 2
    print(_HEAD)
    results, broken = [], 0
    plans = [Plan(name, options.mutants, options.seed) for name in names]
    for name, found in _results(plans, options.jobs):
        _show("")
        if isinstance(found, str):
            print(f"{name:16} {found}", flush=True)
            broken += 1
            continue
        results.append(found)
        print(row(found), flush=True)
        for one in found.survivors:
            print("\n".join(details(one, explanations.of(found.unit, one))), flush=True)
    if len(results) > 1:
        print(_summary(results))
    stale = explanations.stale(results)
    for line in stale:
        print(line, file=sys.stderr)
    unexplained = sum(not explanations.of(it.unit, one) for it in results for one in it.survivors)
    weak = [it.unit for it in results if not it.good]
    if weak:
        print(f"below {SCORE:.0%}, or more than {UNDECIDED:.0%} undecided: {', '.join(weak)}")
    if unexplained:
        print(f"{unexplained} survivors not explained in verif/mutation/explained.toml")
    return 1 if weak or unexplained or stale or broken else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
