"""What code coverage costs: the same run on a build with it and on one without, in turn.

    python -m verif.coverage.code.cost [--run sqrt-default ...] [--pairs 5]

A run's cost is the processor time of the simulator, Python in it included; the builds are made before. The
ratio is the median of those of the pairs. Exit code 1 where one is above the bar.
"""

import argparse
import resource
import sys
from collections.abc import Iterator, Sequence
from statistics import median

from verif.coverage.code import runs

BAR = 1.3
"""Most that coverage may cost, as a ratio."""
_RUNS = ("normalise-default", "ray_store-default", "core-pictures-default-1-4-4-verilator")
"""An arithmetic unit, a block, the core."""


def _spent() -> float:
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def _seconds(name: str, coverage: bool) -> float:
    """Processor time of one run. Raises RuntimeError where it fails."""
    before = _spent()
    outcome = runs.simulate(name, coverage)
    if not outcome.passed:
        raise RuntimeError(f"{name}: {outcome.complaint()}")
    return _spent() - before


def pairs(name: str, number: int) -> Iterator[tuple[float, float]]:
    """Seconds without and with coverage, of runs that take turns; the first of all build and are not told."""
    for coverage in (False, True):
        _seconds(name, coverage)
    for _ in range(number):
        yield _seconds(name, False), _seconds(name, True)


def main(arguments: Sequence[str]) -> int:
    """Prints a line a run; 0 where no ratio is above the bar."""
    parser = argparse.ArgumentParser(
        prog="python -m verif.coverage.code.cost", description="Cost of coverage."
    )
    parser.add_argument("--run", nargs="+", default=list(_RUNS), choices=runs.everything(), metavar="RUN")
    parser.add_argument("--pairs", type=int, default=5)
    options = parser.parse_args(arguments)
    worst = 0.0
    for name in options.run:
        measured = list(pairs(name, options.pairs))
        ratio = median(on / off for off, on in measured)
        off, on = (median(column) for column in zip(*measured, strict=True))
        print(
            f"{name:45} {off:7.2f} s without, {on:7.2f} s with: {ratio:.2f} times (at most {BAR})", flush=True
        )
        worst = max(worst, ratio)
    return int(worst > BAR)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
