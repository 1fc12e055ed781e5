"""A camera that moves once around what it looks at, a scene a frame."""

import math
from dataclasses import replace

import numpy as np

from models.fixed import BOOK
from models.scene.types import Scene, Vec3


def orbit(scene: Scene, number: int) -> list[Scene]:
    """The scene from so many places on a circle around its center of interest; the first is its own.

    The axis is the camera's up. Raises ValueError where a place is outside of the coordinates.
    """
    return [_turned(scene, math.tau * step / number) for step in range(number)]


def _turned(scene: Scene, angle: float) -> Scene:
    """Rodrigues' rotation of the camera's position, rounded to raw coordinates."""
    camera = scene.camera
    axis = np.array(camera.up, dtype=float) / np.linalg.norm(camera.up)
    arm = np.array(camera.position, dtype=float) - camera.center
    turned = (
        arm * math.cos(angle)
        + np.cross(axis, arm) * math.sin(angle)
        + axis * axis.dot(arm) * (1 - math.cos(angle))
    )
    x, y, z = (round(value) for value in turned + camera.center)
    position: Vec3 = (x, y, z)
    if not all(BOOK.min <= value <= BOOK.max for value in position):
        raise ValueError("the camera's way around the scene leaves the coordinates")
    return replace(scene, camera=replace(camera, position=position))
