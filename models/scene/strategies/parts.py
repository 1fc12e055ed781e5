"""Hypothesis strategies of scenes, for the tests of the models and for the benches.

They shrink toward a black scene with few objects and a camera that looks down an axis.
"""

from typing import TypeVar

from hypothesis import strategies as st

from models.fixed import BOOK, COLOUR, RADIUS, Format
from models.scene.frame import Capacity, CounterWidths, FrameError, check_camera
from models.scene.types import INDEX, Camera, Light, Material, Scene, Sphere, Triangle, Vec3

T = TypeVar("T")


def raws(fmt: Format) -> st.SearchStrategy[int]:
    """Raw integers of a format, its ends and its 1.0 often among them."""
    ends = [0, min(fmt.one, fmt.max), fmt.min, fmt.max]
    return st.one_of(st.sampled_from(ends), st.integers(fmt.min, fmt.max))


def vectors(fmt: Format) -> st.SearchStrategy[Vec3]:
    """Three raw integers of a format."""
    component = raws(fmt)
    return st.tuples(component, component, component)


def materials() -> st.SearchStrategy[Material]:
    """Any material that the frame holds."""
    colour = vectors(COLOUR)
    return st.builds(Material, colour, colour, colour, colour, colour, st.integers(INDEX.min, INDEX.max))


def spheres() -> st.SearchStrategy[Sphere]:
    """Any sphere with a radius."""
    return st.builds(Sphere, materials(), vectors(BOOK), st.integers(1, RADIUS.max))


def triangles() -> st.SearchStrategy[Triangle]:
    """Any triangle, degenerate ones too."""
    vertex = vectors(BOOK)
    return st.builds(Triangle, materials(), st.tuples(vertex, vertex, vertex))


def is_drawable(camera: Camera) -> bool:
    """Whether the core accepts a frame with this camera."""
    try:
        check_camera(camera)
    except FrameError:
        return False
    return True


def cameras() -> st.SearchStrategy[Camera]:
    """Any camera that the core accepts."""
    vector = vectors(BOOK)
    plain = Camera((0, 0, 0), (0, BOOK.one, 0), (0, 0, BOOK.one))
    drawn = st.builds(Camera, vector, vector, vector)
    return st.one_of(st.just(plain), drawn.map(lambda camera: camera if is_drawable(camera) else plain))


def scenes(capacity: Capacity | None = None) -> st.SearchStrategy[Scene]:
    """Any scene that a core of this capacity (default: the book's counters) draws."""
    most = capacity or CounterWidths().capacity
    return st.builds(
        Scene,
        camera=cameras(),
        lights=_tuples(st.builds(Light, vectors(BOOK), vectors(COLOUR)), most.lights),
        spheres=_tuples(spheres(), most.spheres),
        triangles=_tuples(triangles(), most.triangles),
        ambient=vectors(COLOUR),
        background=vectors(COLOUR),
    )


def undrawable_cameras() -> st.SearchStrategy[Camera]:
    """Cameras without a direction of view, without an up, or with an up along the direction of view."""
    axis = st.sampled_from([(1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 0), (1, -2, 3)])
    length = st.integers(-1000, 1000)

    def along(direction: Vec3, distance: int) -> Vec3:
        x, y, z = direction
        return (x * distance, y * distance, z * distance)

    def build(direction: Vec3, reach: int, up: int) -> Camera:
        return Camera((0, 0, 0), along(direction, up), along(direction, reach))

    return st.builds(build, axis, length, length)


def _tuples(items: st.SearchStrategy[T], most: int) -> st.SearchStrategy[tuple[T, ...]]:
    return st.lists(items, max_size=most).map(tuple)
