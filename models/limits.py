"""Constants of the core's contract that are not formats: distances, depth, weights, fault codes.

The Verilog gets them through the generated header `hdl/raytracer.vh`.
"""

from collections.abc import Mapping
from enum import IntEnum
from fractions import Fraction
from types import MappingProxyType

T_MIN = Fraction(1, 64)
"""Smallest distance at which a ray hits; keeps a ray from hitting its own origin."""

INFINITY = Fraction(256 * 1024 - 1, 1024)
"""Largest positive ``[9.10]``; a hit at or beyond it is a miss (book, chapter 9)."""

MAX_DEPTH = 5
"""Deepest ray of a tree; the primary ray is depth 1."""

UNITS = 2
"""Trace units of the default build: tests of a ray against an object in one clock."""

MIN_WEIGHT = Fraction(1, 256)
"""A secondary ray is cast where a channel of its weight reaches this."""

SHININESS = 16
"""Exponent of the highlight (book, 7.1.3)."""

INDEX_STEP = Fraction(1, 8)
"""Refractive index n = 1 + index * INDEX_STEP."""

BOOK_HALF_ANGLE_DEGREES = 30
"""The book's half field of view: tan_h = tan(30 degrees), tan_v = tan(30 degrees * h / w)."""


class Fault(IntEnum):
    """Why a frame is refused: the first fault of its bit string, then the picture's size, then the camera."""

    NONE = 0
    FRAME_SHORT = 1
    FRAME_LONG = 2
    CAPACITY = 3
    KIND = 4
    RADIUS = 5
    CAMERA_POSITION = 6
    CAMERA_UP = 7
    SIZE = 8


MEANING: Mapping[Fault, str] = MappingProxyType(
    {
        Fault.FRAME_SHORT: "the frame ends before its counts are satisfied",
        Fault.FRAME_LONG: "the frame goes on behind its last field",
        Fault.CAPACITY: "more lights, spheres or triangles than the core holds",
        Fault.KIND: "an object's kind bit is not that of its place",
        Fault.RADIUS: "a sphere of radius 0",
        Fault.CAMERA_POSITION: "the camera is at its center of interest",
        Fault.CAMERA_UP: "up is zero or parallel to the view",
        Fault.SIZE: "width or height is 0",
    }
)
"""What each fault says to people."""


class Record(IntEnum):
    """Kinds of records that the frame loader hands on."""

    CAMERA = 0
    LIGHT = 1
    SPHERE = 2
    TRIANGLE = 3
    TAIL = 4


RECORD_SLOTS = 26
"""Fields of the longest record, a triangle: kind, 15 colour components, index, 9 coordinates."""

SPHERE_SLOTS = 21
"""Fields of a sphere's record: kind, 15 colour components, index, center, radius."""
