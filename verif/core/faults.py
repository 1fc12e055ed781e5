"""Tests of what goes wrong: frames that are refused, and reset in the middle of one."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import cocotb
import numpy as np
from hypothesis import strategies as st

from models.core import Registers
from models.limits import Fault
from models.scene.frame import Frame, check, unpack
from models.scene.types import View
from verif.core.frames import once, send_all
from verif.core.setting import Setting
from verif.core.strategies import (
    FAULTS,
    FaultyFrame,
    Shot,
    counter_bits,
    faulty_frames,
    flipped,
    splitting,
)
from verif.env.block import holds, same

_ENOUGH_EXAMPLES = 50


def verdict(setting: Setting, words: Sequence[int], registers: Registers) -> Fault:
    """The fault of a frame: the loader's first, then the size's, then the camera's."""
    fault = check(words, setting.design.counters)
    behind_size = fault in (Fault.NONE, Fault.CAMERA_POSITION, Fault.CAMERA_UP)
    return Fault.SIZE if behind_size and not (registers.width and registers.height) else fault


@cocotb.test()
async def every_fault_anywhere_is_told_by_its_code_and_draws_nothing(dut: Any) -> None:
    """Each fault at drawn places, some more in a row; then a good frame is drawn exactly."""
    setting = Setting.of(dut)
    core = setting.core

    async def example(first: FaultyFrame, others: list[FaultyFrame], shot: Shot) -> None:
        await core.reset(shot.registers)
        for frame in (first, *others):
            same("the model's verdict", frame.fault, verdict(setting, frame.words, shot.registers))
            got = await setting.refused(frame.words)
            same(f"{len(frame.words)} words", (frame.fault, 0), (got.fault, len(got.rgb)))
            same(f"busy behind {frame.fault.name}", False, core.busy)
        setting.same_since_reset(setting.same_picture(shot, await setting.draw(shot)))

    counters = setting.design.counters
    others = st.lists(faulty_frames(counters), max_size=2)
    for fault in FAULTS:
        faulty = faulty_frames(counters, (fault,))
        await holds(setting.run, example, faulty, others, setting.shots(), cost=len(FAULTS))


@cocotb.test()
async def a_picture_without_a_size_is_a_fault_of_every_frame_until_reset(dut: Any) -> None:
    """SIZE comes before the camera's own faults and behind the loader's."""
    setting = Setting.of(dut)
    core = setting.core

    async def example(shot: Shot, side: str, frame: FaultyFrame) -> None:
        none = replace(shot.registers, **{side: 0})
        await core.reset(none)
        for words in (setting.words(shot.scene), frame.words):
            got = await setting.refused(words)
            same("fault and pixels", (verdict(setting, words, none), 0), (got.fault, len(got.rgb)))
        await core.reset(shot.registers)
        setting.same_picture(shot, await setting.draw(shot))

    sides = st.sampled_from(("width", "height"))
    await holds(setting.run, example, setting.shots(), sides, faulty_frames(setting.design.counters), cost=5)


@cocotb.test()
async def a_faulty_frame_behind_a_good_one_leaves_its_picture_alone(dut: Any) -> None:
    """The fault is told while the picture is drawn, and every pixel of the picture still comes, exact."""
    setting = Setting.of(dut)
    core = setting.core
    shot = await setting.example(16, 16)
    radius_0 = replace(shot.scene.spheres[0], radius=0)
    scene = replace(shot.scene, background=(0, 0, 0), spheres=(radius_0,))
    core.take(True)
    await core.send(setting.words(shot.scene))
    await setting.soon(once(dut.m_axis_video_tvalid), setting.clocks())
    sender = cocotb.start_soon(core.send(setting.words(scene)))
    before = await setting.collected(shot, core.collect())
    same("fault", Fault.RADIUS, before.fault)
    behind = await setting.collected(shot, core.collect())
    await sender
    assert len(before.rgb), "the fault was not told while the picture was drawn"
    rgb, hit = np.concatenate([before.rgb, behind.rgb]), np.concatenate([before.hit, behind.hit])
    setting.same_picture(shot, replace(behind, rgb=rgb, hit=hit))
    setting.same_picture(shot, await setting.draw(shot))


@cocotb.test()
async def flipped_bits_give_the_picture_they_describe_or_the_right_fault(dut: Any) -> None:
    """Any frame, any bits flipped, cut or continued: never a hang; the next frame is exact."""
    setting = Setting.of(dut)
    counters = setting.design.counters
    anywhere = st.integers(0, 32 * 32)
    counts = st.sampled_from(counter_bits(counters))
    bits: st.SearchStrategy[list[int]] = (
        st.just([]) | st.lists(anywhere, max_size=4) | st.lists(counts, max_size=2)
    )
    seen: Counter[str] = Counter()

    async def example(shot: Shot, flips: list[int], surplus: int) -> None:
        words = flipped(setting.words(shot.scene), flips)
        words = words[:surplus] or words[:1] if surplus < 0 else (*words, *range(surplus))
        await setting.core.reset(shot.registers)
        fault = verdict(setting, words, shot.registers)
        seen[fault.name] += 1
        if fault is Fault.NONE:
            told = replace(shot, scene=unpack(Frame(words), counters))
            setting.same_picture(told, await setting.collected(told, setting.core.draw(words)))
        else:
            got = await setting.refused(words)
            same("fault and pixels", (fault.name, 0), (got.fault.name, len(got.rgb)))
        setting.same_picture(shot, await setting.draw(shot))

    await holds(setting.run, example, setting.shots(), bits, st.just(0) | st.integers(-3, 3))
    dut._log.info("frames by fault: %s", dict(seen))
    if setting.run.examples >= _ENOUGH_EXAMPLES:
        assert seen[Fault.NONE.name] and len(seen) > 3, f"only seen: {dict(seen)}"


@cocotb.test()
async def reset_at_any_clock_leaves_a_core_as_new(dut: Any) -> None:
    """While a frame is loaded, set up, drawn or drained, pixels taken or not; the next frame is exact."""
    setting = Setting.of(dut)
    core = setting.core

    async def example(before: Shot, again: bool, taken: bool, wait: int, after: Shot) -> None:
        await core.reset(before.registers)
        core.take(taken)
        words = setting.words(before.scene)
        sender = cocotb.start_soon(send_all(core, [words, words] if again else [words]))
        await core.wait(wait)
        sender.cancel()
        await core.reset(after.registers)
        same("busy behind reset", False, core.busy)
        setting.same_since_reset(setting.same_picture(after, await setting.draw(after)))

    flag, moments = st.booleans(), st.integers(0, 1500)
    await holds(setting.run, example, setting.shots(), flag, flag, moments, setting.shots())


@cocotb.test()
async def reset_with_rays_of_every_depth_under_way_leaves_a_core_as_new(dut: Any) -> None:
    """In the middle of trees in which every hit splits, at clocks of the seed; the next one is exact."""
    setting = Setting.of(dut)
    core = setting.core
    view = View.square(8, 6, 70)
    scene = splitting(setting.design.capacity)
    tree = Shot(scene, setting.registers(view), view)
    leaf = Shot(scene, replace(tree.registers, width=2, height=2), None)
    await core.reset(tree.registers)
    whole = setting.same_picture(tree, await setting.draw(tree))
    drawing = core.cycles
    random = setting.run.generator(0)
    for part in random.uniform(0.3, 0.95, max(1, setting.run.examples // 3)):
        await core.reset(tree.registers)
        core.take(bool(random.integers(2)))
        sender = cocotb.start_soon(core.send(setting.words(scene)))
        await core.wait(round(part * drawing))
        await sender
        under_way = core.counts.secondary_rays
        assert 0 < under_way < whole.counts.secondary_rays, f"{under_way} secondary rays: nothing to reset"
        await core.reset(leaf.registers)
        same("busy behind reset", False, core.busy)
        setting.same_since_reset(setting.same_picture(leaf, await setting.draw(leaf)))
