"""Scenes that the core draws, and the registers to draw them with, as Hypothesis strategies.

What the frame can hold is almost all empty space; these put the camera and the light where they
matter: inside the sphere, on its surface, far from it, at the edge of the number range. They
shrink toward a black scene, an axis and one pixel.
"""

from dataclasses import dataclass, replace

from hypothesis import strategies as st

from models.core import Registers
from models.core import registers as as_registers
from models.fixed import BOOK, COLOUR, RADIUS
from models.formats import Formats
from models.scene.frame import Capacity
from models.scene.strategies import is_drawable, materials, raws, scenes, undrawable_cameras, vectors
from models.scene.types import Camera, Light, Material, Scene, Sphere, Vec3, View
from verif.render.job import CAPACITY

SIZES = ((1, 1), (2, 1), (1, 2), (4, 3), (3, 5), (8, 6), (16, 9))
"""Pictures small enough for many of them; the set-up of each takes longer than its pixels."""

_AXES: tuple[Vec3, ...] = ((0, 0, 1), (0, 1, 0), (1, 0, 0), (0, 0, -1), (0, -1, 0), (-1, 0, 0))
_RADIUS_TO_COORD = BOOK.frac_bits - RADIUS.frac_bits
_QUARTERS = 4
_FAR = 1 << (BOOK.width - 1)


def _clamped(place: tuple[int, ...]) -> Vec3:
    x, y, z = (min(max(component, BOOK.min), BOOK.max) for component in place)
    return (x, y, z)


def _moved(start: Vec3, direction: Vec3, distance: int) -> Vec3:
    """``distance`` raw steps along a direction, held in the range of a coordinate."""
    length = max(1, round(sum(component * component for component in direction) ** 0.5))
    return _clamped(tuple(s + d * distance // length for s, d in zip(start, direction, strict=True)))


def _directions() -> st.SearchStrategy[Vec3]:
    small = st.integers(-1000, 1000)
    return st.sampled_from(_AXES) | st.tuples(small, small, small)


def _distances(radius: int) -> st.SearchStrategy[int]:
    """From the center of a sphere, in raw steps: at, in, on, just off and far off its surface."""
    surface = radius << _RADIUS_TO_COORD
    near = st.integers(-2, 2).map(lambda step: max(0, surface + step))
    quarters = st.integers(0, 5 * _QUARTERS).map(lambda count: surface * count // _QUARTERS)
    return st.just(3 * surface) | st.just(surface) | near | quarters | st.integers(0, 2 * _FAR)


def _centers() -> st.SearchStrategy[Vec3]:
    return st.just((0, 0, 0)) | vectors(BOOK)


def _radii() -> st.SearchStrategy[int]:
    return st.sampled_from((8, 1, RADIUS.max)) | st.integers(1, RADIUS.max)


def _colours() -> st.SearchStrategy[Vec3]:
    """Mostly colours that leave a pixel between black and white, sometimes anything."""
    usual = st.integers(0, COLOUR.one)
    return st.tuples(usual, usual, usual) | vectors(COLOUR)


@st.composite
def _around(draw: st.DrawFn, sphere: Sphere) -> Vec3:
    """A place chosen by its distance from a sphere."""
    return _moved(sphere.center, draw(_directions()), draw(_distances(sphere.radius)))


@st.composite
def _aimed_cameras(draw: st.DrawFn, sphere: Sphere) -> Camera:
    """Anywhere around the sphere; looks at it, past its edge, or away from it."""
    position = draw(_around(sphere))
    aim = draw(st.just(sphere.center) | _around(sphere))
    if draw(st.booleans()):
        aim = _clamped(tuple(2 * p - a for p, a in zip(position, aim, strict=True)))
    up = draw(st.sampled_from(_AXES).map(lambda axis: _moved((0, 0, 0), axis, BOOK.one)) | vectors(BOOK))
    wanted = Camera(position, up, aim)
    # A view along some axis is neither of length 0 nor parallel to any up, if up has a length.
    others = [Camera(position, up, _moved(position, axis, _FAR)) for axis in _AXES]
    upright = [Camera(position, (0, BOOK.one, 0), camera.center) for camera in others]
    return next(camera for camera in (wanted, *others, *upright) if is_drawable(camera))


@st.composite
def _aimed_scenes(draw: st.DrawFn) -> Scene:
    """One sphere that the camera is near to, inside of or looks at, and at most one light near it."""
    colours = _colours()
    sphere = Sphere(draw(materials()), draw(_centers()), draw(_radii()))
    if draw(st.booleans()):
        sphere = replace(sphere, material=Material(draw(colours), draw(colours), draw(colours)))
    camera = draw(_aimed_cameras(sphere))
    place = _around(sphere) | st.just(camera.position) | vectors(BOOK)
    lights = draw(st.lists(st.builds(Light, place, colours), max_size=1))
    return Scene(camera, tuple(lights), (sphere,), (), draw(colours), draw(colours))


@st.composite
def _lit_points(draw: st.DrawFn) -> Scene:
    """Camera and light on one axis through the sphere, the light at or next to where the axis meets it."""
    axis = draw(st.sampled_from(_AXES))
    radius = draw(_radii())
    sphere = Sphere(draw(materials()), (0, 0, 0), radius)
    surface = radius << _RADIUS_TO_COORD
    reach = draw(st.sampled_from((3 * surface, surface // 2)))
    # From inside the far side is seen, from outside the near one.
    seen = surface if reach > surface else -surface
    light = Light(_moved((0, 0, 0), axis, seen + draw(st.sampled_from((0, 0, 1, -1)))), draw(_colours()))
    up = _moved((0, 0, 0), _AXES[(_AXES.index(axis) + 1) % 3], BOOK.one)
    camera = Camera(_moved((0, 0, 0), axis, reach), up, (0, 0, 0))
    return Scene(camera, (light,), (sphere,), (), draw(_colours()), draw(_colours()))


def drawable_scenes() -> st.SearchStrategy[Scene]:
    """Any scene that this core draws."""
    return _aimed_scenes() | _lit_points() | scenes(CAPACITY)


def camera_faults() -> st.SearchStrategy[Scene]:
    """Scenes that differ from drawable ones in a camera that cannot be drawn."""

    def build(scene: Scene, camera: Camera) -> Scene:
        return replace(scene, camera=camera)

    return st.builds(build, scenes(CAPACITY), undrawable_cameras())


def crowded_scenes() -> st.SearchStrategy[Scene]:
    """Scenes of at most 3 lights, 3 spheres and 2 triangles: mostly more than this core holds."""
    return scenes(Capacity(3, 3, 2))


@dataclass(frozen=True)
class Shot:
    """A scene and how it is looked at; view: None where no scene file can say what the registers do."""

    scene: Scene
    registers: Registers
    view: View | None


def shots(fmts: Formats, most: int, scene: st.SearchStrategy[Scene] | None = None) -> st.SearchStrategy[Shot]:
    """Scenes, drawable ones by default, in pictures of at most ``most`` pixels: the book's view, square
    pixels, any tangents."""
    sizes = st.sampled_from([size for size in SIZES if size[0] * size[1] <= most])
    scene = scene or drawable_scenes()

    def seen(scene: Scene, view: View) -> Shot:
        return Shot(scene, as_registers(view, fmts), view)

    def book(size: tuple[int, int]) -> View:
        return View.book(*size)

    def square(size: tuple[int, int], angle: int) -> View:
        return View.square(*size, angle)

    def untold(scene: Scene, size: tuple[int, int], tan_h: int, tan_v: int) -> Shot:
        return Shot(scene, Registers(*size, tan_h, tan_v), None)

    views = st.builds(book, sizes) | st.builds(square, sizes, st.integers(1, 120))
    tangent = raws(fmts.tan)
    return st.builds(seen, scene, views) | st.builds(untold, scene, sizes, tangent, tangent)
