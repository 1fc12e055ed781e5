"""Places, colours, materials and cameras of scenes that show something; all shrink toward the plain ones.

Strategies are kept: to build one takes longer than to draw from it. What depends on other draws is a function
of `draw` instead.
"""

from collections.abc import Callable, Sequence
from functools import cache

from hypothesis import strategies as st

from models.fixed import BOOK, COLOUR, RADIUS
from models.scene.strategies.parts import is_drawable
from models.scene.types import BLACK, INDEX, Camera, Light, Material, Sphere, Triangle, Vec3

ONE = BOOK.one
QUARTER = ONE // 4
STEP = 1 << (BOOK.frac_bits - RADIUS.frac_bits)
"""A step of the radius in raw units of a coordinate."""
FULL = COLOUR.one
AXES: tuple[Vec3, ...] = ((0, 0, 1), (0, 1, 0), (1, 0, 0), (0, 0, -1), (0, -1, 0), (-1, 0, 0))
WALL = 24 * ONE
"""Half the width of a wall."""
_GREY: Vec3 = (FULL // 2, FULL // 2, FULL // 2)


def clamped(place: Sequence[float]) -> Vec3:
    """Rounded, and held in the range of a coordinate."""
    x, y, z = (min(max(round(component), BOOK.min), BOOK.max) for component in place)
    return (x, y, z)


def plus(start: Vec3, way: Vec3, times: int = 1) -> Vec3:
    """Some times a way further, held in the range."""
    return clamped([s + times * w for s, w in zip(start, way, strict=True)])


def moved(start: Vec3, way: Vec3, distance: float) -> Vec3:
    """`distance` raw steps along a way, held in the range of a coordinate."""
    length = sum(component * component for component in way) ** 0.5
    return clamped([s + distance * w / length for s, w in zip(start, way, strict=True)])


@cache
def ways() -> st.SearchStrategy[Vec3]:
    """Directions: along an axis, or any."""
    small = st.integers(-8, 8)
    any_way = st.tuples(small, small, small).map(lambda way: way if any(way) else AXES[0])
    return st.sampled_from(AXES) | any_way


@cache
def places(reach: int) -> st.SearchStrategy[Vec3]:
    """Within so many units of the origin along each axis; every other one on quarters of a unit."""
    coarse = st.integers(-4 * reach, 4 * reach).map(lambda steps: steps * QUARTER)
    fine = st.integers(-reach * ONE, reach * ONE)
    return st.tuples(coarse, coarse, coarse) | st.tuples(fine, fine, fine)


def around(draw: st.DrawFn, place: Vec3, reach: int) -> Vec3:
    """Within so many units of a place along each axis."""
    return plus(place, draw(places(reach)))


@cache
def colours(least: int = 0, most: int = FULL) -> st.SearchStrategy[Vec3]:
    """Grey halfway, or any; the ends often."""
    middle = (least + most) // 2
    component = st.sampled_from((middle, least, most)) | st.integers(least, most)
    return st.just((middle, middle, middle)) | st.tuples(component, component, component)


@cache
def matte() -> st.SearchStrategy[Material]:
    """Neither reflects nor lets light through."""
    return st.builds(Material, colours(), colours(), colours())


@cache
def mirrors(least: int = 0) -> st.SearchStrategy[Material]:
    """Dark, and reflect `least` or more."""
    dark = colours(0, FULL // 4)
    return st.builds(Material, dark, dark, colours(), colours(least))


@cache
def bright_mirrors() -> st.SearchStrategy[Material]:
    """Reflect at least half."""
    return mirrors(FULL // 2)


@cache
def glass() -> st.SearchStrategy[Material]:
    """Dark, lets a quarter of the light or more through; of any refractive index."""
    dark = colours(0, FULL // 4)
    index = st.sampled_from((4, 0, INDEX.max)) | st.integers(INDEX.min, INDEX.max)
    clear = colours(FULL // 4)
    return st.builds(Material, dark, dark, colours(), st.just(BLACK) | dark, clear, index)


@cache
def materials() -> st.SearchStrategy[Material]:
    """Any of these."""
    return st.one_of(st.just(Material(_GREY, _GREY, _GREY)), matte(), mirrors(), glass())


@cache
def extreme_colours() -> st.SearchStrategy[Vec3]:
    """Nothing, all, next to these, and more."""
    component = st.sampled_from((FULL, 0, 1, FULL - 1, FULL + 1, 2 * FULL, COLOUR.max))
    return st.tuples(component, component, component) | component.map(lambda grey: (grey, grey, grey))


@cache
def extremes() -> st.SearchStrategy[Material]:
    """Of such coefficients only."""
    colour = extreme_colours()
    return st.builds(Material, colour, colour, colour, colour, colour, st.integers(0, INDEX.max))


@cache
def lights(reach: int) -> st.SearchStrategy[Light]:
    """Near the origin."""
    return st.builds(Light, places(reach), colours(FULL // 4))


@cache
def radii(least: int = 1, most: int = RADIUS.max) -> st.SearchStrategy[int]:
    """Raw; the ends often, and one unit."""
    return st.sampled_from((min(max(8, least), most), least, most)) | st.integers(least, most)


@cache
def spheres(kind: Callable[[], st.SearchStrategy[Material]] = materials) -> st.SearchStrategy[Sphere]:
    """Half a unit or larger, near the origin, of some kind of material."""
    return st.builds(Sphere, kind(), places(3), radii(least=4))


@cache
def _depths() -> st.SearchStrategy[tuple[int, int]]:
    """How far from the center in eighths of the radius, and how many steps further in."""
    eighths = st.integers(0, 7).map(lambda eighth: (eighth, 0))
    return eighths | st.integers(1, 32).map(lambda steps: (8, steps))


def inside(draw: st.DrawFn, sphere: Sphere) -> Vec3:
    """A place in a sphere, its center and next to its surface among them."""
    eighths, steps = draw(_depths())
    return moved(sphere.center, draw(ways()), eighths * sphere.radius * STEP // 8 - steps)


@cache
def _ups() -> st.SearchStrategy[Vec3]:
    return st.sampled_from([plus((0, 0, 0), axis, ONE) for axis in (*AXES[1:3], *AXES)]) | places(1)


def looking(draw: st.DrawFn, position: Vec3, center: Vec3) -> Camera:
    """From a place at another, with a drawn up; a camera that draws a picture in any case."""
    ups = (draw(_ups()), *(plus((0, 0, 0), axis, ONE) for axis in AXES[:2]))
    # Where the places are one, look along an axis that is free.
    centers = (center, moved(position, AXES[0], ONE), moved(position, AXES[3], ONE))
    cameras = (Camera(position, up, some_center) for some_center in centers for up in ups)
    return next(camera for camera in cameras if is_drawable(camera))


def camera(draw: st.DrawFn, target: Vec3, nearest: int = 4, farthest: int = 10) -> Camera:
    """Some units away from what it looks at."""
    distance = draw(st.integers(4 * nearest, 4 * farthest)) * QUARTER
    return looking(draw, moved(target, draw(ways()), distance), target)


def plate(material: Material, place: Vec3, axis: int, half: int = WALL) -> Triangle:
    """A triangle across an axis, 4 by 2 halves large around a place."""
    corners = []
    for across, along in ((-2, -1), (2, -1), (0, 1)):
        corner = list(place)
        corner[axis - 1] += across * half
        corner[axis - 2] += along * half
        corners.append(clamped(corner))
    return Triangle(material, (corners[0], corners[1], corners[2]))


def wall(material: Material, camera: Camera, behind: int = 2 * ONE) -> Triangle:
    """A large triangle behind what the camera looks at, across the axis that it looks along most."""
    ahead = [c - p for c, p in zip(camera.center, camera.position, strict=True)]
    axis = max(range(3), key=lambda number: abs(ahead[number]))
    place = list(camera.center)
    place[axis] += behind if ahead[axis] > 0 else -behind
    return plate(material, clamped(place), axis)


def middle(corners: Sequence[Vec3]) -> Vec3:
    """The mean of places."""
    return clamped([sum(components) / len(corners) for components in zip(*corners, strict=True)])
