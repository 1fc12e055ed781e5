"""The experiments (book, chapter 9), each a table of measured rows."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from models import images, reference
from models.core import registers, render
from models.core.trace import MISS
from models.fixed import BOOK, RADIUS
from models.formats import BUILDS, Knobs, formats
from models.limits import INFINITY, MAX_DEPTH
from models.scene.load import load
from models.scene.types import Camera, Scene, SceneFile, Sphere, View
from verif.core.builds import core_build
from verif.core.job import Job, request
from verif.env.build import CACHE
from verif.render.compare import Summary, expect, summarise
from verif.render.simulate import simulate

SCENES = Path("models/scenes")
ONE, THREE = SCENES / "one_sphere.toml", SCENES / "three_spheres.toml"
BOOK_SECONDS = {ONE: 5, THREE: 30}
"""What the book's software took for a frame of 512 x 512."""

CLOCK_HZ = 80_000_000
"""Clock that the default build is meant for."""

BITS = range(10, 21)
DISTANCES = (1, 2, 4, 8, 16, 32, 64, 100, 128, 160, 200, 240, 250, 254, 255)
RADII = (1, 8, RADIUS.max)
"""0.125, 1 and 3.875, raw."""

SIZE = 512
Progress = Callable[[str], None]


class WrongPicture(RuntimeError):
    """A pixel of the RTL is not the model's: its figures mean nothing."""


@dataclass(frozen=True)
class Timing:
    """A frame of 512 x 512: the book's software, clocks of the core, and what they mean at `CLOCK_HZ`."""

    scene: str
    book_seconds: int
    summary: Summary

    @property
    def milliseconds(self) -> float:
        """Of a frame, at the clock that the build is meant for."""
        return 1000 * self.summary.cycles / CLOCK_HZ


@dataclass(frozen=True)
class Precision:
    """A picture with so many fraction bits in every format, against the reference."""

    scene: str
    bits: int
    hit_mismatch_percent: float
    psnr_db: float


@dataclass(frozen=True)
class Vanishing:
    """Pixels of 512 x 512 that a sphere covers at a distance: core and reference."""

    radius: float
    distance: int
    pixels: int
    reference_pixels: int


@dataclass(frozen=True)
class Depth:
    """A scene drawn to a depth, and how far its picture is from that of the full depth."""

    scene: str
    depth: int
    summary: Summary
    psnr_db: float


def _drawn(job: Job, progress: Progress) -> Summary:
    """Through the RTL, every pixel compared. Raises WrongPicture where one is not the model's."""
    progress(f"{job.name}, {job.view.width} x {job.view.height}, depth {job.depth}")
    expected = expect(job)
    build = core_build(job.build, job.simulator)
    folder = CACHE / "book"
    drawn = simulate(build, job.frame, job.registers, f"book-{job.name}-{job.depth}", folder, None, 256)
    summary = summarise(job, drawn, expected)
    if summary.mismatched_pixels:
        raise WrongPicture(f"{job.name}: {summary.mismatched_pixels} pixels are not the model's")
    return summary


def timing(progress: Progress) -> list[Timing]:
    """The book's two timing scenes through the RTL."""
    return [
        Timing(path.stem, seconds, _drawn(request(str(path), f"{SIZE}x{SIZE}"), progress))
        for path, seconds in BOOK_SECONDS.items()
    ]


def uniform(bits: int) -> Knobs:
    """Knobs with so many fraction bits everywhere."""
    return Knobs(unit=bits, point=bits, colour=bits, screen=bits)


def precision(progress: Progress) -> list[Precision]:
    """Both scenes with 10 to 20 fraction bits everywhere, by the bit-exact model."""
    rows = []
    for path in BOOK_SECONDS:
        file = load(path)
        view = file.view_for(SIZE, SIZE)
        ideal = reference.render(file.scene, view)
        for bits in BITS:
            progress(f"{path.stem}, {bits} fraction bits")
            fmts = formats(uniform(bits))
            drawn = render(file.scene, registers(view, fmts), fmts)
            hits = images.hit_mismatch_percent(drawn.hit.astype(np.int32), ideal.hit)
            rows.append(Precision(path.stem, bits, hits, images.psnr_db(drawn.rgb, ideal.rgb)))
    return rows


def _far_scene(file: SceneFile, radius: int, distance: int) -> Scene:
    """The sphere of the book's scene before the camera, its center so far away, the view along an axis."""
    camera = Camera((0, 0, BOOK.one), (0, BOOK.one, 0), (0, 0, 0))
    sphere = Sphere(file.scene.spheres[0].material, (0, 0, BOOK.one * (1 - distance)), radius)
    return replace(file.scene, camera=camera, spheres=(sphere,))


def vanishing(progress: Progress) -> list[Vanishing]:
    """Spheres of three radii that go away along the axis of the view, by the bit-exact model."""
    file, fmts = load(ONE), formats(BUILDS["default"])
    view = View.book(SIZE, SIZE)
    rows = []
    for radius in RADII:
        progress(f"sphere of radius {radius / RADIUS.one}")
        for distance in DISTANCES:
            scene = _far_scene(file, radius, distance)
            drawn = render(scene, replace(registers(view, fmts), depth=1), fmts)
            ideal = reference.render(scene, view, max_depth=1)
            seen, wanted = int((drawn.hit != MISS).sum()), int((ideal.hit != MISS).sum())
            rows.append(Vanishing(radius / RADIUS.one, distance, seen, wanted))
    return rows


def last_seen(rows: Sequence[Vanishing]) -> Iterator[tuple[float, int]]:
    """Radius and the largest distance tried at which the core still shows the sphere."""
    for radius in sorted({row.radius for row in rows}):
        yield radius, max(row.distance for row in rows if row.radius == radius and row.pixels)


def depths(progress: Progress) -> list[Depth]:
    """Two scenes with secondary rays through the RTL, drawn to depths 1 to 5."""
    rows = []
    for name in ("three_spheres", "glass"):
        path = str(SCENES / f"{name}.toml")
        full = request(path, "256x256")
        best = render(full.file.scene, full.registers, full.formats).rgb
        for depth in range(1, MAX_DEPTH + 1):
            job = request(path, "256x256", depth=str(depth))
            shallow = render(job.file.scene, job.registers, job.formats).rgb
            rows.append(Depth(name, depth, _drawn(job, progress), images.psnr_db(shallow, best)))
    return rows


INFINITY_NUMBER = float(INFINITY)
"""A hit at or beyond it is a miss."""
