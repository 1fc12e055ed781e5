"""Code coverage of the design by the benches.

    python -m verif.coverage.code collect [--units sqrt,div] [--core] [--missing] [--jobs 2]
    python -m verif.coverage.code report [--holes [sqrt|hdl/arith/sqrt.v ...]] [--exclusions]
    python -m verif.coverage.code export [--lcov FILE] [--ucis FILE]

`collect` runs the benches (without options all of them) and keeps what each run hit; `report` shows what all
runs that were kept hit together. Both end with exit code 1 where that is below 100 % of what is not excluded,
a bench failed, or an exclusion is stale.
"""

import argparse
import datetime
import os
import sys
from collections.abc import Sequence
from pathlib import Path

from verif.coverage.code import collect, exclusions, lcov, runs, totals, ucis
from verif.coverage.code.points import CodeCoverage
from verif.env import sources, units


class RequestError(ValueError):
    """What was asked for cannot be done; the text is the whole message."""


def _names(options: argparse.Namespace) -> list[str]:
    chosen: list[str] = []
    for unit in filter(None, (options.units or "").split(",")):
        try:
            chosen += runs.of_unit(unit)
        except KeyError as error:
            raise RequestError(f"--units {unit}: {error.args[0]}") from None
    if options.core:
        chosen += runs.of_core()
    chosen = chosen or list(runs.everything())
    return [name for name in chosen if not (options.missing and collect.current(name))]


def _files(wanted: Sequence[str]) -> list[str]:
    """Files of the design by path, or by the name of a unit: its own module's file."""
    found = []
    for word in wanted:
        paths = [
            path for path in sources.HDL.rglob("*.v") if word in (path.stem, sources.relative([path])[0])
        ]
        if not paths:
            raise RequestError(f"--holes {word}: is no file of hdl/ and no module")
        found += sources.relative(paths)
    return found


def _review(coverage: CodeCoverage) -> exclusions.Review:
    whole = set(runs.everything()) <= coverage.tests
    return exclusions.apply(exclusions.read(), coverage, whole=whole)


def _kept() -> CodeCoverage:
    coverage = collect.merged()
    if not coverage.points:
        raise RequestError("build/coverage/code: holds no code coverage; run `collect` first")
    collect.write(coverage)
    return coverage


def _show(wanted: Sequence[str] | None, with_exclusions: bool = False) -> int:
    review = _review(_kept())
    if wanted is not None:
        print("\n".join(totals.holes(review, _files(wanted))))
    else:
        print("\n".join(totals.table(review)))
        if review.holes:
            print(f"not hit: {len(review.holes)} points, which `report --holes` lists")
    if with_exclusions:
        print("\n".join(f"{number:6} {text}" for text, number in totals.excluded_by(review).most_common()))
    missing = set(runs.everything()) - review.coverage.tests
    if missing:
        print(
            f"{len(missing)} of {len(runs.everything())} runs are not in it, as {min(missing)}",
            file=sys.stderr,
        )
    for problem in review.problems:
        print(f"stale exclusion: {problem}", file=sys.stderr)
    return int(bool(review.problems or review.holes))


def _collect(options: argparse.Namespace) -> int:
    failed = collect.collect(_names(options), options.jobs)
    for run in failed:
        print(f"{run.name} failed: {run.complaint}", file=sys.stderr)
    return max(_show(None), int(bool(failed)))


def _export(options: argparse.Namespace) -> int:
    review = _review(_kept())
    if options.lcov:
        options.lcov.write_text(lcov.export(review))
    if options.ucis:
        options.ucis.write_text(ucis.export(review, datetime.datetime.now(datetime.UTC)))
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python -m verif.coverage.code", description="Code coverage.")
    commands = parser.add_subparsers(dest="command", required=True)
    collecting = commands.add_parser("collect", help="run benches and keep what they hit")
    collecting.add_argument("--units", help=f"only these, comma between: {', '.join(units.names())}")
    collecting.add_argument(
        "--core", action="store_true", help="only, or also, the benches of the whole core"
    )
    collecting.add_argument(
        "--missing", action="store_true", help="only those not kept, or of a changed design"
    )
    collecting.add_argument("--jobs", type=int, default=os.cpu_count() or 1, help="runs at a time")
    reporting = commands.add_parser("report", help="show what was kept")
    reporting.add_argument("--holes", nargs="*", metavar="FILE", help="list holes: of modules, files, or all")
    reporting.add_argument(
        "--exclusions", action="store_true", help="list how much each exclusion leaves out"
    )
    exporting = commands.add_parser("export", help="write what was kept for other tools")
    exporting.add_argument("--lcov", type=Path, help="tracefile, lines and branches alone")
    exporting.add_argument("--ucis", type=Path, help="UCIS 1.0 XML")
    return parser


def main(arguments: Sequence[str]) -> int:
    """Does what the words say; 0, 1 where coverage is incomplete, 2 where the words or files are wrong."""
    options = _parser().parse_args(arguments)
    try:
        if options.command == "collect":
            return _collect(options)
        return _export(options) if options.command == "export" else _show(options.holes, options.exclusions)
    except (RequestError, exclusions.ExclusionError, ValueError) as error:
        print(error, file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
