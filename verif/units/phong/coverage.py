"""What must have been seen of what a light adds: signs of cosines, powers, terms that vanish or saturate."""

from collections.abc import Callable, Mapping

import numpy as np
from numpy.typing import NDArray

from models.arith import exact_dot, vec_mul
from models.core import highlight
from models.core.phong import colour_add
from models.fixed import Raw
from models.header import selected
from verif.env.coverage.classes import all_lanes, any_lane
from verif.env.coverage.points import Coverage, Holds, Point, Samples, cross
from verif.env.coverage.rounding import lanes_apart
from verif.env.coverage.sieve import Sieve
from verif.env.unit import Parameters
from verif.units.phong.unit import UNIT

SIEVE = Sieve(UNIT)
HITS = SIEVE.directed("lit hits")


def _exact_cosine(s: Samples, vector: str) -> Raw:
    return exact_dot(s[vector], s["direction"])


def _cosine(p: Parameters, s: Samples, vector: str) -> Raw:
    """Floored and held in the range of a unit component and in that of a cosine."""
    fmts = selected(p)
    floored = fmts.unit.resize(_exact_cosine(s, vector), 2 * fmts.unit.frac_bits)
    return fmts.cosine.saturate(floored)


def _power(p: Parameters, s: Samples) -> Raw:
    return highlight(_cosine(p, s, "mirrored"), selected(p))


def _terms(p: Parameters, s: Samples) -> tuple[Raw, Raw]:
    """What reflects diffusely, and the highlight, both (3, n)."""
    fmts = selected(p)
    diffuse = vec_mul(s["k_diffuse"], _cosine(p, s, "normal"), fmts.coeff, fmts.cosine, fmts.shade)
    specular = vec_mul(s["k_specular"], _power(p, s), fmts.coeff, fmts.cosine, fmts.shade)
    return diffuse, specular


def _lit(p: Parameters, s: Samples) -> NDArray[np.bool_]:
    return np.asarray((s["dark"] == 0) & (_cosine(p, s, "normal") > 0))


def _cosines(sieve: Sieve, vector: str) -> Point:
    """Of one cosine: exact sign, and where the floor or the range changes it."""

    def case(matches: Callable[[Raw, int], NDArray[np.bool_]]) -> Holds:
        def holds(p: Parameters, s: Samples) -> NDArray[np.bool_]:
            return matches(_exact_cosine(s, vector), selected(p).unit.one ** 2)

        return holds

    step = 1 / 1024
    return sieve.point(
        f"cosine_of_{vector}",
        f"cosine of {vector} and the light, exact; 1 is full",
        {
            "from_behind": case(lambda exact, one: exact < -step * one),
            "less_than_a_step_behind": case(lambda exact, one: (exact < 0) & (exact > -(one**0.5))),
            "zero": case(lambda exact, _one: exact == 0),
            "less_than_a_step": case(lambda exact, one: (exact > 0) & (exact < one**0.5)),
            "grazing": case(lambda exact, one: (exact > one**0.5) & (exact < 0.1 * one)),
            "steep": case(lambda exact, one: (exact > 0.1 * one) & (exact < 0.99 * one)),
            "one": case(lambda exact, one: exact == one),
            "held": case(lambda exact, one: exact >= 2 * one),
        },
    )


LIGHT = cross(
    HITS.point(
        "normal",
        "which side of the surface the light is on",
        {
            "front": lambda p, s: _cosine(p, s, "normal") > 0,
            "edge": lambda p, s: (_cosine(p, s, "normal") == 0) & (_exact_cosine(s, "normal") >= 0),
            "back": lambda _p, s: _exact_cosine(s, "normal") < 0,
        },
    ),
    HITS.point(
        "dark",
        "whether the light is at the point",
        {"light": lambda _p, s: s["dark"] == 0, "dark": lambda _p, s: s["dark"] == 1},
    ),
    name="light",
)


def _of_power(matches: Callable[[Raw, Raw, int], NDArray[np.bool_]]) -> Holds:
    """Of power, its cosine and 1, of lit hits."""

    def holds(p: Parameters, s: Samples) -> NDArray[np.bool_]:
        one = selected(p).cosine.one
        return np.asarray(matches(_power(p, s), _cosine(p, s, "mirrored"), one) & _lit(p, s))

    return holds


POWERS = SIEVE.point(
    "power",
    "the highlight of lit hits",
    {
        "nothing": _of_power(lambda _power, cosine, _one: cosine == 0),
        "vanishes": _of_power(lambda power, cosine, _one: (power == 0) & (cosine > 0)),
        "faint": _of_power(lambda power, _cosine, one: (power > 0) & (power < one // 256)),
        "bright": _of_power(lambda power, _cosine, one: (power > one // 2) & (power < one)),
        "full": _of_power(lambda power, _cosine, one: power == one),
        "more_than_full": _of_power(lambda power, _cosine, one: power > one),
    },
)


def _of_terms(matches: Callable[[Raw, Raw, Raw, int], NDArray[np.bool_]]) -> Holds:
    """Of both terms, the result and the largest colour, in a channel with light of a lit hit."""

    def holds(p: Parameters, s: Samples) -> NDArray[np.bool_]:
        found = matches(*_terms(p, s), s["colour"], selected(p).shade.max)
        return any_lane(found & _lit(p, s) & (s["intensity"] > 0))

    return holds


TERMS = SIEVE.point(
    "terms",
    "both terms of a channel",
    {
        "both_nothing": _of_terms(lambda diffuse, specular, _c, _most: (diffuse == 0) & (specular == 0)),
        "only_diffuse": _of_terms(lambda diffuse, specular, _c, _most: (diffuse > 0) & (specular == 0)),
        "only_highlight": _of_terms(lambda diffuse, specular, _c, _most: (diffuse == 0) & (specular > 0)),
        "both": _of_terms(lambda diffuse, specular, _c, _most: (diffuse > 0) & (specular > 0)),
        "diffuse_saturates": _of_terms(lambda diffuse, _s, _c, most: diffuse == most),
        "highlight_saturates": _of_terms(lambda _d, specular, _c, most: specular == most),
        "only_the_sum_saturates": _of_terms(
            lambda diffuse, specular, _c, most: (
                (diffuse + specular > most) & (np.maximum(diffuse, specular) < most)
            )
        ),
        "only_the_light_saturates": _of_terms(
            lambda diffuse, specular, colour, most: (diffuse + specular < most) & (colour == most)
        ),
        "the_light_leaves_nothing": _of_terms(
            lambda diffuse, specular, colour, _most: (diffuse + specular > 0) & (colour == 0)
        ),
    },
)


def _total(p: Parameters, s: Samples) -> Raw:
    return colour_add(*_terms(p, s), selected(p)) * s["intensity"]


def _floored(p: Parameters, s: Samples) -> NDArray[np.bool_]:
    mask = selected(p).coeff.one - 1
    return any_lane(
        (_total(p, s) & mask == mask) & _lit(p, s) & (s["colour"] > 0) & (s["colour"] < selected(p).shade.max)
    )


CHANNELS: Mapping[str, Holds] = {
    "one_off": lambda p, s: _lit(p, s) & any_lane(s["intensity"] == 0) & any_lane(s["colour"] > 0),
    "all_off": lambda p, s: _lit(p, s) & all_lanes(s["intensity"] == 0),
    "no_reflectance": lambda p, s: (
        _lit(p, s)
        & all_lanes(s["k_diffuse"] == 0)
        & all_lanes(s["k_specular"] == 0)
        & all_lanes(s["intensity"] > 0)
    ),
    "full_reflectance_in_full_light": lambda p, s: (
        _lit(p, s)
        & any_lane((s["intensity"] == selected(p).coeff.one) & (s["k_diffuse"] == selected(p).coeff.one))
    ),
    "most_of_a_step_dropped": _floored,
    "would_be_lit_but_dark": lambda p, s: (s["dark"] == 1) & any_lane(_total(p, s) > 0),
    "highlight_behind": lambda p, s: (_exact_cosine(s, "normal") < 0) & (_power(p, s) > 0),
}

COVERAGE = Coverage(
    (
        HITS.again(LIGHT),
        _cosines(SIEVE, "normal"),
        _cosines(SIEVE, "mirrored"),
        POWERS,
        TERMS,
        SIEVE.point("channels", "channels beside each other, and what they lose", CHANNELS),
        lanes_apart(SIEVE, "colour", signed=False),
    )
)
