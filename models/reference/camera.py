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
    y, x = np.meshgrid(rows, np.arange(view.width), indexing="ij")
    return directions(camera, view, x.ravel(), y.ravel())


def directions(camera: Camera, view: View, x: Floats | Ints, y: Floats | Ints) -> Floats:
    """Unit directions (3, n) through places of the picture (n,); a pixel's center is at whole numbers."""
    d, u, v = basis(camera)
    across = u * (view.tan_h * ((2 * x + 1) / view.width - 1))
    down = v * (view.tan_v * ((2 * y + 1) / view.height - 1))
    return normalise(d + across + down)
