"""Markdown and JUnit XML: what they say is what the record says."""

import xml.etree.ElementTree as ElementTree
from dataclasses import replace

import pytest

from regressions import junit, markdown
from regressions.record import Status
from regressions.tests.whole import RECORD


def test_junit_is_well_formed_and_counts_as_the_record_does() -> None:
    """Whatever is in the messages."""
    suite = ElementTree.fromstring(junit.xml(RECORD).encode())
    cases = suite.findall("testcase")
    counts = RECORD.counts()
    assert len(cases) == int(suite.get("tests", "")) == len(RECORD.results)
    assert len(suite.findall("testcase/failure")) == int(suite.get("failures", "")) == counts[Status.FAILED]
    errors = counts[Status.TIMED_OUT] + counts[Status.KILLED] + counts[Status.NOT_RUN]
    assert len(suite.findall("testcase/error")) == int(suite.get("errors", "")) == errors
    assert suite.get("skipped") == "0"


def test_junit_tells_each_failure_with_its_command() -> None:
    """And what the regression was of."""
    suite = ElementTree.fromstring(junit.xml(RECORD).encode())
    text = suite.findtext("testcase/failure", "")
    assert "sum is 3" in text and RECORD.results[1].command in text
    facts = {found.get("name"): found.get("value") for found in suite.iter("property")}
    assert (facts["seed"], facts["revision"], facts["cocotb"]) == ("7", RECORD.revision, "2.1.0")


def test_the_summary_tells_each_bucket_with_its_command() -> None:
    """And verdict, counts, seed and notes."""
    page = markdown.summary(RECORD)
    assert page.startswith("# tried: interrupted\n")
    assert "1 passed, 1 failed, 1 timed out, 1 killed, 1 not run" in page
    assert "root seed 7" in page and "a note" in page
    for bucket in RECORD.buckets:
        assert bucket.message in page and bucket.command in page


@pytest.mark.parametrize(
    "row",
    [
        "| sqrt | 2 | 1 | 1 | 100.0 % |",
        "| line | 1 | 0 | 1 | 100.0 % |",
        "| toggle | 1 | 0 | 0 | 0.0 % |",
        "| sqrt | 10 | 2 | 0 | 7 | 87.5 % |",
        "1 of 1 promises are kept.",
    ],
)
def test_the_summary_has_the_figures_of_every_section(row: str) -> None:
    """Excluded bins and equivalent mutants do not count."""
    assert row in markdown.summary(RECORD).splitlines()


def test_a_section_that_was_not_measured_is_left_out() -> None:
    """No figure stands for nothing."""
    bare = replace(RECORD, coverage=(), code=(), mutation=(), plan=())
    assert "%" not in markdown.summary(bare)
