"""The plan joined with what a regression found: which promises hold."""

import re
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from functools import partial

from verif.plan.records import NamedTest, Plan, Promise, Specification

Results = Mapping[tuple[str, str], str]
"""Status of each test, by `NamedTest.where` and `NamedTest.name`: `passed`, `not_run`, or how it failed."""

PASSED, NOT_RUN = "passed", "not_run"

_PARAMETERS = re.compile(r"[\[/].*")


class Standing(StrEnum):
    """What is known of a promise; the first of these that is so."""

    FAILED = "failed"
    NOT_RUN = "not run"
    HOLE = "hole"
    PASSED = "passed"


@dataclass(frozen=True)
class Verdict:
    """A promise and how it stands.

    tests: status of each. points: of each cover point or bin that it needs, bins hit and bins to hit.
    """

    plan: str
    id: str
    what: str
    file: str
    rules: tuple[str, ...]
    tests: Mapping[str, str]
    points: Mapping[str, tuple[int, int]]
    standing: Standing


@dataclass(frozen=True)
class RuleVerdict:
    """A rule or fault and how it stands: as the worst of the promises that fulfil it."""

    id: str
    kind: str
    section: str
    text: str
    promises: tuple[str, ...]
    standing: Standing


def fold(outcomes: Iterable[tuple[str, str, str]]) -> dict[tuple[str, str], str]:
    """Results of (where, name, status) of single runs: names without parameters, the worst status of each."""
    worst: dict[tuple[str, str], str] = {}
    for where, name, status in outcomes:
        key = (where, _PARAMETERS.sub("", name))
        worst[key] = max(worst.get(key, PASSED), status, key=_badness)
    return worst


def _badness(status: str) -> int:
    return {PASSED: 0, NOT_RUN: 1}.get(status, 2)


def join(
    plans: Sequence[Plan],
    results: Results,
    coverage: Mapping[str, int],
    excluded: Collection[str] = frozenset(),
) -> tuple[Verdict, ...]:
    """How every promise stands.

    coverage: hits of every bin, by `<unit>.<point>.<bin>`; 0 where there were none. excluded: bins that need
    no hit. A cover point of which neither knows anything was not measured, which is a hole.
    """
    needed = {name: hits for name, hits in coverage.items() if name not in excluded}
    judge = partial(_verdict, results=results, coverage=needed, excluded=excluded)
    return tuple(judge(plan, promise) for plan in plans for promise in plan.promises)


def _verdict(
    plan: Plan, promise: Promise, results: Results, coverage: Mapping[str, int], excluded: Collection[str]
) -> Verdict:
    tests = {str(test): _status(test, results) for test in promise.tests}
    points = {name: _hits(name, coverage) for name in promise.covers}
    holes = [
        name
        for name, (hit, there) in points.items()
        if hit < there or not (there or any(_is_of(found, name) for found in excluded))
    ]
    worst = max(tests.values(), key=_badness, default=NOT_RUN)
    if worst == NOT_RUN:
        standing = Standing.NOT_RUN
    elif worst != PASSED:
        standing = Standing.FAILED
    else:
        standing = Standing.HOLE if holes else Standing.PASSED
    return Verdict(
        plan.name, promise.id, promise.what, str(plan.file), promise.rules, tests, points, standing
    )


def _status(test: NamedTest, results: Results) -> str:
    return results.get((test.where, test.name), NOT_RUN)


def _is_of(found: str, name: str) -> bool:
    """Whether a bin is the one of this name, or belongs to the point of this name."""
    return found == name or found.startswith(f"{name}.")


def _hits(name: str, coverage: Mapping[str, int]) -> tuple[int, int]:
    """Bins hit and there, of a point or a bin."""
    counts = [hits for found, hits in coverage.items() if _is_of(found, name)]
    return sum(hits > 0 for hits in counts), len(counts)


def join_rules(specification: Specification, verdicts: Sequence[Verdict]) -> tuple[RuleVerdict, ...]:
    """How every rule and fault stands; one that no promise fulfils has not run."""
    order = list(Standing)
    judged = []
    for rule in specification.rules:
        own = [verdict for verdict in verdicts if rule.id in verdict.rules]
        worst = min((verdict.standing for verdict in own), key=order.index, default=Standing.NOT_RUN)
        names = tuple(verdict.id for verdict in own)
        judged.append(RuleVerdict(rule.id, rule.kind, rule.section, rule.text, names, worst))
    return tuple(judged)
