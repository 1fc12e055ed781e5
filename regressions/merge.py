"""Coverage, mutation and the plan, merged into a record once its runs have ended."""

from dataclasses import replace
from pathlib import Path

from regressions.record import Record


def merged(record: Record, folder: Path) -> Record:
    """The record with all that its runs left in their folders."""
    return replace(record)
