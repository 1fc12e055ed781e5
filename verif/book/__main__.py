"""Repeats the book's experiments: writes the tables of hdl/BOOK.md and the plots beside the pictures.

    python -m verif.book [timing] [precision] [vanishing] [depths]      (make book)

Without a name all of them. Exit code 0; 1 where a picture is not the model's; 2 where a name or a tool is
missing.
"""

import argparse
import math
import sys
from collections.abc import Callable, Iterator

from models.pages import replaced
from verif.book import experiments, plots
from verif.env import sources
from verif.env.build import BuildError
from verif.env.simulators import MissingTool
from verif.render.simulate import SimulationError

PAGE = sources.HDL / "BOOK.md"
PICTURES = sources.HDL / "pictures"


def _say(text: str) -> None:
    print(f"  {text}", file=sys.stderr, flush=True)


def _timing() -> Iterator[str]:
    yield "| scene | book's software | clocks | a pixel | utilisation | frame at 80 MHz | faster |"
    yield "| --- | --- | --- | --- | --- | --- | --- |"
    for row in experiments.timing(_say):
        found, ms = row.summary, row.milliseconds
        yield (
            f"| {row.scene} | {row.book_seconds} s | {found.cycles:,} | {found.cycles_per_pixel:.3f} "
            f"| {found.utilisation:.3f} | {ms:.1f} ms | {1000 * row.book_seconds / ms:,.0f} times |"
        )


def _precision() -> Iterator[str]:
    rows = experiments.precision(_say)
    plots.precision(rows, PICTURES / "book_precision.png")
    yield "| scene | fraction bits | other hits | PSNR |"
    yield "| --- | --- | --- | --- |"
    for row in rows:
        psnr = "equal" if math.isinf(row.psnr_db) else f"{row.psnr_db:.2f} dB"
        yield f"| {row.scene} | {row.bits} | {row.hit_mismatch_percent:.4f} % | {psnr} |"


def _vanishing() -> Iterator[str]:
    rows = experiments.vanishing(_say)
    plots.vanishing(rows, PICTURES / "book_vanishing.png")
    radii = list(dict.fromkeys(row.radius for row in rows))
    yield f"| distance | {' | '.join(f'r = {radius}' for radius in radii)} |"
    yield f"| --- |{' --- |' * len(radii)}"
    for distance in experiments.DISTANCES:
        own = [row for row in rows if row.distance == distance]
        cells = " | ".join(f"{row.pixels} ({row.reference_pixels})" for row in own)
        yield f"| {distance} | {cells} |"
    seen = [f"{distance} (r = {radius})" for radius, distance in experiments.last_seen(rows)]
    yield ""
    yield f"Largest distance tried at which the sphere is still seen: {', '.join(seen)}."


def _depths() -> Iterator[str]:
    rows = experiments.depths(_say)
    plots.depths(rows, PICTURES / "book_depths.png")
    yield "| scene | depth | secondary rays a pixel | clocks a pixel | PSNR to depth 5 |"
    yield "| --- | --- | --- | --- | --- |"
    for row in rows:
        found = row.summary
        psnr = "equal" if math.isinf(row.psnr_db) else f"{row.psnr_db:.1f} dB"
        rays = found.secondary_rays / found.pixels
        yield f"| {row.scene} | {row.depth} | {rays:.2f} | {found.cycles_per_pixel:.2f} | {psnr} |"


TABLES: dict[str, Callable[[], Iterator[str]]] = {
    "timing": _timing,
    "precision": _precision,
    "vanishing": _vanishing,
    "depths": _depths,
}


def main() -> int:
    """Command line; see the module's docstring."""
    parser = argparse.ArgumentParser(prog="make book", description=__doc__)
    parser.add_argument("names", nargs="*", metavar="experiment", help=", ".join(TABLES))
    names = parser.parse_args().names or list(TABLES)
    if unknown := [name for name in names if name not in TABLES]:
        _say(f"no experiment is called {unknown[0]}; choose of {', '.join(TABLES)}")
        return 2
    try:
        for name in names:
            lines = list(TABLES[name]())
            PAGE.write_text(replaced(PAGE.read_text(), name, lines))
            print("\n".join([f"{name}:", *lines, ""]), flush=True)
    except MissingTool as error:
        _say(str(error))
        return 2
    except (BuildError, SimulationError, experiments.WrongPicture) as error:
        _say(str(error))
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
