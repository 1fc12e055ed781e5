"""Tests of mirrored direction and cosine: the standard ones, and geometry in float64 with derived bounds.

With p the length of the quantised normal, N^ = N/p and u a step: N.V is floored once and each
component of (N.V) N once, so R is off V - 2 (N^.V) N^ by at most
2 |p^2 - 1| |N^.V| + 2 p u + 2 sqrt 3 u.
"""

from dataclasses import dataclass

import numpy as np

from models.header import selected
from verif.env import vectors
from verif.env.definitions import Holds, is_floor
from verif.env.fields import Operands
from verif.env.pipelined_tests import standard_tests
from verif.env.unit import Parameters
from verif.env.vectors import SLACK, Floats
from verif.units.reflect.unit import UNIT

_NEARLY = 4.0
"""Steps that the length of a truncated unit vector may be off: sqrt 3, and some."""


@dataclass(frozen=True)
class _Mirror:
    """V, N, R in numbers; which V and N are unit vectors; N^; how far R may be off."""

    v: Floats
    n: Floats
    r: Floats
    apt: Holds
    normal: Floats
    bound: Floats

    @classmethod
    def of(cls, p: Parameters, given: Operands, got: Operands) -> "_Mirror":
        """Numbers of operands and results."""
        unit = selected(p).unit
        names = ((given, "direction"), (given, "normal"), (got, "mirrored"))
        v, n, r = (unit.to_float(values[name]) for values, name in names)
        lengths, step, normal = (vectors.length(v), vectors.length(n)), 1.0 / unit.one, vectors.unit(n)
        apt = np.logical_and(*(np.abs(length - 1.0) < _NEARLY * step for length in lengths))
        floors = 2.0 * (lengths[1] + np.sqrt(3.0)) * step
        bound = 2.0 * np.abs(lengths[1] ** 2 - 1.0) * np.abs(vectors.dot(normal, v)) + floors + SLACK
        return cls(v, n, r, apt, normal, bound)


def result_is_the_mirror_image_at_the_surface(p: Parameters, given: Operands, got: Operands) -> Holds:
    """V - 2 (N^.V) N^ in float64."""
    at = _Mirror.of(p, given, got)
    exact = at.v - 2.0 * vectors.dot(at.normal, at.v) * at.normal
    return vectors.where(at.apt, vectors.length(at.r - exact) <= at.bound)


def length_of_the_result_is_that_of_the_direction(p: Parameters, given: Operands, got: Operands) -> Holds:
    """A mirror keeps lengths."""
    at = _Mirror.of(p, given, got)
    off = np.abs(vectors.length(at.r) - vectors.length(at.v))
    return vectors.where(at.apt, off <= at.bound)


def angle_of_reflection_is_the_angle_of_incidence(p: Parameters, given: Operands, got: Operands) -> Holds:
    """N.R = -N.V."""
    at = _Mirror.of(p, given, got)
    off = np.abs(vectors.dot(at.n, at.r) + vectors.dot(at.n, at.v))
    return vectors.where(at.apt, off <= vectors.length(at.n) * at.bound)


def result_stays_in_the_plane_of_direction_and_normal(p: Parameters, given: Operands, got: Operands) -> Holds:
    """R - V is along N."""
    at = _Mirror.of(p, given, got)
    off = vectors.length(np.cross(at.r - at.v, at.normal, axis=0))
    return vectors.where(at.apt, off <= at.bound)


def cosine_is_that_of_direction_and_normal(p: Parameters, given: Operands, got: Operands) -> Holds:
    """N.V floored, of any vectors; held in range."""
    exact = (given["normal"] * given["direction"]).sum(axis=0)
    cosine = UNIT.outputs(p)[1]
    return is_floor(exact, selected(p).unit.frac_bits, cosine, got["cosine"])


globals().update(
    standard_tests(
        UNIT,
        result_is_the_mirror_image_at_the_surface,
        length_of_the_result_is_that_of_the_direction,
        angle_of_reflection_is_the_angle_of_incidence,
        result_stays_in_the_plane_of_direction_and_normal,
        cosine_is_that_of_direction_and_normal,
    )
)
