"""Whole scenes that show something, one small function for each kind of scene that is easily drawn wrong.

A kind draws the few objects that make it what it is, the camera that looks at them and the lights it needs
(`_Parts`); more lights, colours and sometimes more objects are added to all kinds alike. They shrink toward
few grey objects and a camera that looks down an axis. What the frame can hold at all is drawn too.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from random import Random

from hypothesis import strategies as st

from models.fixed import BOOK
from models.limits import INFINITY, T_MIN
from models.scene import meshes
from models.scene.frame import Capacity, CounterWidths
from models.scene.strategies import common
from models.scene.strategies.common import AXES, FULL, ONE, QUARTER, STEP, clamped, moved, plus
from models.scene.strategies.parts import scenes, vectors
from models.scene.strategies.pin_holes import drawn_meshes
from models.scene.types import Camera, Light, Scene, Sphere, Triangle, Vec3

_MORE = 2
"""At most so many objects and lights of each sort are added to those of a kind of scene."""
_ORIGIN: Vec3 = (0, 0, 0)


@dataclass(frozen=True)
class _Parts:
    """What makes a scene one of its kind."""

    camera: Camera
    spheres: tuple[Sphere, ...] = ()
    triangles: tuple[Triangle, ...] = ()
    lights: tuple[Light, ...] = ()


@dataclass(frozen=True)
class _Kind:
    """The smallest core that can hold a kind of scene, and how to draw one for a core of some capacity."""

    needs: Capacity
    parts: Callable[[st.DrawFn, Capacity], _Parts]


def whole_scenes(capacity: Capacity | None = None) -> st.SearchStrategy[Scene]:
    """Scenes of all kinds that a core of this capacity (default: the book's counters) can hold."""
    return st.one_of(*classes(capacity).values())


def classes(capacity: Capacity | None = None) -> Mapping[str, st.SearchStrategy[Scene]]:
    """The strategies of `whole_scenes` by the names of their kinds."""
    most = capacity or CounterWidths().capacity
    drawn = {
        name: _finished(kind, most)
        for name, kind in _KINDS.items()
        if kind.needs.lights <= most.lights
        and kind.needs.spheres <= most.spheres
        and kind.needs.triangles <= most.triangles
    }
    return {**drawn, "edge_of_range": _pushed(st.one_of(*drawn.values())), "anything": scenes(most)}


@st.composite
def _finished(draw: st.DrawFn, kind: _Kind, capacity: Capacity) -> Scene:
    """A scene of a kind, with more lights and objects where there is room for them."""
    parts = kind.parts(draw, capacity)
    target = parts.camera.center
    lights, spheres, triangles = list(parts.lights), list(parts.spheres), list(parts.triangles)
    for _ in range(draw(st.integers(0, min(_MORE, capacity.lights - len(lights))))):
        light = draw(common.lights(10))
        lights.append(replace(light, position=plus(target, light.position)))
    crowded = draw(st.integers(0, 3)) == 3
    for _ in range(draw(st.integers(0, min(_MORE, capacity.spheres - len(spheres)))) * crowded):
        place = common.around(draw, target, 5)
        spheres.append(Sphere(draw(common.materials()), place, draw(common.radii(1, 12))))
    for _ in range(draw(st.integers(0, min(_MORE, capacity.triangles - len(triangles)))) * crowded):
        a, b, c = (common.around(draw, target, 5) for _ in range(3))
        triangles.append(Triangle(draw(common.materials()), (a, b, c)))
    return Scene(
        camera=parts.camera,
        lights=tuple(lights),
        spheres=tuple(spheres),
        triangles=tuple(triangles),
        ambient=draw(common.colours()),
        background=draw(common.colours(0, FULL // 2)),
    )


@st.composite
def _pushed(draw: st.DrawFn, kinds: st.SearchStrategy[Scene]) -> Scene:
    """A scene moved as a whole to the ends of the range of coordinates."""
    scene = draw(kinds)
    camera = scene.camera
    places = [camera.position, camera.center, *(light.position for light in scene.lights)]
    places += [sphere.center for sphere in scene.spheres]
    places += [corner for triangle in scene.triangles for corner in triangle.vertices]
    x, y, z = (
        (BOOK.max - max(components), BOOK.min - min(components), 0)[draw(st.integers(0, 2))]
        for components in zip(*places, strict=True)
    )
    way = (x, y, z)
    return replace(
        scene,
        camera=replace(camera, position=plus(camera.position, way), center=plus(camera.center, way)),
        lights=tuple(replace(light, position=plus(light.position, way)) for light in scene.lights),
        spheres=tuple(replace(sphere, center=plus(sphere.center, way)) for sphere in scene.spheres),
        triangles=tuple(_moved_triangle(triangle, way) for triangle in scene.triangles),
    )


def _moved_triangle(triangle: Triangle, way: Vec3) -> Triangle:
    a, b, c = (plus(corner, way) for corner in triangle.vertices)
    return replace(triangle, vertices=(a, b, c))


def _before_wall(draw: st.DrawFn, parts: _Parts) -> _Parts:
    """With a wall to be seen behind what may be seen through."""
    return replace(parts, triangles=(*parts.triangles, common.wall(draw(common.materials()), parts.camera)))


def _sensible(draw: st.DrawFn, capacity: Capacity) -> _Parts:
    """Balls on a floor, light from above: a picture as people make them."""
    count = draw(st.integers(1, min(3, capacity.spheres)))
    spheres = []
    for number in range(count):
        radius = draw(common.radii(4, 12))
        shift = draw(st.integers(-4, 4)) * QUARTER
        center = ((2 * number - count + 1) * ONE, radius * STEP - ONE, shift)
        spheres.append(Sphere(draw(common.materials()), center, radius))
    floor: tuple[Triangle, ...] = ()
    if capacity.triangles >= 2:
        wide = 6 * ONE
        a, b, c, d = ((-wide, -ONE, wide), (wide, -ONE, wide), (wide, -ONE, -wide), (-wide, -ONE, -wide))
        material = draw(common.materials())
        floor = (Triangle(material, (a, b, c)), Triangle(material, (a, c, d)))
    lights = []
    for _ in range(draw(st.integers(0, min(3, capacity.lights)))):
        aside, above, ahead = draw(st.integers(-6, 6)), draw(st.integers(4, 9)), draw(st.integers(-6, 6))
        lights.append(Light((aside * ONE, above * ONE, ahead * ONE), draw(common.colours(FULL // 4))))
    aside, above, away = draw(st.integers(-12, 12)), draw(st.integers(2, 16)), draw(st.integers(16, 32))
    position = (aside * QUARTER, above * QUARTER, away * QUARTER)
    camera = common.looking(draw, position, spheres[0].center)
    return _Parts(camera, tuple(spheres), floor, tuple(lights))


def _camera_inside(draw: st.DrawFn, capacity: Capacity) -> _Parts:
    """The camera in a sphere, its center or next to its surface, sometimes with a ball in there."""
    outer = draw(common.spheres())
    spheres: tuple[Sphere, ...] = (outer,)
    if capacity.spheres > 1 and draw(st.booleans()):
        center = common.inside(draw, outer)
        spheres = (outer, Sphere(draw(common.materials()), center, draw(common.radii(1, 6))))
    position = common.inside(draw, outer)
    return _Parts(common.looking(draw, position, common.around(draw, outer.center, 2)), spheres)


def _touching(draw: st.DrawFn, capacity: Capacity) -> _Parts:
    """Two spheres that touch from outside or inside, exactly or but for a step, and a plane that does."""
    first, second = draw(common.spheres()), draw(common.spheres())
    number = draw(st.integers(0, len(AXES) - 1))
    axis = AXES[number]
    reach = draw(st.sampled_from((first.radius + second.radius, first.radius - second.radius)))
    slack = draw(st.sampled_from((0, 0, 1, -1)))
    second = replace(second, center=plus(first.center, axis, reach * STEP + slack))
    parts = _Parts(common.camera(draw, plus(first.center, axis, first.radius * STEP)), (first, second))
    if not capacity.triangles or not draw(st.booleans()):
        return parts
    place = plus(first.center, axis, -first.radius * STEP)
    plane = common.plate(draw(common.materials()), place, 2 - number % 3, 4 * ONE)
    return replace(parts, triangles=(plane,))


def _edge_on(draw: st.DrawFn, capacity: Capacity) -> _Parts:
    """A triangle in a plane through the camera, before a wall; a light in that plane too, sometimes."""
    position, ahead, aside = draw(common.places(3)), draw(common.ways()), draw(common.ways())

    def in_plane(i: int, j: int) -> Vec3:
        return plus(plus(position, ahead, i * QUARTER), aside, j * QUARTER)

    def drawn() -> Vec3:
        return in_plane(draw(st.integers(2, 16)), draw(st.integers(-8, 8)))

    triangle = Triangle(draw(common.materials()), (drawn(), drawn(), drawn()))
    camera = common.looking(draw, position, in_plane(8, 0))
    lights: tuple[Light, ...] = ()
    if capacity.lights and draw(st.booleans()):
        lights = (Light(drawn(), draw(common.colours(FULL // 4))),)
    return _before_wall(draw, _Parts(camera, (), (triangle,), lights))


def _same_spheres(draw: st.DrawFn, capacity: Capacity) -> _Parts:
    """One place and radius for two materials: the lower number is seen."""
    sphere = draw(common.spheres())
    again = replace(sphere, material=draw(common.materials()))
    return _Parts(common.camera(draw, sphere.center), (sphere, again))


def _same_triangles(draw: st.DrawFn, capacity: Capacity) -> _Parts:
    """One triangle for two materials, its corners in another order, perhaps of the other sense."""
    corners = (draw(common.places(4)), draw(common.places(4)), draw(common.places(4)))
    p, q, r = draw(st.permutations(range(3)))
    triangles = (
        Triangle(draw(common.materials()), corners),
        Triangle(draw(common.materials()), (corners[p], corners[q], corners[r])),
    )
    return _before_wall(draw, _Parts(common.camera(draw, common.middle(corners)), (), triangles))


def _through(draw: st.DrawFn, capacity: Capacity) -> _Parts:
    """A sphere with its center at a corner of a triangle, or in the middle of it."""
    sphere = draw(common.spheres())
    center, a, b = sphere.center, draw(common.places(4)), draw(common.places(4))
    times = draw(st.sampled_from((0, -1)))
    corners = (plus(plus(center, a, times), b, times), plus(center, a), plus(center, b))
    triangle = Triangle(draw(common.materials()), corners)
    return _Parts(common.camera(draw, center), (sphere,), (triangle,))


def _light_in_glass(draw: st.DrawFn, capacity: Capacity) -> _Parts:
    """The light of the scene shines out of a glass ball, onto a wall where there is one."""
    sphere = draw(common.spheres(common.glass))
    light = Light(common.inside(draw, sphere), draw(common.colours(FULL // 4)))
    parts = _Parts(common.camera(draw, sphere.center), (sphere,), (), (light,))
    return _before_wall(draw, parts) if capacity.triangles else parts


def _light_on_sphere(draw: st.DrawFn, capacity: Capacity) -> _Parts:
    """A light where an axis meets a sphere, or a step beside; the camera looks at it."""
    sphere = draw(common.spheres())
    axis = draw(st.sampled_from(AXES))
    slack = draw(st.sampled_from((0, 1, -1)))
    place = plus(sphere.center, axis, sphere.radius * STEP + slack)
    way = draw(common.ways()) if draw(st.integers(0, 2)) == 2 else axis
    position = moved(place, way, draw(st.integers(8, 32)) * QUARTER)
    light = Light(place, draw(common.colours(FULL // 4)))
    return _Parts(common.looking(draw, position, place), (sphere,), (), (light,))


def _light_on_triangle(draw: st.DrawFn, capacity: Capacity) -> _Parts:
    """A light at a corner, on an edge or in the face of a triangle, or a step beside."""
    corner = draw(common.places(3))
    a, b = draw(common.places(1)), draw(common.places(1))
    triangle = Triangle(draw(common.materials()), (corner, plus(corner, a, 6), plus(corner, b, 6)))
    # In sixths of the sides, which lie on the grid.
    along, across = draw(st.sampled_from(((0, 0), (3, 0), (0, 6), (3, 3), (2, 2), (1, 3))))
    place = plus(plus(corner, a, along), b, across)
    light = Light(plus(place, draw(st.sampled_from((_ORIGIN, *AXES)))), draw(common.colours(FULL // 4)))
    return _before_wall(draw, _Parts(common.camera(draw, place), (), (triangle,), (light,)))


def _near_and_far(draw: st.DrawFn, capacity: Capacity) -> _Parts:
    """A wall straight ahead, at about the smallest or the largest distance of a hit."""
    if draw(st.booleans()):
        distance = int(T_MIN * ONE) + draw(st.integers(0, 8) | st.integers(-4, 0))
    else:
        # Rays beside the middle have a longer way: part of the wall is beyond infinity.
        distance = int(INFINITY * ONE) - draw(st.integers(2 * ONE, 4 * ONE) | st.integers(-2, 2 * ONE))
    camera = common.looking(draw, (0, 0, -(distance // 2)), (0, 0, distance - distance // 2))
    return _Parts(camera, (), (common.wall(draw(common.materials()), camera, behind=0),))


def _huge_triangles(draw: st.DrawFn, capacity: Capacity) -> _Parts:
    """Triangles from one end of the range to the other, before a wall."""
    corner = vectors(BOOK)
    triangles = []
    for _ in range(draw(st.integers(1, min(4, capacity.triangles - 1)))):
        corners = (draw(corner), draw(corner), draw(corner))
        triangles.append(Triangle(draw(common.materials()), corners))
    target = common.middle(triangles[0].vertices)
    return _before_wall(draw, _Parts(common.camera(draw, target, 1, 60), (), tuple(triangles)))


def _facing_mirrors(draw: st.DrawFn, capacity: Capacity) -> _Parts:
    """Two parallel mirrors with the camera between them, and something to be seen again and again."""
    axis = draw(st.integers(0, 2))
    gap = draw(st.integers(8, 24)) * QUARTER
    ahead = AXES[2 - axis]
    glass = common.mirrors(FULL // 2)
    mirrors = tuple(common.plate(draw(glass), plus(_ORIGIN, ahead, side), axis) for side in (-gap, gap))
    position = plus(_ORIGIN, ahead, -(gap // 2))
    center = plus(plus(_ORIGIN, ahead, gap), AXES[2 - axis - 1], draw(st.integers(-8, 8)) * QUARTER)
    spheres: tuple[Sphere, ...] = ()
    if capacity.spheres:
        spheres = (
            Sphere(draw(common.materials()), common.middle((position, center)), draw(common.radii(1, 8))),
        )
    return _Parts(common.looking(draw, position, center), spheres, mirrors)


def _mirror_balls(draw: st.DrawFn, capacity: Capacity) -> _Parts:
    """Two mirroring spheres."""
    spheres = (draw(common.spheres(common.bright_mirrors)), draw(common.spheres(common.bright_mirrors)))
    return _Parts(common.camera(draw, spheres[0].center), spheres)


def _glass_in_glass(draw: st.DrawFn, capacity: Capacity) -> _Parts:
    """A glass ball inside a glass ball, sometimes a triangle inside both, sometimes the camera."""
    outer = Sphere(draw(common.glass()), draw(common.places(2)), draw(common.radii(12)))
    inner = Sphere(draw(common.glass()), outer.center, draw(common.radii(4, outer.radius)))
    room = (outer.radius - inner.radius) * STEP
    eighths = draw(st.integers(0, 8))
    inner = replace(inner, center=moved(outer.center, draw(common.ways()), room * eighths / 8))
    triangles: tuple[Triangle, ...] = ()
    if capacity.triangles and draw(st.booleans()):
        a, b, c = (common.inside(draw, inner) for _ in range(3))
        triangles = (Triangle(draw(common.materials()), (a, b, c)),)
    if draw(st.integers(0, 3)) == 3:
        camera = common.looking(draw, common.inside(draw, inner), outer.center)
    else:
        camera = common.camera(draw, outer.center)
    return _Parts(camera, (outer, inner), triangles)


def _glass_before_wall(draw: st.DrawFn, capacity: Capacity) -> _Parts:
    """Refraction with something to refract."""
    sphere = draw(common.spheres(common.glass))
    return _before_wall(draw, _Parts(common.camera(draw, sphere.center), (sphere,)))


def _shared_edges(draw: st.DrawFn, capacity: Capacity) -> _Parts:
    """A closed mesh whose faces share all edges, of one or of several materials."""
    mesh = draw(drawn_meshes(min(14, capacity.triangles)))
    turn = (draw(st.integers(1, 8)), *(draw(st.integers(-8, 8)) for _ in range(3)))
    scale = draw(st.integers(4, 12)) / 4
    try:
        mesh = meshes.placed(mesh, meshes.rotation(turn), scale, draw(common.places(2)))
    except ValueError:
        mesh = meshes.tetrahedron()
    palette = [draw(common.materials()) for _ in range(draw(st.integers(1, 3)))]
    triangles = tuple(
        replace(face, material=palette[number % len(palette)])
        for number, face in enumerate(mesh.triangles(palette[0]))
    )
    target = meshes.aim(mesh, draw(st.integers(0, 2)), draw(st.integers(0, len(triangles) - 1)))
    return _Parts(common.camera(draw, target, 2, 6), (), triangles)


def _fan(draw: st.DrawFn, capacity: Capacity) -> _Parts:
    """Triangles around one corner, each of which shares an edge with the next, before a wall."""
    count = draw(st.integers(2, min(6, capacity.triangles - 1)))
    hub = draw(common.places(2))
    rim = [common.around(draw, hub, 3) for _ in range(count + 1)]
    triangles = tuple(
        Triangle(draw(common.materials()), (hub, rim[number], rim[number + 1])) for number in range(count)
    )
    return _before_wall(draw, _Parts(common.camera(draw, hub), (), triangles))


def _degenerate(draw: st.DrawFn, capacity: Capacity) -> _Parts:
    """A triangle without area, or a step wide, before a wall that must show behind it."""
    a, way = draw(common.places(3)), draw(common.ways())
    b = plus(a, way, draw(st.integers(1, ONE)))
    c = draw(st.sampled_from((a, b, plus(a, way, -QUARTER), plus(b, AXES[0]), plus(a, AXES[1]))))
    corners = draw(st.sampled_from(((a, b, c), (c, a, b), (a, a, a), (a, c, b))))
    triangle = Triangle(draw(common.materials()), corners)
    return _before_wall(draw, _Parts(common.camera(draw, a), (), (triangle,)))


def _extreme(draw: st.DrawFn, capacity: Capacity) -> _Parts:
    """Coefficients and lights of nothing, a little, all, and much more than all."""
    sphere = draw(common.spheres(common.extremes))
    light = Light(common.around(draw, sphere.center, 8), draw(common.extreme_colours()))
    camera = common.camera(draw, sphere.center)
    triangles = (common.wall(draw(common.extremes()), camera),) if capacity.triangles else ()
    return _Parts(camera, (sphere,), triangles, (light,))


def _crowd(draw: st.DrawFn, capacity: Capacity) -> _Parts:
    """As many objects and lights as the core holds, or one less of each sort, around the origin.

    A seed places them: a draw for each of hundreds of corners would be too much for Hypothesis.
    """
    random = Random(draw(st.integers(0, 1 << 16)))
    palette = [draw(common.materials()) for _ in range(draw(st.integers(1, 4)))]
    missing = draw(st.integers(0, 1))

    def place(reach: int) -> Vec3:
        return clamped([random.randint(-reach * ONE, reach * ONE) for _ in range(3)])

    def triangle() -> Triangle:
        corner = place(5)
        return Triangle(random.choice(palette), (corner, plus(corner, place(2)), plus(corner, place(2))))

    spheres = tuple(
        Sphere(random.choice(palette), place(5), random.randint(2, 12))
        for _ in range(max(1, capacity.spheres - missing))
    )
    triangles = tuple(triangle() for _ in range(max(0, capacity.triangles - missing)))
    lights = tuple(
        Light(place(9), (random.randrange(FULL), random.randrange(FULL), random.randrange(FULL)))
        for _ in range(capacity.lights)
    )
    return _Parts(common.camera(draw, spheres[0].center), spheres, triangles, lights)


_KINDS: Mapping[str, _Kind] = {
    "sensible": _Kind(Capacity(0, 1, 0), _sensible),
    "camera_inside": _Kind(Capacity(0, 1, 0), _camera_inside),
    "touching": _Kind(Capacity(0, 2, 0), _touching),
    "edge_on": _Kind(Capacity(0, 0, 2), _edge_on),
    "same_spheres": _Kind(Capacity(0, 2, 0), _same_spheres),
    "same_triangles": _Kind(Capacity(0, 0, 3), _same_triangles),
    "through": _Kind(Capacity(0, 1, 1), _through),
    "light_in_glass": _Kind(Capacity(1, 1, 0), _light_in_glass),
    "light_on_sphere": _Kind(Capacity(1, 1, 0), _light_on_sphere),
    "light_on_triangle": _Kind(Capacity(1, 0, 2), _light_on_triangle),
    "near_and_far": _Kind(Capacity(0, 0, 1), _near_and_far),
    "huge_triangles": _Kind(Capacity(0, 0, 2), _huge_triangles),
    "facing_mirrors": _Kind(Capacity(0, 0, 2), _facing_mirrors),
    "mirror_balls": _Kind(Capacity(0, 2, 0), _mirror_balls),
    "glass_in_glass": _Kind(Capacity(0, 2, 0), _glass_in_glass),
    "glass_before_wall": _Kind(Capacity(0, 1, 1), _glass_before_wall),
    "shared_edges": _Kind(Capacity(0, 0, 4), _shared_edges),
    "fan": _Kind(Capacity(0, 0, 3), _fan),
    "degenerate": _Kind(Capacity(0, 0, 2), _degenerate),
    "extreme": _Kind(Capacity(1, 1, 0), _extreme),
    "crowd": _Kind(Capacity(0, 1, 0), _crowd),
}
