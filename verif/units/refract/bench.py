"""Tests of the transmitted direction: the standard ones, and Snell's law in float64 with derived bounds.

Of hits: V and N are unit vectors but for a few steps, c is -N.V and what its floor adds, 0 <= d < u. With
eta' = eta - e the ratio that the table holds (e < g where the ray enters, 0 where it leaves) and f what the
last floor takes from each component,

    T = (eta' c - floors - root) N + eta' V - f        |f| < sqrt 3 u

* Across N only eta' V and f are left: that is Snell's law, within e + sqrt 3 u.
* The radicand is above R = 1 - eta^2 (1 - c^2), by less than D: the floors of 1 - c^2, of eta^2 and of their
  product. Its root is off by less than sqrt(R + D) - sqrt(R) and a floor. So the factor of N is off by less
  than E = sqrt(R + D) - sqrt(R) + 2 g + e.
* With A = eta c - sqrt R and exact unit vectors |T| = 1. Their lengths p and n and the floor of c leave
  | |T|^2 - 1 | <= A^2 |p^2 - 1| + 2 A eta d + eta^2 |n^2 - 1|.
"""

from dataclasses import dataclass

import numpy as np

from models.header import selected
from models.limits import INDEX_STEP
from verif.env import vectors
from verif.env.context import Context
from verif.env.definitions import Holds, all_lanes
from verif.env.fields import Operands, count, describe_all, select
from verif.env.pipelined import Mismatch, PipelinedBench
from verif.env.pipelined_tests import mixed, standard_tests
from verif.env.unit import Parameters
from verif.env.vectors import SLACK, Floats
from verif.units.refract.unit import UNIT, eta, meeting

_ROOT_3 = float(np.sqrt(3.0))
_NEARLY = 4.0
"""Steps that the length of a truncated unit vector may be off: sqrt 3, and some."""
_SYMMETRY_STREAM, _BEYOND_STREAM = 1 << 18, 1 << 19
_BEYOND = 64
"""Steps beyond -1 of which every one is looked at: a cosine's rounding is a few."""


@dataclass(frozen=True)
class _Meeting:
    """Rays that meet surfaces, in numbers. v, n, t: V, N, T; length: |N|, 1 where that is no unit vector;
    total: what the unit says.
    """

    apt: Holds
    total: Holds
    v: Floats
    n: Floats
    t: Floats
    length: Floats
    cosine: Floats
    eta: Floats
    step: float
    ratio_error: Floats
    radicand: Floats
    radicand_error: Floats
    factor_error: Floats

    @classmethod
    def of(cls, p: Parameters, given: Operands, got: Operands) -> "_Meeting":
        """Numbers of operands and results, and which of them are hits."""
        fmts = selected(p)
        v, n = (fmts.unit.to_float(given[name]) for name in ("direction", "normal"))
        step, grain = 1.0 / fmts.unit.one, 1.0 / fmts.gain.one
        floored = (given["normal"] * given["direction"]).sum(axis=0) >> fmts.unit.frac_bits
        front = (given["cosine"] == floored) & (floored <= 0)
        lengths = [np.abs(vectors.length(vector) - 1.0) < _NEARLY * step for vector in (v, n)]
        apt = front & lengths[0] & lengths[1]
        cosine = np.clip(-fmts.unit.to_float(given["cosine"]), 0.0, 1.0)
        ratio = eta(given["index"], given["leaving"])
        ratio_error = np.where(given["leaving"] == 1, 0.0, 1.0 / fmts.eta.one)
        square_error = np.where(given["leaving"] == 1, 0.0, 1.0 / fmts.eta_sq.one)
        radicand_error = ratio**2 / fmts.sine_sq.one + square_error + grain**2
        radicand = 1.0 - ratio**2 * (1.0 - cosine**2)
        held = np.maximum(radicand, 0.0)
        return cls(
            apt=apt,
            total=np.asarray(got["total"] == 1),
            v=v,
            n=n,
            t=fmts.unit.to_float(got["transmitted"]),
            length=np.where(apt, vectors.length(n), 1.0),
            cosine=cosine,
            eta=ratio,
            step=step,
            ratio_error=ratio_error,
            radicand=radicand,
            radicand_error=radicand_error,
            factor_error=np.sqrt(held + radicand_error) - np.sqrt(held) + 2.0 * grain + ratio_error,
        )

    @property
    def passes(self) -> Holds:
        """Hits whose ray goes on behind the surface."""
        return np.asarray(self.apt & ~self.total)

    @property
    def error(self) -> Floats:
        """How far T may be from the equation with V, N and c as they are given."""
        across = _ROOT_3 * self.step + self.ratio_error * vectors.length(self.v)
        return self.length * self.factor_error + across + SLACK

    @property
    def depth(self) -> Floats:
        """-T.N^ of the equation with exact unit vectors: sqrt R."""
        return np.sqrt(np.maximum(self.radicand, 0.0))

    @property
    def depth_error(self) -> Floats:
        """How far -T.N^ may be from |N| sqrt R."""
        lengths = np.abs(self.length - 1.0 / self.length)
        return self.eta * (self.cosine * lengths + self.step / self.length) + self.error


def sine_of_the_result_is_that_of_snells_law(p: Parameters, given: Operands, got: Operands) -> Holds:
    """|T x N^| = eta |V x N^|."""
    at = _Meeting.of(p, given, got)
    normal = vectors.unit(at.n)
    sine, incidence = (vectors.length(np.cross(vector, normal, axis=0)) for vector in (at.t, at.v))
    bound = _ROOT_3 * at.step + at.ratio_error * incidence + SLACK
    return vectors.where(at.passes, np.abs(sine - at.eta * incidence) <= bound)


def result_stays_in_the_plane_of_direction_and_normal(p: Parameters, given: Operands, got: Operands) -> Holds:
    """T.(V x N^) is what the last floor leaves of it."""
    at = _Meeting.of(p, given, got)
    across = np.cross(at.v, vectors.unit(at.n), axis=0)
    bound = _ROOT_3 * at.step * vectors.length(across) + SLACK
    return vectors.where(at.passes, np.abs(vectors.dot(at.t, across)) <= bound)


def result_goes_on_behind_the_surface(p: Parameters, given: Operands, got: Operands) -> Holds:
    """T.N^ = -sqrt(1 - eta^2 sin^2), so it is not positive but for the bound."""
    at = _Meeting.of(p, given, got)
    off = np.abs(vectors.dot(at.t, vectors.unit(at.n)) + at.length * at.depth)
    return vectors.where(at.passes, off <= at.depth_error)


def result_is_a_unit_vector(p: Parameters, given: Operands, got: Operands) -> Holds:
    """Within the bound; a radicand that is negative by less than D counts as 0."""
    at = _Meeting.of(p, given, got)
    factor = np.abs(at.eta * at.cosine - at.depth)
    squares = factor**2 * np.abs(at.length**2 - 1.0) + 2.0 * factor * at.eta * at.step
    squares += at.eta**2 * np.abs(vectors.dot(at.v, at.v) - 1.0) + np.maximum(-at.radicand, 0.0)
    off = np.abs(vectors.length(at.t) - 1.0)
    return vectors.where(at.passes, off <= squares + at.error)


def reflection_is_total_just_where_the_root_has_no_number(
    p: Parameters, given: Operands, got: Operands
) -> Holds:
    """In integers: (n sin)^2 > 1 where it is total, and where it is not, (n sin)^2 <= 1 + D."""
    one, steps = selected(p).cosine.one, int(1 / INDEX_STEP)
    incidence = np.clip(-given["cosine"], 0, one)
    n = steps + given["index"]
    radicand = (steps * one) ** 2 - n**2 * (one**2 - incidence**2)
    least = -_Meeting.of(p, given, got).radicand_error * float(steps * one) ** 2
    total, leaving = got["total"] == 1, given["leaving"] == 1
    return np.where(total, leaving & (radicand < 0), ~leaving | (radicand >= least))


def total_reflection_is_the_mirror_image(_: Parameters, given: Operands, got: Operands) -> Holds:
    """R as it is, whatever it is."""
    return vectors.where(got["total"] == 1, all_lanes(got["transmitted"] == given["mirrored"]))


def ray_goes_straight_on_where_the_index_is_that_of_the_air(
    p: Parameters, given: Operands, got: Operands
) -> Holds:
    """n = 1 bends nothing and reflects nothing."""
    at = _Meeting.of(p, given, got)
    same = ~at.total & (vectors.length(at.t - at.v) <= at.error)
    return vectors.where(at.apt & (given["index"] == 0), same)


async def a_ray_that_is_turned_round_goes_back_where_it_came_from(
    bench: PipelinedBench, run: Context
) -> None:
    """What enters along V and goes on along T leaves, sent back along -T, along -V.

    Across N each way multiplies by eta, so V comes back within (n + 1) sqrt 3 u + n e. Its second cosine
    is off sqrt R by less than b, so its second radicand is off c^2 by less than n^2 b (2 + b): where c^2 is
    less, the ray grazes and may be totally reflected.
    """
    fmts = selected(run.parameters)
    generator = run.generator(_SYMMETRY_STREAM)
    drawn = mixed(bench.unit, generator, run, min(run.operands // 4, 10_000))
    given, got = await bench.answers({**drawn, "leaving": np.zeros_like(drawn["leaving"])})
    at = _Meeting.of(run.parameters, given, got)
    n = 1.0 + given["index"] * float(INDEX_STEP)
    off = np.abs(at.length**2 - 1.0) + at.length * at.depth_error + at.step
    index = np.flatnonzero(at.apt & (at.cosine**2 > n**2 * off * (2.0 + off)))
    chosen, there = select(given, index), select(got, index)
    back = meeting(
        -there["transmitted"], -chosen["normal"], chosen["index"], np.ones_like(chosen["leaving"]), fmts
    )
    given, returned = await bench.answers(back)
    normal = vectors.unit(fmts.unit.to_float(chosen["normal"]))
    arrived = fmts.unit.to_float(returned["transmitted"] + chosen["direction"])
    n = n[index]
    bound = (n + 1.0) * _ROOT_3 / fmts.unit.one + n / fmts.eta.one + SLACK
    astray = vectors.length(np.cross(arrived, normal, axis=0)) > bound
    wrong = np.flatnonzero(astray | (returned["total"] == 1))
    if not index.size or wrong.size:
        text = describe_all(bench.unit.inputs(run.parameters), given, int(wrong[0])) if wrong.size else "none"
        raise Mismatch(f"{wrong.size} of {count(given)} rays do not go back, as\n{text}")


async def a_cosine_beyond_head_on_is_held_there(bench: PipelinedBench, run: Context) -> None:
    """Just beyond, by any number of steps that rounding could make and by each power of two: as at -1."""
    fmts = selected(run.parameters)
    excess = np.union1d(np.arange(1, _BEYOND), 1 << np.arange(fmts.unit.frac_bits))
    drawn = mixed(bench.unit, run.generator(_BEYOND_STREAM), run, excess.size)
    given, got = await bench.answers({**drawn, "cosine": -fmts.unit.one - excess})
    _, held = await bench.answers({**drawn, "cosine": np.full_like(excess, -fmts.unit.one)})
    different = (got["transmitted"] != held["transmitted"]).any(axis=0) | (got["total"] != held["total"])
    if (wrong := np.flatnonzero(different)).size:
        text = describe_all(bench.unit.inputs(run.parameters), given, int(wrong[0]))
        raise Mismatch(f"{wrong.size} of {excess.size} cosines are not held, as\n{text}")


globals().update(
    standard_tests(
        UNIT,
        sine_of_the_result_is_that_of_snells_law,
        result_stays_in_the_plane_of_direction_and_normal,
        result_goes_on_behind_the_surface,
        result_is_a_unit_vector,
        reflection_is_total_just_where_the_root_has_no_number,
        total_reflection_is_the_mirror_image,
        ray_goes_straight_on_where_the_index_is_that_of_the_air,
        more=(a_ray_that_is_turned_round_goes_back_where_it_came_from, a_cosine_beyond_head_on_is_held_there),
    )
)
