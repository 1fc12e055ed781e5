"""The screen's basis: model of ``hdl/scene/camera.v`` (book 8.2.1)."""

from dataclasses import dataclass

import numpy as np

from models.core.unit_vector import unit_vector
from models.fixed import Raw
from models.formats import Formats
from models.limits import MAX_DEPTH, Fault
from models.scene.types import Camera


class CameraFault(ValueError):
    """The frame's camera, or the picture's size, cannot be drawn."""

    def __init__(self, fault: Fault) -> None:
        super().__init__(fault.name)
        self.fault = fault


@dataclass(frozen=True)
class Registers:
    """What the core is told beside the frame: size in pixels, raw tangents in the format `tan`, depth of the
    deepest ray."""

    width: int
    height: int
    tan_h: int
    tan_v: int
    depth: int = MAX_DEPTH


@dataclass(frozen=True)
class Basis:
    """Where pixels are: all of shape (3, 1); base in `screen`, spans are magnitudes in `span`, signs +-1.

    d, u, v: the unit vectors that they were made of.
    """

    base: Raw
    column_span: Raw
    column_sign: Raw
    row_span: Raw
    row_sign: Raw
    d: Raw
    u: Raw
    v: Raw


def _column(vector: tuple[int, int, int]) -> Raw:
    return np.array(vector, dtype=np.int64).reshape(3, 1)


def _cross(a: Raw, b: Raw) -> Raw:
    """Exact cross product, no bit dropped."""
    return np.array([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


def camera(description: Camera, registers: Registers, fmts: Formats) -> Basis:
    """The basis of a frame.

    Raises CameraFault: SIZE where width or height is 0, CAMERA_POSITION where the camera is at its
    center of interest, CAMERA_UP where up is parallel to the view, both found exactly.
    """
    if not registers.width or not registers.height:
        raise CameraFault(Fault.SIZE)
    view = _column(description.center) - _column(description.position)
    if not view.any():
        raise CameraFault(Fault.CAMERA_POSITION)
    right = _cross(view, _column(description.up))
    if not right.any():
        raise CameraFault(Fault.CAMERA_UP)
    bits = max(2 * fmts.unit.width + 1, 2 * fmts.coord.width + 2)
    d = unit_vector(view, bits, fmts).unit
    u = unit_vector(right, bits, fmts).unit
    v = unit_vector(_cross(d, u), bits, fmts).unit
    column_span, column_sign = _span(u, registers.tan_h, fmts)
    row_span, row_sign = _span(v, registers.tan_v, fmts)
    base = (
        (d << (fmts.screen.frac_bits - fmts.unit.frac_bits)) - column_sign * column_span - row_sign * row_span
    )
    return Basis(base, column_span, column_sign, row_span, row_sign, d, u, v)


def _span(direction: Raw, tangent: int, fmts: Formats) -> tuple[Raw, Raw]:
    """Magnitude, floored, and sign of tangent * direction."""
    drop = fmts.tan.frac_bits + fmts.unit.frac_bits - fmts.screen.frac_bits
    product = direction * tangent
    return np.abs(product) >> drop, np.where(product < 0, -1, 1)
