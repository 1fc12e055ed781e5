"""A record with something in each of its sections."""

from dataclasses import replace

from regressions.record import (
    Bin,
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
    Rule,
    Status,
    Unit,
)
from regressions.tests.planned import of_python
from regressions.triage import buckets
from verif.plan.join import Standing

_MESSAGES = {
    Status.FAILED: "sum is 3 | not 4\nFailing test case: example(\x00 ]]> <1>)",
    Status.TIMED_OUT: "60 s of wall-clock time are over",
    Status.KILLED: "ended by SIGKILL",
    Status.NOT_RUN: "interrupted before it began",
}

RESULTS = tuple(
    replace(
        of_python(f"run.{status}", "print()"),
        status=status,
        seconds=1.5,
        simulated_ns=2e6,
        folder=f"build/regressions/tried/run.{status}",
        message=_MESSAGES.get(status, ""),
        checks=(Check("it_works", "verif.tried", _MESSAGES.get(status, ""), simulated_ns=2e6),),
    )
    for status in Status
)

_BINS = (Bin("zero", 3, "zeros", by={"run.passed": 3}), Bin("odd", 0, excluded="never"))

_TESTS = {"verif.tried::it_works": Status.PASSED}

RECORD = Record(
    id="tried",
    list="tried",
    seed=7,
    revision="0123456789abcdef",
    dirty=True,
    tools={"cocotb": "2.1.0"},
    started="2027-01-02T03:04:05+00:00",
    seconds=9.0,
    jobs=2,
    results=RESULTS,
    interrupted=True,
    buckets=buckets(RESULTS),
    coverage=(
        Unit(
            "sqrt",
            (
                Point(
                    "root",
                    "what",
                    (Bin("zero", 3, "zeros", by={"run.passed": 3}), Bin("odd", 0, excluded="never")),
                ),
            ),
        ),
    ),
    curves=(Curve("sqrt", "closure", 1, ((0, 0), (9, 1))),),
    code=(
        File(
            "hdl/a.v",
            (
                CodePoint(3, 1, CodeKind.LINE, "block", 2, (3, 4), by=(0,)),
                CodePoint(3, 5, CodeKind.TOGGLE, "a[0]:0->1", 0),
            ),
        ),
    ),
    code_runs=("sqrt-default",),
    mutation=(Mutation("sqrt", 10, 7, 2, 0, (Mutant(4, "hdl/a.v", 3, "inv", "survived", "{}"),)),),
    plan=(
        Promise(
            "sqrt",
            "sqrt.exact",
            "It is.",
            "a.toml",
            {"a::b": Status.PASSED},
            {"root": (1, 1)},
            Standing.PASSED,
        ),
    ),
    rules=(Rule("arithmetic.root", "rule", "[2.1]", "Roots are exact.", ("sqrt.exact",), Standing.PASSED),),
    notes=("a note",),
)
