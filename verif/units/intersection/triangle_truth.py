"""What a ray and a triangle are to each other, in float64 with derived bounds, and definitions that follow.

Seen along the ray, on the plane across it, the ray is the point 0 and a corner r (from the ray's origin) is
at its lateral place. The unit keeps w bits of a corner, w the width of a mantissa: each component is floored
to a step d <= |r|_max 2^-(w-2). Moving it along the ray adds no more than (sqrt 2 + 2) d to each of two
components. That makes sqrt 2 (sqrt 2 + 2) sqrt 3 d < 8.5 d in the lateral plane, as the longest component
of a unit vector is 1 / sqrt 3 at least. So a corner is taken to be at most E = 8.5 d from its true place, an
edge no further off than its worse end; and where the ray passes further from all edges than that, moving the
corners there cannot change whether the ray is within.

Distance: t = B / A with B = N.r0 and A = N.I. The unit's B is off by E_B = |N|_1 d0 and a step of `plane`,
its A is less by up to a step E_A of `facing`: t is off by at most (E_B + |t| E_A) / (A - E_A) and a step of
its own.
"""

from dataclasses import dataclass

import numpy as np

from models.formats import Formats
from models.header import selected
from models.limits import T_MIN
from verif.env import vectors
from verif.env.definitions import Holds
from verif.env.fields import Operands
from verif.env.unit import Parameters
from verif.env.vectors import SLACK, Floats
from verif.units.intersection.unit import corners

_LENGTH_STEPS = 6
_FARTHEST = 256.0
"""A triangle at this distance or beyond is not hit, whatever the limit."""


def lateral(reach: Floats, direction: Floats) -> Floats:
    """Places (2, n) of points (3, n), seen from the ray's origin, on the plane across directions (3, n)."""
    shortest = np.abs(direction).argmin(axis=0)
    helper = (np.arange(3)[:, None] == shortest).astype(np.float64)
    u = vectors.unit(np.cross(direction, helper, axis=0))
    v = np.cross(direction, u, axis=0)
    return np.stack([vectors.dot(reach, u), vectors.dot(reach, v)])


def turn(a: Floats, b: Floats) -> Floats:
    """Twice the signed area of (0, a, b), of points (2, n)."""
    return np.asarray(a[0] * b[1] - a[1] * b[0])


def distance_to_edge(a: Floats, b: Floats) -> Floats:
    """From 0 to the segments between points (2, n)."""
    along = b - a
    square = np.maximum((along * along).sum(axis=0), np.finfo(np.float64).tiny)
    share = np.clip(-(a * along).sum(axis=0) / square, 0.0, 1.0)
    nearest = a + share * along
    return np.sqrt((nearest * nearest).sum(axis=0))


@dataclass(frozen=True)
class Seen:
    """A point seen from a ray's origin: reach (3, n), lateral place (2, n), how far off it may be (n,)."""

    reach: Floats
    place: Floats
    error: Floats


@dataclass(frozen=True)
class Ray:
    """Rays in numbers: apt where the direction is of unit length but for a few steps."""

    fmts: Formats
    apt: Holds
    origin: Floats
    raw: Floats
    direction: Floats

    @classmethod
    def of(cls, p: Parameters, given: Operands) -> "Ray":
        """The rays of some operands."""
        fmts = selected(p)
        raw = fmts.unit.to_float(given["direction"])
        off = np.abs(vectors.length(raw) - 1.0)
        apt = off * fmts.unit.one < _LENGTH_STEPS
        return cls(fmts, apt, fmts.point.to_float(given["origin"]), raw, vectors.unit(raw))

    def step(self, reach: Floats) -> Floats:
        """What a corner's components are floored to, at most."""
        return np.asarray(np.abs(reach).max(axis=0) * 2.0 ** (2 - self.fmts.mantissa.width))

    def sees(self, corner: Floats) -> Seen:
        """A point (3, n) from these rays."""
        reach = corner - self.origin
        return Seen(reach, lateral(reach, self.direction), 8.5 * self.step(reach) + SLACK)


def clear_of(a: Seen, b: Seen) -> Holds:
    """The ray passes further from an edge than the edge may be off."""
    return np.asarray(distance_to_edge(a.place, b.place) > np.maximum(a.error, b.error))


@dataclass(frozen=True)
class Truth:
    """The ray and the triangle in float64.

    apt: it is a triangle, its normal and the direction are unit vectors but for a few steps, or the normal is
    0. inside, outside: the ray passes clearly so. facing: N.I, exact; sure: it is further from 0 than
    rounding. distance and error: of a ray that is not parallel.
    """

    apt: Holds
    inside: Holds
    outside: Holds
    facing: Floats
    sure: Holds
    distance: Floats
    error: Floats

    @classmethod
    def of(cls, p: Parameters, given: Operands) -> "Truth":
        """What float64 makes of some operands."""
        ray = Ray.of(p, given)
        fmts = ray.fmts
        a, b, c = (ray.sees(fmts.coord.to_float(corner)) for corner in corners(given))
        turns = [turn(s.place, e.place) for s, e in ((a, b), (b, c), (c, a))]
        within = (np.minimum.reduce(turns) > 0) | (np.maximum.reduce(turns) < 0)
        clear = clear_of(a, b) & clear_of(b, c) & clear_of(c, a)
        normal = fmts.unit.to_float(given["shape"])
        behind, facing = vectors.dot(normal, a.reach), vectors.dot(normal, ray.raw)
        loss = 1.0 / fmts.facing.one
        least = np.abs(facing) - loss
        distance = behind / np.where(facing == 0, 1.0, facing)
        error_behind = np.abs(normal).sum(axis=0) * ray.step(a.reach) + 1.0 / fmts.plane.one + SLACK
        error = (error_behind + np.abs(distance) * loss) / np.maximum(least, loss) + 1.0 / fmts.point.one
        short = vectors.length(normal) < 1.0 + _LENGTH_STEPS / fmts.unit.one
        return cls(
            ray.apt & short & (given["triangle"] == 1),
            within & clear,
            ~within & clear,
            facing,
            least > loss,
            distance,
            error,
        )

    def between(self, limit: Floats) -> Holds:
        """The plane is clearly met at a distance that counts."""
        end = np.minimum(limit, _FARTHEST)
        met = (self.distance > float(T_MIN) + self.error) & (self.distance < end - self.error)
        return np.asarray(self.sure & met)

    def beyond(self, limit: Floats) -> Holds:
        """The plane is clearly met at no distance that counts, or not at all."""
        end = np.minimum(limit, _FARTHEST)
        missed = (self.distance < float(T_MIN) - self.error) | (self.distance > end + self.error)
        return np.asarray((self.sure & missed) | (self.facing == 0))


def _limit(p: Parameters, given: Operands) -> Floats:
    return selected(p).point.to_float(given["limit"])


def a_ray_through_a_triangle_hits_it(p: Parameters, given: Operands, got: Operands) -> Holds:
    """Clearly within the edges, at a distance that counts: a hit, from either side."""
    truth = Truth.of(p, given)
    return vectors.where(truth.apt & truth.inside & truth.between(_limit(p, given)), got["hit"] == 1)


def a_ray_beside_a_triangle_misses_it(p: Parameters, given: Operands, got: Operands) -> Holds:
    """Clearly outside the edges; triangles so small or so thin that rounding leaves nothing of them, too."""
    truth = Truth.of(p, given)
    return vectors.where(truth.apt & truth.outside, got["hit"] == 0)


def a_triangle_behind_or_beyond_the_limit_or_along_the_ray_is_missed(
    p: Parameters, given: Operands, got: Operands
) -> Holds:
    """A parallel ray misses whatever its distance is; without area the normal is 0 and every ray parallel."""
    truth = Truth.of(p, given)
    return vectors.where(truth.apt & truth.beyond(_limit(p, given)), got["hit"] == 0)


def distance_is_that_of_the_triangles_plane(p: Parameters, given: Operands, got: Operands) -> Holds:
    """Within the bound, for all hits of rays that are not almost parallel."""
    truth = Truth.of(p, given)
    off = np.abs(selected(p).point.to_float(got["distance"]) - truth.distance)
    return vectors.where(truth.apt & truth.sure & (got["hit"] == 1), off <= truth.error)


def a_ray_that_goes_the_way_of_the_normal_leaves_a_triangle(
    _: Parameters, given: Operands, got: Operands
) -> Holds:
    """The sign of an exact product, for directions and normals of any length."""
    facing = (given["direction"] * given["shape"]).sum(axis=0)
    return vectors.where((given["triangle"] == 1) & (got["hit"] == 1), (facing > 0) == (got["leaving"] == 1))


def a_triangle_has_no_chord(_: Parameters, given: Operands, got: Operands) -> Holds:
    """Offset and half of the chord are 0."""
    nothing = (got["offset"] == 0).all(axis=0) & (got["half_chord"] == 0)
    return vectors.where(given["triangle"] == 1, nothing)


DEFINITIONS = (
    a_ray_through_a_triangle_hits_it,
    a_ray_beside_a_triangle_misses_it,
    a_triangle_behind_or_beyond_the_limit_or_along_the_ray_is_missed,
    distance_is_that_of_the_triangles_plane,
    a_ray_that_goes_the_way_of_the_normal_leaves_a_triangle,
    a_triangle_has_no_chord,
)
