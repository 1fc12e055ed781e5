"""What the page shows, as compact tables: from a record and the sources, nothing measured again.

A table is `{"columns": [...], "rows": [[...], ...]}`. Where a row names another, it does so by the other's
place in its table.
"""

from collections.abc import Hashable, Iterable, Sequence
from dataclasses import dataclass
from itertools import chain
from typing import Any

from regressions.record import CodeKind, File, Record, Result, Status
from regressions.report.gains import Gain, gains
from regressions.report.places import Place, Places
from regressions.report.texts import Texts
from verif.coverage.code.exclusions import Toggle
from verif.plan.join import Standing

Table = dict[str, Any]

_LINES = (CodeKind.LINE, CodeKind.BRANCH)
"""Kinds whose hits are hits of whole lines."""


class Numbers:
    """Values, each kept once, by the order in which they came."""

    def __init__(self) -> None:
        self._found: dict[Hashable, int] = {}

    def of(self, value: Hashable) -> int:
        """The value's place."""
        return self._found.setdefault(value, len(self._found))

    def values(self) -> list[Any]:
        """All of them."""
        return list(self._found)


@dataclass(frozen=True)
class Share:
    """How much of what was meant is there. excluded: of all that there is, what was not meant."""

    good: int
    excluded: int
    all: int

    @property
    def needed(self) -> int:
        """All that was meant."""
        return self.all - self.excluded

    @classmethod
    def of(cls, found: Iterable[tuple[int, str]]) -> "Share":
        """Of things by their hits and by why they are excluded."""
        listed = list(found)
        good = sum(hits > 0 and not excluded for hits, excluded in listed)
        return cls(good, sum(bool(excluded) for _, excluded in listed), len(listed))

    def row(self) -> list[int]:
        """For a table."""
        return [self.good, self.needed, self.excluded]


def sections(record: Record, texts: Texts) -> dict[str, Table]:
    """The parts of the page's data by name."""
    places = Places(texts.files)
    return {
        "summary": _summary(record, texts),
        "cards": _cards(record),
        "buckets": _buckets(record),
        "results": _results(record),
        "plan": _plan(record, places),
        "rules": _rules(record),
        **_functional(record, places),
        "curves": _curves(record),
        **_code(record),
        **_mutation(record),
        "texts": dict(texts.files),
    }


def _table(columns: str, rows: Iterable[Sequence[object]]) -> Table:
    return {"columns": columns.split(), "rows": [list(row) for row in rows]}


def _place(place: Place | None) -> list[object]:
    return [] if place is None else list(place)


def _summary(record: Record, texts: Texts) -> Table:
    verdict = "interrupted" if record.interrupted else "passed" if record.passed else "failed"
    return {
        **{name: getattr(record, name) for name in ("id", "list", "seed", "revision", "dirty", "started")},
        **{"seconds": record.seconds, "jobs": record.jobs, "tools": dict(record.tools), "verdict": verdict},
        "notes": [*record.notes, *([texts.note] if texts.note else [])],
        "counts": {str(status): number for status, number in record.counts().items()},
    }


def _cards(record: Record) -> Table:
    """The totals that head the page; a section that measured nothing has none."""
    passed = record.counts()[Status.PASSED]
    bins = [found for unit in record.coverage for point in unit.points for found in point.bins]
    code = [point for file in record.code for point in file.points]
    judged = sum(unit.mutants - unit.equivalent for unit in record.mutation)
    equivalent = sum(unit.equivalent for unit in record.mutation)
    kept = sum(promise.standing is Standing.PASSED for promise in record.plan)
    fulfilled = sum(rule.standing is Standing.PASSED for rule in record.rules)
    shares = {
        ("Runs passed", "tests"): Share(passed, 0, len(record.results)),
        ("Promises kept", "plan"): Share(kept, 0, len(record.plan)),
        ("Rules and faults fulfilled", "plan"): Share(fulfilled, 0, len(record.rules)),
        ("Functional bins", "functional"): Share.of((found.hits, found.excluded) for found in bins),
        **{
            (f"Code: {kind}", "code"): Share.of((p.hits, p.excluded) for p in code if p.kind is kind)
            for kind in CodeKind
        },
        ("Mutants killed", "mutation"): Share(
            sum(unit.killed for unit in record.mutation), equivalent, judged + equivalent
        ),
    }
    return _table("title view good needed excluded", ([*name, *of.row()] for name, of in shares.items()))


def _buckets(record: Record) -> Table:
    place = {result.id: index for index, result in enumerate(record.results)}
    rows = (
        (
            bucket.message,
            bucket.example,
            [place[name] for name in bucket.results],
            bucket.command,
            bucket.waves,
        )
        for bucket in record.buckets
    )
    return _table("message example results command waves", rows)


def _results(record: Record) -> Table:
    """Results with what each adds to the bins."""
    place = {result.id: index for index, result in enumerate(record.results)}
    bins = [found for unit in record.coverage for point in unit.points for found in point.bins]
    hitters = [[place[name] for name in found.by if name in place] for found in bins]
    of_bins = gains(hitters, len(record.results))
    columns = (
        "id entry kind test seed status seconds simulated command folder waves message checks unit simulator "
        "set build bins binsOnly binsMore"
    )
    rows = ([*_result(result), *_gain(gain)] for result, gain in zip(record.results, of_bins, strict=True))
    return _table(columns, rows)


def _result(result: Result) -> list[object]:
    checks = [[f"{check.where}::{check.name}", check.message, check.skipped] for check in result.checks]
    return [
        *(result.id, result.entry, result.kind, result.test, result.seed, result.status, result.seconds),
        *(result.simulated_ns, result.command, result.folder, result.waves, result.message, checks),
        *(result.unit, result.simulator, result.parameter_set, result.build),
    ]


def _gain(gain: Gain) -> list[int]:
    return [gain.hit, gain.only, gain.more]


def _line_gains(record: Record) -> tuple[Gain, ...]:
    hitters = chain.from_iterable(_lines(file).values() for file in record.code)
    return gains(list(hitters), len(record.code_runs))


def _lines(file: File) -> dict[int, set[int]]:
    """Runs that hit each line that a line or branch point is about."""
    found: dict[int, set[int]] = {}
    for point in file.points:
        if point.kind in _LINES:
            for line in point.lines or (point.line,):
                found.setdefault(line, set()).update(point.by)
    return found


def _plan(record: Record, places: Places) -> Table:
    rows = (
        [
            *(promise.unit, promise.name, promise.what, promise.standing),
            [[test, str(status)] for test, status in promise.tests.items()],
            [[name, *bins] for name, bins in promise.points.items()],
            _place(places.promise(promise.file, promise.name)),
        ]
        for promise in record.plan
    )
    return _table("unit name what standing tests points place", rows)


def _rules(record: Record) -> Table:
    rows = ((r.name, r.kind, r.section, r.text, r.standing, r.promises) for r in record.rules)
    return _table("name kind section text standing promises", rows)


def _functional(record: Record, places: Places) -> dict[str, Table]:
    """Units, points and bins, each in a table."""
    place = {result.id: index for index, result in enumerate(record.results)}
    units: list[list[object]] = []
    points: list[list[object]] = []
    bins: list[list[object]] = []
    for unit in record.coverage:
        share = Share.of((found.hits, found.excluded) for point in unit.points for found in point.bins)
        units.append([unit.name, len(unit.points), *share.row(), _place(places.module(unit.name))])
        for point in unit.points:
            for found in point.bins:
                by = [[place[name], hits] for name, hits in found.by.items() if name in place]
                where = _place(places.bin(unit.name, point.name, found.name))
                row = [len(points), found.name, found.hits, found.recipe, found.excluded, by, where]
                bins.append(row)
            points.append(
                [len(units) - 1, point.name, point.doc, _place(places.point(unit.name, point.name))]
            )
    return {
        "units": _table("name points good needed excluded place", units),
        "points": _table("unit name doc place", points),
        "bins": _table("point name hits recipe excluded by place", bins),
    }


def _curves(record: Record) -> Table:
    """Closure's and random's; those of single results are not drawn."""
    rows = (
        (curve.unit, curve.strategy, curve.bins, curve.steps)
        for curve in record.curves
        if curve.strategy in ("closure", "random")
    )
    return _table("unit strategy bins steps", rows)


def _code(record: Record) -> dict[str, Table]:
    """Totals by file and kind; points by file; and the reasons and sets of runs that points refer to."""
    reasons, sets = Numbers(), Numbers()
    reasons.of("")
    points = {file.path: _code_points(file, reasons, sets) for file in record.code}
    toggles = {file.path: _toggles(file, reasons, sets) for file in record.code}
    files = ([file.path, *chain.from_iterable(_totals(file))] for file in record.code)
    columns = " ".join(f"{kind} {kind}Needed {kind}Excluded" for kind in CodeKind)
    runs = zip(record.code_runs, _line_gains(record), strict=True)
    return {
        "files": _table(f"path {columns}", files),
        "code": {
            **{"kinds": list(CodeKind), "points": points, "toggles": toggles},
            **{"reasons": reasons.values(), "sets": sets.values()},
        },
        "runs": _table("name lines linesOnly linesMore", ([name, *_gain(gain)] for name, gain in runs)),
    }


def _code_points(file: File, reasons: Numbers, sets: Numbers) -> list[list[object]]:
    """Points that are no toggles: line, kind, name, hits, set of runs, reason, lines."""
    kinds = list(CodeKind)
    return [
        [p.line, kinds.index(p.kind), p.name, p.hits, sets.of(p.by), reasons.of(p.excluded), list(p.lines)]
        for p in file.points
        if p.kind is not CodeKind.TOGGLE
    ]


def _toggles(file: File, reasons: Numbers, sets: Numbers) -> list[list[object]]:
    """Toggles of a signal with the same runs and reason together, since nearly all points are toggles: line,
    signal, set of runs, reason, and by turns twice the bit, one more where it falls, and the hits. A signal
    of one bit has bit -1."""
    found: dict[tuple[object, ...], list[int]] = {}
    for point in file.points:
        if point.kind is CodeKind.TOGGLE:
            toggle = Toggle.of(point.name)
            bit = -1 if toggle.bit is None else toggle.bit
            key = (point.line, toggle.signal, sets.of(point.by), reasons.of(point.excluded))
            found.setdefault(key, []).extend((2 * bit + (toggle.edge == "1->0"), point.hits))
    return [[*key, hits] for key, hits in found.items()]


def _totals(file: File) -> Iterable[list[int]]:
    for kind in CodeKind:
        yield Share.of((point.hits, point.excluded) for point in file.points if point.kind is kind).row()


def _mutation(record: Record) -> dict[str, Table]:
    units = (
        (unit.unit, unit.mutants, unit.killed, unit.equivalent, unit.undecided, unit.score)
        for unit in record.mutation
    )
    survivors = (
        (unit.unit, m.number, m.change, m.verdict, m.shown_by, m.reason, [m.file, m.line])
        for unit in record.mutation
        for m in unit.survivors
    )
    return {
        "mutation": _table("unit mutants killed equivalent undecided score", units),
        "survivors": _table("unit number change verdict witness reason place", survivors),
    }
