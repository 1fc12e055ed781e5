"""Bins that are left out of functional coverage: each with a reason, an owner and a date of review.

    [[exclude]]
    bin = "state.unused"          # point.bin
    reason = "the encoding has ten states"
    proof = "control.no_state_is_illegal"     # a test or command that shows it; optional
    owner = "verification"
    review = 2027-06-01

The file is `exclusions.toml` beside the unit's `coverage.py`; where there is none, nothing is left out.
"""

import tomllib
from collections.abc import Collection
from dataclasses import dataclass
from datetime import date
from pathlib import Path
from typing import Any

_FIELDS = {"bin": str, "reason": str, "owner": str, "review": date}


class ExclusionError(ValueError):
    """An exclusion that does not hold; the text names file, entry and remedy."""


@dataclass(frozen=True)
class Exclusion:
    """what: the bin's name. proof: what shows that it cannot be hit, where something does."""

    what: str
    reason: str
    owner: str
    review: date
    proof: str = ""


def of_unit(path: Path, bins: Collection[str], today: date | None = None) -> tuple[Exclusion, ...]:
    """The exclusions of one file. Raises ExclusionError for one that is incomplete or stale."""
    if not path.exists():
        return ()
    try:
        entries = tomllib.loads(path.read_text()).get("exclude", [])
    except tomllib.TOMLDecodeError as error:
        raise ExclusionError(f"{path}: is no TOML: {error}") from error
    return tuple(
        _checked(path, number, entry, bins, today or date.today()) for number, entry in enumerate(entries, 1)
    )


def _checked(path: Path, number: int, entry: dict[str, Any], bins: Collection[str], today: date) -> Exclusion:
    where = f"{path}, exclusion {number}"
    for name, kind in _FIELDS.items():
        if not isinstance(entry.get(name), kind) or entry[name] == "":
            raise ExclusionError(f"{where}: {name} is missing; write {name} = ... (a {kind.__name__})")
    if unknown := entry.keys() - _FIELDS.keys() - {"proof"}:
        raise ExclusionError(f"{where}: {', '.join(sorted(unknown))} means nothing here; take it out")
    if entry["bin"] not in bins:
        raise ExclusionError(
            f"{where}: no bin is called {entry['bin']}; take the exclusion out or correct its name"
        )
    if entry["review"] < today:
        raise ExclusionError(
            f"{where}: review was due on {entry['review']}; look at {entry['bin']} again and set a new date"
        )
    return Exclusion(entry["bin"], entry["reason"], entry["owner"], entry["review"], entry.get("proof", ""))
