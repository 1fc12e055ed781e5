"""Tests of the secondary rays of a hit: the model at every clock, and what header and book say of a ray.

Statements are about the steps of a whole ray and what came of them, not about the model.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

import cocotb
import numpy as np
from hypothesis import strategies as st

from models.fixed import Raw
from models.header import selected
from models.latency import LATENCY
from verif.env import context
from verif.env.block import holds
from verif.env.definitions import Holds
from verif.env.fields import Operands, count, describe_all
from verif.env.operands import batches
from verif.env.pipelined import Mismatch
from verif.env.unit import Parameters
from verif.units.children import frames
from verif.units.children.frames import Frame, drawn_frame, drawn_rays
from verif.units.shading import ShadingBench

_PART = 300
"""Rays of one frame of the long run."""


@dataclass(frozen=True)
class Settings:
    """What is drawn of a frame."""

    lights: int
    max_depth: int
    mirrors: bool
    glass: bool
    seed: int

    def frame(self, p: Parameters) -> Frame:
        """The frame."""
        generator = np.random.default_rng(self.seed)
        return drawn_frame(generator, self.lights, self.max_depth, self.mirrors, self.glass, p)


def _settings(p: Parameters) -> st.SearchStrategy[Settings]:
    lights, depths = st.integers(0, (1 << p["LIGHT_W"]) - 1), st.integers(1, (1 << p["DEPTH_W"]) - 1)
    return st.builds(Settings, lights, depths, st.booleans(), st.booleans(), st.integers(0, (1 << 32) - 1))


async def create(dut: Any) -> tuple[ShadingBench, context.Context]:
    """A bench that has been reset, and its run."""
    run = context.read()
    p = run.parameters
    latency = LATENCY["children"](p)
    bench = ShadingBench(dut, p, frames.inputs(p), frames.outputs(p), latency)
    await bench.restart()
    return bench, run


async def run_rays(bench: ShadingBench, frame: Frame, rays: Operands, gaps: Sequence[int] = ()) -> Operands:
    """All steps of rays, in a table that has been loaded; what came of each."""
    steps, _ = frame.steps(rays)
    got = await bench.run(steps, frame.model(steps, bench.parameters), gaps)
    if bench.signals is not None:
        held = {name: np.full(count(steps), value) for name, value in frame.settings.items()}
        bench.saw({**steps, **got, **held, "child_weights": frame.weights(steps, bench.parameters)})
    return got


@cocotb.test()
async def every_step_gives_what_the_model_gives_when_it_must(dut: Any) -> None:
    """Drawn rays of drawn frames, with gaps; one frame behind the other."""
    bench, run = await create(dut)
    p = run.parameters

    async def example(first: Settings, second: Settings, drawn: Operands, gaps: list[int]) -> None:
        await bench.restart()
        for settings in (first, second):
            frame = settings.frame(p)
            await bench.load(frame.materials, frame.settings)
            await run_rays(bench, frame, frame.legal(drawn, p), gaps)

    gaps = st.lists(st.integers(0, 3), max_size=8)
    await holds(run, example, _settings(p), _settings(p), batches(frames.rays(p), 8), gaps, cost=2)


@cocotb.test()
async def reset_drops_what_is_in_flight_and_nothing_after(dut: Any) -> None:
    """At a drawn moment; the table stays."""
    bench, run = await create(dut)
    p = run.parameters

    async def example(settings: Settings, before: Operands, wait: int, after: Operands) -> None:
        frame = settings.frame(p)
        await bench.load(frame.materials, frame.settings)
        await bench.drive(frame.steps(frame.legal(before, p))[0])
        await bench.clocks(wait)
        await bench.restart()
        await bench.nothing_comes()
        await run_rays(bench, frame, frame.legal(after, p))

    batch = batches(frames.rays(p), 4)
    await holds(run, example, _settings(p), batch, st.integers(0, bench.latency), batch, cost=2)


@dataclass(frozen=True)
class Seen:
    """Rays of a frame, their steps, of which ray each is, and what came of it."""

    p: Parameters
    frame: Frame
    rays: Operands
    steps: Operands
    ray: Raw
    got: Operands

    def of_ray(self, values: Raw) -> Raw:
        """The sum over the steps of each ray."""
        return np.bincount(self.ray, values, count(self.rays)).astype(np.int64)

    @property
    def may_have_children(self) -> Holds:
        """Rays that are not the deepest."""
        return np.asarray(self.rays["depth"] < self.frame.max_depth)


def _drawn_settings(run: context.Context) -> Iterator[Settings]:
    """Seeded, without end."""
    generator, p = run.generator(0), run.parameters
    while True:
        lights = int(generator.integers(0, 1 << p["LIGHT_W"]))
        depth = int(generator.integers(1, 1 << p["DEPTH_W"]))
        mirrors, glass = (generator.random(2) < 0.8).tolist()
        yield Settings(lights, depth, mirrors, glass, int(generator.integers(1 << 32)))


async def _long_run(dut: Any, share: int, check: Callable[[Seen], Holds] | None = None) -> None:
    """Volume, back to back: seeded frames of all kinds; what is said of each ray must hold for all."""
    bench, run = await create(dut)
    p, number, all_steps = run.parameters, 0, 0
    for settings in _drawn_settings(run):
        frame, generator = settings.frame(p), run.generator(1, number)
        rays = drawn_rays(generator, frame, _PART, p)
        steps, ray = frame.steps(rays)
        await bench.load(frame.materials, frame.settings)
        seen = Seen(p, frame, rays, steps, ray, await run_rays(bench, frame, rays))
        if check is not None and (wrong := np.flatnonzero(~check(seen))).size:
            shown = describe_all(frames.rays(p), rays, int(wrong[0]))
            raise Mismatch(f"not so for {wrong.size} of {_PART} rays of {settings}, the first:\n{shown}")
        number, all_steps = number + 1, all_steps + count(steps)
        if all_steps >= run.operands // share:
            break
    bench.log.info("%d rays, %d steps checked", number * _PART, all_steps)


@cocotb.test()
async def a_long_run_matches_the_model(dut: Any) -> None:
    """Volume."""
    await _long_run(dut, share=5)


@cocotb.test()
async def every_bit_of_a_share_weighs(dut: Any) -> None:
    """All objects have the same shares, in which every other bit is 1, the others are, all, none."""
    bench, run = await create(dut)
    p = run.parameters
    most, deepest = selected(p).coeff.max, (1 << p["DEPTH_W"]) - 1
    plain = drawn_frame(run.generator(2), 1, deepest, True, True, p)
    for number, share in enumerate((most // 3, most - most // 3, most, 0)):
        shares = np.full_like(plain.materials.reflection, share)
        frame = replace(plain, materials=replace(plain.materials, reflection=shares, transparency=shares))
        await bench.load(frame.materials, frame.settings)
        got = await run_rays(bench, frame, drawn_rays(run.generator(3, number), frame, _PART // 4, p))
        assert bool(got["child_valid"].any()) == (share > 0), f"children with a share of {share}"


@cocotb.test()
async def a_ray_fills_or_settles_all_its_places_and_the_deepest_none(dut: Any) -> None:
    """A place a kind of child that the frame may have, over all steps of the ray, of the level below."""

    def check(seen: Seen) -> Holds:
        got = seen.got
        places = seen.frame.reflects + seen.frame.transmits
        ends = seen.of_ray(got["child_valid"] + got["settle_count"])
        level = seen.steps["depth"] + 1
        below = (got["child_valid"] == 0) | (got["child_depth"] == level)
        below &= (got["settle_valid"] == 0) | (got["settle_depth"] == level)
        right = (ends == np.where(seen.may_have_children, places, 0)) & (seen.of_ray(~below) == 0)
        return right & (seen.of_ray((got["settle_valid"] == 1) != (got["settle_count"] > 0)) == 0)

    await _long_run(dut, 20, check)


@cocotb.test()
async def a_rays_work_is_its_steps_and_children_and_the_first_step_tells_of_all_steps(dut: Any) -> None:
    """So no term of a step can end the pixel before the work of the others is known."""

    def check(seen: Seen) -> Holds:
        got, first = seen.got, seen.steps["step"] == 0
        steps = seen.of_ray(np.ones_like(seen.ray))
        told = seen.of_ray(np.where(first, got["more_count"] - got["child_valid"], 0)) == steps - 1
        whole = seen.of_ray(got["more_count"]) == steps - 1 + seen.of_ray(got["child_valid"])
        in_time = seen.of_ray((got["child_valid"] == 1) & (got["more_count"] < 1)) == 0
        return told & whole & in_time

    await _long_run(dut, 20, check)


@cocotb.test()
async def a_child_is_sent_where_a_channel_of_its_weight_is_not_below_the_least(dut: Any) -> None:
    """Of each kind once at most; the weight is exact in integers: a product reaches it or not."""

    def check(seen: Seen) -> Holds:
        hit = (seen.rays["hit"] == 1) & seen.may_have_children
        own, one = seen.rays["own"], selected(seen.p).coeff.one
        wanted = [
            hit & (seen.rays["weight"] * table[:, own] >= seen.p["MIN_WEIGHT"] * one).any(axis=0)
            for table in (seen.frame.materials.reflection, seen.frame.materials.transparency)
        ]
        sent = seen.got["child_valid"] == 1
        step = seen.steps["step"]
        found = [seen.of_ray(sent & (step == kind)) for kind in (0, 1)]
        none_else = seen.of_ray(sent & (step > 1)) == 0
        return (found[0] == wanted[0]) & (found[1] == wanted[1]) & none_else

    await _long_run(dut, 20, check)


@cocotb.test()
async def work_is_told_before_a_term_of_the_same_step_can_end(dut: Any) -> None:
    """What comes of a step here is earlier than what comes of it there."""
    bench, run = await create(dut)
    assert bench.latency < LATENCY["lighting"](run.parameters)
