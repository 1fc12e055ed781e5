"""Buckets: failures that differ in numbers alone are one."""

from dataclasses import replace

import pytest

from regressions.record import Status
from regressions.tests.planned import of_python
from regressions.triage import buckets, normalised


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("operand 3 of 70 (1 wrong)", "operand 12 of 1000 (35 wrong)"),
        ("a = 0x3f, 12 (0x1a = -0.5)", "a = 7"),
        ("level is -3, not 0x1F", "level is 12, not 0xab"),
        ("build/runs/a-1/sim.log is missing", "/tmp/x/y.log is missing"),
        ("1.5e-3 s are over", "600 s are over"),
        ("wrong\nFailing test case: example(1)", "wrong\nFailing test case: example([2, 3])"),
        ("wrong\n\nsecond: also 3", "wrong"),
        ("add @reproduce_failure('6.1', b'AXic')", "add @reproduce_failure('6.2', b'QQ==')"),
    ],
)
def test_numbers_paths_seeds_and_examples_make_no_difference(one: str, other: str) -> None:
    """The rest does."""
    assert normalised(one) == normalised(other)
    assert normalised(one) != normalised("something else")


def test_names_with_digits_are_names() -> None:
    """`rgb888` is no number, nor is `u0`."""
    assert normalised("rgb888 differs in u0") == "rgb888 differs in u0"


def test_failures_are_grouped_the_most_frequent_first() -> None:
    """Each with the command and the full message of its first run; what passed is in none."""
    failed = [
        replace(of_python(name, ""), status=Status.FAILED, message=message)
        for name, message in [("a", "late by 3"), ("b", "sum is 4"), ("c", "late by 5")]
    ]
    passed = replace(of_python("d", ""), status=Status.PASSED)
    first, second = buckets([*failed, passed])
    assert (first.results, second.results) == (("a", "c"), ("b",))
    assert (first.message, first.example, first.command) == ("late by #", "late by 3", failed[0].command)


@pytest.mark.parametrize("status", [status for status in Status if status is not Status.PASSED])
def test_whatever_did_not_pass_is_in_a_bucket(status: Status) -> None:
    """Also what did not run."""
    (found,) = buckets([replace(of_python("a", ""), status=status, message="why")])
    assert found.results == ("a",)
