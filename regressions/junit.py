"""A regression as JUnit XML, as CI services read it: one test case a run."""

import re
import xml.etree.ElementTree as ElementTree

from regressions.record import Record, Result, Status

# XML 1.0 has no way to hold these.
_FORBIDDEN = re.compile(r"[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def xml(record: Record) -> str:
    """The document. Timed out and killed runs are errors, those that did not run are errors too: nothing that
    has not passed counts as skipped."""
    counts = record.counts()
    failures = counts[Status.FAILED]
    errors = len(record.results) - failures - counts[Status.PASSED]
    suite = ElementTree.Element(
        "testsuite",
        name=record.list,
        tests=str(len(record.results)),
        failures=str(failures),
        errors=str(errors),
        skipped="0",
        time=f"{record.seconds:.3f}",
        timestamp=record.started,
    )
    properties = ElementTree.SubElement(suite, "properties")
    facts = {"revision": record.revision, "dirty": record.dirty, "seed": record.seed, **record.tools}
    for name, value in facts.items():
        ElementTree.SubElement(properties, "property", name=name, value=str(value))
    suite.extend(_case(result) for result in record.results)
    ElementTree.indent(suite)
    return ElementTree.tostring(suite, encoding="unicode", xml_declaration=True) + "\n"


def _case(result: Result) -> ElementTree.Element:
    case = ElementTree.Element(
        "testcase", classname=result.entry, name=f"{result.test}#{result.index}", time=f"{result.seconds:.3f}"
    )
    if result.status is not Status.PASSED:
        kind = "failure" if result.status is Status.FAILED else "error"
        message = _FORBIDDEN.sub("?", result.message)
        first = message.splitlines()[0] if message else ""
        element = ElementTree.SubElement(case, kind, type=str(result.status), message=first)
        element.text = f"{message}\nshown again by: {result.command}\n"
    return case
