"""No ray of the bit-exact model looks through a closed mesh of triangles that share their edges."""

from collections import Counter

import numpy as np
import pytest
from numpy.typing import NDArray

from models.core import registers, render
from models.fixed import BOOK, COLOUR
from models.formats import BUILDS, formats
from models.reference.camera import primary_directions
from models.scene import meshes
from models.scene.frame import CounterWidths
from models.scene.meshes import PinHole
from models.scene.types import View

_DEFAULT = formats(BUILDS["default"])
_VIEWS = tuple(View.square(9, 9, angle) for angle in (0.5, 3, 20, 60))
"""The middle pixel looks exactly at the corner, edge or face that the camera aims at; the narrow views have
all their pixels near it."""
_CAMERAS = 500
_RED = (COLOUR.one, 0, 0)
_WIDE = CounterWidths(4, 6, 8).capacity.triangles


_NO_NEARER = 2.0**-13
"""Distances closer than this may change places: a few steps of the format `point`."""


def _too_deep(found: PinHole, view: View, hit: NDArray[np.int16], leaks: NDArray[np.bool_]) -> int:
    """How many of the leaks show something that is further away than any front of the mesh.

    In a thin corner of the mesh front and back may be one step apart, or none; then the lower number is seen.
    """
    triangles = found.scene.triangles
    place = np.array(found.scene.camera.position)
    corners = (np.array([triangle.vertices for triangle in triangles]) - place) / BOOK.one
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    rays = primary_directions(found.scene.camera, view, np.arange(view.height))[:, leaks.ravel()]
    distances = (normals * corners[:, 0]).sum(axis=1)[:, None] / (normals @ rays)
    seen = hit[leaks]
    fronts = [number for number, face in enumerate(triangles[:-1]) if face.material.ambient == _RED]
    further = np.abs(distances[fronts] - distances[seen, np.arange(seen.size)]).min(axis=0)
    return int((further > _NO_NEARER).sum())


@pytest.mark.parametrize(
    ("seed", "cameras", "most_triangles"),
    [(1, _CAMERAS, 15), (2, _CAMERAS, 15), (3, _CAMERAS, 15), (4, _CAMERAS, 15), (5, 60, _WIDE)],
)
def test_nothing_is_seen_through_a_closed_mesh(seed: int, cameras: int, most_triangles: int) -> None:
    rng = np.random.default_rng(seed)
    seen: Counter[str] = Counter()
    for number in range(cameras):
        found = meshes.pin_hole(rng, most_triangles)
        view = _VIEWS[number % len(_VIEWS)]
        drawn = render(found.scene, registers(view, _DEFAULT), _DEFAULT)
        leaks = found.seen_through(drawn.rgb, view)
        wall = leaks & (drawn.rgb != PinHole.HIDDEN_COLOUR).any(axis=-1)
        assert not wall.any(), f"{wall.sum()} pixels of {view} look through the mesh of {found.scene}"
        deep = _too_deep(found, view, drawn.hit, leaks)
        assert not deep, f"{deep} pixels of {view} show a hidden face of {found.scene}"
        mesh = (drawn.hit >= 0) & (drawn.hit < len(found.mesh.faces))
        seen["mesh"] += int(mesh.sum())
        seen["wall"] += int((drawn.hit == len(found.mesh.faces)).sum())
        seen["several faces"] += len(np.unique(drawn.hit[mesh])) > 1
    # Pixels beside the mesh, and pictures of edges: without them nothing would be shown.
    assert min(seen["mesh"], seen["wall"]) > 2 * cameras
    assert seen["several faces"] > cameras / 2
