"""The colour of a ray: ports, model, whole hits of one sphere under one light.

The scene's constants reach the stages of the pipeline at different clocks, so they hold still while
rays are in flight: all operands of a batch have the scene of most of them.
"""

import numpy as np
from numpy.random import Generator

from models.core import SphereHit, object_setup, shader, sphere_intersect
from models.core.shader import PointLight, Sphere
from models.fixed import Raw
from models.formats import Knobs, formats
from verif.env import vectors
from verif.env.fields import Field, Operands, bit, count, select
from verif.env.unit import Break, Parameters, PipelinedUnit
from verif.units.phong.unit import coefficients
from verif.units.sphere_intersect import rays

FMTS = formats(Knobs())

_RAY = (
    Field.of("weight", FMTS.shade, lanes=3),
    Field.of("direction", FMTS.unit, lanes=3),
    bit("hit"),
    bit("leaving"),
    Field.of("offset", FMTS.offset, lanes=3),
    Field.of("half_chord", FMTS.half_chord),
)

SCENE = (
    Field.of("center", FMTS.coord, lanes=3),
    Field.of("radius_sq", FMTS.radius_sq),
    Field.of("inv_radius", FMTS.inv_radius),
    Field.of("ambient", FMTS.shade, lanes=3),
    Field.of("k_diffuse", FMTS.coeff, lanes=3),
    Field.of("k_specular", FMTS.coeff, lanes=3),
    Field.of("k_transparency", FMTS.coeff, lanes=3),
    bit("light_on"),
    Field.of("light_position", FMTS.coord, lanes=3),
    Field.of("light_intensity", FMTS.coeff, lanes=3),
    Field.of("background", FMTS.coeff, lanes=3),
)
"""Ports that hold still."""


def _inputs(_: Parameters) -> tuple[Field, ...]:
    return (*_RAY, *SCENE)


def _outputs(_: Parameters) -> tuple[Field, ...]:
    return (Field.of("colour", FMTS.shade, lanes=3), bit("light_at_point"))


def _model(_: Parameters, operands: Operands) -> Operands:
    constants = ("center", "radius_sq", "inv_radius", "ambient", "k_diffuse", "k_specular", "k_transparency")
    sphere = Sphere(*[operands[name] for name in constants])
    light_on = bool(operands["light_on"][0])
    light = PointLight(light_on, operands["light_position"], operands["light_intensity"])
    none = np.zeros(count(operands), dtype=np.int64)
    hit = SphereHit(
        operands["hit"] == 1,
        operands["leaving"] == 1,
        none,
        operands["offset"],
        operands["half_chord"],
        none,
        none,
    )
    colour, at_point = shader(
        operands["weight"], operands["direction"], hit, sphere, light, operands["background"], FMTS
    )
    return {"colour": colour, "light_at_point": at_point.astype(np.int64)}


def _one_scene(_: Parameters, operands: Operands) -> Operands:
    """All rays in the scene of most of them."""
    table = np.concatenate([operands[port.name].reshape(port.lanes, -1) for port in SCENE])
    first, times = np.unique(table, axis=1, return_index=True, return_counts=True)[1:]
    usual = first[np.argmax(times)]
    same = select(operands, np.full(count(operands), usual))
    return {**operands, **{port.name: same[port.name] for port in SCENE}}


LIGHTS = ("touching", "close", "inside", "off", "anywhere")
"""Where a scene's light is: on the sphere, beside or in it, nowhere, anywhere."""


def _light(generator: Generator, kind: str, center: Raw, radius: Raw) -> Raw:
    """A light (3, 1) of one of the kinds."""
    to_coord = FMTS.coord.frac_bits - FMTS.radius.frac_bits
    reach = int(radius[0]) << to_coord
    direction = vectors.directions(generator, 1)
    if kind in ("anywhere", "off"):
        return generator.integers(FMTS.coord.min, FMTS.coord.max, (3, 1), endpoint=True)
    if kind == "touching":
        return FMTS.coord.saturate(center + np.eye(3, dtype=np.int64)[:, :1] * reach)
    low, high = (0.0, 0.95) if kind == "inside" else (1.05, 10.0)
    return FMTS.coord.saturate(center + (direction * reach * generator.uniform(low, high)).astype(np.int64))


def _scene(generator: Generator, kind: str) -> tuple[Operands, Raw]:
    """The constants of one scene, one operand, and its radius (1,)."""
    center, radius = rays.spheres(generator, 1, FMTS)
    if kind == "touching":  # its pole must be where a light can be
        center = center >> 2
    material = {name: coefficients(generator, 1) for name in ("k_diffuse", "k_specular", "k_transparency")}
    constants = object_setup(radius, coefficients(generator, 1), coefficients(generator, 1), FMTS)
    scene: dict[str, Raw] = {
        **material,
        "radius_sq": constants.radius_sq,
        "inv_radius": constants.inv_radius,
        "ambient": constants.ambient,
        "center": center,
        "light_on": np.array([kind != "off"], dtype=np.int64),
        "light_position": _light(generator, kind, center, radius),
        "light_intensity": coefficients(generator, 1),
        "background": coefficients(generator, 1),
    }
    return scene, radius


def rays_of_a_scene(generator: Generator, size: int, number: int) -> Operands:
    """Rays past the sphere of one scene, a fifth of them along the axis x, which hit its very pole.

    The scene's number says which of `LIGHTS` it has, in turn.
    """
    scene, radius = _scene(generator, LIGHTS[number % len(LIGHTS)])
    center = np.broadcast_to(scene["center"], (3, size))
    origin, direction = rays.aimed(generator, center, radius, size, FMTS)
    axial = generator.random(size) < 0.2
    shift = FMTS.point.frac_bits - FMTS.coord.frac_bits
    before = generator.integers(4 * FMTS.point.one, 20 * FMTS.point.one, size)
    pole = (center << shift) + np.eye(3, dtype=np.int64)[:, :1] * before
    origin = np.where(axial, FMTS.point.saturate(pole), origin)
    direction = np.where(axial, -np.eye(3, dtype=np.int64)[:, :1] * FMTS.unit.one, direction)
    found = sphere_intersect(origin, direction, center, scene["radius_sq"], FMTS.point.max, FMTS)
    weight = FMTS.shade.resize(coefficients(generator, size), FMTS.coeff.frac_bits)
    full = generator.random(size) < 0.7
    return {
        "weight": np.where(full, FMTS.shade.one, weight),
        "direction": direction,
        "hit": found.hit.astype(np.int64),
        "leaving": found.leaving.astype(np.int64),
        "offset": found.offset,
        "half_chord": found.half_chord,
        **{port.name: np.repeat(scene[port.name], size, axis=-1) for port in SCENE},
    }


def _directed(_: Parameters, generator: Generator, size: int) -> Operands:
    return rays_of_a_scene(generator, size, int(generator.integers(len(LIGHTS))))


UNIT = PipelinedUnit(
    name="shader",
    inputs=_inputs,
    outputs=_outputs,
    model=_model,
    legal=_one_scene,
    directed=_directed,
    breaks=(
        Break("shade/shader.v", "shadowed ? k_transparency : {3{ONE}}", "{3{ONE}}"),
        Break("shade/shader.v", "shadow_degenerate || !light_on", "shadow_degenerate"),
        Break("shade/shader.v", "lit_hit ? lit : background_shade", "lit"),
    ),
)
