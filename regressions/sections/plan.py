"""The verification plan joined with what ran here."""

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

from regressions.record import Check, Promise, Record, Result, Rule, Status
from regressions.sections.notes import noted
from verif.plan import join
from verif.plan.read import read_plans, read_specification
from verif.plan.records import PlanError


def added(record: Record, _root: Path) -> Record:
    """The record with how every promise stands."""
    try:
        plans, specification = read_plans(), read_specification()
    except PlanError as error:
        return noted(record, [str(error)])
    bins = {
        f"{unit.name}.{point.name}.{found.name}": found
        for unit in record.coverage
        for point in unit.points
        for found in point.bins
    }
    excluded = {name for name, found in bins.items() if found.excluded}
    hits = {name: found.hits for name, found in bins.items()}
    verdicts = join.join(plans, join.fold(outcomes(record)), hits, excluded)
    rules = join.join_rules(specification, verdicts)
    return replace(record, plan=tuple(map(_promise, verdicts)), rules=tuple(map(_rule, rules)))


def outcomes(record: Record) -> Iterator[tuple[str, str, str]]:
    """Where each test is, its name and how it ended: in every run."""
    for result in record.results:
        for check in result.checks:
            yield check.where, check.name, _status(result, check)


def _status(result: Result, check: Check) -> Status:
    """A test that passed in a run that was stopped has passed."""
    if check.skipped:
        return Status.NOT_RUN
    if check.message:
        return Status.FAILED if result.status is Status.PASSED else result.status
    return Status.PASSED


def _promise(verdict: join.Verdict) -> Promise:
    return Promise(
        verdict.plan,
        verdict.id,
        verdict.what,
        verdict.file,
        {name: Status(status) for name, status in verdict.tests.items()},
        verdict.points,
        verdict.standing,
    )


def _rule(verdict: join.RuleVerdict) -> Rule:
    return Rule(verdict.id, verdict.kind, verdict.section, verdict.text, verdict.promises, verdict.standing)
