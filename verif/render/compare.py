"""The RTL's picture against the bit-exact model and the reference: numbers, and where it goes wrong."""

import math
import time
from dataclasses import asdict, dataclass

import numpy as np

from models import images, reference
from models.core import Rendering, render
from models.reference import Rendering as ReferenceRendering
from verif.core.job import Job
from verif.env.simulators import version
from verif.render.simulate import Drawn
from verif.render.worst import WorstPixel, worst_pixels


@dataclass(frozen=True)
class Summary:
    """What `summary.json` holds; worst_pixels: of the RTL against the reference.

    mismatched_pixels: RTL against the bit-exact model, colour or object. hit_mismatch_percent: primary
    rays of the RTL that hit another object than the reference's. psnr_db: RTL against the reference, None
    where the pictures are equal. cycles: from the first word of the frame to the last pixel. *_rays, tests:
    the core's own counters; utilisation: tests / (units * clocks of the frame). simulation_seconds: wall
    clock.
    """

    scene: str
    width: int
    height: int
    pixels: int
    mismatched_pixels: int
    hit_mismatch_percent: float
    psnr_db: float | None
    cycles: int
    cycles_per_pixel: float
    primary_rays: int
    secondary_rays: int
    shadow_rays: int
    tests: int
    units: int
    utilisation: float
    lights_at_point: int
    degenerate_triangles: int
    depth: int
    simulation_seconds: float
    pixels_per_second: float
    model_seconds: float
    reference_seconds: float
    simulator: str
    build: str
    worst_pixels: list[WorstPixel]

    def as_dict(self) -> dict[str, object]:
        """Names and values, for JSON."""
        return asdict(self)


@dataclass(frozen=True)
class Expected:
    """Both pictures that the RTL's is held against, and the seconds that each took."""

    model: Rendering
    model_seconds: float
    reference: ReferenceRendering
    reference_seconds: float

    @property
    def clocks_per_pixel(self) -> int:
        """More than the core takes, on average: many times what its tests and steps need."""
        counts = self.model.counts
        work = counts.tests + counts.primary_rays + counts.secondary_rays + counts.shadow_rays
        return 4 + 4 * math.ceil(work / counts.primary_rays)


def expect(job: Job) -> Expected:
    """Draws the model's and the reference's picture."""
    start = time.perf_counter()
    model = render(job.file.scene, job.registers, job.formats)
    middle = time.perf_counter()
    ideal = reference.render(job.file.scene, job.view, max_depth=job.depth)
    return Expected(model, middle - start, ideal, time.perf_counter() - middle)


def wrong_pixels(drawn: Drawn, expected: Expected) -> list[tuple[int, int]]:
    """Pixels (x, y), in picture order, whose colour or object is not the model's."""
    wrong = (drawn.rgb != expected.model.rgb).any(axis=-1) | (drawn.hit != expected.model.hit)
    return [(int(x), int(y)) for y, x in zip(*np.nonzero(wrong), strict=True)]


def summarise(job: Job, drawn: Drawn, expected: Expected) -> Summary:
    """All figures of a picture."""
    pixels = job.view.width * job.view.height
    psnr = images.psnr_db(drawn.rgb, expected.reference.rgb)
    return Summary(
        scene=str(job.file.path),
        width=job.view.width,
        height=job.view.height,
        pixels=pixels,
        mismatched_pixels=len(wrong_pixels(drawn, expected)),
        hit_mismatch_percent=images.hit_mismatch_percent(drawn.hit.astype(np.int32), expected.reference.hit),
        psnr_db=None if math.isinf(psnr) else psnr,
        cycles=drawn.latency,
        cycles_per_pixel=drawn.latency / pixels,
        primary_rays=drawn.counts.primary_rays,
        secondary_rays=drawn.counts.secondary_rays,
        shadow_rays=drawn.counts.shadow_rays,
        tests=drawn.counts.tests,
        units=job.core.units,
        utilisation=drawn.counts.tests / (job.core.units * drawn.cycles),
        lights_at_point=drawn.counts.lights_at_point,
        degenerate_triangles=drawn.degenerate,
        depth=job.depth,
        simulation_seconds=drawn.seconds,
        pixels_per_second=pixels / drawn.seconds,
        model_seconds=expected.model_seconds,
        reference_seconds=expected.reference_seconds,
        simulator=version(job.simulator),
        build=job.build,
        worst_pixels=worst_pixels(job.file.scene, job.view, job.depth, drawn.rgb, expected.reference.rgb),
    )
