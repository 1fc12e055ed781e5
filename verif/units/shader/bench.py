"""Tests of the colour of a ray: the standard ones, and whole hits in many scenes.

The last test of the light's path takes hit point and normal from the ports, which the benches of
their units hold to the geometry, and follows the light in float64. With u and v the steps of a point
and of a unit vector, e_X = sqrt 3 u bounds the point's error, e_N the normal's, and

    e_L = 2 e_X / distance + 4 sqrt 3 v,   e_R = 4 e_N + 2 |p^2 - 1| + 2 (p + sqrt 3) v

those of the directions to the light and of the mirror, with p the normal's length.
"""

from collections.abc import Awaitable, Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from models.limits import INFINITY, SHININESS, T_MIN
from verif.env import definitions, vectors
from verif.env.context import Context
from verif.env.definitions import Definition, Holds, all_lanes, is_floor
from verif.env.fields import Operands, concatenate
from verif.env.pipelined import PipelinedBench
from verif.env.pipelined_tests import standard_tests
from verif.env.unit import Parameters
from verif.env.vectors import SLACK, Floats
from verif.units.highlight.bench import power_bound
from verif.units.shader.unit import FMTS, LIGHTS, SCENE, UNIT, rays_of_a_scene

_POINT_STEP, _UNIT_STEP, _SHADE_STEP = (1.0 / fmt.one for fmt in (FMTS.point, FMTS.unit, FMTS.shade))
_SHADE_MOST = FMTS.shade.max * _SHADE_STEP
_ROOT_3 = float(np.sqrt(3.0))
_SCENES, _RAYS = 40, 250
_SCENE_STREAM = 1 << 18
_CLEAR = 1e-2
"""How far from its limits a shadow ray's distance must be to be decided: more than any error here."""


class _HoldingPort:
    """The port of the harness; where nothing is to be driven the scene, its low bits, stays."""

    def __init__(self, port: Any, bits: int) -> None:
        self._port, self._mask, self._scene = port, (1 << bits) - 1, 0

    @property
    def value(self) -> Any:
        """What is on the port."""
        return self._port.value

    @value.setter
    def value(self, word: int) -> None:
        if word:
            self._scene = word & self._mask
        self._port.value = word or self._scene


class SceneBench(PipelinedBench):
    """A bench whose idle clocks keep the scene of the last operand."""

    def __init__(self, *arguments: Any) -> None:
        super().__init__(*arguments)
        self._port = _HoldingPort(self._port, sum(port.bits for port in SCENE))


def ray_that_misses_brings_the_weighted_background(_: Parameters, given: Operands, got: Operands) -> Holds:
    """Exactly, floored and saturated once."""
    miss = given["hit"] == 0
    background = given["background"] << (FMTS.shade.frac_bits - FMTS.coeff.frac_bits)
    port = UNIT.outputs({})[0]
    floor = is_floor(background * given["weight"], FMTS.shade.frac_bits, port, got["colour"])
    return vectors.where(miss, all_lanes(floor) & (got["light_at_point"] == 0))


def hit_without_a_light_has_the_ambient_light(_: Parameters, given: Operands, got: Operands) -> Holds:
    """Exactly, floored and saturated once."""
    unlit = (given["hit"] == 1) & (given["light_on"] == 0)
    port = UNIT.outputs({})[0]
    floor = is_floor(given["ambient"] * given["weight"], FMTS.shade.frac_bits, port, got["colour"])
    return vectors.where(unlit, all_lanes(floor) & (got["light_at_point"] == 0))


def no_light_makes_a_hit_darker_than_its_ambient(_: Parameters, given: Operands, got: Operands) -> Holds:
    """Whatever is behind or in front of it."""
    ambient = (given["ambient"] * given["weight"]) >> FMTS.shade.frac_bits
    least = np.minimum(ambient, FMTS.shade.max)
    return vectors.where(given["hit"] == 1, all_lanes(got["colour"] >= least))


@dataclass(frozen=True)
class _Path:
    """The light's way to a hit in float64: where it is decided, cosines and their bounds, shadow."""

    hit: Holds
    distance: Floats
    decided: Holds
    shadowed: Holds
    cosine: Floats
    mirror: Floats
    error_cosine: Floats
    error_mirror: Floats

    @classmethod
    def of(cls, given: Operands) -> "_Path":
        """Of all operands as if they were hits."""
        ray = FMTS.unit.to_float(given["direction"])
        turn = np.where(given["leaving"] == 1, -1.0, 1.0)
        radius = np.sqrt(FMTS.radius_sq.to_float(given["radius_sq"]))
        h = FMTS.half_chord.to_float(given["half_chord"])
        outward = -(FMTS.offset.to_float(given["offset"]) + turn * h * ray)
        normal = turn * outward / radius
        p = vectors.length(normal)
        mirrored = ray - 2.0 * vectors.dot(normal, ray) * normal
        way = FMTS.coord.to_float(given["light_position"] - given["center"]) - outward
        distance = vectors.length(way)
        direction = vectors.unit(way)
        e_point = _ROOT_3 * _POINT_STEP
        e_normal = e_point / radius + (vectors.length(outward) + 2.0 * _ROOT_3) * _UNIT_STEP
        e_light = 2.0 * e_point / np.maximum(distance, _POINT_STEP) + 4.0 * _ROOT_3 * _UNIT_STEP
        e_mirrored = 4.0 * p * e_normal + 2.0 * np.abs(p * p - 1.0) + 2.0 * (p + _ROOT_3) * _UNIT_STEP
        shadowed, clear = _shadow(outward, direction, radius, np.minimum(distance, float(INFINITY)))
        cosine = vectors.dot(normal, direction)
        e_cosine = e_normal + p * e_light + _UNIT_STEP + SLACK
        return cls(
            given["hit"] == 1,
            distance,
            clear & (np.abs(cosine) > e_cosine + _UNIT_STEP) & (distance > _CLEAR),
            shadowed,
            np.maximum(cosine, 0.0),
            np.maximum(vectors.dot(mirrored, direction), 0.0),
            e_cosine,
            e_mirrored + e_light + _UNIT_STEP + SLACK,
        )


def _shadow(outward: Floats, direction: Floats, radius: Floats, limit: Floats) -> tuple[Holds, Holds]:
    """Whether the sphere is between a point and the light, and whether that is beyond doubt."""
    along = -vectors.dot(outward, direction)
    aside = vectors.length(outward + along * direction)
    discriminant = radius * radius - aside * aside
    half = np.sqrt(np.maximum(discriminant, 0.0))
    near, far = along - half, along + half
    t_min = float(T_MIN)
    end = np.where(near >= t_min, near, far)
    shadowed = (discriminant >= 0.0) & (end >= t_min) & (end < limit)
    clear = (discriminant > 0.05**2) & (np.abs(end - limit) > _CLEAR)
    for distance in (near, far):
        clear &= np.abs(distance - t_min) > _CLEAR
    return shadowed, clear


def only_a_light_at_the_hit_point_is_reported(_: Parameters, given: Operands, got: Operands) -> Holds:
    """A reported light is within the point's error; further away, or off, none is reported."""
    path, reported = _Path.of(given), got["light_at_point"] == 1
    close = path.hit & (path.distance <= _ROOT_3 * _POINT_STEP + SLACK) & (given["light_on"] == 1)
    return np.asarray(~reported | close)


def some_light_is_at_the_hit_point_and_adds_nothing(_: Parameters, given: Operands, got: Operands) -> Holds:
    """Just the weighted ambient light is left."""
    ambient = (given["ambient"] * given["weight"]) >> FMTS.shade.frac_bits
    alone = all_lanes(got["colour"] == np.minimum(ambient, FMTS.shade.max))
    return vectors.where(got["light_at_point"] == 1, alone)


def lit_hit_has_the_colour_of_the_equation(_: Parameters, given: Operands, got: Operands) -> Holds:
    """Phong's equation with the sphere's own shadow, where that is decided, within the bounds."""
    path = _Path.of(given)
    names = ("k_diffuse", "k_specular", "k_transparency", "light_intensity")
    diffuse, specular, transparency, intensity = (FMTS.coeff.to_float(given[name]) for name in names)
    arriving = np.minimum(intensity * np.where(path.shadowed, transparency, 1.0), _SHADE_MOST)
    highest = np.minimum(path.mirror + path.error_mirror, 1.0) ** (SHININESS - 1)
    e_power = SHININESS * highest * path.error_mirror + power_bound(np.minimum(path.mirror, 1.0))
    error = diffuse * (path.error_cosine + _UNIT_STEP) + specular * e_power + 2.0 * _SHADE_STEP
    front = path.cosine > 0.0
    both = np.minimum(diffuse * path.cosine + specular * path.mirror**SHININESS, _SHADE_MOST)
    direct = np.where(front, both * arriving, 0.0)
    e_direct = np.where(front, error * arriving + (both + 1.0) * _SHADE_STEP, 0.0)
    weight = FMTS.shade.to_float(given["weight"])
    local = np.minimum(FMTS.shade.to_float(given["ambient"]) + np.minimum(direct, _SHADE_MOST), _SHADE_MOST)
    off = np.abs(FMTS.shade.to_float(got["colour"]) - np.minimum(local * weight, _SHADE_MOST))
    bound = e_direct * weight + _SHADE_STEP + SLACK
    return vectors.where(path.hit & path.decided & (given["light_on"] == 1), all_lanes(off <= bound))


def _scenes(run: Context, stream: int) -> Iterator[Operands]:
    """The rays of one scene after the other; in a short run there are fewer of both."""
    share = min(1.0, run.operands / (_SCENES * _RAYS * 4))
    for scene in range(max(2 * len(LIGHTS), int(_SCENES * share))):
        yield rays_of_a_scene(run.generator(stream, scene), max(100, int(_RAYS * share)), scene)


def _in_many_scenes(statement: Definition) -> Callable[..., Awaitable[None]]:
    """A test of the statement on the rays of all scenes together."""

    async def body(bench: PipelinedBench, run: Context) -> None:
        parts = []
        for rays in _scenes(run, _SCENE_STREAM):
            parts.append(await bench.answers(rays))
        given, got = (concatenate(side) for side in zip(*parts, strict=True))
        definitions.check(statement, UNIT, run.parameters, given, got)

    body.__name__ = statement.__name__
    body.__doc__ = statement.__doc__
    return body


async def whole_hits_of_many_scenes_match_the_model(bench: PipelinedBench, run: Context) -> None:
    """A scene, its rays, the next scene."""
    for rays in _scenes(run, _SCENE_STREAM + 1):
        await bench.run(rays)


_STATEMENTS = (
    ray_that_misses_brings_the_weighted_background,
    hit_without_a_light_has_the_ambient_light,
    no_light_makes_a_hit_darker_than_its_ambient,
    only_a_light_at_the_hit_point_is_reported,
    some_light_is_at_the_hit_point_and_adds_nothing,
    lit_hit_has_the_colour_of_the_equation,
)

globals().update(
    standard_tests(
        UNIT,
        more=(whole_hits_of_many_scenes_match_the_model, *map(_in_many_scenes, _STATEMENTS)),
        bench=SceneBench,
    )
)
