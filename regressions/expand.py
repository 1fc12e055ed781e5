"""From a list to the runs it means: one result that has not run for each test and each of its seeds."""

import hashlib
import re
import subprocess
import sys
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from fnmatch import fnmatchcase

from regressions.lists import Entry, Kind, ListError, RunList
from regressions.record import Result, Status
from verif.core.cases import CASES
from verif.env import sources, units
from verif.env.simulators import Simulator

PYTHON = ".venv/bin/python"

_SEEDS = 1 << 31

_EACH_UNIT = "{unit}"
"""In the words of a module: once with each unit."""


@dataclass(frozen=True)
class _Test:
    """A test of an entry: its name, what Python is told to run it, and what a person types.

    seeded: whether those take a seed.
    """

    name: str
    arguments: tuple[str, ...]
    command: str
    unit: str = ""
    simulator: str = ""
    parameter_set: str = ""
    build: str = ""
    seed_option: str = "--seed"
    seed_word: str = ""


def derived(root: int, test: str, index: int) -> int:
    """The seed of one run: its own, whatever else is in the list."""
    digest = hashlib.sha256(f"{root}/{test}/{index}".encode()).digest()
    return int.from_bytes(digest[:8], "big") % (_SEEDS - 1) + 1


def expand(run_list: RunList, root: int) -> tuple[Result, ...]:
    """All runs of a list, in its order. Raises ListError where an entry names nothing."""
    found: list[Result] = []
    for entry in run_list.entries:
        at = f"{run_list.path}: entry {entry.name}"
        for test in _TESTS[entry.kind](entry, at):
            found += (_planned(entry, test, index, root) for index in range(entry.seeds))
    return tuple(_distinct(found))


def chosen(planned: Sequence[Result], pattern: str) -> tuple[Result, ...]:
    """Those whose id or test the pattern matches, `*` and `?` being any. Raises ListError where none is."""
    found = tuple(run for run in planned if _any(pattern, (run.id, run.test)))
    if not found:
        raise ListError(f"{pattern}: matches none of {len(planned)} runs, such as {planned[0].id}")
    return found


def _distinct(planned: Iterable[Result]) -> Iterator[Result]:
    """Ids are folders' names, from which characters were taken: two that became one are told apart."""
    taken: set[str] = set()
    for run in planned:
        name, number = run.id, 1
        while name in taken:
            number += 1
            name = f"{run.id}~{number}"
        taken.add(name)
        yield replace(run, id=name)


def _planned(entry: Entry, test: _Test, index: int, root: int) -> Result:
    seed = derived(root, f"{entry.kind}/{test.name}", index)
    word = f" {test.seed_word}{seed}" if test.seed_word else ""
    option = (test.seed_option, str(seed)) if test.seed_word else ()
    return Result(
        id=re.sub(r"[^A-Za-z0-9._-]+", "_", f"{entry.name}.{test.name}.{index}"),
        entry=entry.name,
        kind=entry.kind,
        test=test.name,
        index=index,
        seed=seed,
        status=Status.NOT_RUN,
        seconds=0.0,
        command=test.command + word,
        folder="",
        arguments=(*test.arguments, *option),
        wall_limit=entry.wall_minutes * 60,
        simulated_limit=(entry.simulated_ms or 0) * 1e6,
        unit=test.unit,
        simulator=test.simulator,
        parameter_set=test.parameter_set,
        build=test.build,
    )


def _any(pattern: str, names: Iterable[str]) -> bool:
    """A name is the pattern, brackets and all, or matches it."""
    return any(name == pattern or fnmatchcase(name, pattern) for name in names)


def _matching(names: Sequence[str], wanted: Iterable[str], at: str, what: str) -> list[str]:
    """The names that a pattern wants, in their order. Raises ListError for a pattern that wants none."""
    patterns = list(wanted)
    for pattern in patterns:
        if not any(fnmatchcase(name, pattern) for name in names):
            raise ListError(f"{at}: {what}: {pattern!r} matches none of {', '.join(names)}")
    return [name for name in names if any(fnmatchcase(name, pattern) for pattern in patterns)]


def _left(names: Sequence[str], entry: Entry, at: str) -> list[str]:
    """The names that an entry's tests want, less its exceptions."""
    out = _matching(names, entry.without, at, "except")
    return [name for name in _matching(names, entry.tests, at, "tests") if name not in out]


def _units(entry: Entry, at: str) -> Iterator[_Test]:
    names = _left(units.names(), entry, at)
    sets = {name: list(units.find(name).parameter_sets()) for name in names}
    every = sorted({found for of_unit in sets.values() for found in of_unit})
    wanted = _matching(every, entry.sets, at, "sets")
    for name in names:
        for parameter_set in sets[name]:
            if parameter_set in wanted:
                yield from (_unit(entry, name, parameter_set, simulator) for simulator in entry.simulators)


def _unit(entry: Entry, name: str, parameter_set: str, simulator: Simulator) -> _Test:
    options = ["--unit", name, "--sim", simulator, "--set", parameter_set]
    words = [f"make unit UNIT={name} SIM={simulator} SET={parameter_set}"]
    for option in ("examples", "operands"):
        value = getattr(entry, option)
        if value is not None:
            options += [f"--{option}", str(value)]
            words.append(f"{option.upper()}={value}")
    return _Test(
        f"{name}-{parameter_set}-{simulator}",
        ("-m", "pytest", "verif/test_units.py", *options),
        " ".join(words),
        unit=name,
        simulator=simulator,
        parameter_set=parameter_set,
        seed_word="SEED=",
    )


def _cores(entry: Entry, at: str) -> Iterator[_Test]:
    names = _left([str(case) for case in CASES], entry, at)
    builds = _matching(list(dict.fromkeys(case.design.build for case in CASES)), entry.builds, at, "builds")
    for case in CASES:
        design = case.design
        if str(case) in names and design.build in builds and design.simulator in entry.simulators:
            examples = () if entry.examples is None else ("--examples", str(entry.examples))
            node = f"verif/test_core.py::test_core[{case}]"
            yield replace(
                _pytest(node, examples),
                name=str(case),
                unit="core",
                simulator=design.simulator,
                build=design.build,
            )


def _pytest(node: str, options: Sequence[str] = ()) -> _Test:
    """A test by what pytest calls it. The benches' seed is an option of `verif`'s; elsewhere Hypothesis'."""
    option = "--seed" if node.startswith("verif") else "--hypothesis-seed"
    words = " ".join([f"make setup && {PYTHON} -m pytest '{node}'", *options])
    return _Test(node, ("-m", "pytest", node, *options), words, seed_option=option, seed_word=f"{option}=")


def _collected(names: Sequence[str], at: str) -> list[str]:
    """Each test of these by its id."""
    command = [sys.executable, "-m", "pytest", "--collect-only", "-q", *names]
    done = subprocess.run(command, cwd=sources.ROOT, capture_output=True, text=True, check=False)
    found = [line for line in done.stdout.splitlines() if "::" in line]
    if done.returncode or not found:
        raise ListError(f"{at}: tests: pytest collects nothing of {', '.join(names)}")
    return found


def _paths(entry: Entry, at: str) -> Iterator[_Test]:
    nodes: list[str] = []
    for pattern in entry.tests:
        path, _, test = pattern.partition("::")
        files = sorted(sources.ROOT.glob(path))
        if not files:
            raise ListError(f"{at}: tests: {path!r} is no file or folder of the project")
        nodes += [f"{file}::{test}" if test else file for file in sources.relative(files)]
    out = _matching(nodes, entry.without, at, "except")
    nodes = [node for node in nodes if node not in out]
    yield from (_pytest(node) for node in (_collected(nodes, at) if entry.each else nodes))


def _modules(entry: Entry, at: str) -> Iterator[_Test]:
    for text in entry.tests:
        package = text.split()[0]
        if not (sources.ROOT / package.replace(".", "/") / "__main__.py").exists():
            raise ListError(f"{at}: tests: {package!r} is no package of the project that Python runs")
        for name in units.names() if _EACH_UNIT in text else ("",):
            words = text.replace(_EACH_UNIT, name)
            command = f"make setup && {PYTHON} -m {words}"
            yield _Test(words, ("-m", *words.split()), command, unit=name)


_TESTS = {Kind.UNIT: _units, Kind.CORE: _cores, Kind.PYTEST: _paths, Kind.MODULE: _modules}
