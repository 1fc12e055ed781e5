"""Transmitted directions: exact rationals, the book's formula in float64, Snell's law."""

import math
from collections.abc import Sequence
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from models.arith import dot
from models.core import reflect
from models.core.refract import INDEX_CODES, Refracted, ratios, refract
from models.fixed import Format, Raw
from models.formats import BUILDS, Formats, formats
from models.scene.types import Vec3
from models.tests.arith_oracles import floored, raws, value, vectors

Floats = NDArray[np.float64]

DEFAULT = formats(BUILDS["default"])
EVERY_BUILD = [formats(knobs) for knobs in BUILDS.values()]
GLASS = 4
"""Code of n = 1.5."""


def exact_ratio(index: int, leaving: bool) -> Fraction:
    """n_from / n_to."""
    n = 1 + Fraction(index, 8)
    return n if leaving else 1 / n


@pytest.mark.parametrize("fmts", EVERY_BUILD, ids=list(BUILDS))
def test_the_tables_hold_each_ratio_and_its_square_floored(fmts: Formats) -> None:
    eta, square = ratios(fmts)
    assert len(eta) == len(square) == 2 * INDEX_CODES
    for index in range(INDEX_CODES):
        for leaving in (False, True):
            exact = exact_ratio(index, leaving)
            place = index + INDEX_CODES * leaving
            assert value(int(eta[place]), fmts.eta) <= exact < value(int(eta[place]) + 1, fmts.eta)
            assert (
                value(int(square[place]), fmts.eta_sq)
                <= exact**2
                < value(int(square[place]) + 1, fmts.eta_sq)
            )
            assert eta[place] <= fmts.eta.max
            assert square[place] <= fmts.eta_sq.max


def columns(*vectors: Sequence[int]) -> Raw:
    return np.array(vectors, dtype=np.int64).T


def in_rationals(
    way: Vec3, normal: Vec3, cosine: int, index: int, leaving: bool, fmts: Formats
) -> list[int] | None:
    """The rule of the unit's header, one ray at a time; None where the reflection is total."""
    exact = exact_ratio(index, leaving)
    eta = value(floored(exact, fmts.eta), fmts.eta)
    square = value(floored(exact**2, fmts.eta_sq), fmts.eta_sq)
    c = min(max(-value(cosine, fmts.unit), Fraction(0)), Fraction(1))
    sine_sq = value(floored(1 - c * c, fmts.sine_sq), fmts.sine_sq)
    wide = Format(8, 2 * fmts.gain.frac_bits)
    radicand = 1 - value(floored(square * sine_sq, wide), wide)
    if radicand < 0:
        return None
    root = Fraction(math.isqrt(int(radicand * wide.one)), fmts.gain.one)
    bent = value(floored(eta * c, Format(8, fmts.gain.frac_bits)), fmts.gain)
    gain = value(floored(bent - root, fmts.gain), fmts.gain)
    pairs = zip(way, normal, strict=True)
    return [floored(gain * value(n, fmts.unit) + eta * value(v, fmts.unit), fmts.unit) for v, n in pairs]


@settings(max_examples=400)
@given(st.sampled_from(EVERY_BUILD), st.integers(0, INDEX_CODES - 1), st.booleans(), st.data())
def test_any_operands_give_what_exact_rationals_give(
    fmts: Formats, index: int, leaving: bool, data: st.DataObject
) -> None:
    way, normal, mirrored = (data.draw(vectors(fmts.unit)) for _ in range(3))
    cosine = data.draw(raws(fmts.unit))
    got = refract(
        columns(way),
        columns(normal),
        columns(mirrored),
        np.array([cosine]),
        np.array([index]),
        np.array([leaving]),
        fmts,
    )
    expected = in_rationals(way, normal, cosine, index, leaving, fmts)
    assert got.total[0] == (expected is None)
    assert got.transmitted[:, 0].tolist() == (list(mirrored) if expected is None else expected)


def plane_ray(degrees: Floats, fmts: Formats) -> tuple[Raw, Raw]:
    """Directions that come down on the plane y = 0 at some angles from its normal, and that normal."""
    angle = np.radians(degrees)
    way = np.stack([np.sin(angle), -np.cos(angle), np.zeros_like(angle)])
    normal = np.zeros_like(way)
    normal[1] = 1
    return np.trunc(way * fmts.unit.one).astype(np.int64), (normal * fmts.unit.one).astype(np.int64)


def passed(way: Raw, normal: Raw, index: int, leaving: bool, fmts: Formats) -> tuple[Refracted, Raw]:
    """What becomes of directions at a surface, and their reflections."""
    mirrored, cosine = reflect(way, normal, fmts)
    count = way.shape[1]
    codes, sides = np.full(count, index), np.full(count, leaving)
    return refract(way, normal, mirrored, cosine, codes, sides, fmts), mirrored


def angles(direction: Raw) -> Floats:
    """Degrees from straight down."""
    return np.asarray(np.degrees(np.arctan2(np.hypot(direction[0], direction[2]), -direction[1])))


def test_45_degrees_into_glass_become_28_1_degrees() -> None:
    got, _ = passed(*plane_ray(np.array([45.0]), DEFAULT), GLASS, False, DEFAULT)
    assert angles(got.transmitted)[0] == pytest.approx(28.1255, abs=5e-3)
    assert got.transmitted[0, 0] > 0, "on the far side of the normal"


@pytest.mark.parametrize("index", range(INDEX_CODES))
def test_refraction_follows_snells_law_in_and_out(index: int) -> None:
    n = 1 + index / 8
    degrees = np.linspace(0, 85, 200)
    way, normal = plane_ray(degrees, DEFAULT)
    inside, _ = passed(way, normal, index, False, DEFAULT)
    assert not inside.total.any()
    np.testing.assert_allclose(
        n * np.sin(np.radians(angles(inside.transmitted))), np.sin(np.radians(degrees)), atol=2e-4
    )
    lengths = np.sqrt((DEFAULT.unit.to_float(inside.transmitted) ** 2).sum(axis=0))
    np.testing.assert_allclose(lengths, 1, atol=2e-4)
    outside, _ = passed(inside.transmitted, normal, index, True, DEFAULT)
    assert not outside.total.any()
    np.testing.assert_allclose(angles(outside.transmitted), degrees, atol=0.2)


@pytest.mark.parametrize("index", range(1, INDEX_CODES))
def test_beyond_the_critical_angle_the_ray_is_the_reflected_one(index: int) -> None:
    critical = math.degrees(math.asin(1 / (1 + index / 8)))
    below = np.linspace(0, critical - 0.05, 50)
    above = np.linspace(critical + 0.05, 89, 50)
    got, _ = passed(*plane_ray(below, DEFAULT), index, True, DEFAULT)
    assert not got.total.any()
    got, mirrored = passed(*plane_ray(above, DEFAULT), index, True, DEFAULT)
    assert got.total.all()
    np.testing.assert_array_equal(got.transmitted, mirrored)


@pytest.mark.parametrize("leaving", [False, True])
def test_what_bends_no_light_lets_a_ray_go_straight_on(leaving: bool) -> None:
    way, normal = plane_ray(np.linspace(0, 80, 100), DEFAULT)
    got, _ = passed(way, normal, 0, leaving, DEFAULT)
    assert not got.total.any()
    assert np.abs(got.transmitted - way).max() <= 8


@settings(max_examples=100)
@given(st.sampled_from(EVERY_BUILD), st.integers(0, INDEX_CODES - 1), st.booleans(), st.integers(0, 2**32))
def test_unit_vectors_give_the_books_formula_within_a_derived_bound(
    fmts: Formats, index: int, leaving: bool, seed: int
) -> None:
    """T = (eta c - sqrt(1 - eta^2 (1 - c^2))) N + eta V in float64, with c = -N.V as the core has it.

    eta, its square, the sine's square and the radicand are floored by up to a step each: the radicand is off
    by d <= 2^-16 + eta^2 2^-24 + 2^-32, its root by d / root or sqrt d and a step, the gain by a step of eta,
    of the product and of the root more.
    """
    generator, count = np.random.default_rng(seed), 500
    normal, way = (generator.standard_normal((3, count)) for _ in range(2))
    normal, way = (v / np.sqrt((v * v).sum(axis=0)) for v in (normal, way))
    normal = np.where((normal * way).sum(axis=0) > 0, -normal, normal)
    n_raw, v_raw = (np.trunc(v * fmts.unit.one).astype(np.int64) for v in (normal, way))
    cosine = dot(n_raw, v_raw, fmts.unit, fmts.unit, fmts.unit)
    nothing = np.zeros_like(n_raw)
    got = refract(v_raw, n_raw, nothing, cosine, np.full(count, index), np.full(count, leaving), fmts)
    eta = float(exact_ratio(index, leaving))
    c = np.clip(-fmts.unit.to_float(cosine), 0, 1)
    radicand = 1 - eta * eta * (1 - c * c)
    off = 2.0**-16 + eta * eta * 2.0**-24 + 2.0**-32
    decided = np.abs(radicand) > off
    np.testing.assert_array_equal(got.total[decided], radicand[decided] < 0)
    root = np.sqrt(np.maximum(radicand, 0))
    ideal = (eta * c - root) * fmts.unit.to_float(n_raw) + eta * fmts.unit.to_float(v_raw)
    root_off = np.minimum(math.sqrt(off), off / np.maximum(root, 1e-9)) + 2.0**-16
    bound = root_off + 3 * 2.0**-16 + 2.0**-16 + 1 / fmts.unit.one
    passes = decided & (radicand > 0)
    error = np.abs(fmts.unit.to_float(got.transmitted) - ideal).max(axis=0)
    assert (error <= bound)[passes].all()
