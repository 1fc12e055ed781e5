"""Checks the verification plan, or shows it.

    python -m verif.plan check
    python -m verif.plan show [FOLDER | specification]

Exit code 1 where the plan has errors, 2 where it cannot be read.
"""

import argparse
import sys
import textwrap
from collections.abc import Iterator, Sequence

from verif.plan.check import check
from verif.plan.inventory import inventory
from verif.plan.read import read_plans, read_specification
from verif.plan.records import Kind, Plan, PlanError, Specification

_SPECIFICATION = "specification"
_WIDTH = 110


def _block(head: str, text: str, *lists: tuple[str, Sequence[str]]) -> Iterator[str]:
    """An entry: a line of its own, its text, and what it names."""
    yield head
    yield textwrap.fill(text, _WIDTH, initial_indent="    ", subsequent_indent="    ")
    yield from (f"      {label} {name}" for label, names in lists for name in names)


def plan_lines(plan: Plan) -> Iterator[str]:
    """Promises with their tests, cover points and rules."""
    for promise in plan.promises:
        tests = [str(test) for test in promise.tests]
        named = ("test", tests), ("cover", promise.covers), ("rule", promise.rules)
        yield from _block(promise.id, promise.what, *named)


def specification_lines(specification: Specification, plans: Sequence[Plan]) -> Iterator[str]:
    """Rules and faults with the promises that fulfil them."""
    promises = [promise for plan in plans for promise in plan.promises]
    for rule in specification.rules:
        names = [promise.id for promise in promises if rule.id in promise.rules]
        yield from _block(f"{rule.id} ({rule.kind}, {rule.section})", rule.text, ("promise", names))


def _check(plans: Sequence[Plan], specification: Specification) -> int:
    there = inventory()
    findings = check(plans, specification, there)
    for finding in findings:
        print(finding, file=sys.stderr)
    kinds = [rule.kind for rule in specification.rules]
    print(
        f"{sum(len(plan.promises) for plan in plans)} promises in {len(plans)} plans, "
        f"{kinds.count(Kind.RULE)} rules, {kinds.count(Kind.FAULT)} faults, {len(there.tests)} tests, "
        f"{len(there.points)} cover points of {sum(len(point.bins) for point in there.points)} bins: "
        f"{len(findings)} errors"
    )
    return 1 if findings else 0


def _show(name: str | None, plans: Sequence[Plan], specification: Specification) -> int:
    if name == _SPECIFICATION:
        print("\n".join(specification_lines(specification, plans)))
        return 0
    chosen = [plan for plan in plans if name in (None, plan.name)]
    if not chosen:
        names = ", ".join([*(plan.name for plan in plans), _SPECIFICATION])
        raise PlanError(f"{name}: there is no such plan; choose one of {names}")
    print("\n".join(line for plan in chosen for line in plan_lines(plan)))
    return 0


def main(arguments: Sequence[str]) -> int:
    """Command line."""
    parser = argparse.ArgumentParser(prog="python -m verif.plan", description="The verification plan.")
    commands = parser.add_subparsers(dest="command", required=True)
    commands.add_parser("check", help="holds plans, tests, cover points and specification against each other")
    shown = commands.add_parser("show", help="prints promises, or the specification with what fulfils it")
    shown.add_argument("name", nargs="?", help=f"of a folder, or {_SPECIFICATION}; default: all plans")
    options = parser.parse_args(arguments)
    try:
        plans, specification = read_plans(), read_specification()
        if options.command == "check":
            return _check(plans, specification)
        return _show(options.name, plans, specification)
    except PlanError as error:
        print(error, file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
