"""A film through the video block: pictures at a rate in, frames of the screen out, as files."""

import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from models.images import save_png
from models.video import VGA
from verif.env import harness
from verif.env.build import Build
from verif.env.run import run
from verif.env.simulators import Simulator
from verif.video.bench import SEEN, STREAM
from verif.video.samples import RECORDING

TOP = "screen_tb"
_SEED = 1
_GIF_MS = 10
"""What times in a GIF are counted in."""


class FilmError(RuntimeError):
    """The simulation failed, or what was seen was not what it must be; the text says what and where."""


def screen_build(simulator: Simulator) -> Build:
    """The video block as it is by default between player and recorder, both clocks its own."""
    return Build(TOP, simulator, control=harness.control(TOP), optimise="-O3", timing=True)


@dataclass(frozen=True)
class Film:
    """What was seen: pictures uint8 (n, h, w, 3), each other than the one before, black first; refreshes: how
    many frames of the screen each was seen, but for the first and the last, whose times mean nothing."""

    pictures: NDArray[np.uint8]
    refreshes: NDArray[np.int64]

    @property
    def shown(self) -> NDArray[np.uint8]:
        """The pictures without the black before the first one."""
        return self.pictures[1:]


def show(
    pictures: NDArray[np.uint8], rate: float, name: str, simulator: Simulator = Simulator.VERILATOR
) -> Film:
    """Shows pictures (n, h, w, 3), of which no two that follow are equal, at a rate in pictures a second.

    The bench compares every frame with the model, and its figures with the mode's. Raises FilmError.
    """
    build = screen_build(simulator)
    with tempfile.TemporaryDirectory() as scratch:
        source = Path(scratch) / "pictures.npy"
        np.save(source, pictures)
        settings = {"extra": {"pictures": str(source), "rate": rate}}
        outcome = run(build, "verif.video.bench", name, seed=_SEED, settings=settings)
    for recording in (RECORDING, STREAM):
        (outcome.directory / recording).unlink(missing_ok=True)
    if not outcome.passed:
        raise FilmError(outcome.complaint())
    with np.load(outcome.directory / SEEN) as seen:
        starts = seen["starts"].astype(np.int64)
        return Film(seen["pictures"], np.diff(starts, append=starts[-1:]) // VGA.clocks)


def times_ms(film: Film, rate: float, step_ms: int = 1) -> list[int]:
    """How long each picture was seen, in steps of so many milliseconds that add up; the last: its share."""
    frames = [int(count) for count in film.refreshes[1:-1]]
    ends = np.cumsum([0.0, *frames]) * 1000 / VGA.refresh_hz
    ends = np.append(ends, max(ends[-1] + 1000 / VGA.refresh_hz, len(film.shown) * 1000 / rate))
    rounded = [round(end / step_ms) * step_ms for end in ends.tolist()]
    return [after - before for before, after in pairwise(rounded)]


def write(film: Film, rate: float, out: Path) -> None:
    """Each picture as frame-<number>.png, all as animation.png and animation.gif, and in half the size, for
    pages, all as small.gif and four of them as sheet.png."""
    out.mkdir(parents=True, exist_ok=True)
    for old in out.glob("frame-*.png"):
        old.unlink()
    for number, picture in enumerate(film.shown):
        save_png(out / f"frame-{number:03}.png", picture)
    images = [Image.fromarray(picture, "RGB") for picture in film.shown]
    _animate(out / "animation.png", images, times_ms(film, rate))
    times = times_ms(film, rate, _GIF_MS)
    _animate(out / "animation.gif", [_palette(picture) for picture in film.shown], times)
    _animate(out / "small.gif", [_palette(_half(picture)) for picture in film.shown], times)
    save_png(out / "sheet.png", sheet(film.shown))


def sheet(shown: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Four pictures of a film, at the quarters of its way, in half the size: as large as one of them."""
    quarters = [_half(shown[len(shown) * quarter // 4]) for quarter in range(4)]
    return np.vstack([np.hstack(quarters[:2]), np.hstack(quarters[2:])])


def _half(picture: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Of the default screen each stored pixel once: it repeats them twice in either direction."""
    return picture[::2, ::2]


def _palette(picture: NDArray[np.uint8]) -> Image.Image:
    return Image.fromarray(picture, "RGB").quantize(dither=Image.Dither.FLOYDSTEINBERG)


def _animate(path: Path, images: Sequence[Image.Image], times: Sequence[int]) -> None:
    first, *others = images
    first.save(path, save_all=True, append_images=others, duration=list(times), loop=0)
