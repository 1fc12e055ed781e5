"""Notes on what a section could not measure, or measured before this regression."""

import datetime
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

from regressions.record import Record

_NAMED = 3


def noted(record: Record, notes: Iterable[str]) -> Record:
    """The record with more notes, each once."""
    return replace(record, notes=tuple(dict.fromkeys((*record.notes, *notes))))


def older(record: Record, paths: Iterable[Path], what: str) -> list[str]:
    """A note where files were written before the regression began: they are of the tree as it was then."""
    start = datetime.datetime.fromisoformat(record.started).timestamp()
    old = sorted(path.stem for path in paths if path.stat().st_mtime < start)
    names = ", ".join(old[:_NAMED]) + (" and others" if len(old) > _NAMED else "")
    return [f"{what} was measured before this regression: {names}"] if old else []
