"""Functional coverage of all runs, bin by bin, and the curves that closure left."""

from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path

from regressions.outcome import RUNS, simulations, sound
from regressions.record import Bin, Curve, Point, Record, Unit
from regressions.sections.notes import noted, older
from verif.coverage import close, designs
from verif.coverage.exclusions import ExclusionError, of_unit
from verif.env import sources
from verif.env.coverage import database

By = dict[str, dict[str, int]]
"""Hits by a bin's name and a result's id."""


def added(record: Record, root: Path) -> Record:
    """The record with functional coverage, of every design that has cover points."""
    hits = _hits(record, root)
    units, notes = [], []
    for name in designs.names():
        try:
            covered, stale = unit(designs.find(name), hits.pop(name, {}))
        except ExclusionError as error:
            notes.append(str(error).replace(f"{sources.ROOT}/", ""))
            continue
        units.append(covered)
        notes += stale
    notes += [f"{name}: runs sampled it, and no design is called so" for name in hits]
    closed = sorted(close.FOLDER.glob("*.json"))
    notes += older(record, closed, "closure")
    curves = tuple(curve for path in closed for curve in _curves(close.read(path)))
    found = replace(record, coverage=tuple(one for one in units if one.points), curves=curves)
    return noted(found, notes)


def _hits(record: Record, root: Path) -> dict[str, By]:
    """By unit, bin and result. What failed, or ran on a design broken on purpose, has covered nothing."""
    found: dict[str, By] = {}
    for result in record.results:
        folder = root / result.folder
        good = [one for one in simulations(folder) if sound(one)] if result.folder else []
        for simulation in good:
            run = folder / RUNS / simulation["directory"]
            for unit, bins in database.merged(database.of_run(run)).items():
                of_unit = found.setdefault(unit, {})
                for name, number in bins.items():
                    if number:
                        by = of_unit.setdefault(name, {})
                        by[result.id] = by.get(result.id, 0) + number
    return found


def unit(design: designs.Design, hits: Mapping[str, Mapping[str, int]]) -> tuple[Unit, list[str]]:
    """Bins with their hits, and a note on each that is excluded and was hit all the same: it counts as hit.

    Raises ExclusionError where an exclusion does not hold by itself.
    """
    bins = dict(design.coverage.bins())
    excluded = {entry.what: entry.reason for entry in of_unit(design.exclusions, bins)}
    stale = sorted(excluded.keys() & hits.keys())
    for bin_name in stale:
        del excluded[bin_name]
    notes = [f"{design.name}: {one} was hit; take it out of its {design.exclusions.name}" for one in stale]
    points = []
    for point in design.coverage.points:
        rows = []
        for found in point.bins:
            full = f"{point.name}.{found.name}"
            by = hits.get(full, {})
            reason = excluded.get(full, "")
            rows.append(Bin(found.name, sum(by.values()), found.recipe.name, reason, by))
        points.append(Point(point.name, point.doc, tuple(rows)))
    return Unit(design.name, tuple(points)), notes


def _curves(closed: close.Closed) -> Iterator[Curve]:
    for strategy, steps in (("closure", closed.directed), ("random", closed.undirected)):
        if steps:
            yield Curve(closed.unit, strategy, closed.bins, steps)
