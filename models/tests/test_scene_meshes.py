"""Meshes are closed and face outward; the outline of one says what the reference renderer shows of it."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from models.fixed import BOOK
from models.reference import render
from models.scene import meshes
from models.scene.frame import CounterWidths, pack, unpack
from models.scene.meshes import Mesh, PinHole
from models.scene.strategies import is_drawable, pin_holes
from models.scene.strategies.pin_holes import drawn_meshes
from models.scene.types import Camera, View

ONE = BOOK.one
CAMERA = Camera((0, 0, 6 * ONE), (0, ONE, 0), (0, 0, 0))
VIEWS = (View.book(8, 6), View.book(7, 5), View.book(9, 9))
SOLIDS: dict[str, tuple[Callable[[], Mesh], int, int]] = {
    "tetrahedron": (meshes.tetrahedron, 4, 4),
    "octahedron": (meshes.octahedron, 6, 8),
    "cube": (meshes.cube, 8, 12),
    "icosahedron": (meshes.icosahedron, 12, 20),
    "bipyramid of 3": (lambda: meshes.bipyramid(3), 5, 6),
    "bipyramid of 7": (lambda: meshes.bipyramid(7), 9, 14),
}


def volumes(mesh: Mesh) -> NDArray[np.int64]:
    """Above 0 where a face turns its back to the mean corner, which is inside a convex mesh."""
    corners = np.array(mesh.corners, dtype=np.int64)
    a, b, c = (
        corners[[face[n] for face in mesh.faces]] * len(corners) - corners.sum(axis=0) for n in range(3)
    )
    volume: NDArray[np.int64] = np.einsum("ij,ij->i", a, np.cross(b, c))
    return volume


def check_closed(mesh: Mesh) -> None:
    edges = [(face[n], face[(n + 1) % 3]) for face in mesh.faces for n in range(3)]
    assert len(set(edges)) == len(edges), "no two faces run along an edge in one direction"
    assert {(b, a) for a, b in edges} == set(edges), "each edge is run along in both"
    assert mesh.is_closed
    assert len(mesh.corners) - len(edges) // 2 + len(mesh.faces) == 2, "Euler"
    assert {corner for face in mesh.faces for corner in face} == set(range(len(mesh.corners)))


@pytest.mark.parametrize("name", SOLIDS)
def test_a_solid_has_its_corners_and_faces_and_is_closed(name: str) -> None:
    build, corners, faces = SOLIDS[name]
    mesh = build()
    assert (len(mesh.corners), len(mesh.faces)) == (corners, faces)
    check_closed(mesh)
    assert (volumes(mesh) > 0).all(), "all faces turn outward"


def test_a_mesh_with_a_face_missing_or_turned_is_not_closed() -> None:
    mesh = meshes.octahedron()
    assert not Mesh(mesh.corners, mesh.faces[1:]).is_closed
    a, b, c = mesh.faces[0]
    assert not Mesh(mesh.corners, ((a, c, b), *mesh.faces[1:])).is_closed


@settings(max_examples=100)
@given(st.lists(st.tuples(*[st.integers(-50, 50)] * 3), min_size=4, max_size=20, unique=True))
def test_a_hull_is_closed_and_has_all_points_behind_its_faces(points: list[tuple[int, int, int]]) -> None:
    try:
        mesh = meshes.hull(points)
    except ValueError as refused:
        assert "plane" in str(refused) or "area" in str(refused)
        return
    check_closed(mesh)
    for face in mesh.faces:
        a, b, c = (np.array(mesh.corners[corner]) for corner in face)
        heights = (np.array(points) - a) @ np.cross(b - a, c - a)
        assert heights.max() == 0


def test_points_in_a_plane_have_no_hull() -> None:
    with pytest.raises(ValueError, match="one plane"):
        meshes.hull([(0, 0, 0), (1, 0, 0), (0, 1, 0), (5, 7, 0)])


@pytest.mark.parametrize("most", [4, 6, 14, 40, 254])
def test_random_hulls_have_as_many_faces_as_asked_for_at_most(most: int) -> None:
    rng = np.random.default_rng(1)
    counts = set()
    for _ in range(20 if most < 100 else 3):
        mesh = meshes.random_hull(rng, most)
        check_closed(mesh)
        assert (volumes(mesh) > 0).all()
        counts.add(len(mesh.faces))
    assert max(counts) <= most
    assert most < 14 or len(counts) > 1


@settings(max_examples=50)
@given(drawn_meshes(14), st.tuples(*[st.integers(1, 8)] * 4), st.floats(0.25, 16))
def test_a_placed_mesh_is_closed_turned_and_on_the_grid(
    mesh: Mesh, quaternion: tuple[int, ...], scale: float
) -> None:
    turn = meshes.rotation(quaternion)
    np.testing.assert_allclose(turn @ turn.T, np.eye(3), atol=1e-12)
    assert np.linalg.det(turn) == pytest.approx(1)
    try:
        moved = meshes.placed(mesh, turn, scale, (5, -7, 9))
    except ValueError as refused:
        assert "area" in str(refused)
        return
    check_closed(moved)
    exact = scale * np.array(mesh.corners) @ turn.T + (5, -7, 9)
    assert np.abs(np.array(moved.corners) - exact).max() <= 0.5 + 1e-6


def test_a_mesh_that_leaves_the_grid_or_loses_a_face_is_refused() -> None:
    with pytest.raises(ValueError, match="range of coordinates"):
        meshes.placed(meshes.cube(), np.eye(3), 1.0, (BOOK.max, 0, 0))
    with pytest.raises(ValueError, match="no area"):
        meshes.placed(meshes.icosahedron(), np.eye(3), 0.0003, (0, 0, 0))


@pytest.mark.parametrize(
    ("camera", "problem"),
    [
        (Camera((0, 0, 1100), (0, ONE, 0), (0, 0, 0)), "near"),
        (Camera((0, 0, 6 * ONE), (0, 100, 1000), (0, 0, 0)), "up is too near"),
        (Camera((0, 0, 6 * ONE), (0, 0, 1000), (0, 0, 0)), "parallel"),
        (Camera((0, 0, 255 * ONE), (0, ONE, 0), (0, 0, 0)), "wall leaves"),
    ],
)
def test_a_camera_that_the_margin_does_not_cover_is_refused(camera: Camera, problem: str) -> None:
    with pytest.raises(ValueError, match=problem):
        meshes.before_wall(meshes.octahedron(), camera)


def check_against_reference(found: PinHole, view: View) -> tuple[int, int, int]:
    """How many pixels are inside, outside, undecided."""
    faces = len(found.mesh.faces)
    assert is_drawable(found.scene.camera)
    assert [triangle.vertices for triangle in found.scene.triangles[:faces]] == [
        tuple(found.mesh.corners[corner] for corner in face) for face in found.mesh.faces
    ]
    assert len(found.scene.triangles) == faces + 1
    outline = meshes.outline(found.mesh, found.scene.camera, view)
    got = render(found.scene, view)
    assert not (outline.inside & outline.outside).any()
    assert (got.hit >= 0).all(), "the wall fills what the mesh leaves"
    assert (got.hit[outline.inside] < faces).all()
    assert (got.hit[outline.outside] == faces).all()
    assert (got.rgb[outline.inside] == PinHole.MESH_COLOUR).all()
    assert (got.rgb[got.hit == faces] == PinHole.WALL_COLOUR).all()
    assert not found.seen_through(got.rgb, view).any()
    inside, outside = int(outline.inside.sum()), int(outline.outside.sum())
    return inside, outside, got.hit.size - inside - outside


def test_the_outline_is_what_the_reference_shows_from_many_cameras() -> None:
    rng = np.random.default_rng(7)
    counts = np.zeros(3)
    for number in range(300):
        found = meshes.pin_hole(rng)
        assert unpack(pack(found.scene)) == found.scene
        check_closed(found.mesh)
        counts += check_against_reference(found, VIEWS[number % len(VIEWS)])
    inside, outside, undecided = counts / counts.sum()
    assert inside > 0.3
    assert outside > 0.2
    assert undecided < 0.02


@settings(max_examples=40)
@given(pin_holes(), st.sampled_from(VIEWS))
def test_the_outline_is_what_the_reference_shows_of_drawn_scenes(found: PinHole, view: View) -> None:
    check_closed(found.mesh)
    check_against_reference(found, view)


def test_the_simplest_drawn_scene_shows_mesh_and_wall() -> None:
    found = meshes.before_wall(meshes.tetrahedron(), CAMERA)
    inside, outside, _ = check_against_reference(found, View.book(33, 33))
    assert inside > 50
    assert outside > 50


def test_scenes_of_the_wide_build_have_larger_meshes() -> None:
    rng = np.random.default_rng(3)
    wide = CounterWidths(4, 6, 8)
    found = [meshes.pin_hole(rng, wide.capacity.triangles) for _ in range(12)]
    assert max(len(pin_hole.mesh.faces) for pin_hole in found) > 30
    for pin_hole in found:
        check_against_reference(pin_hole, VIEWS[0])
        assert unpack(pack(pin_hole.scene, wide), wide) == pin_hole.scene


def test_a_camera_inside_a_mesh_sees_nothing_else() -> None:
    found = meshes.before_wall(meshes.icosahedron(2 * ONE), Camera((0, 0, 0), (0, ONE, 0), (100, 30, 512)))
    assert check_against_reference(found, View.book(31, 31)) == (31 * 31, 0, 0)


@pytest.mark.parametrize("face", range(8))
def test_a_missing_face_is_seen_through(face: int) -> None:
    """What it is for: where a face is missing the pixels show what is behind it, and are told."""
    mesh = meshes.octahedron(2 * ONE)
    ways = np.array(mesh.corners)[list(mesh.faces[face])].sum(axis=0)
    x, y, z = (int(component) for component in 2 * ways + (700, 300, 90))
    camera = Camera((x, y, z), (300, ONE, 200), (0, 0, 0))
    found = meshes.before_wall(mesh, camera)
    view = View.book(16, 12)
    assert not found.seen_through(render(found.scene, view).rgb, view).any()
    rest = (*found.scene.triangles[:face], *found.scene.triangles[face + 1 :])
    got = render(replace(found.scene, triangles=rest), view)
    gap = (render(found.scene, view).hit == face) & meshes.outline(mesh, camera, view).inside
    assert gap.sum() > 5
    np.testing.assert_array_equal(found.seen_through(got.rgb, view), gap)
    assert (got.rgb[gap] == PinHole.HIDDEN_COLOUR).all()


def test_edges_that_turn_their_sides_are_the_outline() -> None:
    """A cube seen along an axis: the four rays next to the outline of its near side, within and without."""
    mesh = meshes.cube()
    camera = Camera((0, 0, 3 * ONE), (0, ONE, 0), (0, 0, 0))
    # The near side is 2 units away and 1 unit high: the tangent of half the view that just shows it is 1/2.
    for tan, inside in ((0.4999, False), (0.499, True), (0.501, False)):
        outline = meshes.outline(mesh, camera, View(1, 1, 1.0, 1.0))
        assert outline.inside.all()
        # One column; the uppermost of 3 rows looks up by 2/3 of the tangent of half the view.
        tall = meshes.outline(mesh, camera, View(1, 3, 1.0, 1.5 * tan))
        assert bool(tall.inside[0, 0]) is inside
        assert bool(tall.outside[0, 0]) is (tan > 0.5)
