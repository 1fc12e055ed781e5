"""Tests of room: a tree in which every hit splits, all pixels in flight, and a consumer that does not come.

What a ray, a step or a term needs is reserved before it starts; `core_watch` holds the core to that in every
clock of every test. Here the core runs into each limit and must come out again.
"""

from dataclasses import replace
from typing import Any

import cocotb
from hypothesis import strategies as st

from models.core import Counts
from models.limits import MAX_DEPTH
from models.scene.types import View
from verif.core.setting import Setting
from verif.core.strategies import Shot, depths, splitting
from verif.env.block import holds, same
from verif.env.pipelined import Mismatch

_STALL = 20_000
"""Clocks in which nothing may happen any more where no pixel is taken."""
_LOOK = 1_000
"""Clocks between two looks at whether something happens; far more than a ray takes."""
_SIDES = {4: (4, 3), 16: (8, 6), 512: (32, 20)}
"""Pictures of more pixels than there are slots."""


def _shot(setting: Setting, width: int, height: int, depth: int = MAX_DEPTH) -> Shot:
    view = View.square(width, height, 70)
    return Shot(splitting(setting.design.capacity), setting.registers(view, depth), view)


async def _standing(setting: Setting, most: int) -> Counts:
    """The core's counters when nothing has happened for a while. Mismatch after that many clocks."""
    before = setting.core.counts
    for _ in range(most // _LOOK):
        await setting.core.wait(_LOOK)
        now = setting.core.counts
        if now == before and now.primary_rays:
            return now
        before = now
    raise Mismatch(f"the core still works after {most} clocks: {before}")


@cocotb.test()
async def every_hit_splits_and_no_pixel_is_taken_for_long(dut: Any) -> None:
    """All slots fill with finished trees, then nothing moves; drained, every pixel is there and exact."""
    setting = Setting.of(dut)
    core = setting.core
    shot = _shot(setting, *_SIDES[setting.slots])
    wanted = setting.expected(shot)
    pixels = wanted.counts.primary_rays
    same("secondary rays", pixels * (2**MAX_DEPTH - 2), wanted.counts.secondary_rays)
    assert pixels > setting.slots + 2, "the picture does not fill the slots"
    await core.reset(shot.registers)
    core.take(False)
    await core.send(setting.words(shot.scene))
    standing = await _standing(setting, setting.clocks(wanted))
    # One pixel may wait at the output beside those that have slots.
    same("pixels in flight", True, setting.slots <= standing.primary_rays <= setting.slots + 1)
    same("secondary rays of them", standing.primary_rays * (2**MAX_DEPTH - 2), standing.secondary_rays)
    await core.wait(_STALL)
    same("counters behind a long stall", standing, core.counts)
    core.take(True)
    got = await setting.collected(shot, core.collect())
    setting.same_picture(shot, got)
    dut._log.info("%d clocks, waited for: %s", got.cycles, ", ".join(core.waits))
    places = {f"places for rays of depth {depth}" for depth in range(2, MAX_DEPTH + 1)}
    needed = {"free pixels"} | (places if setting.small else set())
    assert needed <= set(core.waits), f"never waited for: {needed - set(core.waits)}"


@cocotb.test()
async def a_consumer_that_comes_and_goes_loses_no_pixel_of_a_tree(dut: Any) -> None:
    """Pixels are taken for some clocks, then not for some, over and over, while trees are traced."""
    setting = Setting.of(dut)
    core = setting.core

    async def come_and_go(spells: list[tuple[int, int]]) -> None:
        while True:
            for away, there in spells:
                core.take(False)
                await core.wait(away)
                core.take(True)
                await core.wait(there)

    async def example(side: int, depth: int, spells: list[tuple[int, int]]) -> None:
        shot = _shot(setting, *((4, 3) if side else (2, 2)), depth)
        await core.reset(shot.registers)
        consumer = cocotb.start_soon(come_and_go(spells))
        await core.send(setting.words(shot.scene))
        pixels = shot.registers.width * shot.registers.height
        spare = pixels * sum(away for away, _ in spells)
        got = await setting.collected(shot, core.collect(), spare)
        consumer.cancel()
        setting.same_picture(shot, got)

    spell = st.tuples(st.integers(0, 3) | st.integers(0, 3000), st.integers(1, 5))
    spells = st.lists(spell, min_size=1, max_size=4)
    await holds(setting.run, example, st.integers(0, 1), depths(), spells, cost=2)


@cocotb.test()
async def frames_behind_a_tree_find_every_place_free(dut: Any) -> None:
    """Trees of every depth behind each other, without a reset, end with all places given back."""
    setting = Setting.of(dut)
    first = _shot(setting, 4, 3)
    await setting.core.reset(first.registers)
    for depth in (MAX_DEPTH, 1, 3, 2, MAX_DEPTH):
        shot = replace(first, registers=replace(first.registers, depth=depth))
        setting.core.registers(shot.registers)
        setting.same_picture(shot, await setting.draw(shot))
    same("promises broken", [], setting.core.breaches)
