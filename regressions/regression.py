"""One regression: builds, runs on all cores, the first failures again with waves, the record of it all."""

import datetime
import os
import threading
import time
from concurrent.futures import ThreadPoolExecutor, as_completed
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path

from regressions import provenance, record, sections, triage
from regressions.builds import without_build
from regressions.execute import execute
from regressions.lists import Kind
from regressions.progress import Progress
from regressions.record import Record, Result, Status
from verif.env import sources
from verif.env.build import CACHE

FOLDER = CACHE / "regressions"
LATEST = "latest"
RECORD = "record.json"

_WITH_WAVES = 3
"""Buckets whose first run is repeated with all signals recorded."""

_SIMULATE = (Kind.UNIT, Kind.CORE)

_WAVES_FACTOR = 5.0
"""Recording makes a run nearly four times as long, and needs a build of its own."""


@dataclass(frozen=True)
class Order:
    """What is to be run: planned runs, as which list, from which root seed, so many at a time."""

    list: str
    seed: int
    planned: tuple[Result, ...]
    jobs: int


def fresh_folder(name: str) -> Path:
    """A new folder below `build/regressions/`, named after the time and the list."""
    now = datetime.datetime.now(datetime.UTC).strftime("%Y%m%d-%H%M%S")
    FOLDER.mkdir(parents=True, exist_ok=True)
    for number in range(1, 1000):
        folder = FOLDER / (f"{now}-{name}" if number == 1 else f"{now}-{name}-{number}")
        with suppress(FileExistsError):
            folder.mkdir()
            return folder
    raise FileExistsError(f"{FOLDER}: holds a thousand regressions of this second")


def regress(order: Order, folder: Path, stop: threading.Event, progress: Progress) -> Record:
    """Runs all; the record, which is also in the folder. ``stop`` leaves the rest as not run."""
    started = datetime.datetime.now(datetime.UTC).isoformat(timespec="seconds")
    start = time.monotonic()
    found = Record(
        id=folder.name,
        list=order.list,
        seed=order.seed,
        revision=provenance.revision(),
        dirty=provenance.dirty(),
        tools=provenance.tools(),
        started=started,
        seconds=0.0,
        jobs=order.jobs,
        results=order.planned,
    )
    # From the first moment there is a record, whatever ends this process.
    record.write(replace(found, interrupted=True), folder / RECORD)
    results = _results(order, folder, stop, progress)
    found = replace(found, results=results, buckets=triage.buckets(results))
    record.write(replace(found, interrupted=True), folder / RECORD)
    found = _with_waves(found, folder, stop, progress)
    seconds = round(time.monotonic() - start, 1)
    found = replace(found, interrupted=stop.is_set(), seconds=seconds)
    found = sections.added(found, sources.ROOT)
    record.write(found, folder / RECORD)
    _point_to(folder)
    return found


def _results(order: Order, folder: Path, stop: threading.Event, progress: Progress) -> tuple[Result, ...]:
    """The runs' results, in the order of the plan."""
    why = without_build(order.planned, order.jobs, stop, progress.building)
    ended = {run.id: replace(run, message=why[run.id]) for run in order.planned if run.id in why}
    for result in ended.values():
        progress.skipped(result)
    lock = threading.Lock()

    def one(planned: Result) -> Result:
        if stop.is_set():
            return replace(planned, message="interrupted before it began")
        with lock:
            progress.started()
        result = execute(planned, folder / planned.id, stop)
        with lock:
            progress.ended(result)
        return result

    with ThreadPoolExecutor(order.jobs) as pool:
        futures = [pool.submit(one, run) for run in order.planned if run.id not in ended]
        for future in as_completed(futures):
            result = future.result()
            ended[result.id] = result
    return tuple(ended[run.id] for run in order.planned)


def _with_waves(found: Record, folder: Path, stop: threading.Event, progress: Progress) -> Record:
    """The record with all signals of the first run of the first buckets; a note on each that passes now."""
    by_id = {result.id: result for result in found.results}
    firsts = [by_id[bucket.results[0]] for bucket in found.buckets]
    chosen = [first for first in firsts if first.kind in _SIMULATE and first.status is not Status.NOT_RUN]

    def again(first: Result) -> Result:
        longer = replace(first, wall_limit=first.wall_limit * _WAVES_FACTOR)
        return execute(longer, folder / first.id / "waves", stop, waves=True)

    waves: dict[str, str] = {}
    notes = []
    with ThreadPoolExecutor(found.jobs) as pool:
        for number, repeated in enumerate(pool.map(again, chosen[:_WITH_WAVES]), 1):
            progress.recording(number, len(chosen[:_WITH_WAVES]))
            dumps = sorted((sources.ROOT / repeated.folder).glob("runs/*/dump.*"))
            waves[repeated.id] = os.path.relpath(dumps[0], sources.ROOT) if dumps else ""
            if repeated.status is Status.PASSED:
                notes.append(
                    f"{repeated.id}: did not fail again with waves; it depends on more than its seed"
                )
    return replace(
        found,
        results=tuple(replace(one, waves=waves.get(one.id, "")) for one in found.results),
        buckets=tuple(replace(one, waves=waves.get(one.results[0], "")) for one in found.buckets),
        notes=tuple(notes),
    )


def _point_to(folder: Path) -> None:
    """`latest` is the newest regression."""
    fresh = FOLDER / f".{LATEST}.{os.getpid()}"
    fresh.unlink(missing_ok=True)
    fresh.symlink_to(folder.name)
    fresh.replace(FOLDER / LATEST)
