"""Closed meshes of triangles on the core's grid, and scenes that show a pin-hole where there is one.

A pin-hole scene is a closed mesh before a wall of another colour. Faces that the camera can only see through
others have a colour of their own, so that a gap shows even where a face behind it hides the wall. Ambient
light alone colours them all: each pixel has one of these colours exactly. `outline` says which pixels must
show the mesh; a pixel of them in any other colour looked through a gap between two faces.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from models.fixed import BOOK, COLOUR
from models.reference.camera import basis, primary_directions
from models.reference.vectors import Bools, Floats, column, dot
from models.scene.frame import check_camera
from models.scene.types import BLACK, Camera, Material, Scene, Triangle, Vec3, View

Face = tuple[int, int, int]
Points = NDArray[np.int64]

MARGIN = 2.0**-11
"""Smallest angle, in radians, between a ray and the outline of a mesh at which `outline` decides.

It covers what the default build rounds: unit directions, the camera's axes, and the corners' places as seen
from a camera that keeps `NEAREST` and `UPRIGHT`.
"""

NEAREST = 0.125
"""Least distance of a drawn camera from the mesh: well above T_MIN."""

UPRIGHT = 0.25
"""Least sine of the angle between a drawn camera's view and its up; below, rounding turns the picture."""

_INSIDE = 1 / 6
"""Share of the drawn cameras that stand inside the mesh."""
_SAME = 1e-9
"""Rounding of the test of a ray against a triangle; far below any margin."""
_WALL_BEHIND = 1.0
"""Least distance from the mesh to the wall, along the view."""
_WALL_REACH = 2.5
"""Radius of the wall's corners in units of its distance; half of it is seen in every direction, which is more
than the diagonal of a view of 60 by 60 degrees."""


@dataclass(frozen=True)
class Mesh:
    """Corners, raw, and faces as numbers of corners, counter-clockwise as seen from outside."""

    corners: tuple[Vec3, ...]
    faces: tuple[Face, ...]

    def triangles(self, material: Material) -> tuple[Triangle, ...]:
        """The faces as objects of a scene."""
        return tuple(
            Triangle(material, (self.corners[a], self.corners[b], self.corners[c])) for a, b, c in self.faces
        )

    def edges(self) -> Iterator[tuple[int, int]]:
        """Each side of each face, in the face's direction; in a closed mesh each comes once either way."""
        for a, b, c in self.faces:
            yield from ((a, b), (b, c), (c, a))

    @property
    def is_closed(self) -> bool:
        """Whether each edge belongs to two faces that run along it in opposite directions."""
        edges = list(self.edges())
        known = set(edges)
        return len(known) == len(edges) and all((b, a) in known for a, b in edges)


def hull(points: ArrayLike) -> Mesh:
    """The convex hull of integer points, exact; points inside it are not corners of any face.

    One point after another is joined to the rim of the faces that it sees. ValueError where all points lie
    in a plane, and where a face would have no area.
    """
    places = [(int(x), int(y), int(z)) for x, y, z in np.asarray(points)]
    start = _first_four(places)
    a, b, c, d = start
    faces = [(a, b, c), (a, c, d), (a, d, b), (b, d, c)]
    if _volume(places, (a, b, c), d) > 0:
        faces = [(p, r, q) for p, q, r in faces]
    for number in range(len(places)):
        if number not in start:
            faces = _joined(places, faces, number)
    _check_areas(places, faces)
    used = sorted({corner for face in faces for corner in face})
    new = {old: position for position, old in enumerate(used)}
    return Mesh(tuple(places[old] for old in used), tuple((new[p], new[q], new[r]) for p, q, r in faces))


def bipyramid(sides: int, size: int = BOOK.one) -> Mesh:
    """A gem of 2 * sides faces around an axis; `size` is its radius and half its height."""
    angle = 2 * np.pi * np.arange(sides) / sides
    ring = np.stack([np.cos(angle), np.sin(angle), np.zeros(sides)], axis=1)
    return hull(_rounded(size * np.concatenate([ring, [[0, 0, 1], [0, 0, -1]]])))


def tetrahedron(size: int = BOOK.one) -> Mesh:
    """4 faces."""
    return hull(size * np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]]))


def octahedron(size: int = BOOK.one) -> Mesh:
    """8 faces."""
    return hull(size * np.concatenate([np.eye(3, dtype=np.int64), -np.eye(3, dtype=np.int64)]))


def cube(size: int = BOOK.one) -> Mesh:
    """12 faces, two a side, of the same plane."""
    return hull(size * (2 * np.indices((2, 2, 2)).reshape(3, -1).T - 1))


def icosahedron(size: int = BOOK.one) -> Mesh:
    """20 faces; too many for the default build."""
    golden = (1 + 5**0.5) / 2
    corners = [np.roll((0, y, z * golden), turn) for turn in range(3) for y in (-1, 1) for z in (-1, 1)]
    return hull(_rounded(size * np.array(corners)))


def random_hull(rng: np.random.Generator, most_faces: int, size: int = BOOK.one) -> Mesh:
    """The hull of points around a sphere, of up to `most_faces` faces, an even number of at least 4."""
    count = int(rng.integers(4, most_faces // 2 + 2, endpoint=True))
    directions = rng.normal(size=(count, 3))
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    try:
        return hull(_rounded(size * rng.uniform(0.6, 1.0, (count, 1)) * directions))
    except ValueError:
        return tetrahedron(size)


def solids(most_faces: int) -> tuple[Mesh, ...]:
    """The regular ones that have no more faces, the simplest first."""
    known = (tetrahedron(), octahedron(), bipyramid(3), bipyramid(5), cube(), bipyramid(7), icosahedron())
    return tuple(mesh for mesh in known if len(mesh.faces) <= most_faces)


def rotation(quaternion: ArrayLike) -> Floats:
    """The matrix (3, 3) of a quaternion w, x, y, z of any length but 0."""
    numbers = np.asarray(quaternion, dtype=np.float64)
    w, x, y, z = numbers / np.linalg.norm(numbers)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def placed(mesh: Mesh, turn: Floats, scale: float, center: Vec3) -> Mesh:
    """A mesh turned, scaled and moved; its corners are rounded to the grid, so faces still share them.

    ValueError where a corner leaves the range of coordinates, or the rounding leaves a face without area: no
    ray hits that one, and its neighbours meet along corners that only one of them has.
    """
    corners = _rounded(scale * np.array(mesh.corners) @ turn.T) + np.array(center)
    if corners.min() < BOOK.min or corners.max() > BOOK.max:
        raise ValueError(f"a mesh of scale {scale:g} at {center} leaves the range of coordinates")
    moved = Mesh(tuple(_vec3(corner) for corner in corners), mesh.faces)
    _check_areas(moved.corners, moved.faces)
    return moved


@dataclass(frozen=True)
class PinHole:
    """A mesh before a wall: triangles of `scene` are the mesh's faces, in their order, then the wall.

    The colours are those of its pixels.
    """

    scene: Scene
    mesh: Mesh

    MESH_COLOUR = (255, 0, 0)
    HIDDEN_COLOUR = (0, 0, 255)
    WALL_COLOUR = (0, 255, 0)

    def seen_through(self, rgb: NDArray[np.uint8], view: View, margin: float = MARGIN) -> Bools:
        """(h, w): the pixels that must show the mesh and do not. There must be none."""
        inside = outline(self.mesh, self.scene.camera, view, margin).inside
        leaks: Bools = inside & (rgb != np.array(self.MESH_COLOUR)).any(axis=2)
        return leaks


def before_wall(mesh: Mesh, camera: Camera) -> PinHole:
    """The pin-hole scene of a mesh and a camera that looks roughly at it.

    The wall is one triangle across the view, behind all of the mesh and wider than the view. ValueError
    where there is no room for it, or for a camera that `MARGIN` does not speak of.
    """
    _check_camera(mesh, camera)
    d, u, v = basis(camera)
    place = column(camera.position)
    depths = dot(d, np.array(mesh.corners).T / BOOK.one - place)
    depth = max(0.0, float(depths.max())) + _WALL_BEHIND
    reach = _WALL_REACH * depth
    angles = (90.0, 210.0, 330.0)
    corners = [
        place + depth * d + reach * (np.cos(np.radians(a)) * u - np.sin(np.radians(a)) * v) for a in angles
    ]
    raw = _rounded(BOOK.one * np.concatenate(corners, axis=1).T)
    if raw.min() < BOOK.min or raw.max() > BOOK.max:
        raise ValueError("the wall leaves the range of coordinates")
    one = COLOUR.one
    seen, hidden, behind = (
        Material(colour, BLACK, BLACK) for colour in ((one, 0, 0), (0, 0, one), (0, one, 0))
    )
    # From outside the fronts of faces are seen, from inside the backs; a face seen edge-on is not seen.
    unseen = 1 if _is_inside(mesh, camera.position) else -1
    faces = tuple(
        replace(triangle, material=hidden if side == unseen else seen)
        for triangle, side in zip(mesh.triangles(seen), _sides(mesh, camera.position), strict=True)
    )
    wall = Triangle(behind, (_vec3(raw[0]), _vec3(raw[1]), _vec3(raw[2])))
    scene = Scene(camera, (), (), (*faces, wall), ambient=(one, one, one), background=BLACK)
    return PinHole(scene, mesh)


def pin_hole(rng: np.random.Generator, most_triangles: int = 15) -> PinHole:
    """A drawn mesh at a drawn place, turned and scaled, before a camera around it or inside of it.

    The camera looks exactly at a corner, an edge or a face. A scene has at most `most_triangles`, the wall's
    included.
    """
    while True:
        try:
            return _draw(rng, most_triangles - 1)
        except ValueError:
            continue


def _draw(rng: np.random.Generator, most_faces: int) -> PinHole:
    """One attempt of `pin_hole`; ValueError where it is none."""
    known = solids(most_faces)
    choice = int(rng.integers(2 * len(known)))
    mesh = known[choice] if choice < len(known) else random_hull(rng, most_faces)
    scale = float(2 ** rng.uniform(-2, 2))
    center = _vec3(rng.integers(-64 * BOOK.one, 64 * BOOK.one, 3))
    mesh = placed(mesh, rotation(rng.normal(size=4)), scale, center)
    away = rng.normal(size=3)
    distance = 0.0 if rng.random() < _INSIDE else scale * float(2 ** rng.uniform(0, 2))
    position = np.array(center) + BOOK.one * distance * away / np.linalg.norm(away)
    up = _vec3(_rounded(BOOK.one * rng.normal(size=3)))
    target = aim(mesh, int(rng.integers(3)), int(rng.integers(len(mesh.faces))))
    return before_wall(mesh, Camera(_vec3(_rounded(position)), up, target))


def aim(mesh: Mesh, kind: int, face: int) -> Vec3:
    """Where a camera may look: a corner (kind 0), a point of an edge (1), or of a face (2)."""
    corners = np.array([mesh.corners[number] for number in mesh.faces[face % len(mesh.faces)]])
    return _vec3(_rounded(corners[: kind + 1].mean(axis=0)))


def _check_camera(mesh: Mesh, camera: Camera) -> None:
    """ValueError for a camera without a picture, too near to a face, or whose up is almost along its view."""
    check_camera(camera)
    place = np.array(camera.position)
    ahead, up = (np.array(way) / BOOK.one for way in (np.array(camera.center) - place, np.array(camera.up)))
    sine = np.linalg.norm(np.cross(ahead, up)) / (np.linalg.norm(ahead) * np.linalg.norm(up))
    if sine < UPRIGHT:
        raise ValueError(f"up is too near to the direction of view: the sine of their angle is {sine:.3g}")
    corners = (np.array(mesh.corners) - place) / BOOK.one
    distance = min(_least_distance(corners[list(face)]) for face in mesh.faces)
    if distance < NEAREST:
        raise ValueError(f"the camera may be as near as {distance:.3g} to the mesh")


@dataclass(frozen=True)
class Outline:
    """Pixels (h, w) whose rays certainly meet the mesh, and those whose rays certainly miss it.

    The rest pass the outline by less than the margin.
    """

    inside: Bools
    outside: Bools


def outline(mesh: Mesh, camera: Camera, view: View, margin: float = MARGIN) -> Outline:
    """What the silhouette of a closed mesh says of each pixel's center.

    Whether a ray meets a closed mesh only changes where the ray crosses an edge between a face seen from the
    front and one seen from the back, which integers decide exactly. So a ray further than the margin from all
    such edges is decided by a test of all faces whose rounding is far below the margin, also where it runs
    along an edge between two faces of one side: widening these by the rounding closes no gap that exists.
    """
    rays = primary_directions(camera, view, np.arange(view.height))
    ways = np.array(mesh.corners) - np.array(camera.position)
    sides = _sides(mesh, camera.position)
    near = np.zeros(rays.shape[1], dtype=np.bool_)
    for a, b in _contour(mesh, sides):
        near |= _angle_to_arc(rays, ways[a], ways[b]) <= margin
    meets = np.zeros_like(near)
    for side, (a, b, c) in zip(sides, mesh.faces, strict=True):
        if side:
            poles = np.stack([_pole(ways[p], ways[q]) for p, q in ((a, b), (b, c), (c, a))])
            meets |= (side * (poles @ rays) <= _SAME).all(axis=0)
    shape = (view.height, view.width)
    return Outline((meets & ~near).reshape(shape), (~meets & ~near).reshape(shape))


def _sides(mesh: Mesh, place: Vec3) -> list[int]:
    """Which side of each face a place sees: 1 the front, -1 the back, 0 neither; exact."""
    volumes = [_volume((*mesh.corners, place), face, -1) for face in mesh.faces]
    return [(volume > 0) - (volume < 0) for volume in volumes]


def _is_inside(mesh: Mesh, place: Vec3) -> bool:
    """Whether the faces fill all directions from a place; from outside, fronts and backs fill the same.

    The solid angle of a triangle: van Oosterom and Strackee, 1983.
    """
    ways = (np.array(mesh.corners) - np.array(place)) / BOOK.one
    a, b, c = (ways[[face[number] for face in mesh.faces]] for number in range(3))
    p, q, r = (np.linalg.norm(way, axis=1) for way in (a, b, c))
    triple = np.einsum("ij,ij->i", a, np.cross(b, c))
    ab, bc, ca = (np.einsum("ij,ij->i", x, y) for x, y in ((a, b), (b, c), (c, a)))
    angles = 2 * np.arctan2(triple, p * q * r + ab * r + bc * p + ca * q)
    return bool(abs(angles.sum()) > 2 * np.pi)


def _contour(mesh: Mesh, sides: Sequence[int]) -> list[tuple[int, int]]:
    """Edges between faces of which different sides are seen; all edges of a face seen edge-on."""
    side_of = dict(zip(mesh.edges(), (side for side in sides for _ in range(3)), strict=True))
    return [(a, b) for (a, b), side in side_of.items() if a < b and (side == 0 or side_of[(b, a)] != side)]


def _angle_to_arc(rays: Floats, a: Points, b: Points) -> Floats:
    """(n,): lower bound of the angles between unit rays (3, n) and all directions from one way to another."""
    pole = _pole(a, b)
    between = (np.cross(pole, a) @ rays >= 0) & (np.cross(b, pole) @ rays >= 0) & pole.any()
    ends = [np.linalg.norm(rays - (way / np.linalg.norm(way))[:, None], axis=0) for way in (a, b)]
    # A sine is smaller than its angle, a chord too.
    return np.where(between, np.abs(pole @ rays), np.minimum(*ends))


def _pole(a: Points, b: Points) -> Floats:
    """Unit vector across two ways from the camera, from an exact product; zero where they are one way."""
    across = np.cross(a, b)
    return across / max(1.0, float(np.linalg.norm(across)))


def _least_distance(corners: Floats) -> float:
    """From the origin to a triangle, at least: to its plane, or to the sphere around it, the larger."""
    middle = corners.mean(axis=0)
    radius = np.linalg.norm(corners - middle, axis=1).max()
    normal = np.cross(corners[1] - corners[0], corners[2] - corners[0])
    plane = abs(float(np.dot(normal, middle))) / float(np.linalg.norm(normal))
    return max(plane, float(np.linalg.norm(middle) - radius))


def _check_areas(corners: Sequence[Vec3], faces: Sequence[Face]) -> None:
    places = np.array(corners)
    for a, b, c in faces:
        if not np.cross(places[b] - places[a], places[c] - places[a]).any():
            raise ValueError(f"the face at {corners[a]} has no area")


def _first_four(places: list[Vec3]) -> tuple[int, int, int, int]:
    """Four points that span a volume."""
    for b in range(1, len(places)):
        for c in range(b + 1, len(places)):
            for d in range(c + 1, len(places)):
                if _volume(places, (0, b, c), d):
                    return (0, b, c, d)
    raise ValueError("all points lie in one plane")


def _joined(places: list[Vec3], faces: list[Face], number: int) -> list[Face]:
    """The hull with one more point; faces of whose plane it is part do not see it."""
    visible = {face for face in faces if _volume(places, face, number) > 0}
    rim = {edge for a, b, c in visible for edge in ((a, b), (b, c), (c, a))}
    kept = [face for face in faces if face not in visible]
    return kept + [(a, b, number) for a, b in sorted(rim) if (b, a) not in rim]


def _volume(places: Sequence[Vec3], face: Face, number: int) -> int:
    """Six times the signed volume of a face and a point: above 0 where the point is in front of the face."""
    (px, py, pz), (qx, qy, qz), (rx, ry, rz) = (places[corner] for corner in face)
    ux, uy, uz = qx - px, qy - py, qz - pz
    vx, vy, vz = rx - px, ry - py, rz - pz
    wx, wy, wz = (s - p for s, p in zip(places[number], (px, py, pz), strict=True))
    return wx * (uy * vz - uz * vy) + wy * (uz * vx - ux * vz) + wz * (ux * vy - uy * vx)


def _rounded(values: ArrayLike) -> Points:
    return np.floor(np.asarray(values, dtype=np.float64) + 0.5).astype(np.int64)


def _vec3(values: ArrayLike) -> Vec3:
    x, y, z = (int(value) for value in np.asarray(values))
    return (x, y, z)
