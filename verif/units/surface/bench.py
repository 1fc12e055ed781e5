"""Tests of hit point and normal: the standard ones, and geometry in float64 with derived bounds.

A hit is apt where half chord and inverse radius are those of some radius r: h = floor sqrt(r^2 - q.q).
With I the direction, n its length, I^ = I / n, u and v a step of a point and of a unit vector, the
center is seen from the hit point as m = q +- (h I - d), 0 <= d < u, and h^2 falls short of r^2 - q.q
by at most 2 r u, so

    | |m|^2 - r^2 | <= B = |n^2 - 1| h^2 + 2 r u + 2 h n |q.I^| + 2 sqrt 3 u |m| + 3 u^2

and |m| is off by at most B / r. 1 / r is floored by less than v, and each product once.
"""

from dataclasses import dataclass

import numpy as np

from verif.env import vectors
from verif.env.definitions import Holds
from verif.env.fields import Operands
from verif.env.pipelined_tests import standard_tests
from verif.env.unit import Parameters
from verif.env.vectors import SLACK, Floats
from verif.units.surface.unit import FMTS, UNIT, inverse

_POINT_STEP, _UNIT_STEP = 1.0 / FMTS.point.one, 1.0 / FMTS.unit.one
_ROOT_3 = float(np.sqrt(3.0))
_RADII = np.arange(1, FMTS.radius.max + 1)


@dataclass(frozen=True)
class _Hit:
    """Hits in numbers: seen is X - center as the result has it; error bounds its length."""

    apt: Holds
    radius: Floats
    direction: Floats
    slope: Floats
    seen: Floats
    normal: Floats
    error: Floats

    @classmethod
    def of(cls, given: Operands, got: Operands) -> "_Hit":
        """Numbers of operands and results, and which of them are hits."""
        raw = FMTS.unit.to_float(given["direction"])
        n, direction = vectors.length(raw), vectors.unit(raw)
        q = FMTS.offset.to_float(given["offset"])
        h = FMTS.half_chord.to_float(given["half_chord"])
        radius = _radius(given)
        slope = np.abs(vectors.dot(q, direction))
        apt = (radius > 0) & (np.abs(n - 1.0) < 1e-4) & (slope < 0.05)
        r = np.where(apt, radius, 1)
        seen = FMTS.point.to_float(got["point"]) - FMTS.coord.to_float(given["center"])
        m = vectors.length(seen)
        error = np.abs(n * n - 1.0) * h * h + 2.0 * (r + _ROOT_3 * m) * _POINT_STEP
        error += 2.0 * h * n * slope + 3.0 * _POINT_STEP**2
        normal = FMTS.unit.to_float(got["normal"])
        return cls(apt, r, direction, slope, seen, normal, error / r + SLACK)


def _radius(given: Operands) -> Floats:
    """The radius whose inverse and half chord these are; 0 where there is none."""
    number = np.minimum(np.searchsorted(-inverse(_RADII), -given["inv_radius"]), _RADII.size - 1)
    radius = _RADII[number]
    frac = 2 * (FMTS.point.frac_bits - FMTS.radius.frac_bits)
    q, h = given["offset"], given["half_chord"]
    rest = (radius * radius << frac) - (q * q).sum(axis=0) - h * h
    fits = (inverse(radius) == given["inv_radius"]) & (rest >= 0) & (rest <= 2 * h)
    return np.where(fits, FMTS.radius.to_float(radius), 0.0)


def point_is_on_the_sphere(_: Parameters, given: Operands, got: Operands) -> Holds:
    """|X - center| = r, however far the viewer is."""
    hit = _Hit.of(given, got)
    return vectors.where(hit.apt, np.abs(vectors.length(hit.seen) - hit.radius) <= hit.error)


def point_is_on_the_chord_at_the_end_that_is_named(_: Parameters, given: Operands, got: Operands) -> Holds:
    """center - X - q is along I within the floor; against I where the ray leaves."""
    hit = _Hit.of(given, got)
    along = -hit.seen - FMTS.offset.to_float(given["offset"])
    aside = vectors.length(np.cross(along, hit.direction, axis=0))
    turned = np.where(given["leaving"] == 1, -1.0, 1.0) * vectors.dot(along, hit.direction)
    fits = (aside <= _ROOT_3 * _POINT_STEP + SLACK) & (turned >= -_ROOT_3 * _POINT_STEP)
    return vectors.where(hit.apt, fits)


def normal_is_the_radius_of_the_point(_: Parameters, given: Operands, got: Operands) -> Holds:
    """N = (X - center) / r outside, its opposite inside, within what is floored."""
    hit = _Hit.of(given, got)
    outward = np.where(given["leaving"] == 1, -1.0, 1.0) * hit.seen / hit.radius
    bound = (vectors.length(hit.seen) + _ROOT_3) * _UNIT_STEP + SLACK
    return vectors.where(hit.apt, vectors.length(hit.normal - outward) <= bound)


def normal_is_a_unit_vector(_: Parameters, given: Operands, got: Operands) -> Holds:
    """The point's error over r, and that of the product."""
    hit = _Hit.of(given, got)
    bound = hit.error / hit.radius + (vectors.length(hit.seen) + _ROOT_3) * _UNIT_STEP + SLACK
    return vectors.where(hit.apt, np.abs(vectors.length(hit.normal) - 1.0) <= bound)


def normal_is_turned_toward_the_viewer(_: Parameters, given: Operands, got: Operands) -> Holds:
    """N.I <= 0 but for what a grazing ray leaves open: q.I^ and the floors."""
    hit = _Hit.of(given, got)
    open_point = (hit.slope + _ROOT_3 * _POINT_STEP) / hit.radius
    bound = open_point + (vectors.length(hit.seen) + _ROOT_3) * _UNIT_STEP + SLACK
    return vectors.where(hit.apt, vectors.dot(hit.normal, hit.direction) <= bound)


globals().update(
    standard_tests(
        UNIT,
        point_is_on_the_sphere,
        point_is_on_the_chord_at_the_end_that_is_named,
        normal_is_the_radius_of_the_point,
        normal_is_a_unit_vector,
        normal_is_turned_toward_the_viewer,
    )
)
