"""Tests of the ray-sphere test: the standard ones, and geometry in float64 with derived bounds.

Let I^ be the direction over its length n (a unit vector's is off by a few steps), c the center seen
from the origin, b^ = I^.c, q^ = c - b^ I^, u a step of a point. The unit floors I.c and b I once
each, so |q - q^| <= E_q = |b^| |1 - n^2| + (n + sqrt 3) u; as q^ is at a right angle to I^, q.q is
off by at most 2 |q^| sqrt 3 u + E_q^2. The roots follow.
"""

from dataclasses import dataclass

import numpy as np

from models.limits import T_MIN
from verif.env import vectors
from verif.env.definitions import Holds
from verif.env.fields import Operands
from verif.env.pipelined_tests import standard_tests
from verif.env.unit import Parameters
from verif.env.vectors import SLACK, Floats
from verif.units.sphere_intersect.unit import FMTS, UNIT

_STEP = 1.0 / FMTS.point.one
_T_MIN = float(T_MIN)
_ROOT_3 = float(np.sqrt(3.0))


@dataclass(frozen=True)
class _Truth:
    """The ray and the sphere in float64, and by how much the unit may differ.

    apt: the direction is a unit vector but for a few steps and the center is within the range of a
    point. error_*: bounds of q, of the discriminant and of distances.
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
    def of(cls, given: Operands) -> "_Truth":
        """What float64 makes of some operands."""
        raw = FMTS.unit.to_float(given["direction"])
        n = vectors.length(raw)
        direction = vectors.unit(raw)
        c = FMTS.coord.to_float(given["center"]) - FMTS.point.to_float(given["origin"])
        apt = (np.abs(n - 1.0) < 1e-4) & (np.abs(c).max(axis=0) < FMTS.point.max * _STEP)
        radius_sq = FMTS.radius_sq.to_float(given["radius_sq"])
        along = vectors.dot(direction, c)
        aside = vectors.length(c - along * direction)
        discriminant = radius_sq - aside * aside
        e_offset = np.abs(along) * np.abs(1.0 - n * n) + (n + _ROOT_3) * _STEP + SLACK
        e_disc = 2.0 * aside * _ROOT_3 * _STEP + e_offset**2 + SLACK
        half = np.sqrt(np.maximum(discriminant, 0.0))
        e_half = np.minimum(np.sqrt(e_disc), e_disc / np.maximum(half, 1e-12)) + _STEP
        e_distance = np.abs(along) * np.abs(1.0 - n) + _STEP + e_half + SLACK
        return cls(
            apt,
            direction,
            vectors.length(c),
            np.sqrt(radius_sq),
            discriminant,
            along - half,
            along + half,
            e_offset,
            e_disc,
            e_distance,
        )


def hits_where_the_ray_meets_the_sphere_between_its_limits(
    _: Parameters, given: Operands, got: Operands
) -> Holds:
    """Undecided is only what lies within the bounds of the discriminant or of a distance."""
    truth, limit = _Truth.of(given), FMTS.point.to_float(given["limit"])
    distance = np.where(truth.near >= _T_MIN, truth.near, truth.far)
    hit = (truth.discriminant >= 0) & (distance >= _T_MIN) & (distance < limit)
    near_by = np.abs(truth.near - _T_MIN) > truth.error_distance
    far_end = np.abs(truth.far - _T_MIN) > truth.error_distance
    clear = np.abs(distance - limit) > truth.error_distance
    meets = truth.discriminant > truth.error_discriminant
    decided = (truth.discriminant < -truth.error_discriminant) | (meets & near_by & far_end & clear)
    return vectors.where(truth.apt & decided, hit == got["hit"])


def distance_is_that_of_the_end_of_the_chord_it_names(_: Parameters, given: Operands, got: Operands) -> Holds:
    """The far end where the ray leaves, else the near one, within the bound."""
    truth = _Truth.of(given)
    end = np.where(got["leaving"] == 1, truth.far, truth.near)
    off = np.abs(FMTS.point.to_float(got["distance"]) - end)
    return vectors.where(truth.apt & (got["hit"] == 1), off <= truth.error_distance)


def no_hit_is_nearer_than_the_smallest_distance_or_at_the_limit(
    _: Parameters, given: Operands, got: Operands
) -> Holds:
    """Exact, for directions of any length."""
    inside = (got["distance"] >= int(T_MIN * FMTS.point.one)) & (got["distance"] < given["limit"])
    return vectors.where(got["hit"] == 1, inside)


def a_ray_leaves_where_it_starts_inside_or_on_the_sphere(
    _: Parameters, given: Operands, got: Operands
) -> Holds:
    """Inside: every hit is leaving. Further outside than the smallest distance: none is."""
    truth, hit = _Truth.of(given), got["hit"] == 1
    outside = truth.center_away - truth.radius
    inside = outside < -truth.error_distance
    beyond = outside > _T_MIN + truth.error_distance
    leaves = vectors.where(truth.apt & hit & inside, got["leaving"] == 1)
    enters = vectors.where(truth.apt & hit & beyond, got["leaving"] == 0)
    return leaves & enters


def offset_is_at_a_right_angle_to_the_ray_and_half_the_chord_completes_it(
    _: Parameters, given: Operands, got: Operands
) -> Holds:
    """q.I^ = 0 within the bound; q.q + h^2 is r^2 with the remainder of a square root, exactly."""
    truth = _Truth.of(given)
    q, h = got["offset"], got["half_chord"]
    slope = np.abs(vectors.dot(FMTS.offset.to_float(q), truth.direction))
    shift = 2 * FMTS.point.frac_bits - FMTS.radius_sq.frac_bits
    rest = (given["radius_sq"] << shift) - (q * q).sum(axis=0) - h * h
    right = (slope <= truth.error_offset) & (rest >= 0) & (rest <= 2 * h)
    return vectors.where(truth.apt & (got["hit"] == 1), right)


globals().update(
    standard_tests(
        UNIT,
        hits_where_the_ray_meets_the_sphere_between_its_limits,
        distance_is_that_of_the_end_of_the_chord_it_names,
        no_hit_is_nearer_than_the_smallest_distance_or_at_the_limit,
        a_ray_leaves_where_it_starts_inside_or_on_the_sphere,
        offset_is_at_a_right_angle_to_the_ray_and_half_the_chord_completes_it,
    )
)
