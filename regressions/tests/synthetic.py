"""Records of regressions that never ran, drawn from a seed: as large as wanted, with every kind of entry.

Points lie on real lines of the design, so that pages of them show real sources.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.random import Generator

from regressions.record import (
    Bin,
    Bucket,
    Check,
    CodeKind,
    CodePoint,
    Curve,
    File,
    Mutant,
    Mutation,
    Point,
    Promise,
    Record,
    Result,
    Rule,
    Status,
    Unit,
)
from verif.env import sources
from verif.plan.join import Standing
from verif.units.sqrt.coverage import COVERAGE

HOSTILE = "</script><img src=x onerror=\"document.title='broken out'\"> & 'quoted' {{data}}"
"""Text that no page may take for its own."""

HOLE = "sqrt.remainder.half"
"""A bin of the square root that nothing hits."""

WITNESS = '[{"radicand": 7, "valid": 1, "tag": 0}, {"radicand": 5, "valid": 0, "tag": 0}]'
"""Inputs clock by clock, as the qualification by mutation tells them."""

_ENDS = (*[Status.PASSED] * 20, Status.FAILED, Status.TIMED_OUT, Status.KILLED, Status.NOT_RUN)


@dataclass(frozen=True)
class Size:
    """How many results, bins and points of code a record has; code_runs: how many runs count code."""

    results: int = 40
    bins: int = 120
    points: int = 15_000
    code_runs: int = 12


LARGE = Size(results=1_500, bins=3_000, points=200_000, code_runs=150)
"""More than a nightly."""


def record(seed: int, size: Size = Size()) -> Record:
    """A record with failures, holes, exclusions and survivors."""
    generator = np.random.default_rng(seed)
    results = tuple(_result(generator, number) for number in range(size.results))
    units = (_square_root(results, generator), *_units(generator, results, size.bins))
    plan = tuple(_promise(generator, unit, point) for unit in units for point in unit.points)
    return Record(
        id="20260101-000000-synthetic",
        list="synthetic",
        seed=seed,
        revision="0" * 40,
        dirty=True,
        tools={"python": "3.11", "verilator": "5.049"},
        started="2026-01-01T00:00:00+00:00",
        seconds=1234.5,
        jobs=2,
        results=results,
        buckets=_buckets(results),
        coverage=units,
        curves=tuple(curve for unit in units for curve in _curves(generator, unit)),
        code=_files(generator, size),
        code_runs=tuple(f"block{number}-default" for number in range(size.code_runs)),
        mutation=tuple(_mutation(generator, unit.name) for unit in units),
        plan=plan,
        rules=tuple(_rules(plan)),
        notes=("nothing of this was measured",),
    )


def _result(generator: Generator, number: int) -> Result:
    # The first two fail alike, with a message that is no page's friend.
    status = Status.FAILED if number < 2 else _ENDS[generator.integers(len(_ENDS))]
    message = "" if status is Status.PASSED else HOSTILE if number < 2 else f"{status} after {number} clocks"
    return Result(
        id=f"units.block{number % 37}-default-verilator.{number}",
        entry="units",
        kind="unit",
        test=f"block{number % 37}-default-verilator",
        index=number,
        seed=int(generator.integers(1 << 31)),
        status=status,
        seconds=float(np.round(generator.exponential(5.0), 3)),
        command=f"make unit UNIT=block{number % 37} SIM=verilator SET=default SEED={number}",
        folder=f"build/regressions/synthetic/{number}",
        simulated_ns=float(generator.integers(10**7)),
        message=message,
        unit=f"block{number % 37}",
        simulator="verilator",
        parameter_set="default",
        checks=tuple(
            Check(f"promise_{check}", "bench", message=message if check == 0 else "") for check in range(4)
        ),
    )


def _buckets(results: Sequence[Result]) -> tuple[Bucket, ...]:
    found: dict[str, list[Result]] = {}
    for result in results:
        if result.status is not Status.PASSED:
            found.setdefault(result.message.split(" after")[0], []).append(result)
    return tuple(
        Bucket(message, of[0].message, tuple(one.id for one in of), of[0].command)
        for message, of in found.items()
    )


def _hit(generator: Generator, name: str, results: Sequence[Result], recipe: str) -> Bin:
    if generator.random() < 0.03:
        return Bin(name, 0, recipe, excluded="the encoding has ten states")
    number = int(generator.integers(1, 12)) if generator.random() < 0.95 else 0
    chosen = generator.choice(len(results), min(number, len(results)), replace=False)
    by = {results[at].id: int(generator.integers(1, 10_000)) for at in sorted(chosen)}
    return Bin(name, sum(by.values()), recipe, by=by)


def _square_root(results: Sequence[Result], generator: Generator) -> Unit:
    """The points that the square root has, with the one hole that tests follow."""
    points = [
        Point(
            point.name,
            point.doc,
            tuple(
                Bin(found.name, 0, found.recipe.name)
                if f"sqrt.{point.name}.{found.name}" == HOLE
                else Bin(found.name, 7, found.recipe.name, by={results[0].id: 4, results[-1].id: 3})
                for found in point.bins
            ),
        )
        for point in COVERAGE.points
    ]
    return Unit("sqrt", tuple(points))


def _units(generator: Generator, results: Sequence[Result], bins: int) -> list[Unit]:
    """Units of four points of ten bins."""
    return [
        Unit(
            f"block{unit}",
            tuple(
                Point(
                    f"point{point}",
                    f"cases of {point}",
                    tuple(
                        _hit(generator, f"bin{number}", results, f"recipe {number % 4}")
                        for number in range(10)
                    ),
                )
                for point in range(4)
            ),
        )
        for unit in range(-(-bins // 40))
    ]


def _curves(generator: Generator, unit: Unit) -> tuple[Curve, Curve]:
    bins = sum(not found.excluded for point in unit.points for found in point.bins)
    directed = np.sort(generator.integers(1, 2_000, bins))
    random = np.sort(generator.integers(1, 20_000, bins // 2))
    return (
        Curve(unit.name, "closure", bins, tuple((int(at), hit) for hit, at in enumerate(directed, 1))),
        Curve(unit.name, "random", bins, tuple((int(at), hit) for hit, at in enumerate(random, 1))),
    )


def _files(generator: Generator, size: Size) -> tuple[File, ...]:
    paths = sources.relative(sorted(sources.HDL.rglob("*.v")))
    every = [_points(generator, path, size.points // len(paths), size.code_runs) for path in paths]
    return tuple(File(path, points) for path, points in zip(paths, every, strict=True))


def _points(generator: Generator, path: str, number: int, runs: int) -> tuple[CodePoint, ...]:
    """One in twenty is not hit, one in a hundred excluded; runs hit whole signals alike."""
    last = len((sources.ROOT / path).read_text().splitlines())
    lines = np.sort(generator.integers(1, last + 1, number))
    kinds = generator.choice([0, 1, 2, 3], number, p=[0.05, 0.05, 0.05, 0.85])
    shares = [tuple(np.flatnonzero(generator.random(runs) < 0.3).tolist()) for _ in range(20)]
    return tuple(
        _point(generator, int(line), list(CodeKind)[kind], index, shares[line % 20], last)
        for index, (line, kind) in enumerate(zip(lines, kinds, strict=True))
    )


def _point(
    generator: Generator, line: int, kind: CodeKind, index: int, by: tuple[int, ...], last: int
) -> CodePoint:
    name = {CodeKind.TOGGLE: f"signal_reg[{index % 64}]:0->1", CodeKind.EXPRESSION: "a==1 => 1"}.get(
        kind, "if"
    )
    about = tuple(range(line, min(line + 3, last + 1))) if kind is CodeKind.LINE else ()
    chance = generator.random()
    if chance < 0.05 or not by:
        why = "cannot be reached" if chance < 0.01 else ""
        return CodePoint(line, index + 1, kind, name, 0, about, excluded=why)
    return CodePoint(line, index + 1, kind, name, int(generator.integers(1, 10**6)), about, by=by)


def _mutation(generator: Generator, unit: str) -> Mutation:
    survivors = (
        Mutant(1, "hdl/arith/sqrt.v", 51, "inv at bit 3", "survived", WITNESS, "a don't care"),
        Mutant(2, "hdl/arith/sqrt.v", 52, "const0 at bit 0", "undecided"),
    )
    return Mutation(unit, 200, 200 - 12 - 2, 12, 1, survivors)


def _promise(generator: Generator, unit: Unit, point: Point) -> Promise:
    status = [Status.PASSED, Status.PASSED, Status.FAILED, Status.NOT_RUN][generator.integers(4)]
    needed = [found for found in point.bins if not found.excluded]
    hit = sum(found.hits > 0 for found in needed)
    held = Standing.PASSED if hit == len(needed) else Standing.HOLE
    standing = {Status.FAILED: Standing.FAILED, Status.NOT_RUN: Standing.NOT_RUN}.get(status, held)
    return Promise(
        unit=unit.name,
        name=f"{unit.name}.{point.name}",
        what=f"It does what {point.doc} say.",
        file="verif/units/sqrt/plan.toml",
        tests={f"verif.units.{unit.name}.bench::every_case_matches": status},
        points={f"{unit.name}.{point.name}": (hit, len(needed))},
        standing=standing,
    )


def _rules(plan: Sequence[Promise]) -> Iterator[Rule]:
    """A rule for every two promises, and a fault that nothing fulfils."""
    order = list(Standing)
    for number in range(0, len(plan), 2):
        own = plan[number : number + 2]
        worst = min((promise.standing for promise in own), key=order.index)
        names = tuple(promise.name for promise in own)
        yield Rule(f"rule.{number}", "rule", "[9.1]", f"It is as {number} says.", names, worst)
    yield Rule("fault.none", "fault", "[9.2]", "Nothing comes of it.", (), Standing.NOT_RUN)
