"""Primary rays (book, 8.2.1)."""

import numpy as np

from models.reference.vectors import Floats, Ints, column, cross, normalise
from models.scene.frame import check_camera
from models.scene.types import Camera, View


def basis(camera: Camera) -> tuple[Floats, Floats, Floats]:
    """Unit columns d (forward), u (to the right), v (down the screen).

    Raises FrameError for a camera that the core refuses.
    """
    check_camera(camera)
    d = normalise(column(camera.center) - column(camera.position))
    u = normalise(cross(d, column(camera.up)))
    v = normalise(cross(d, u))
    return d, u, v


def primary_directions(camera: Camera, view: View, rows: Ints) -> Floats:
    """Unit directions (3, n) through the centers of the pixels of the rows numbered, row by row."""
    d, u, v = basis(camera)
    x = (2 * np.arange(view.width) + 1) / view.width - 1
    y = (2 * rows + 1) / view.height - 1
    across = u[:, :, None] * (view.tan_h * x)[None, None, :]
    down = v[:, :, None] * (view.tan_v * y)[None, :, None]
    return normalise((d[:, :, None] + across + down).reshape(3, -1))
