"""Regressions: lists of tests, run on all cores, with one record of what came out.

    python -m regressions list [LIST]               the lists, or the runs of one
    python -m regressions run LIST [--seed N] [--jobs N] [--only PATTERN]
    python -m regressions rerun PATTERN | --failed  runs of a regression again, with the same seeds
    python -m regressions show [--of ID]            a regression's summary

`--of` names another regression than the latest. Each has a folder `build/regressions/<id>/` with its
`record.json`, `summary.md`, `junit.xml`, `report.html` and a folder for each run. Exit code 0 where
everything passed, 1 where not, 2 where the request cannot be understood.
"""

import argparse
import os
import signal
import sys
import threading
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from types import FrameType, MappingProxyType

from regressions import junit, lists, markdown, record, regression
from regressions.expand import chosen, expand
from regressions.lists import ListError
from regressions.progress import Progress
from regressions.record import Record, RecordError, Result, Status
from regressions.regression import LATEST, RECORD, Order, fresh_folder, regress
from regressions.report.page import PAGE, page

_SEEDS = 1 << 31

_NOTES = 4
"""Told at the end of a regression; the summary has them all."""


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python -m regressions", description="Run lists of tests.")
    commands = parser.add_subparsers(dest="command", required=True)
    listing = commands.add_parser("list", help="the lists, or the runs of one")
    listing.add_argument("list", nargs="?")
    run = commands.add_parser("run", help="run a list")
    run.add_argument("list", help="name of a list, or a file .toml")
    run.add_argument("--seed", type=int, help="root of all seeds; default: the time")
    run.add_argument("--only", help="only runs whose id or test matches this; * and ? are any")
    rerun = commands.add_parser("rerun", help="runs of a regression again, with the same seeds")
    rerun.add_argument("pattern", nargs="?", help="id or test; * and ? are any")
    rerun.add_argument("--failed", action="store_true", help="all that have not passed")
    show = commands.add_parser("show", help="a regression's summary")
    for command in (run, rerun):
        command.add_argument("--jobs", type=int, help="runs at a time; default: one a core")
    for command in (rerun, show):
        command.add_argument("--of", default=LATEST, help="regression; default: the latest")
    return parser


def _list(options: argparse.Namespace) -> int:
    if options.list is None:
        for name in lists.names():
            print(f"{name:14} {lists.load(name).about}")
        return 0
    planned = expand(lists.load(options.list), 0)
    print("\n".join(run.id for run in planned))
    return 0


def _run(options: argparse.Namespace) -> int:
    seed = int(time.time()) % _SEEDS if options.seed is None else options.seed
    if not 0 <= seed < _SEEDS:
        raise ListError(f"--seed {seed}: is 0 to {_SEEDS - 1}")
    run_list = lists.load(options.list)
    planned = expand(run_list, seed)
    if options.only is not None:
        planned = chosen(planned, options.only)
    return run_order(Order(run_list.name, seed, planned, _jobs(options.jobs)))


def _rerun(options: argparse.Namespace) -> int:
    if options.failed == (options.pattern is not None):
        raise ListError("rerun: name a run, or say --failed")
    old = record.read(_path(options.of))
    planned = old.results
    if options.failed:
        planned = tuple(result for result in planned if result.status is not Status.PASSED)
        if not planned:
            print(f"{old.id}: every run passed, nothing is to be run again")
            return 0
    else:
        planned = chosen(planned, options.pattern)
    name = old.list.removesuffix("-again") + "-again"
    return run_order(Order(name, old.seed, tuple(map(_unrun, planned)), _jobs(options.jobs)))


def _unrun(result: Result) -> Result:
    """The run as it was planned."""
    return replace(
        result,
        status=Status.NOT_RUN,
        seconds=0.0,
        simulated_ns=0.0,
        folder="",
        message="",
        checks=(),
        waves="",
    )


def _show(options: argparse.Namespace) -> int:
    found = record.read(_path(options.of))
    print(markdown.summary(found))
    return 0 if found.passed else 1


_COMMANDS: Mapping[str, Callable[[argparse.Namespace], int]] = MappingProxyType(
    {"list": _list, "run": _run, "rerun": _rerun, "show": _show}
)


def _jobs(wanted: int | None) -> int:
    if wanted is not None and wanted < 1:
        raise ListError(f"--jobs {wanted}: is at least 1")
    return wanted or os.cpu_count() or 1


def _path(name: str) -> Path:
    return regression.FOLDER / name / RECORD


@contextmanager
def _stopped_by_signals() -> Iterator[threading.Event]:
    """An event that Ctrl-C and a request to end set, so that the record is still written."""
    stop = threading.Event()

    def end(_number: int, _frame: FrameType | None) -> None:
        stop.set()

    before = {number: signal.signal(number, end) for number in (signal.SIGINT, signal.SIGTERM)}
    try:
        yield stop
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


def run_order(order: Order) -> int:
    """Runs, reports, and says in the end where everything is."""
    folder = fresh_folder(order.list)
    with _stopped_by_signals() as stop:
        found = regress(order, folder, stop, Progress(len(order.planned)))
    (folder / "summary.md").write_text(markdown.summary(found))
    (folder / "junit.xml").write_text(junit.xml(found))
    (folder / PAGE).write_text(page(found))
    print("\n".join(_last_words(found, folder)))
    return 0 if found.passed else 1


def _last_words(found: Record, folder: Path) -> list[str]:
    counts = ", ".join(f"{n} {status.replace('_', ' ')}" for status, n in found.counts().items() if n)
    failures = [f"{len(bucket.results)} x {bucket.message}\n    {bucket.command}" for bucket in found.buckets]
    notes = [f"note: {note}" for note in found.notes[:_NOTES]]
    if left := len(found.notes) - len(notes):
        notes.append(f"{left} more notes are in the summary")
    return [*failures, *notes, f"{found.list}: {counts} in {found.seconds:.0f} s; {folder / 'summary.md'}"]


def main(arguments: Sequence[str]) -> int:
    """Runs a command; its exit code."""
    options = _parser().parse_args(arguments)
    try:
        return _COMMANDS[options.command](options)
    except (ListError, RecordError) as error:
        print(error, file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
