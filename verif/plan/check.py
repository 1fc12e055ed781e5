"""What is wrong with the plans: promises, tests, cover points and rules that do not meet."""

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from verif.plan.inventory import Inventory
from verif.plan.read import PLAN
from verif.plan.records import Plan, Promise, Specification


@dataclass(frozen=True)
class Finding:
    """One error: file and entry that it is about, what is wrong, and what to do."""

    file: str
    entry: str
    problem: str
    remedy: str

    def __str__(self) -> str:
        return f"{self.file}: {self.entry}: {self.problem}; {self.remedy}"


def check(plans: Sequence[Plan], specification: Specification, there: Inventory) -> tuple[Finding, ...]:
    """Every error, those of one kind together."""
    return (
        *_ids(plans, specification),
        *_promises(plans, specification, there),
        *_tests_without_a_promise(plans, there),
        *_points_without_a_promise(plans, there),
        *_rules_without_a_promise(plans, specification),
        *_units_without_a_plan(plans, there),
    )


def _all(plans: Sequence[Plan]) -> Iterator[tuple[Plan, Promise]]:
    return ((plan, promise) for plan in plans for promise in plan.promises)


def _ids(plans: Sequence[Plan], specification: Specification) -> Iterator[Finding]:
    for plan, promise in _all(plans):
        if not promise.id.startswith(f"{plan.name}."):
            yield Finding(
                str(plan.file),
                promise.id,
                "is not named after its folder",
                f"begin the id with `{plan.name}.`",
            )
    named = [(promise.id, str(plan.file)) for plan, promise in _all(plans)]
    named += [(rule.id, str(specification.file)) for rule in specification.rules]
    files = dict(named)
    for name, number in Counter(name for name, _ in named).items():
        if number > 1:
            yield Finding(files[name], name, f"{number} entries have this id", "give each one of its own")


def _promises(plans: Sequence[Plan], specification: Specification, there: Inventory) -> Iterator[Finding]:
    rules = {rule.id for rule in specification.rules}
    points = {point.name for point in there.points} | {name for point in there.points for name in point.full}
    for plan, promise in _all(plans):
        file, entry = str(plan.file), promise.id
        if not promise.tests:
            yield Finding(file, entry, "no test shows it", "name one in `tests`")
        for test in promise.tests:
            if test not in there.tests:
                yield Finding(
                    file, entry, f"{test} is no test", "correct the name in `tests` or write the test"
                )
        for point in promise.covers:
            if point not in points:
                remedy = "correct the name in `covers` or declare the point"
                yield Finding(file, entry, f"{point} is no cover point or bin", remedy)
        for rule in promise.rules:
            if rule not in rules:
                remedy = f"correct the name in `rules` or add it to {specification.file}"
                yield Finding(file, entry, f"{rule} is no rule or fault", remedy)


def _tests_without_a_promise(plans: Sequence[Plan], there: Inventory) -> Iterator[Finding]:
    promised = {test for _, promise in _all(plans) for test in promise.tests}
    for test in sorted(there.tests - promised):
        remedy = f"name it in the `tests` of a promise in a {PLAN}"
        yield Finding(test.where, test.name, "no promise needs this test", remedy)


def _points_without_a_promise(plans: Sequence[Plan], there: Inventory) -> Iterator[Finding]:
    promised = {name for _, promise in _all(plans) for name in promise.covers}
    for point in there.points:
        left = [] if point.name in promised else [name for name in point.full if name not in promised]
        if left:
            what = "no promise needs this cover point"
            if len(left) < len(point.bins):
                what = f"no promise needs these bins of it: {', '.join(left)}"
            yield Finding(point.file, point.name, what, f"name it in the `covers` of a promise in a {PLAN}")


def _rules_without_a_promise(plans: Sequence[Plan], specification: Specification) -> Iterator[Finding]:
    fulfilled = {name for _, promise in _all(plans) for name in promise.rules}
    for rule in specification.rules:
        if rule.id not in fulfilled:
            remedy = f"name it in the `rules` of a promise in a {PLAN}"
            yield Finding(str(specification.file), rule.id, f"no promise fulfils this {rule.kind}", remedy)


def _units_without_a_plan(plans: Sequence[Plan], there: Inventory) -> Iterator[Finding]:
    planned = {plan.file.parent for plan in plans if plan.promises}
    for folder in there.units:
        if folder not in planned:
            yield Finding(str(folder / PLAN), folder.name, "the unit has no plan", "write its promises there")
