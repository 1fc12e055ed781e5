"""A scene in real numbers, and the one factor that brings it onto the core's grid.

Scaling a whole scene leaves its picture unchanged, but radii have 3 fraction bits only and coordinates end at
256. So factors that put a radius on a step are tried one by one (powers of two where there are no spheres),
and the one with the smallest error is taken: the error of each center, radius and vertex relative to the size
of its own object, of the camera and the lights relative to their distance from the point looked at.
"""

import math
from collections.abc import Iterable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from models.fixed import BOOK, RADIUS
from models.limits import INFINITY
from models.scene import numbers
from models.scene.frame import check_camera
from models.scene.types import BLACK, Camera, Light, Material, Scene, Sphere, Triangle, Vec3

Point = tuple[float, float, float]

WORST_ERROR = 0.05
"""A scene that only fits with larger relative errors is refused: it would be another scene."""

_SMALLEST_POWER, _LARGEST_POWER = -40, 40
_UP_LENGTH = 64.0
"""Largest component of a scaled `up`: far from saturating a cross product with a unit vector."""
_SAME = 1e-12
"""Errors closer than this are equal; of equally good factors the one nearest to 1 is taken."""


@dataclass(frozen=True)
class Drawing:
    """A scene before scaling: lengths in real numbers, materials already in the core's."""

    place: Point = (0.0, 0.0, 0.0)
    at: Point = (0.0, 0.0, 0.0)
    up: Point = (0.0, 0.0, 0.0)
    background: Vec3 = BLACK
    lights: list[tuple[Point, Vec3]] = field(default_factory=list)
    spheres: list[tuple[Material, Point, float]] = field(default_factory=list)
    triangles: list[tuple[Material, tuple[Point, Point, Point]]] = field(default_factory=list)


@dataclass(frozen=True)
class Fit:
    """The factor and the worst relative error it leaves, with the name of what has it."""

    factor: float
    error: float
    worst: str


@dataclass(frozen=True)
class _Length:
    """Lengths that are rounded together, the size their error is compared with, and what they are."""

    values: NDArray[np.float64]
    size: float
    name: str
    steps: int = BOOK.one


def fit(drawing: Drawing) -> Fit:
    """The best factor; ValueError says why there is none."""
    limit = _largest_factor(drawing)
    lengths = list(_lengths(drawing))
    fits = [_judge(factor, lengths) for factor in _candidates(drawing, limit)]
    if not fits:
        raise ValueError(_why_not(drawing))
    least = min(found.error for found in fits)
    good = [found for found in fits if found.error <= least + _SAME]
    best = min(good, key=lambda found: abs(math.log(found.factor)))
    if best.error > WORST_ERROR:
        raise ValueError(
            f"at the best factor, {best.factor:.6g}, the error of {best.worst} is {100 * best.error:.3g} %, "
            f"above {100 * WORST_ERROR:g} %; the scene does not fit the core's radii and coordinates"
        )
    return best


def convert(drawing: Drawing, chosen: Fit) -> tuple[Scene, str]:
    """The scaled scene and a remark about factor and error; ValueError for a camera without a picture."""

    def point(values: Point) -> Vec3:
        x, y, z = (numbers.coordinate(value * chosen.factor) for value in values)
        return (x, y, z)

    def triangle(material: Material, corners: tuple[Point, Point, Point]) -> Triangle:
        a, b, c = (point(corner) for corner in corners)
        return Triangle(material, (a, b, c))

    camera = Camera(point(drawing.place), _direction(drawing.up), point(drawing.at))
    check_camera(camera)
    scene = Scene(
        camera=camera,
        lights=tuple(Light(point(place), intensity) for place, intensity in drawing.lights),
        spheres=tuple(
            Sphere(material, point(center), numbers.nearest(radius * chosen.factor, RADIUS))
            for material, center, radius in drawing.spheres
        ),
        triangles=tuple(triangle(material, corners) for material, corners in drawing.triangles),
        ambient=BLACK,
        background=drawing.background,
    )
    exact = chosen.error < _SAME
    error = "without error" if exact else f"worst error {100 * chosen.error:.2g} %, of {chosen.worst}"
    return scene, f"scaled by {chosen.factor:.6g}, {error}"


def _direction(up: Point) -> Vec3:
    """A direction in [9.10]: as it is where that is exact, else so long that rounding hardly turns it."""
    largest = max(abs(component) for component in up)
    scale = 1.0
    if largest and any((component * BOOK.one) % 1 for component in up):
        scale = _UP_LENGTH / largest
    x, y, z = (numbers.coordinate(component * scale) for component in up)
    return (x, y, z)


def _points(drawing: Drawing) -> NDArray[np.float64]:
    """(n, 3): everything a ray or a light's beam may start or end at."""
    points = [drawing.place, *(place for place, _ in drawing.lights)]
    points += [corner for _, corners in drawing.triangles for corner in corners]
    array = np.array(points, dtype=np.float64)
    if not drawing.spheres:
        return array
    centers = np.array([center for _, center, _ in drawing.spheres])
    radii = np.array([radius for _, _, radius in drawing.spheres])[:, None]
    return np.concatenate([array, *(centers + sign * radii * axis for axis in np.eye(3) for sign in (-1, 1))])


def _largest_factor(drawing: Drawing) -> float:
    """Above it a coordinate leaves [9.10], or a distance within the scene reaches infinity."""
    points = _points(drawing)
    coordinate = max(float(np.abs(points).max()), *(abs(component) for component in drawing.at))
    span = max(float(np.linalg.norm(points - point, axis=1).max()) for point in points)
    limits = [BOOK.max / BOOK.one / coordinate if coordinate else math.inf]
    limits += [float(INFINITY) / span if span else math.inf]
    return min(limits)


def _candidates(drawing: Drawing, limit: float) -> Iterable[float]:
    radii = sorted({radius for _, _, radius in drawing.spheres})
    if not radii:
        powers = (2.0**power for power in range(_SMALLEST_POWER, _LARGEST_POWER + 1))
        return [factor for factor in powers if factor <= limit]
    tried = {1.0} | {code / RADIUS.one / radius for radius in radii for code in range(1, RADIUS.max + 1)}
    return [
        factor
        for factor in sorted(tried)
        if factor <= limit
        and numbers.nearest(radii[0] * factor, RADIUS) >= 1
        and numbers.nearest(radii[-1] * factor, RADIUS) <= RADIUS.max
    ]


def _lengths(drawing: Drawing) -> Iterable[_Length]:
    at = np.array(drawing.at)
    for number, (_, center, radius) in enumerate(drawing.spheres):
        yield _Length(np.array(center), radius, f"the center of sphere {number}")
        yield _Length(np.array([radius]), radius, f"the radius of sphere {number}", RADIUS.one)
    for number, (_, corners) in enumerate(drawing.triangles):
        vertices = np.array(corners)
        size = float(np.linalg.norm(vertices - np.roll(vertices, 1, axis=0), axis=1).max())
        yield _Length(vertices, size, f"the vertices of triangle {number}")
    distance = float(np.linalg.norm(at - drawing.place))
    yield _Length(np.array([drawing.place, drawing.at]), distance, "the camera")
    for number, (place, _) in enumerate(drawing.lights):
        yield _Length(np.array(place), float(np.linalg.norm(at - place)), f"light {number}")


def _judge(factor: float, lengths: list[_Length]) -> Fit:
    errors = [(_error(factor, length), length.name) for length in lengths if length.size > 0]
    error, worst = max(errors, key=lambda pair: pair[0], default=(0.0, "nothing"))
    return Fit(factor, error, worst)


def _error(factor: float, length: _Length) -> float:
    steps = length.values * (factor * length.steps)
    return float(np.abs(np.floor(steps + 0.5) - steps).max()) / (factor * length.steps * length.size)


def _why_not(drawing: Drawing) -> str:
    radii = [radius for _, _, radius in drawing.spheres]
    if radii and max(radii) > min(radii) * RADIUS.max:
        return (
            f"radii from {min(radii):g} to {max(radii):g} differ by more than {RADIUS.max} times, "
            f"the range of the core's radius"
        )
    return (
        f"no factor brings the radii to {1 / RADIUS.one} or more and keeps all coordinates and distances "
        f"below {float(INFINITY):.5g}; the scene is too wide for its spheres"
    )
