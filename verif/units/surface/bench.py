"""Tests of hit point and normal: the standard ones, and geometry in float64 with derived bounds.

A sphere's hit is apt where half chord and inverse radius are those of some radius r:
h = floor sqrt(r^2 - q.q).
With I the direction, n its length, I^ = I / n, u and v a step of a point and of a unit vector, the
center is seen from the hit point as m = q +- (h I - d), 0 <= d < u, and h^2 falls short of r^2 - q.q
by at most 2 r u, so

    | |m|^2 - r^2 | <= B = |n^2 - 1| h^2 + 2 r u + 2 h n |q.I^| + 2 sqrt 3 u |m| + 3 u^2

and |m| is off by at most B / r. 1 / r is floored by less than v, and each product once.

A triangle's hit is o + t I, floored once, and its normal is its own or the opposite one: both exactly.
"""

from dataclasses import dataclass

import numpy as np

from models.fixed import Raw
from models.formats import Formats
from models.header import selected
from verif.env import vectors
from verif.env.definitions import Holds, all_lanes
from verif.env.fields import Operands
from verif.env.pipelined_tests import standard_tests
from verif.env.unit import Parameters
from verif.env.vectors import SLACK, Floats
from verif.units.surface.unit import UNIT, inv_radius, inverse

_ROOT_3 = float(np.sqrt(3.0))
_NEARLY = 4.0
"""Steps that the length of a truncated unit vector may be off: sqrt 3, and some."""


@dataclass(frozen=True)
class _Hit:
    """Hits of spheres in numbers: seen is X - center as the result has it; error bounds its length. turned: 1
    outside, -1 inside. Steps of a point, of a unit vector.
    """

    apt: Holds
    radius: Floats
    direction: Floats
    slope: Floats
    turned: Floats
    offset: Floats
    seen: Floats
    normal: Floats
    error: Floats
    point_step: float
    unit_step: float

    @classmethod
    def of(cls, p: Parameters, given: Operands, got: Operands) -> "_Hit":
        """Numbers of operands and results, and which of them are hits."""
        fmts = selected(p)
        point_step, unit_step = 1.0 / fmts.point.one, 1.0 / fmts.unit.one
        raw = fmts.unit.to_float(given["direction"])
        n, direction = vectors.length(raw), vectors.unit(raw)
        q = fmts.offset.to_float(given["offset"])
        h = fmts.half_chord.to_float(given["half_chord"])
        radius = _radius(given, fmts)
        slope = np.abs(vectors.dot(q, direction))
        apt = (radius > 0) & (np.abs(n - 1.0) < _NEARLY * unit_step) & (slope < 0.05)
        r = np.where(apt, radius, 1)
        seen = fmts.point.to_float(got["point"]) - fmts.coord.to_float(given["center"])
        m = vectors.length(seen)
        error = np.abs(n * n - 1.0) * h * h + 2.0 * (r + _ROOT_3 * m) * point_step
        error += 2.0 * h * n * slope + 3.0 * point_step**2
        return cls(
            apt=apt,
            radius=r,
            direction=direction,
            slope=slope,
            turned=np.where(given["leaving"] == 1, -1.0, 1.0),
            offset=q,
            seen=seen,
            normal=fmts.unit.to_float(got["normal"]),
            error=error / r + SLACK,
            point_step=point_step,
            unit_step=unit_step,
        )

    @property
    def normal_error(self) -> Floats:
        """What is floored of a normal."""
        return (vectors.length(self.seen) + _ROOT_3) * self.unit_step + SLACK


def _radius(given: Operands, fmts: Formats) -> Floats:
    """The radius whose inverse and half chord these are; 0 where there is none, and of a triangle."""
    radii = np.arange(1, fmts.radius.max + 1)
    inv = inv_radius(given["shape"], fmts)
    number = np.minimum(np.searchsorted(-inverse(radii, fmts), -inv), radii.size - 1)
    radius = radii[number]
    frac = 2 * (fmts.point.frac_bits - fmts.radius.frac_bits)
    q, h = given["offset"], given["half_chord"]
    rest = (radius * radius << frac) - (q * q).sum(axis=0) - h * h
    fits = (inverse(radius, fmts) == inv) & (rest >= 0) & (rest <= 2 * h) & (given["triangle"] == 0)
    return np.where(fits, fmts.radius.to_float(radius), 0.0)


def point_is_on_the_sphere(p: Parameters, given: Operands, got: Operands) -> Holds:
    """|X - center| = r, however far the viewer is."""
    hit = _Hit.of(p, given, got)
    return vectors.where(hit.apt, np.abs(vectors.length(hit.seen) - hit.radius) <= hit.error)


def point_is_on_the_chord_at_the_end_that_is_named(p: Parameters, given: Operands, got: Operands) -> Holds:
    """center - X - q is along I within the floor; against I where the ray leaves."""
    hit = _Hit.of(p, given, got)
    along = -hit.seen - hit.offset
    aside = vectors.length(np.cross(along, hit.direction, axis=0))
    ahead = hit.turned * vectors.dot(along, hit.direction)
    fits = (aside <= _ROOT_3 * hit.point_step + SLACK) & (ahead >= -_ROOT_3 * hit.point_step)
    return vectors.where(hit.apt, fits)


def normal_is_the_radius_of_the_point(p: Parameters, given: Operands, got: Operands) -> Holds:
    """N = (X - center) / r outside, its opposite inside, within what is floored."""
    hit = _Hit.of(p, given, got)
    outward = hit.turned * hit.seen / hit.radius
    return vectors.where(hit.apt, vectors.length(hit.normal - outward) <= hit.normal_error)


def normal_is_a_unit_vector(p: Parameters, given: Operands, got: Operands) -> Holds:
    """The point's error over r, and that of the product."""
    hit = _Hit.of(p, given, got)
    bound = hit.error / hit.radius + hit.normal_error
    return vectors.where(hit.apt, np.abs(vectors.length(hit.normal) - 1.0) <= bound)


def normal_is_turned_toward_the_viewer(p: Parameters, given: Operands, got: Operands) -> Holds:
    """N.I <= 0 but for what a grazing ray leaves open: q.I^ and the floors."""
    hit = _Hit.of(p, given, got)
    bound = (hit.slope + _ROOT_3 * hit.point_step) / hit.radius + hit.normal_error
    return vectors.where(hit.apt, vectors.dot(hit.normal, hit.direction) <= bound)


def _along(given: Operands) -> Raw:
    """t I of triangles, exact."""
    return np.asarray(given["distance"] * given["direction"])


def point_of_a_triangle_is_on_the_ray(p: Parameters, given: Operands, got: Operands) -> Holds:
    """o + t I, each component floored; where neither t I nor the sum leaves the range."""
    point, drop = selected(p).point, selected(p).unit.frac_bits
    along = _along(given)
    exact = (given["origin"] << drop) + along
    inside = [(value >= point.min << drop) & (value < point.max << drop) for value in (along, exact)]
    below = exact - (got["point"] << drop)
    fits = all_lanes((below >= 0) & (below < 1 << drop))
    return vectors.where((given["triangle"] == 1) & all_lanes(inside[0] & inside[1]), fits)


def point_of_a_triangle_is_held_within_the_range(p: Parameters, given: Operands, got: Operands) -> Holds:
    """Where o + t I lies beyond it on either side, in each component."""
    point, drop = selected(p).point, selected(p).unit.frac_bits
    exact = (given["origin"] << drop) + _along(given)
    low, high = exact < point.min << drop, exact >= point.max << drop
    # Where t I itself is held, the sum with an origin of the other sign is not what the ray has there.
    same = np.sign(given["origin"]) * np.sign(_along(given)) >= 0
    held = np.where(low, point.min, point.max)
    fits = all_lanes(~((low | high) & same) | (got["point"] == held))
    return vectors.where((given["triangle"] == 1) & ((low | high) & same).any(axis=0), fits)


def normal_of_a_triangle_is_its_own(p: Parameters, given: Operands, got: Operands) -> Holds:
    """As it is from the front, the opposite from behind; -2 has no opposite and becomes the next to it."""
    opposite = np.minimum(-given["shape"], selected(p).unit.max)
    turned = np.where(given["leaving"] == 1, opposite, given["shape"])
    return vectors.where(given["triangle"] == 1, all_lanes(got["normal"] == turned))


globals().update(
    standard_tests(
        UNIT,
        point_is_on_the_sphere,
        point_is_on_the_chord_at_the_end_that_is_named,
        normal_is_the_radius_of_the_point,
        normal_is_a_unit_vector,
        normal_is_turned_toward_the_viewer,
        point_of_a_triangle_is_on_the_ray,
        point_of_a_triangle_is_held_within_the_range,
        normal_of_a_triangle_is_its_own,
    )
)
