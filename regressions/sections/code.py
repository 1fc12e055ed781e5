"""Code coverage: what all runs that collected it have hit, less the exclusions."""

from dataclasses import replace
from pathlib import Path

from regressions.record import CodeKind, CodePoint, File, Record
from regressions.sections.notes import noted, older
from verif.coverage.code import collect, exclusions, runs
from verif.coverage.code.points import Kind, load

_KINDS = {
    Kind.LINE: CodeKind.LINE,
    Kind.BRANCH: CodeKind.BRANCH,
    Kind.EXPRESSION: CodeKind.EXPRESSION,
    Kind.TOGGLE: CodeKind.TOGGLE,
}


def added(record: Record, _root: Path) -> Record:
    """The record with code coverage, as it was last merged; without one where no run has collected any."""
    if not collect.MERGED.exists():
        return noted(record, ["no run has collected code coverage"])
    coverage = load(collect.MERGED).current()
    missing = set(runs.everything()) - coverage.tests
    try:
        review = exclusions.apply(exclusions.read(), coverage, whole=not missing)
    except exclusions.ExclusionError as error:
        return noted(record, [str(error)])
    names = tuple(sorted(coverage.tests))
    place = {name: index for index, name in enumerate(names)}
    files = tuple(
        File(
            path,
            tuple(
                CodePoint(
                    point.line,
                    point.column,
                    _KINDS[point.kind],
                    point.what,
                    hits.count,
                    tuple(sorted(hits.lines)),
                    review.excluded[point].reason if point in review.excluded else "",
                    tuple(sorted(place[test] for test in hits.tests)),
                )
                for point, hits in points.items()
            ),
        )
        for path, points in coverage.of_files().items()
    )
    notes = [*review.problems, *older(record, [collect.MERGED], "code coverage")]
    if missing:
        notes.append(f"code coverage is without {len(missing)} runs, as {min(missing)}")
    return noted(replace(record, code=files, code_runs=names), notes)
