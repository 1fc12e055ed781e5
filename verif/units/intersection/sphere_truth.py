"""What a ray and a sphere are to each other, in float64 with derived bounds, and the definitions that follow.

Let I^ be the direction over its length n (a unit vector's is off by a few steps), c the center seen
from the origin, b^ = I^.c, q^ = c - b^ I^, u a step of a point. The unit floors I.c and b I once
each, so |q - q^| <= E_q = |b^| |1 - n^2| + (n + sqrt 3) u; as q^ is at a right angle to I^, q.q is
off by at most 2 |q^| sqrt 3 u + E_q^2. The roots follow.
"""

from dataclasses import dataclass

import numpy as np

from models.header import selected
from models.limits import T_MIN
from verif.env import vectors
from verif.env.definitions import Holds
from verif.env.fields import Operands
from verif.env.unit import Parameters
from verif.env.vectors import SLACK, Floats
from verif.units.intersection.unit import corners, radius_sq

_T_MIN = float(T_MIN)
_ROOT_3 = float(np.sqrt(3.0))
_LENGTH_STEPS = 6
"""A unit vector's length is off by so many of its steps at most."""


@dataclass(frozen=True)
class _Truth:
    """The ray and the sphere in float64, and by how much the unit may differ.

    apt: it is a sphere, the direction is a unit vector but for a few steps and the center is within the
    range of a point. error_*: bounds of q, of the discriminant and of distances.
    """

    apt: Holds
    direction: Floats
    center_away: Floats
    radius: Floats
    discriminant: Floats
    near: Floats
    far: Floats
    error_offset: Floats
    error_discriminant: Floats
    error_distance: Floats

    @classmethod
    def of(cls, p: Parameters, given: Operands) -> "_Truth":
        """What float64 makes of some operands."""
        fmts = selected(p)
        step = 1.0 / fmts.point.one
        raw = fmts.unit.to_float(given["direction"])
        n = vectors.length(raw)
        direction = vectors.unit(raw)
        c = fmts.coord.to_float(corners(given)[0]) - fmts.point.to_float(given["origin"])
        apt = (np.abs(n - 1.0) * fmts.unit.one < _LENGTH_STEPS) & (given["triangle"] == 0)
        apt &= np.abs(c).max(axis=0) < fmts.point.max * step
        square = fmts.radius_sq.to_float(radius_sq(given, fmts))
        along = vectors.dot(direction, c)
        aside = vectors.length(c - along * direction)
        discriminant = square - aside * aside
        e_offset = np.abs(along) * np.abs(1.0 - n * n) + (n + _ROOT_3) * step + SLACK
        e_disc = 2.0 * aside * _ROOT_3 * step + e_offset**2 + SLACK
        half = np.sqrt(np.maximum(discriminant, 0.0))
        e_half = np.minimum(np.sqrt(e_disc), e_disc / np.maximum(half, 1e-12)) + step
        e_distance = np.abs(along) * np.abs(1.0 - n) + step + e_half + SLACK
        return cls(
            apt,
            direction,
            vectors.length(c),
            np.sqrt(square),
            discriminant,
            along - half,
            along + half,
            e_offset,
            e_disc,
            e_distance,
        )


def hits_where_the_ray_meets_the_sphere_between_its_limits(
    p: Parameters, given: Operands, got: Operands
) -> Holds:
    """Undecided is only what lies within the bounds of the discriminant or of a distance."""
    truth, limit = _Truth.of(p, given), selected(p).point.to_float(given["limit"])
    distance = np.where(truth.near >= _T_MIN, truth.near, truth.far)
    hit = (truth.discriminant >= 0) & (distance >= _T_MIN) & (distance < limit)
    near_by = np.abs(truth.near - _T_MIN) > truth.error_distance
    far_end = np.abs(truth.far - _T_MIN) > truth.error_distance
    clear = np.abs(distance - limit) > truth.error_distance
    meets = truth.discriminant > truth.error_discriminant
    decided = (truth.discriminant < -truth.error_discriminant) | (meets & near_by & far_end & clear)
    return vectors.where(truth.apt & decided, hit == got["hit"])


def distance_is_that_of_the_end_of_the_chord_it_names(p: Parameters, given: Operands, got: Operands) -> Holds:
    """The far end where the ray leaves, else the near one, within the bound."""
    truth = _Truth.of(p, given)
    end = np.where(got["leaving"] == 1, truth.far, truth.near)
    off = np.abs(selected(p).point.to_float(got["distance"]) - end)
    return vectors.where(truth.apt & (got["hit"] == 1), off <= truth.error_distance)


def a_ray_leaves_where_it_starts_inside_or_on_the_sphere(
    p: Parameters, given: Operands, got: Operands
) -> Holds:
    """Inside: every hit is leaving. Further outside than the smallest distance: none is."""
    truth, hit = _Truth.of(p, given), got["hit"] == 1
    outside = truth.center_away - truth.radius
    inside = outside < -truth.error_distance
    beyond = outside > _T_MIN + truth.error_distance
    leaves = vectors.where(truth.apt & hit & inside, got["leaving"] == 1)
    enters = vectors.where(truth.apt & hit & beyond, got["leaving"] == 0)
    return leaves & enters


def offset_is_at_a_right_angle_to_the_ray_and_half_the_chord_completes_it(
    p: Parameters, given: Operands, got: Operands
) -> Holds:
    """q.I^ = 0 within the bound; q.q + h^2 is r^2 with the remainder of a square root, exactly."""
    truth, fmts = _Truth.of(p, given), selected(p)
    q, h = got["offset"], got["half_chord"]
    slope = np.abs(vectors.dot(fmts.offset.to_float(q), truth.direction))
    shift = 2 * fmts.point.frac_bits - fmts.radius_sq.frac_bits
    rest = (radius_sq(given, fmts) << shift) - (q * q).sum(axis=0) - h * h
    right = (slope <= truth.error_offset) & (rest >= 0) & (rest <= 2 * h)
    return vectors.where(truth.apt & (got["hit"] == 1), right)


DEFINITIONS = (
    hits_where_the_ray_meets_the_sphere_between_its_limits,
    distance_is_that_of_the_end_of_the_chord_it_names,
    a_ray_leaves_where_it_starts_inside_or_on_the_sphere,
    offset_is_at_a_right_angle_to_the_ray_and_half_the_chord_completes_it,
)
