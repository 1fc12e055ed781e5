"""The ray tree of each pixel, level by level, all pixels at once (book, 8.2)."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from models.limits import MAX_DEPTH, MIN_WEIGHT
from models.reference.camera import directions, primary_directions
from models.reference.intersect import Shape, nearest, shapes
from models.reference.refract import transmitted
from models.reference.shade import Hits, Materials, hits, local_colour
from models.reference.vectors import Floats, Ints, column
from models.scene.types import Scene, View

_CHUNK = 1 << 15
"""About so many primary rays are traced together: their arrays stay in the processor's cache."""


@dataclass(frozen=True)
class Rendering:
    """A picture, uint8 (h, w, 3), and the object number that each primary ray hits, or -1, int32 (h, w)."""

    rgb: NDArray[np.uint8]
    hit: NDArray[np.int32]


@dataclass(frozen=True)
class _Rays:
    """n rays of one level: origin, direction, weight (3, n), and the pixel each adds to (n,)."""

    origin: Floats
    direction: Floats
    weight: Floats
    pixel: Ints

    def where(self, keep: NDArray[np.bool_]) -> "_Rays":
        return _Rays(self.origin[:, keep], self.direction[:, keep], self.weight[:, keep], self.pixel[keep])


def render(
    scene: Scene,
    view: View,
    *,
    max_depth: int = MAX_DEPTH,
    min_weight: float = float(MIN_WEIGHT),
    rows: slice | None = None,
) -> Rendering:
    """Render a scene, or some rows of it, in float64.

    `max_depth` is the depth of the deepest rays, 1 for primary rays only. A secondary ray is cast where a
    channel of its weight reaches `min_weight`. Raises FrameError for a camera that the core refuses,
    ValueError for a depth below 1.
    """
    if max_depth < 1:
        raise ValueError(f"max_depth {max_depth} leaves no primary ray")
    tracer = _Tracer(scene, max_depth, min_weight)
    wanted = range(view.height)[rows or slice(None)]
    step = max(1, _CHUNK // view.width)
    colours, numbers = [np.empty((3, 0))], [np.empty(0, dtype=np.int64)]
    for start in range(0, len(wanted), step):
        some = wanted[start : start + step]
        colour, number = tracer.trace(primary_directions(scene.camera, view, np.array(some)))
        colours.append(colour)
        numbers.append(number)
    shape = (len(wanted), view.width)
    colour = np.concatenate(colours, axis=1)
    return Rendering(
        rgb=to_rgb888(colour).T.reshape(*shape, 3),
        hit=np.concatenate(numbers).astype(np.int32).reshape(shape),
    )


def sample(
    scene: Scene, view: View, x: Floats, y: Floats, *, max_depth: int = MAX_DEPTH
) -> NDArray[np.uint8]:
    """Colours (n, 3) at places of the picture (n,) that need not be centers of pixels; raises as `render`."""
    tracer = _Tracer(scene, max_depth, float(MIN_WEIGHT))
    colour, _ = tracer.trace(directions(scene.camera, view, x, y))
    return to_rgb888(colour).T


def to_rgb888(colour: Floats) -> NDArray[np.uint8]:
    """Each channel times 255, truncated, clamped to 0 to 255 (book, 8.2.6)."""
    return np.clip(np.floor(colour * 255), 0, 255).astype(np.uint8)


class _Tracer:
    """One scene, ready to trace rays."""

    def __init__(self, scene: Scene, max_depth: int, min_weight: float) -> None:
        self._scene = scene
        self._max_depth = max_depth
        self._min_weight = min_weight
        self._shapes: tuple[Shape, ...] = shapes(scene)
        self._materials = Materials.of(scene)

    def trace(self, directions: Floats) -> tuple[Floats, Ints]:
        """Colours (3, n) of n pixels and the object numbers (n,) that their primary rays hit."""
        count = directions.shape[1]
        origin = np.broadcast_to(column(self._scene.camera.position), directions.shape)
        level = [_Rays(origin, directions, np.ones((3, count)), np.arange(count))]
        pixels = np.zeros((3, count))
        primary = np.empty(0, dtype=np.int64)
        for depth in range(1, self._max_depth + 1):
            children = []
            for rays in level:
                number, at = self._add(rays, pixels)
                primary = number if depth == 1 else primary
                if depth < self._max_depth:
                    children += self._secondary(rays.where(number >= 0), at)
            level = children
        return pixels, primary

    def _add(self, rays: _Rays, pixels: Floats) -> tuple[Ints, Hits]:
        """Add weight * colour of one level's rays to their pixels; their object numbers and hits."""
        distance, number = nearest(self._shapes, rays.origin, rays.direction)
        hit = number >= 0
        own = rays.where(hit)
        at = hits(self._shapes, own.origin, own.direction, distance[hit], number[hit])
        colour = np.repeat(column(self._scene.background), len(number), axis=1)
        colour[:, hit] = local_colour(self._scene, self._shapes, self._materials, at)
        # A level's rays of one kind add to each pixel at most once, so plain indexing loses nothing.
        pixels[:, rays.pixel] += rays.weight * colour
        return number, at

    def _secondary(self, rays: _Rays, at: Hits) -> list[_Rays]:
        """The reflected and the transmitted rays of these hits, each kind a batch of its own."""
        index = self._materials.index[at.number]
        kinds = (
            (at.reflected, self._materials.reflection),
            (transmitted(at, index), self._materials.transparency),
        )
        batches = []
        for direction, share in kinds:
            weight = rays.weight * share[:, at.number]
            keep = weight.max(axis=0) >= self._min_weight
            if keep.any():
                batches.append(_Rays(at.point, direction, weight, rays.pixel).where(keep))
        return batches
