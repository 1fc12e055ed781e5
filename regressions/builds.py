"""The builds that runs need, each made once, before the runs, side by side."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from threading import Event

from regressions.lists import Kind
from regressions.record import Result
from verif.core.cases import CASES
from verif.env import units
from verif.env.build import Build, BuildError, ensure
from verif.env.simulators import MissingTool, Simulator


def needed(run: Result, waves: bool = False) -> Build | None:
    """The build of a run; None where it has none, or makes its own. Raises MissingTool."""
    if run.kind == Kind.UNIT:
        unit = units.find(run.unit)
        parameters = unit.parameter_sets()[run.parameter_set]
        return units.build(unit, Simulator(run.simulator), parameters, waves=waves)
    if run.kind == Kind.CORE:
        return next(case for case in CASES if str(case) == run.test).design.made(waves)
    return None


def by_content(runs: Iterable[Result]) -> tuple[dict[str, Build], dict[str, str], dict[str, str]]:
    """Builds by their key; keys of the runs' builds by their ids; and what keeps a run from having one."""
    builds: dict[str, Build] = {}
    keys: dict[str, str] = {}
    missing: dict[str, str] = {}
    for run in runs:
        try:
            build = needed(run)
        except MissingTool as tool:
            missing[run.id] = str(tool)
            continue
        if build is not None:
            key = build.directory.name
            builds.setdefault(key, build)
            keys[run.id] = key
    return builds, keys, missing


def make(
    builds: Mapping[str, Build], jobs: int, stop: Event, done: Callable[[int, int], None]
) -> dict[str, str]:
    """Makes them; the complaints of those that failed, by key."""
    waiting = {key: build for key, build in builds.items() if not build.ready}
    failed: dict[str, str] = {}

    def one(key: str) -> tuple[str, str]:
        if stop.is_set():
            return key, "interrupted before its build"
        try:
            ensure(waiting[key])
        except (BuildError, MissingTool) as error:
            return key, str(error)
        return key, ""

    with ThreadPoolExecutor(jobs) as pool:
        for number, future in enumerate(as_completed([pool.submit(one, key) for key in waiting]), 1):
            key, complaint = future.result()
            done(number, len(waiting))
            if complaint:
                failed[key] = complaint
    return failed


def without_build(
    runs: Sequence[Result], jobs: int, stop: Event, done: Callable[[int, int], None]
) -> dict[str, str]:
    """Makes all builds that the runs need; why some have none, by the ids of the runs."""
    builds, keys, missing = by_content(runs)
    failed = make(builds, jobs, stop, done)
    return {**missing, **{name: failed[key] for name, key in keys.items() if key in failed}}
