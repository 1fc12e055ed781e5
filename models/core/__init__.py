"""Bit-exact model of the core: a function a block, named as the Verilog module, and the whole frame.

Every function works on many rays at once; vectors have shape (3, n), scalars (n,), all raw ``int64``.
Frame constants are vectors of shape (3, 1). `render.render` draws a picture.
"""

from models.core.camera import Basis, CameraFault, Registers, camera
from models.core.light import light_vector
from models.core.objects import Objects
from models.core.phong import highlight, phong
from models.core.pixel import rgb888
from models.core.rays import ray_generator
from models.core.refract import refract
from models.core.render import Counts, Event, Rendering, registers, render, trace_pixel
from models.core.setup import ObjectConstants, object_setup
from models.core.sphere import SphereHit, sphere_intersect
from models.core.surface import reflect, surface
from models.core.triangle import TriangleHit, triangle_intersect
from models.core.unit_vector import unit_vector

__all__ = [
    "Basis",
    "CameraFault",
    "Counts",
    "Event",
    "ObjectConstants",
    "Objects",
    "Registers",
    "Rendering",
    "SphereHit",
    "TriangleHit",
    "camera",
    "highlight",
    "light_vector",
    "object_setup",
    "phong",
    "ray_generator",
    "reflect",
    "refract",
    "registers",
    "render",
    "rgb888",
    "sphere_intersect",
    "surface",
    "trace_pixel",
    "triangle_intersect",
    "unit_vector",
]
