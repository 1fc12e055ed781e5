"""Tests of speed, at a size where set-up is a small part; `make render` tells the figures of any picture."""

from typing import Any

import cocotb

from verif.core.setting import Setting
from verif.env.block import same


@cocotb.test()
async def one_sphere_and_one_light_take_about_a_clock_a_pixel(dut: Any) -> None:
    """At most 1.1 clocks a pixel from the first word of the frame to the last pixel."""
    setting = Setting.of(dut)
    side = setting.rate_size
    shot = await setting.example(side, side)
    got = await setting.draw(shot)
    setting.same_picture(shot, got)
    each = got.latency / (side * side)
    dut._log.info("%d x %d: %d clocks, %.3f a pixel", side, side, got.latency, each)
    assert each <= 1.1, f"{each:.3f} clocks a pixel"


@cocotb.test()
async def three_spheres_keep_the_trace_units_busy(dut: Any) -> None:
    """The book's second timing scene, with mirrors: at most 12 clocks a pixel, 4 of 5 clocks of the units
    test a ray against an object."""
    setting = Setting.of(dut)
    side = setting.rate_size
    shot = await setting.example(side, side, "three_spheres")
    got = await setting.draw(shot)
    setting.same_picture(shot, got)
    each = got.latency / (side * side)
    useful = got.counts.tests / (setting.units * got.cycles)
    dut._log.info("%d x %d: %.3f clocks a pixel, %.3f tests a unit's clock", side, side, each, useful)
    assert each <= 12, f"{each:.3f} clocks a pixel"
    assert useful >= 0.8, f"{useful:.3f} tests a unit's clock"


@cocotb.test()
async def a_frame_takes_the_same_clocks_whenever_it_is_drawn_after_reset(dut: Any) -> None:
    """Nothing that was there before the reset changes how long a frame takes."""
    setting = Setting.of(dut)
    clocks = set()
    for before in ("three_spheres", "mirrors", "glass"):
        other = await setting.example(8, 6, before)
        setting.same_picture(other, await setting.draw(other))
        shot = await setting.example(16, 12, "shadows")
        got = await setting.draw(shot)
        setting.same_picture(shot, got)
        clocks.add((got.latency, got.cycles))
    same("numbers of clocks", 1, len(clocks))
