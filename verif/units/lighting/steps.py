"""Materials, drawn steps of hits and misses at lights of all kinds, and what must become of each step."""

from dataclasses import dataclass

import numpy as np
from numpy.random import Generator

from models.arith import vec_mul
from models.core import light_vector, phong
from models.fixed import Raw
from models.header import selected
from verif.env import vectors
from verif.env.fields import Field, Operands, bit, join
from verif.env.operands import stream
from verif.env.unit import Parameters
from verif.units.phong.unit import UNIT as PHONG
from verif.units.shading import Materials, colours

_NEAR, _FAR = 8.0, 200.0
_AT_POINT = 0.05
"""Share of the lights that are at the hit point."""


def inputs(p: Parameters) -> tuple[Field, ...]:
    """What a step has, in the order of the harness; owned and own: {own} of the header."""
    fmts = selected(p)
    return (
        Field("slot", p["SLOT_W"], signed=False),
        bit("hit"),
        bit("first"),
        bit("lit"),
        bit("owned"),
        Field("own", p["OBJECT_W"], signed=False),
        Field.of("weight", fmts.shade, lanes=3),
        Field.of("point", fmts.point, lanes=3),
        Field.of("normal", fmts.unit, lanes=3),
        Field.of("mirrored", fmts.unit, lanes=3),
        Field.of("position", fmts.coord, lanes=3),
        Field.of("intensity", fmts.coeff, lanes=3),
    )


def outputs(p: Parameters) -> tuple[Field, ...]:
    """What comes of a step, in the order of the harness."""
    fmts = selected(p)
    return (
        bit("shadow_valid"),
        Field("shadow_slot", p["SLOT_W"], signed=False),
        bit("shadow_owned"),
        Field("shadow_own", p["OBJECT_W"], signed=False),
        Field.of("shadow_base", fmts.shade, lanes=3),
        Field.of("shadow_light", fmts.shade, lanes=3),
        Field.of("shadow_point", fmts.point, lanes=3),
        Field.of("shadow_direction", fmts.unit, lanes=3),
        Field.of("shadow_limit", fmts.point),
        bit("direct_valid"),
        Field("direct_slot", p["SLOT_W"], signed=False),
        Field.of("direct_base", fmts.shade, lanes=3),
        bit("light_at_point"),
    )


@dataclass(frozen=True)
class Frame:
    """What holds still; background (3, 1) in `coeff`."""

    materials: Materials
    background: Raw

    def settings(self, p: Parameters) -> dict[str, int]:
        """By port."""
        port = Field.of("background", selected(p).coeff, lanes=3)
        return {"background": join((port,), {"background": self.background})[0]}

    def model(self, steps: Operands, p: Parameters) -> Operands:
        """What comes of each step."""
        fmts, number, materials = selected(p), steps["own"], self.materials
        shade = fmts.shade
        hit, lit = steps["hit"] == 1, steps["lit"] == 1
        way = light_vector(steps["point"], steps["position"], fmts)
        colour = phong(
            steps["normal"],
            steps["mirrored"],
            way.direction,
            way.degenerate | ~lit,
            materials.diffuse[:, number],
            materials.specular[:, number],
            steps["intensity"],
            fmts,
        )
        light = vec_mul(colour, steps["weight"], shade, shade, shade)
        behind = self.background << (shade.frac_bits - fmts.coeff.frac_bits)
        local = vec_mul(
            np.where(hit, materials.ambient[:, number], behind), steps["weight"], shade, shade, shade
        )
        base = np.where(steps["first"] == 1, local, 0)
        bright = hit & light.any(axis=0)
        shadow = {
            "slot": steps["slot"],
            "owned": steps["owned"],
            "own": number,
            "base": base,
            "light": light,
            "point": steps["point"],
            "direction": way.direction,
            "limit": way.limit,
        }
        direct = {"slot": steps["slot"], "base": base}
        return {
            "shadow_valid": bright.astype(np.int64),
            **{f"shadow_{name}": np.where(bright, values, 0) for name, values in shadow.items()},
            "direct_valid": (~bright).astype(np.int64),
            **{f"direct_{name}": np.where(bright, 0, values) for name, values in direct.items()},
            "light_at_point": (hit & lit & way.degenerate).astype(np.int64),
        }


def legal(steps: Operands, p: Parameters) -> Operands:
    """None has hit what is not there; a miss has one step."""
    first = np.where(steps["hit"] == 1, steps["first"], 1)
    return {**steps, "own": steps["own"] % p["OBJECTS"], "first": first}


def drawn_frame(generator: Generator, p: Parameters) -> Frame:
    """Any materials, and any background."""
    fmts, size = selected(p), p["OBJECTS"]
    ambient = colours(generator, size, fmts.shade)
    coefficients = (colours(generator, size, fmts.coeff) for _ in range(4))
    return Frame(Materials(ambient, *coefficients), colours(generator, 1, fmts.coeff))


def drawn_steps(generator: Generator, size: int, p: Parameters) -> Operands:
    """Mostly hits with lights, near and far, before and behind the surface, some at the hit point."""
    fmts = selected(p)
    assert PHONG.directed is not None
    angles = PHONG.directed(p, generator, size)
    near = generator.uniform(-_NEAR, _NEAR, (3, size))
    distance = np.where(generator.random(size) < 0.5, generator.uniform(0.0, _NEAR, size), _FAR)
    way = fmts.unit.to_float(angles["direction"]) * distance
    position = vectors.truncated(near + way, fmts.coord)
    point = vectors.truncated(near, fmts.point)
    exact = position << (fmts.point.frac_bits - fmts.coord.frac_bits)
    likely = {name: (generator.random(size) < 0.9).astype(np.int64) for name in ("hit", "lit")}
    return legal(
        {
            **stream(generator, inputs(p), size),
            **{name: angles[name] for name in ("normal", "mirrored", "intensity")},
            **likely,
            "position": position,
            "point": np.where(generator.random(size) < _AT_POINT, exact, point),
            "weight": colours(generator, size, fmts.shade),
        },
        p,
    )
