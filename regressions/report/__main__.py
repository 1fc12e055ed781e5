"""Draws the page of a regression.

    python -m regressions.report [--record FILE] [--out FILE]      (make coverage RECORD=FILE)

Without a record the latest regression's, `build/regressions/latest/record.json`; the page lies beside it as
`report.html`. Exit code 2 where there is no such record.
"""

import argparse
import sys
import time
from collections.abc import Sequence
from pathlib import Path

from regressions import record
from regressions.regression import FOLDER, LATEST, RECORD
from regressions.report.page import PAGE, page


def main(arguments: Sequence[str]) -> int:
    """Writes the page and says where it is; the exit code."""
    parser = argparse.ArgumentParser("python -m regressions.report", description="The page of a regression.")
    parser.add_argument("--record", type=Path, help="a regression's record.json; default: the latest")
    parser.add_argument("--out", type=Path, help=f"the page; default: {PAGE} beside the record")
    options = parser.parse_args(arguments)
    path = options.record or FOLDER / LATEST / RECORD
    if not path.is_file():
        print(f"{path}: there is no such record; `make smoke` makes one", file=sys.stderr)
        return 2
    start = time.monotonic()
    try:
        found = record.read(path)
    except record.RecordError as error:
        print(error, file=sys.stderr)
        return 2
    out = options.out or path.with_name(PAGE)
    if not out.parent.is_dir():
        print(f"--out {out}: {out.parent} is no folder; make it first", file=sys.stderr)
        return 2
    out.write_text(page(found))
    size = out.stat().st_size / 1e6
    print(f"{out}: {found.list}, {size:.1f} MB in {time.monotonic() - start:.1f} s; open it in a browser")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
