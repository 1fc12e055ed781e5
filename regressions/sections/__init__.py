"""Coverage, mutation and the plan, merged into a record once its runs have ended: a module a section."""

from collections.abc import Callable
from pathlib import Path

from regressions.record import Record
from regressions.sections import code, functional, mutation, plan
from regressions.sections.notes import noted

Section = Callable[[Record, Path], Record]

_SECTIONS: tuple[Section, ...] = (functional.added, code.added, mutation.added, plan.added)
"""The plan last: it looks at coverage."""


def added(record: Record, root: Path) -> Record:
    """The record with all that its runs left below ``root``, the project's.

    A section that cannot be made is a note: what ran all night is not lost for it.
    """
    for section in _SECTIONS:
        try:
            record = section(record, root)
        except Exception as error:
            record = noted(record, [f"{section.__module__} cannot be made: {error!r}"])
    return record
