"""Tests of the light of each step: the model at every clock, and what header and book say of a step."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import cocotb
import numpy as np
from hypothesis import strategies as st

from models.fixed import Raw
from models.header import selected
from models.latency import LATENCY
from models.limits import INFINITY
from verif.env import context, vectors
from verif.env.block import holds
from verif.env.definitions import Holds, all_lanes, is_floor
from verif.env.fields import Field, Operands, describe_all, select
from verif.env.operands import batches
from verif.env.pipelined import Mismatch
from verif.env.unit import Parameters
from verif.units.lighting import steps as drawing
from verif.units.lighting.steps import Frame, drawn_frame, drawn_steps
from verif.units.shading import ShadingBench

_PART = 500
"""Steps of one frame of the long run."""


async def create(dut: Any) -> tuple[ShadingBench, context.Context]:
    """A bench that has been reset, and its run."""
    run = context.read()
    p = run.parameters
    bench = ShadingBench(dut, p, drawing.inputs(p), drawing.outputs(p), LATENCY["lighting"](p))
    await bench.restart()
    return bench, run


async def load(bench: ShadingBench, seed: int) -> Frame:
    """Loads a drawn frame."""
    frame = drawn_frame(np.random.default_rng(seed), bench.parameters)
    await bench.load(frame.materials, frame.settings(bench.parameters))
    return frame


async def run_steps(bench: ShadingBench, frame: Frame, steps: Operands, gaps: Sequence[int] = ()) -> Operands:
    """Steps in a table that has been loaded; what came of each."""
    got = await bench.run(steps, frame.model(steps, bench.parameters), gaps)
    bench.saw({**steps, **got})
    return got


_SEEDS = st.integers(0, (1 << 32) - 1)


@cocotb.test()
async def every_step_gives_what_the_model_gives_when_it_must(dut: Any) -> None:
    """Drawn steps of drawn frames, with gaps; one frame behind the other."""
    bench, run = await create(dut)

    async def example(first: int, second: int, drawn: Operands, gaps: list[int]) -> None:
        await bench.restart()
        for seed in (first, second):
            await run_steps(bench, await load(bench, seed), drawing.legal(drawn, run.parameters), gaps)

    gaps = st.lists(st.integers(0, 3), max_size=8)
    await holds(run, example, _SEEDS, _SEEDS, batches(drawing.inputs(run.parameters), 8), gaps, cost=3)


@cocotb.test()
async def reset_drops_what_is_in_flight_and_nothing_after(dut: Any) -> None:
    """At a drawn moment; the table stays."""
    bench, run = await create(dut)

    async def example(seed: int, before: Operands, wait: int, after: Operands) -> None:
        frame = await load(bench, seed)
        await bench.drive(drawing.legal(before, run.parameters))
        await bench.clocks(wait)
        await bench.restart()
        await bench.nothing_comes()
        await run_steps(bench, frame, drawing.legal(after, run.parameters))

    batch = batches(drawing.inputs(run.parameters), 4)
    await holds(run, example, _SEEDS, batch, st.integers(0, bench.latency), batch, cost=3)


@dataclass(frozen=True)
class Seen:
    """Steps of a frame, and what came of each; base (3, n) of either kind of term."""

    p: Parameters
    frame: Frame
    steps: Operands
    got: Operands

    @property
    def base(self) -> Raw:
        """Of a direct term or of a shadow ray: what does not come has none."""
        return np.asarray(self.got["shadow_base"] + self.got["direct_base"])


async def _long_run(dut: Any, share: int, check: Callable[[Seen], Holds] | None = None) -> None:
    """Volume, back to back: seeded frames; what is said of each step must hold for all."""
    bench, run = await create(dut)
    p, total = run.parameters, max(run.operands // share, _PART // 2)
    for number, done in enumerate(range(0, total, _PART)):
        generator = run.generator(number)
        frame = await load(bench, int(generator.integers(1 << 32)))
        steps = drawn_steps(generator, min(_PART, total - done), p)
        seen = Seen(p, frame, steps, await run_steps(bench, frame, steps))
        if check is not None and (wrong := np.flatnonzero(~check(seen))).size:
            shown = describe_all(drawing.inputs(p), steps, int(wrong[0]))
            got = describe_all(drawing.outputs(p), seen.got, int(wrong[0]))
            raise Mismatch(f"not so for {wrong.size} steps, the first:\n{shown}\ngot\n{got}")
    bench.log.info("%d steps checked", total)


@cocotb.test()
async def a_long_run_matches_the_model(dut: Any) -> None:
    """Volume."""
    await _long_run(dut, share=5)


@cocotb.test()
async def a_step_ends_in_a_shadow_ray_with_light_or_in_a_direct_term(dut: Any) -> None:
    """In one of them; in a shadow ray exactly where it brings light, from the hit point and its triangle."""

    def check(seen: Seen) -> Holds:
        got, steps = seen.got, seen.steps
        shadow, direct = got["shadow_valid"] == 1, got["direct_valid"] == 1
        slot = np.where(shadow, got["shadow_slot"], got["direct_slot"])
        from_hit = all_lanes(got["shadow_point"] == steps["point"])
        from_hit &= (got["shadow_owned"] == steps["owned"]) & (got["shadow_own"] == steps["own"])
        light = got["shadow_light"].any(axis=0)
        return (shadow != direct) & (slot == steps["slot"]) & (light == shadow) & (~shadow | from_hit)

    await _long_run(dut, 20, check)


@cocotb.test()
async def the_base_is_the_ambient_light_once_and_the_background_of_a_miss(dut: Any) -> None:
    """Times the weight, floored and held within the format."""

    def check(seen: Seen) -> Holds:
        steps, fmts = seen.steps, selected(seen.p)
        drop, port = fmts.shade.frac_bits, Field.of("base", fmts.shade)
        ambient = seen.frame.materials.ambient[:, steps["own"]] * steps["weight"]
        behind = (seen.frame.background * steps["weight"]) << (drop - fmts.coeff.frac_bits)
        exact = np.where(steps["hit"] == 1, ambient, behind)
        once = np.where(steps["first"] == 1, exact, 0)
        return all_lanes(is_floor(once, drop, port, seen.base))

    await _long_run(dut, 20, check)


@cocotb.test()
async def a_light_that_is_not_there_or_at_the_hit_point_adds_nothing(dut: Any) -> None:
    """Only the latter is told, once a light."""

    def check(seen: Seen) -> Holds:
        steps, fmts = seen.steps, selected(seen.p)
        here = all_lanes(steps["position"] << (fmts.point.frac_bits - fmts.coord.frac_bits) == steps["point"])
        there = (steps["hit"] == 1) & (steps["lit"] == 1)
        told = seen.got["light_at_point"] == 1
        return (told == (there & here)) & ((there & ~here) | (seen.got["shadow_valid"] == 0))

    await _long_run(dut, 20, check)


@cocotb.test()
async def a_shadow_ray_ends_at_its_light(dut: Any) -> None:
    """Its direction times its limit leads from the point to the light, within what is floored on the way."""

    def check(seen: Seen) -> Holds:
        steps, got, fmts = seen.steps, seen.got, selected(seen.p)
        limit = fmts.point.to_float(got["shadow_limit"])
        way = fmts.unit.to_float(got["shadow_direction"]) * limit
        reach = fmts.coord.to_float(steps["position"]) - fmts.point.to_float(steps["point"])
        # The direction is off by some steps a component, the length by some of a point's and of a share.
        slack = 4.0 * (limit / fmts.unit.one + 1.0 / fmts.point.one)
        inside = vectors.length(reach) < float(INFINITY) - 1.0
        return (got["shadow_valid"] == 0) | ~inside | (vectors.length(way - reach) < slack)

    await _long_run(dut, 20, check)


@cocotb.test()
async def a_weight_of_none_casts_no_shadow_ray(dut: Any) -> None:
    """Nor does light that the weight makes less than a step; a hit's first step still ends in its base."""
    bench, run = await create(dut)
    frame = await load(bench, 1)
    steps = drawn_steps(run.generator(1 << 16), 200, run.parameters)
    weights = (0 * steps["weight"], steps["weight"] >> (selected(run.parameters).shade.width - 1))
    for weight in weights:
        got = await run_steps(bench, frame, {**steps, "weight": weight})
        dark = select(got, np.flatnonzero(weight.max(axis=0) == 0))
        if dark["shadow_valid"].any() or not dark["direct_valid"].all() or dark["direct_base"].any():
            raise Mismatch("a ray without weight adds something")


@cocotb.test()
async def light_of_a_single_bit_casts_a_shadow_ray(dut: Any) -> None:
    """White light straight above a white surface is what the weight is: each bit of each channel alone."""
    bench, run = await create(dut)
    p, fmts = run.parameters, selected(run.parameters)
    drawn = await load(bench, 2)
    dull = 0 * drawn.materials.specular
    frame = replace(drawn, materials=replace(drawn.materials, diffuse=dull + fmts.coeff.one, specular=dull))
    await bench.load(frame.materials, frame.settings(p))

    width = fmts.shade.width
    steps = drawn_steps(run.generator(1 << 17), 3 * width, p)
    up = np.repeat([[0], [0], [1]], 3 * width, axis=1)
    weight = np.kron(np.eye(3, dtype=np.int64), 1 << np.arange(width))
    above = {
        **{name: np.ones(3 * width, dtype=np.int64) for name in ("hit", "lit")},
        "point": 0 * up,
        "position": up * fmts.coord.one,
        "normal": up * fmts.unit.one,
        "intensity": 0 * up + fmts.coeff.one,
        "weight": weight,
    }
    got = await run_steps(bench, frame, {**steps, **above})
    wrong = np.flatnonzero(~all_lanes(got["shadow_light"] == weight))
    if wrong.size:
        raise Mismatch(f"no shadow ray with the light of weights {weight[:, wrong].T.tolist()}")


@cocotb.test()
async def a_weight_of_one_leaves_ambient_and_background_as_they_are(dut: Any) -> None:
    """Exactly, however bright: none, all bits of a colour, uniform ones."""
    bench, run = await create(dut)
    p, fmts = run.parameters, selected(run.parameters)
    uniform = run.generator(1 << 18).integers(0, fmts.coeff.max, (6, 3, 1), endpoint=True)
    drop = fmts.shade.frac_bits - fmts.coeff.frac_bits
    for seed, background in enumerate((0 * uniform[0], 0 * uniform[0] + fmts.coeff.max, *uniform)):
        frame = replace(drawn_frame(np.random.default_rng(seed), p), background=background)
        await bench.load(frame.materials, frame.settings(p))
        steps = drawn_steps(run.generator(seed), 8, p)
        one = {
            "hit": np.arange(8) & 1,
            "first": 0 * steps["first"] + 1,
            "weight": 0 * steps["weight"] + fmts.shade.one,
        }
        steps = {**steps, **one}
        got = await run_steps(bench, frame, steps)
        exact = np.where(one["hit"], frame.materials.ambient[:, steps["own"]], background << drop)
        if not np.array_equal(got["shadow_base"] + got["direct_base"], exact):
            raise Mismatch(f"a base that its weight of 1 changes, background {background.ravel().tolist()}")
