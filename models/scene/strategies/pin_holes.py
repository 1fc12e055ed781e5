"""Closed meshes before a wall, to be seen through by a gap; see `models.scene.meshes`."""

from hypothesis import assume
from hypothesis import strategies as st

from models.fixed import BOOK
from models.scene import meshes
from models.scene.meshes import Mesh, PinHole
from models.scene.types import Camera, Vec3

_EIGHTH = BOOK.one // 8


def drawn_meshes(most_faces: int) -> st.SearchStrategy[Mesh]:
    """Regular ones, and hulls of drawn points of the grid."""
    steps = st.integers(-8, 8)
    points = st.lists(st.tuples(steps, steps, steps), min_size=4, max_size=most_faces // 2 + 2, unique=True)
    return st.sampled_from(meshes.solids(most_faces)) | points.map(_hull_or_simplest)


@st.composite
def pin_holes(draw: st.DrawFn, most_triangles: int = 15) -> PinHole:
    """Shrinks toward an upright tetrahedron at the origin, and a camera before it that looks at a corner."""
    mesh = draw(drawn_meshes(most_triangles - 1))
    turn = (draw(st.integers(1, 8)), *(draw(st.integers(-8, 8)) for _ in range(3)))
    scale = draw(st.sampled_from((1.0, 2.0, 0.5, 4.0, 0.25)) | st.integers(256, 4096).map(lambda n: n / 1024))
    place = st.just(0) | st.integers(-64 * BOOK.one, 64 * BOOK.one)
    center = (draw(place), draw(place), draw(place))
    way = (draw(st.integers(-8, 8)), draw(st.integers(-8, 8)), draw(st.integers(1, 8)))
    distance = draw(st.integers(16, 64) | st.integers(0, 4)) * scale / 8
    side = draw(st.sampled_from((1, -1)))
    position = _moved(center, way, side * distance)
    up = draw(st.sampled_from(((0, BOOK.one, 0), (BOOK.one, 0, 0), (700, 700, 300), (0, -BOOK.one, 200))))
    kind, face = draw(st.integers(0, 2)), draw(st.integers(0, len(mesh.faces) - 1))
    try:
        mesh = meshes.placed(mesh, meshes.rotation(turn), scale, center)
        return meshes.before_wall(mesh, Camera(position, up, meshes.aim(mesh, kind, face)))
    except ValueError:
        assume(False)
        raise


def _hull_or_simplest(points: list[Vec3]) -> Mesh:
    try:
        return meshes.hull([tuple(_EIGHTH * component for component in point) for point in points])
    except ValueError:
        return meshes.tetrahedron()


def _moved(start: Vec3, way: Vec3, distance: float) -> Vec3:
    length = sum(component * component for component in way) ** 0.5
    x, y, z = (
        round(s + BOOK.one * distance * component / length) for s, component in zip(start, way, strict=True)
    )
    return (x, y, z)
