"""Tests of frames behind each other: what each of them takes with it, and what holds for all."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import cocotb
import numpy as np
from cocotb.utils import get_sim_time
from hypothesis import strategies as st

from models.core import Registers
from models.scene.types import Scene, View
from verif.core.driver import CoreDriver
from verif.core.full import STRIPES, USUAL, full_scene
from verif.core.job import LARGEST
from verif.core.setting import Setting
from verif.core.strategies import Shot, depths
from verif.env.block import holds, same
from verif.env.pipelined import Mismatch


async def send_all(core: CoreDriver, frames: Sequence[Sequence[int]]) -> None:
    """Frames one behind the other."""
    for words in frames:
        await core.send(words)


async def busy(setting: Setting, dut: Any) -> None:
    """Waits until a frame's set-up begins."""
    while not setting.core.busy:
        await setting.soon(once(dut.busy), setting.clocks())
    await setting.core.clocking.edge


async def once(signal: Any) -> None:
    """Waits for a change of a signal."""
    await signal.value_change


@cocotb.test()
async def frames_back_to_back_are_each_exact(dut: Any) -> None:
    """The next frame's words are offered while one is drawn, with no reset between."""
    setting = Setting.of(dut)

    async def example(shot: Shot, others: list[Scene]) -> None:
        core = setting.core
        shots = [replace(shot, scene=scene) for scene in (shot.scene, *others)]
        await core.reset(shot.registers)
        core.take(True)
        sender = cocotb.start_soon(send_all(core, [setting.words(frame.scene) for frame in shots]))
        drawn = []
        for frame in shots:
            got = await setting.collected(frame, core.collect())
            drawn.append(setting.same_picture(frame, got))
        await sender
        # A frame behind the last one would be set up by now: its triangles would be counted.
        setting.same_since_reset(*drawn)

    others = st.lists(setting.any_scene(), min_size=1, max_size=3)
    await holds(setting.run, example, setting.shots(), others)


@cocotb.test()
async def the_next_frame_is_loaded_while_one_is_drawn(dut: Any) -> None:
    """Its last word is taken before the first picture's last pixel; the third frame waits until it may."""
    setting = Setting.of(dut)
    core = setting.core
    shot = await setting.example(16, 16)
    words = setting.words(shot.scene)
    core.take(True)
    loaded: list[float] = []
    drawn: list[float] = []

    async def send() -> None:
        for _ in range(3):
            await core.send(words)
            loaded.append(get_sim_time("ns"))

    sender = cocotb.start_soon(send())
    for _ in range(3):
        setting.same_picture(shot, await setting.collected(shot, core.collect()))
        drawn.append(get_sim_time("ns"))
    await sender
    assert loaded[1] < drawn[0], "the second frame was not loaded while the first was drawn"
    assert drawn[0] < loaded[2] < drawn[1], "the third frame was not loaded while the second was drawn"


@cocotb.test()
async def size_and_view_hold_from_the_first_frame_until_reset(dut: Any) -> None:
    """Registers that change behind the set-up's first clock change nothing; after reset they do."""
    setting = Setting.of(dut)
    core = setting.core
    first, other = Registers(4, 3, 30000, 20000), Registers(3, 2, 70000, 50000)
    scene = (await setting.example(4, 3)).scene
    shot, changed = Shot(scene, first, None), Shot(scene, other, None)
    await core.reset(first)
    core.take(True)
    cocotb.start_soon(core.send(setting.words(scene)))
    await busy(setting, dut)
    core.registers(other)
    setting.same_picture(shot, await setting.collected(shot, core.collect()))
    setting.same_picture(shot, await setting.draw(shot))
    await core.reset(other)
    setting.same_picture(changed, await setting.draw(changed))


@cocotb.test()
async def pictures_of_the_largest_sides_are_exact(dut: Any) -> None:
    """One row of as many columns as there can be, and one column of as many rows.

    The camera stands along the axes, so that a remainder is that of the tangent: of almost all ones.
    """
    setting = Setting.of(dut)
    scene = (await setting.example(4, 3)).scene
    scale = setting.design.formats.span.frac_bits - setting.design.formats.tan.frac_bits
    tangent = (8 * LARGEST - 1) >> scale
    for width, height in ((LARGEST, 1), (1, LARGEST)):
        shot = Shot(scene, Registers(width, height, tangent, tangent, depth=1), None)
        await setting.core.reset(shot.registers)
        setting.same_picture(shot, await setting.draw(shot))


@cocotb.test()
async def frames_of_all_objects_in_colours_of_any_bits_are_exact(dut: Any) -> None:
    """Every object that the core holds is seen, lit and casts rays, the last too; lights are near and far."""
    setting = Setting.of(dut)
    capacity = setting.design.capacity
    view = View.square(12, 12, 60)
    for values in (USUAL, STRIPES, STRIPES[1:], STRIPES[:1]):
        shot = Shot(full_scene(capacity, values), setting.registers(view, 3), view)
        await setting.core.reset(shot.registers)
        wanted = setting.same_picture(shot, await setting.draw(shot))
        hits = wanted.hit[wanted.hit >= 0]
        same("objects seen", list(range(capacity.spheres + capacity.triangles)), np.unique(hits).tolist())
        assert wanted.counts.secondary_rays >= 2 * hits.size, "not every hit casts two rays"


@cocotb.test()
async def each_frame_takes_the_depth_of_its_own_start(dut: Any) -> None:
    """The register changes while a frame is drawn: that frame keeps its depth, the next one has the new."""
    setting = Setting.of(dut)
    core = setting.core

    async def example(shot: Shot, other: Scene, behind: int) -> None:
        following = Shot(other, replace(shot.registers, depth=behind), None)
        await core.reset(shot.registers)
        core.take(True)
        words = [setting.words(frame.scene) for frame in (shot, following)]
        sender = cocotb.start_soon(send_all(core, words))
        await busy(setting, dut)
        core.registers(following.registers)
        for frame in (shot, following):
            setting.same_picture(frame, await setting.collected(frame, core.collect()))
        await sender

    await holds(setting.run, example, setting.shots(), setting.any_scene(), depths())


@cocotb.test()
async def go_holds_a_frame_back_but_not_one_that_is_drawn(dut: Any) -> None:
    """While `go` is low a frame is read and no more; it is drawn when `go` comes, with what is set then."""
    setting = Setting.of(dut)
    core = setting.core

    async def example(shot: Shot, held: int, depth: int) -> None:
        deeper = replace(shot, registers=replace(shot.registers, depth=depth))
        await core.reset(shot.registers)
        core.take(True)
        core.go(False)
        await core.send(setting.words(shot.scene))
        await core.wait(held)
        same("busy while go is low", False, core.busy)
        core.registers(deeper.registers)
        core.go(True)
        await busy(setting, dut)
        core.go(False)
        sender = cocotb.start_soon(core.send(setting.words(shot.scene)))
        setting.same_picture(deeper, await setting.collected(deeper, core.collect()))
        await core.wait(held)
        same("busy behind the frame while go is low", False, core.busy)
        core.go(True)
        setting.same_picture(deeper, await setting.collected(deeper, core.collect()))
        await sender

    held = st.integers(0, 40) | st.integers(0, 1000)
    await holds(setting.run, example, setting.shots(), held, depths(), cost=2)


@cocotb.test()
async def the_counters_of_a_frame_hold_until_the_next_one(dut: Any) -> None:
    """A frame that is read while another is drawn, or waits for `go`, does not touch them."""
    setting = Setting.of(dut)
    core = setting.core
    shot = await setting.example(8, 6, "three_spheres")
    got = await setting.draw(shot)
    setting.same_picture(shot, got)
    await core.wait(100)
    core.go(False)
    await core.send(setting.words(shot.scene))
    await core.wait(100)
    same("counters", got.counts, core.counts)
    core.go(True)
    again = await setting.collected(shot, core.collect())
    setting.same_picture(shot, again)
    if not 0 < got.cycles < got.latency:
        raise Mismatch(f"{got.cycles} clocks of {got.latency} from the first word to the last pixel")
