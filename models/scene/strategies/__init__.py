"""Hypothesis strategies of scenes, for the tests of the models and for the benches.

`parts` says what the frame can hold, `whole` what a picture can show, `pin_holes` what must not be seen
through.
"""

from models.scene.strategies.parts import (
    cameras,
    is_drawable,
    materials,
    raws,
    scenes,
    spheres,
    triangles,
    undrawable_cameras,
    vectors,
)
from models.scene.strategies.pin_holes import pin_holes
from models.scene.strategies.whole import classes, whole_scenes

__all__ = [
    "cameras",
    "classes",
    "is_drawable",
    "materials",
    "pin_holes",
    "raws",
    "scenes",
    "spheres",
    "triangles",
    "undrawable_cameras",
    "vectors",
    "whole_scenes",
]
