"""The summary of a regression in Markdown."""

from collections.abc import Iterable, Iterator, Sequence

from regressions.record import Bucket, Record, Status
from verif.plan.join import Standing

_SLOWEST = 10


def summary(record: Record) -> str:
    """A page: verdict, counts, failures with their commands, coverage, slowest runs."""
    parts = (_head, _entries, _failures, _sections, _slow)
    return "\n".join(line for part in parts for line in part(record))


def _head(record: Record) -> Iterator[str]:
    verdict = "passed" if record.passed else "interrupted" if record.interrupted else "failed"
    yield f"# {record.list}: {verdict}"
    yield ""
    counts = ", ".join(f"{number} {_words(status)}" for status, number in record.counts().items() if number)
    yield f"{len(record.results)} runs in {record.seconds:.0f} s, {record.jobs} at a time: {counts}."
    changed = " and changes that are not committed" if record.dirty else ""
    yield f"Revision {record.revision[:12] or 'unknown'}{changed}, root seed {record.seed}, {record.started}."
    yield ", ".join(f"{name} {version}" for name, version in record.tools.items()) + "."
    yield from (f"Note: {note}." for note in record.notes)
    yield ""


def _words(status: Status) -> str:
    return status.replace("_", " ")


def _table(head: Sequence[str], rows: Iterable[Sequence[object]]) -> Iterator[str]:
    yield f"| {' | '.join(head)} |"
    yield f"|{' --- |' * len(head)}"
    yield from (f"| {' | '.join(str(cell).replace('|', '&#124;') for cell in row)} |" for row in rows)
    yield ""


def _entries(record: Record) -> Iterator[str]:
    names = dict.fromkeys(result.entry for result in record.results)
    rows = []
    for name in names:
        mine = [result for result in record.results if result.entry == name]
        passed = sum(result.status is Status.PASSED for result in mine)
        seconds = sum(result.seconds for result in mine)
        rows.append((name, len(mine), passed, len(mine) - passed, f"{seconds:.0f}"))
    yield from _table(("entry", "runs", "passed", "other", "seconds"), rows)


def _failures(record: Record) -> Iterator[str]:
    if not record.buckets:
        return
    yield "## Failures"
    yield ""
    for bucket in record.buckets:
        yield from _bucket(bucket, record)


def _bucket(bucket: Bucket, record: Record) -> Iterator[str]:
    statuses = {result.id: result.status for result in record.results}
    yield f"### {len(bucket.results)} x {_words(statuses[bucket.results[0]])}: {bucket.message}"
    yield ""
    yield from _fenced(bucket.example)
    yield "Shown again by"
    yield from _fenced(bucket.command)
    if bucket.waves:
        yield f"Waves: `{bucket.waves}`"
    yield f"Runs: {', '.join(bucket.results)}"
    yield ""


def _fenced(text: str) -> Iterator[str]:
    fence = "````" if "```" in text else "```"
    yield from (fence, text, fence)


def _percent(part: int, whole: int) -> str:
    return f"{100 * part / whole:.1f} %" if whole else "none"


def _sections(record: Record) -> Iterator[str]:
    if record.coverage:
        yield from ("## Functional coverage", "")
        yield from _table(("unit", "bins", "excluded", "hit", ""), _functional(record))
    if record.code:
        yield from ("## Code coverage", "")
        yield from _table(("kind", "points", "excluded", "hit", ""), _code(record))
    if record.mutation:
        yield from ("## Mutation", "")
        rows = [
            (m.unit, m.mutants, m.equivalent, m.undecided, m.killed, _score(m.score)) for m in record.mutation
        ]
        yield from _table(("unit", "mutants", "equivalent", "undecided", "killed", "score"), rows)
    if record.plan:
        kept = sum(promise.standing is Standing.PASSED for promise in record.plan)
        yield from ("## Plan", "")
        yield from (f"{kept} of {len(record.plan)} promises are kept.", "")


def _score(score: float | None) -> str:
    return "none" if score is None else f"{100 * score:.1f} %"


def _functional(record: Record) -> Iterator[tuple[object, ...]]:
    for unit in record.coverage:
        bins = [found for point in unit.points for found in point.bins]
        needed = [found for found in bins if not found.excluded]
        hit = sum(found.hits > 0 for found in needed)
        yield unit.name, len(bins), len(bins) - len(needed), hit, _percent(hit, len(needed))


def _code(record: Record) -> Iterator[tuple[object, ...]]:
    points = [point for file in record.code for point in file.points]
    for kind in dict.fromkeys(point.kind for point in points):
        mine = [point for point in points if point.kind is kind]
        needed = [point for point in mine if not point.excluded]
        hit = sum(point.hits > 0 for point in needed)
        yield kind, len(mine), len(mine) - len(needed), hit, _percent(hit, len(needed))


def _slow(record: Record) -> Iterator[str]:
    yield from ("## Slowest runs", "")
    slowest = sorted(record.results, key=lambda result: -result.seconds)[:_SLOWEST]
    rows = [(r.id, f"{r.seconds:.1f}", f"{r.simulated_ns / 1e6:.3f}", r.seed) for r in slowest]
    yield from _table(("run", "seconds", "simulated ms", "seed"), rows)
