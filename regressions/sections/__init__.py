"""Coverage, mutation and the plan, merged into a record once its runs have ended: a module a section."""

from collections.abc import Callable
from pathlib import Path

from regressions.record import Record
from regressions.sections import code, functional, mutation, plan

Section = Callable[[Record, Path], Record]

_SECTIONS: tuple[Section, ...] = (functional.added, code.added, mutation.added, plan.added)
"""The plan last: it looks at coverage."""


def added(record: Record, root: Path) -> Record:
    """The record with all that its runs left below ``root``, the project's."""
    for section in _SECTIONS:
        record = section(record, root)
    return record
