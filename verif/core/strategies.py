"""What the core's benches draw: pictures, frames that are refused, and a tree in which every hit splits."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

from hypothesis import strategies as st

from models.core import Registers
from models.core import registers as as_registers
from models.fixed import BOOK, COLOUR
from models.formats import Formats
from models.limits import MAX_DEPTH, Fault
from models.scene.frame import Capacity, CounterWidths, pack
from models.scene.strategies import classes, raws, undrawable_cameras
from models.scene.types import BLACK, Camera, Light, Material, Scene, Sphere, Triangle, Vec3, View

SIZES = ((1, 1), (2, 1), (1, 2), (4, 3), (3, 5), (8, 6))
"""Pictures small enough for many of them; the set-up of each takes longer than its pixels."""

_WIDEST_ANGLE = 120


@dataclass(frozen=True)
class Shot:
    """A scene and how it is looked at; view: None where no scene file can say what the registers do."""

    scene: Scene
    registers: Registers
    view: View | None


def depths() -> st.SearchStrategy[int]:
    """Of the deepest ray: any, the deepest often."""
    return st.integers(1, MAX_DEPTH) | st.just(MAX_DEPTH)


def shots(fmts: Formats, most: int, scene: st.SearchStrategy[Scene]) -> st.SearchStrategy[Shot]:
    """Scenes in pictures of at most ``most`` pixels, to any depth: the book's view, square pixels, any
    tangents."""
    sizes = st.sampled_from([size for size in SIZES if size[0] * size[1] <= most])

    def seen(scene: Scene, view: View, depth: int) -> Shot:
        return Shot(scene, replace(as_registers(view, fmts), depth=depth), view)

    def book(size: tuple[int, int]) -> View:
        return View.book(*size)

    def square(size: tuple[int, int], angle: int) -> View:
        return View.square(*size, angle)

    def untold(scene: Scene, size: tuple[int, int], tan_h: int, tan_v: int, depth: int) -> Shot:
        return Shot(scene, Registers(*size, tan_h, tan_v, depth), None)

    views = st.builds(book, sizes) | st.builds(square, sizes, st.integers(1, _WIDEST_ANGLE))
    tangent = raws(fmts.tan)
    return st.one_of(
        st.builds(seen, scene, views, depths()), st.builds(untold, scene, sizes, tangent, tangent, depths())
    )


# Trees


def splitting(capacity: Capacity) -> Scene:
    """Shells of glass that mirror, one in another around camera and lights: every hit splits in two.

    Half of the weight goes either way, so that in `MAX_DEPTH` levels no ray becomes negligible; where there
    are as many shells no ray of them misses.
    """
    half, some = COLOUR.one // 2, COLOUR.one // 16
    glass = Material((some,) * 3, (half,) * 3, (half,) * 3, (half,) * 3, (half,) * 3, 4)
    radii = (8, 20, 31)[: capacity.spheres]
    sizes = (8, 28, 90)[: capacity.triangles // 4]
    spheres = tuple(Sphere(glass, BLACK, radius) for radius in radii)
    triangles = tuple(triangle for size in sizes for triangle in _tetrahedron(glass, size * BOOK.one))
    tenth = BOOK.one // 10
    lights = tuple(
        Light((tenth * number, -tenth, 2 * tenth), (some * (1 + number), some, some))
        for number in range(capacity.lights)
    )
    camera = Camera((tenth, 2 * tenth, -tenth), (0, BOOK.one, 0), (0, 0, BOOK.one))
    return Scene(camera, lights, spheres, triangles, (half,) * 3, (COLOUR.one, 0, half))


def _tetrahedron(material: Material, size: int) -> tuple[Triangle, ...]:
    a, b, c, d = (
        (size, size, size),
        (size, -size, -size),
        (-size, size, -size),
        (-size, -size, size),
    )
    return tuple(Triangle(material, corners) for corners in ((a, b, c), (a, c, d), (a, d, b), (b, d, c)))


# Frames that are refused


@dataclass(frozen=True)
class FaultyFrame:
    """Words of a frame that is refused, and why."""

    fault: Fault
    words: tuple[int, ...]


_Make = Callable[[st.DrawFn, Scene, CounterWidths], tuple[int, ...]]


def _short(draw: st.DrawFn, scene: Scene, counters: CounterWidths) -> tuple[int, ...]:
    words = pack(scene, counters).words
    return words[: draw(st.integers(1, len(words) - 1))]


def _long(draw: st.DrawFn, scene: Scene, counters: CounterWidths) -> tuple[int, ...]:
    return (*pack(scene, counters).words, *range(draw(st.integers(1, 40))))


def _kind(draw: st.DrawFn, scene: Scene, counters: CounterWidths) -> tuple[int, ...]:
    at = draw(st.sampled_from(kind_bits(scene, counters)))
    return flipped(pack(scene, counters).words, [at])


def _radius(draw: st.DrawFn, scene: Scene, counters: CounterWidths) -> tuple[int, ...]:
    at = draw(st.integers(0, len(scene.spheres) - 1))
    spheres = list(scene.spheres)
    spheres[at] = replace(spheres[at], radius=0)
    return pack(replace(scene, spheres=tuple(spheres)), counters).words


def _no_view(_draw: st.DrawFn, scene: Scene, counters: CounterWidths) -> tuple[int, ...]:
    camera = replace(scene.camera, center=scene.camera.position)
    return pack(replace(scene, camera=camera), counters).words


def _no_up(draw: st.DrawFn, scene: Scene, counters: CounterWidths) -> tuple[int, ...]:
    cameras = undrawable_cameras().filter(lambda camera: camera.center != camera.position)
    return pack(replace(scene, camera=draw(cameras)), counters).words


_FAULTS: Mapping[Fault, _Make] = {
    Fault.FRAME_SHORT: _short,
    Fault.FRAME_LONG: _long,
    Fault.KIND: _kind,
    Fault.RADIUS: _radius,
    Fault.CAMERA_POSITION: _no_view,
    Fault.CAMERA_UP: _no_up,
}

FAULTS = tuple(_FAULTS)
"""All that a frame itself can have. CAPACITY is none: what the counters can say the core holds."""


@st.composite
def faulty_frames(draw: st.DrawFn, counters: CounterWidths, faults: Sequence[Fault] = FAULTS) -> FaultyFrame:
    """A frame with one of these faults, at any place where the frame can have it."""
    scene = draw(classes(counters.capacity)["crowd"])
    fault = draw(st.sampled_from(faults))
    return FaultyFrame(fault, _FAULTS[fault](draw, scene, counters))


def counter_bits(counters: CounterWidths) -> range:
    """Where in a frame the numbers of objects are; bit 0 is the first."""
    start = 9 * BOOK.width
    return range(start, start + counters.lights + counters.spheres + counters.triangles)


def kind_bits(scene: Scene, counters: CounterWidths) -> list[int]:
    """Where in the frame of a scene the kinds of its objects are."""
    light, sphere, triangle = 114, 352, 461
    first = counter_bits(counters).stop + light * len(scene.lights)
    behind = first + sphere * len(scene.spheres)
    return [
        *(first + sphere * number for number in range(len(scene.spheres))),
        *(behind + triangle * number for number in range(len(scene.triangles))),
    ]


def flipped(words: Sequence[int], bits: Sequence[int]) -> tuple[int, ...]:
    """Words with some bits changed; bit 0 is the first of the frame."""
    changed = list(words)
    for bit in bits:
        changed[bit // 32 % len(words)] ^= 1 << (31 - bit % 32)
    return tuple(changed)


def light_at_the_point(fmts: Formats) -> Scene:
    """A sphere and its light, which is where the middle of the view meets it: ambient light alone is left."""
    one = fmts.coeff.one
    white = (one, one, one)
    sphere = Sphere(Material((one // 2, one // 4, one), white, white), (0, 0, 0), 8)
    surface = 8 << (fmts.coord.frac_bits - fmts.radius.frac_bits)
    camera = Camera((0, 0, 3 * surface), (0, surface, 0), (0, 0, 0))
    return Scene(camera, (Light((0, 0, surface), white),), (sphere,), (), white, (0, 0, 0))


def without_area() -> st.SearchStrategy[Triangle]:
    """Triangles that are a point or lie on a line."""
    step = st.integers(-4, 4)
    component = st.integers(-4 * BOOK.one, 4 * BOOK.one)
    plain = Material((COLOUR.one,) * 3, BLACK, BLACK)

    def build(place: tuple[int, ...], way: tuple[int, ...], times: tuple[int, ...]) -> Triangle:
        a, b, c = (_along(place, way, time) for time in times)
        return Triangle(plain, (a, b, c))

    return st.builds(
        build, st.tuples(*[component] * 3), st.tuples(*[st.integers(-999, 999)] * 3), st.tuples(*[step] * 3)
    )


def _along(place: tuple[int, ...], way: tuple[int, ...], times: int) -> Vec3:
    x, y, z = (p + times * w for p, w in zip(place, way, strict=True))
    return (x, y, z)
