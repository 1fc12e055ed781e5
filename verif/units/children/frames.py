"""Frames of materials, drawn rays that have hit or missed, their steps, and what must become of each step."""

from dataclasses import dataclass

import numpy as np
from numpy.random import Generator

from models.arith import vec_mul
from models.core import refract
from models.fixed import Raw
from models.header import selected
from models.scene.types import INDEX
from verif.env import vectors
from verif.env.fields import Field, Operands, bit, count, select
from verif.env.operands import stream
from verif.env.unit import Parameters
from verif.units.refract.unit import UNIT as REFRACT
from verif.units.shading import Materials, colours


def rays(p: Parameters) -> tuple[Field, ...]:
    """What a ray and its hit have; owned and own: {own} of the header."""
    fmts = selected(p)
    return (
        Field("slot", p["SLOT_W"], signed=False),
        Field("depth", p["DEPTH_W"], signed=False),
        bit("hit"),
        bit("owned"),
        Field("own", p["OBJECT_W"], signed=False),
        Field.of("weight", fmts.shade, lanes=3),
        Field.of("point", fmts.point, lanes=3),
        Field.of("direction", fmts.unit, lanes=3),
        Field.of("normal", fmts.unit, lanes=3),
        Field.of("mirrored", fmts.unit, lanes=3),
        Field.of("cosine", fmts.unit),
        Field.of("index", INDEX),
        bit("leaving"),
    )


def inputs(p: Parameters) -> tuple[Field, ...]:
    """What a step has, in the order of the harness."""
    slot, depth, hit, *rest = rays(p)
    step = Field("step", p["LIGHT_W"], signed=False)
    more = Field("more", p["LIGHT_W"], signed=False)
    return (slot, depth, hit, bit("branching"), step, more, *rest)


def outputs(p: Parameters) -> tuple[Field, ...]:
    """What comes of a step, in the order of the harness."""
    fmts = selected(p)
    return (
        bit("more_valid"),
        Field("more_slot", p["SLOT_W"], signed=False),
        Field("more_count", p["COUNT_W"], signed=False),
        bit("child_valid"),
        Field("child_depth", p["DEPTH_W"], signed=False),
        Field("child_slot", p["SLOT_W"], signed=False),
        bit("child_owned"),
        Field("child_own", p["OBJECT_W"], signed=False),
        Field.of("child_weight", fmts.shade, lanes=3),
        Field.of("child_point", fmts.point, lanes=3),
        Field.of("child_direction", fmts.unit, lanes=3),
        bit("settle_valid"),
        Field("settle_depth", p["DEPTH_W"], signed=False),
        Field("settle_count", 2, signed=False),
    )


@dataclass(frozen=True)
class Frame:
    """What holds still."""

    materials: Materials
    lights: int
    max_depth: int

    @property
    def reflects(self) -> bool:
        """Whether some object does."""
        return bool(self.materials.reflection.any())

    @property
    def transmits(self) -> bool:
        """Whether some object does."""
        return bool(self.materials.transparency.any())

    @property
    def settings(self) -> dict[str, int]:
        """By port."""
        return {
            "max_depth": self.max_depth,
            "reflects": int(self.reflects),
            "transmits": int(self.transmits),
        }

    def legal(self, drawn: Operands, p: Parameters) -> Operands:
        """Rays of this frame: none is deeper than the deepest, none has hit what is not there."""
        depth, own = 1 + drawn["depth"] % self.max_depth, drawn["own"] % p["OBJECTS"]
        return {**drawn, "depth": depth, "own": own}

    def steps(self, drawn: Operands) -> tuple[Operands, Raw]:
        """The steps of rays, one ray after the other, and for each the number of its ray (n,).

        A hit takes one a light, and two at least where the object is glass and the ray not the deepest.
        """
        glass = self.materials.transparency[:, drawn["own"]].any(axis=0)
        branching = (drawn["hit"] == 1) & glass & (drawn["depth"] < self.max_depth)
        steps = np.where(drawn["hit"] == 1, np.maximum(self.lights, np.where(branching, 2, 1)), 1)
        ray = np.repeat(np.arange(steps.size), steps)
        step = np.arange(ray.size) - (np.cumsum(steps) - steps)[ray]
        whole = {**drawn, "branching": branching.astype(np.int64), "more": steps - 1}
        return {**select(whole, ray), "step": step}, ray

    def weights(self, steps: Operands, p: Parameters) -> Raw:
        """(3, n): of the child that each step may cast, in `shade`."""
        fmts, number = selected(p), steps["own"]
        reflection, transparency = (
            self.materials.reflection[:, number],
            self.materials.transparency[:, number],
        )
        share = np.where(steps["step"] == 0, reflection, transparency)
        return vec_mul(steps["weight"], share, fmts.shade, fmts.coeff, fmts.shade)

    def model(self, steps: Operands, p: Parameters) -> Operands:
        """What comes of each step."""
        fmts, number = selected(p), steps["own"]
        first, second = steps["step"] == 0, (steps["step"] == 1) & (steps["branching"] == 1)
        weight = self.weights(steps, p)
        deeper = steps["depth"] < self.max_depth
        heavy = weight.max(axis=0) >= p["MIN_WEIGHT"]
        sent = (first | second) & (steps["hit"] == 1) & deeper & heavy
        without_step = int(self.transmits) * (1 - steps["branching"])
        places = np.where(first, int(self.reflects) + without_step, second.astype(np.int64))
        settled = np.where(deeper, places - sent, 0)
        surface = {name: steps[name] for name in ("direction", "normal", "mirrored", "cosine", "index")}
        turned = refract(**surface, leaving=steps["leaving"] == 1, fmts=fmts).transmitted
        child = {
            "depth": steps["depth"] + 1,
            "slot": steps["slot"],
            "owned": steps["owned"],
            "own": number,
            "weight": weight,
            "point": steps["point"],
            "direction": np.where(second, turned, steps["mirrored"]),
        }
        return {
            "more_valid": np.ones_like(number),
            "more_slot": steps["slot"],
            "more_count": sent + np.where(first, steps["more"], 0),
            "child_valid": sent.astype(np.int64),
            **{f"child_{name}": np.where(sent, values, 0) for name, values in child.items()},
            "settle_valid": (settled > 0).astype(np.int64),
            "settle_depth": np.where(settled > 0, steps["depth"] + 1, 0),
            "settle_count": settled,
        }


def drawn_frame(
    generator: Generator, lights: int, max_depth: int, mirrors: bool, glass: bool, p: Parameters
) -> Frame:
    """Any materials; without mirrors, or without glass, where it is said so."""
    fmts, size = selected(p), p["OBJECTS"]
    ambient = colours(generator, size, fmts.shade)
    diffuse, specular, reflection, transparency = (colours(generator, size, fmts.coeff) for _ in range(4))
    return Frame(
        Materials(ambient, diffuse, specular, reflection * mirrors, transparency * glass), lights, max_depth
    )


def drawn_rays(generator: Generator, frame: Frame, size: int, p: Parameters) -> Operands:
    """Mostly hits, at surfaces met at all angles; weights at which children begin to count among others."""
    fmts = selected(p)
    assert REFRACT.directed is not None
    drawn = frame.legal(stream(generator, rays(p), size), p)
    surface = REFRACT.directed(p, generator, size)
    assert count(surface) == size
    tables = np.stack([frame.materials.reflection, frame.materials.transparency])
    share = np.maximum(tables[generator.integers(0, 2, size), :, drawn["own"]].T, 1)
    least = -(-p["MIN_WEIGHT"] * fmts.coeff.one // share) + generator.integers(-1, 0, size, endpoint=True)
    alone = generator.integers(0, 3, size) == np.arange(3)[:, None]
    weight = vectors.pick(
        generator,
        colours(generator, size, fmts.shade),
        generator.integers(0, fmts.shade.one, (3, size), endpoint=True),
        fmts.shade.saturate(np.where(alone, least, 0)),
    )
    return {**drawn, **surface, "weight": weight, "hit": (generator.random(size) < 0.9).astype(np.int64)}
