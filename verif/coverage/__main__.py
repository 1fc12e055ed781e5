"""`make close`: closes functional coverage of units, side by side, and compares with undirected stimulus.

    python -m verif.coverage [unit ...] [--seconds 120] [--seed 1] [--jobs 2] [--no-compare]

Writes a file a unit, a table and a plot below `build/coverage/closure`. Exit code 0 where no hole is left,
1 where one is or a bench fails, 2 where the request cannot be understood.
"""

import argparse
import os
import sys
import time
from collections.abc import Iterator, Sequence
from concurrent.futures import Future, ThreadPoolExecutor, as_completed

from verif.coverage import designs
from verif.coverage.close import FOLDER, Closed, ClosureError, close
from verif.coverage.curves import plot
from verif.coverage.exclusions import ExclusionError
from verif.env.build import BuildError

_Closing = Future[Closed]


def _arguments(words: Sequence[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="make close", description="Close functional coverage.")
    parser.add_argument("units", nargs="*", help="units; default: all")
    parser.add_argument("--seconds", type=float, default=120.0, help="for each unit at most")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--no-compare", action="store_true", help="no undirected stimulus beside it")
    return parser.parse_args(words)


def row(closed: Closed) -> str:
    """A line of the table."""
    factor, bound = closed.factor
    reached = f"{closed.bins - len(closed.holes)} of {closed.bins}"
    line = (
        f"{closed.unit:16} {reached:>12} bins in {closed.directed[-1][0] if closed.directed else 0:>8} clocks"
    )
    if closed.undirected_clocks:
        line += f"; at random {closed.random_bins:>4} in {closed.undirected_clocks:>8}, "
        line += f"{'more than ' if bound else ''}{factor:.1f} times"
    return f"{line}; {len(closed.excluded)} excluded, {closed.seconds:.1f} s"


def _say(text: str) -> None:
    print(text, flush=True)


def _closed(wanted: Sequence[str], options: argparse.Namespace) -> Iterator[tuple[str, Closed | str]]:
    """Each design's name and what became of it, or the complaint, as they end."""
    with ThreadPoolExecutor(options.jobs) as pool:
        running: dict[_Closing, str] = {
            pool.submit(
                close,
                designs.find(name),
                seed=options.seed,
                seconds=options.seconds,
                compare=not options.no_compare,
                tell=lambda _text: None,
            ): name
            for name in wanted
        }
        for done in as_completed(running):
            try:
                yield running[done], done.result()
            except (ClosureError, ExclusionError, BuildError) as error:
                yield running[done], str(error)


def main(words: Sequence[str]) -> int:
    """Prints the table as it grows; the exit code."""
    options = _arguments(words)
    wanted = [] if options.units in ([], ["all"]) else options.units
    if unknown := [name for name in wanted if name not in designs.names()]:
        print(f"UNIT={unknown[0]} is no unit; one of: {', '.join(designs.names())}", file=sys.stderr)
        return 2
    wanted = wanted or list(designs.names())
    start, failed, found = time.monotonic(), False, []
    for number, (name, what) in enumerate(_closed(wanted, options), 1):
        if isinstance(what, str):
            failed = True
            _say(f"[{number}/{len(wanted)}] {name:16} FAILED: {what}")
            continue
        what.write()
        found.append(what)
        failed |= bool(what.holes)
        _say(f"[{number}/{len(wanted)}] {row(what)}")
        for hole in what.holes:
            _say(f"    hole: {hole}, which the recipe '{what.recipes[hole]}' should reach")
    _say(summary(found, time.monotonic() - start))
    if any(closed.undirected for closed in found):
        _say(f"plot: {plot(found, FOLDER)}")
    return int(failed)


def summary(found: Sequence[Closed], seconds: float) -> str:
    """The last line."""
    bins, holes = sum(one.bins for one in found), sum(len(one.holes) for one in found)
    excluded = sum(len(one.excluded) for one in found)
    return (
        f"{bins - holes} of {bins} bins of {len(found)} designs hit, {holes} holes, {excluded} excluded, "
        f"{seconds:.0f} s"
    )


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
