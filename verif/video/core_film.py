"""A film's pictures as the RTL of the core draws them, in one simulation, each pixel held to the model's."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from models.core import Registers, Rendering
from models.cores import CORES
from models.scene.frame import pack
from models.scene.types import Scene
from verif.core.builds import core_build
from verif.core.driver import PIXELS
from verif.env.run import run
from verif.env.simulators import Simulator
from verif.video.core_film_bench import DRAWN
from verif.video.film import FilmError

_SEED = 1
_SETUP_CLOCKS = 200_000


def _clocks(model: Rendering) -> int:
    """More than the core takes for a picture: many times what its tests and rays need."""
    counts = model.counts
    work = counts.tests + counts.primary_rays + counts.secondary_rays + counts.shadow_rays
    return _SETUP_CLOCKS + 4 * counts.primary_rays + 4 * work


def draw(
    core: str, scenes: Sequence[Scene], size: Registers, wanted: Sequence[Rendering], simulator: Simulator
) -> NDArray[np.uint8]:
    """The pictures (n, h, w, 3) of scenes that a build of `models.cores` holds. Raises FilmError."""
    counters = CORES[core].counters
    extra = {
        "registers": list(vars(size).values()),
        "frames": [[int(word) for word in pack(scene, counters).words] for scene in scenes],
        "clocks": [_clocks(model) for model in wanted],
    }
    build = core_build(core, simulator)
    name = "video-core"
    outcome = run(build, "verif.video.core_film_bench", name, seed=_SEED, settings={"extra": extra})
    (outcome.directory / PIXELS).unlink(missing_ok=True)
    if not outcome.passed:
        raise FilmError(outcome.complaint())
    with np.load(outcome.directory / DRAWN) as drawn:
        pictures: NDArray[np.uint8] = drawn["rgb"]
        hits = drawn["hit"]
    for number, model in enumerate(wanted):
        wrong = (pictures[number] != model.rgb).any(axis=-1) | (hits[number] != model.hit)
        if wrong.any():
            y, x = np.argwhere(wrong)[0].tolist()
            raise FilmError(
                f"picture {number}: {np.count_nonzero(wrong)} of {wrong.size} pixels are not the model's, "
                f"the first one {x},{y}"
            )
    return pictures
