"""Where a unit's cover points are declared: `COVERAGE` in its folder's `coverage.py`."""

import importlib
import importlib.util

from verif.env.coverage.flow import with_flow
from verif.env.coverage.points import Coverage
from verif.env.unit import Unit


def coverage_of(unit: Unit) -> Coverage:
    """A unit's points and those of its kind. Raises TypeError where its `coverage.py` has none."""
    return with_flow(coverage_of_name(unit.name), unit)


def coverage_of_name(name: str) -> Coverage:
    """A unit's own points. Raises TypeError where its `coverage.py` has none."""
    package = f"verif.units.{name}"
    if importlib.util.find_spec(f"{package}.coverage") is None:
        return Coverage(())
    found = importlib.import_module(f"{package}.coverage").COVERAGE
    if not isinstance(found, Coverage):
        raise TypeError(f"{package.replace('.', '/')}/coverage.py: COVERAGE is no Coverage")
    return found
