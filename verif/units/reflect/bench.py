"""Tests of the mirrored direction: the standard ones, and geometry in float64 with derived bounds.

With p the length of the quantised normal, N^ = N/p and u a step: N.V is floored once and each
component of (N.V) N once, so R is off V - 2 (N^.V) N^ by at most
2 |p^2 - 1| |N^.V| + 2 p u + 2 sqrt 3 u.
"""

import numpy as np

from verif.env import vectors
from verif.env.definitions import Holds
from verif.env.fields import Operands
from verif.env.pipelined_tests import standard_tests
from verif.env.unit import Parameters
from verif.env.vectors import SLACK, Floats
from verif.units.reflect.unit import FMTS, UNIT

_STEP = 1.0 / FMTS.unit.one


def _vectors(given: Operands, got: Operands) -> tuple[Floats, Floats, Floats]:
    """V, N, R in numbers."""
    names = ((given, "direction"), (given, "normal"), (got, "mirrored"))
    v, n, r = (FMTS.unit.to_float(values[name]) for values, name in names)
    return v, n, r


def _apt(v: Floats, n: Floats) -> Holds:
    """Unit vectors but for a few steps."""
    return (np.abs(vectors.length(v) - 1.0) < 1e-4) & (np.abs(vectors.length(n) - 1.0) < 1e-4)


def _bound(v: Floats, n: Floats) -> Floats:
    p = vectors.length(n)
    cosine = np.abs(vectors.dot(vectors.unit(n), v))
    return np.asarray(2.0 * np.abs(p * p - 1.0) * cosine + 2.0 * (p + np.sqrt(3.0)) * _STEP + SLACK)


def result_is_the_mirror_image_at_the_surface(_: Parameters, given: Operands, got: Operands) -> Holds:
    """V - 2 (N^.V) N^ in float64."""
    v, n, r = _vectors(given, got)
    normal = vectors.unit(n)
    exact = v - 2.0 * vectors.dot(normal, v) * normal
    return vectors.where(_apt(v, n), vectors.length(r - exact) <= _bound(v, n))


def length_of_the_result_is_that_of_the_direction(_: Parameters, given: Operands, got: Operands) -> Holds:
    """A mirror keeps lengths."""
    v, n, r = _vectors(given, got)
    off = np.abs(vectors.length(r) - vectors.length(v))
    return vectors.where(_apt(v, n), off <= _bound(v, n))


def angle_of_reflection_is_the_angle_of_incidence(_: Parameters, given: Operands, got: Operands) -> Holds:
    """N.R = -N.V."""
    v, n, r = _vectors(given, got)
    off = np.abs(vectors.dot(n, r) + vectors.dot(n, v))
    return vectors.where(_apt(v, n), off <= vectors.length(n) * _bound(v, n))


def result_stays_in_the_plane_of_direction_and_normal(_: Parameters, given: Operands, got: Operands) -> Holds:
    """R - V is along N."""
    v, n, r = _vectors(given, got)
    off = vectors.length(np.cross(r - v, vectors.unit(n), axis=0))
    return vectors.where(_apt(v, n), off <= _bound(v, n))


globals().update(
    standard_tests(
        UNIT,
        result_is_the_mirror_image_at_the_surface,
        length_of_the_result_is_that_of_the_direction,
        angle_of_reflection_is_the_angle_of_incidence,
        result_stays_in_the_plane_of_direction_and_normal,
    )
)
