"""Constants of an object, once a frame: model of ``hdl/scene/object_setup.v``."""

from dataclasses import dataclass

import numpy as np

from models.arith import vec_mul
from models.fixed import Raw
from models.formats import Formats


@dataclass(frozen=True)
class ObjectConstants:
    """radius squared (n,) in `radius_sq`, 1 / radius (n,) in `inv_radius`, ambient term (3, n) in `shade`."""

    radius_sq: Raw
    inv_radius: Raw
    ambient: Raw


def object_setup(radius: Raw, ambient_light: Raw, k_ambient: Raw, fmts: Formats) -> ObjectConstants:
    """What tests and shading need of spheres with these radii (n,), not 0, and coefficients (3, n)."""
    one = 1 << (fmts.inv_radius.frac_bits + fmts.radius.frac_bits)
    ambient = vec_mul(ambient_light, k_ambient, fmts.coeff, fmts.coeff, fmts.shade)
    return ObjectConstants(np.asarray(radius * radius), np.asarray(one // radius), ambient)
