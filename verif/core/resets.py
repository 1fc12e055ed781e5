"""Tests of reset where draws seldom fall: at every change of the control's and the loader's state."""

from typing import Any

import cocotb

from verif.core.frames import send_all
from verif.core.setting import Setting
from verif.env import resets
from verif.env.block import same
from verif.env.pipelined import Mismatch

_BETWEEN = 16
"""Clocks from one reset to the next where no state changes."""


@cocotb.test()
async def reset_in_every_state_of_control_and_loader_leaves_a_core_as_new(dut: Any) -> None:
    """One clock of reset around each change of state, and between; of two frames behind each other. The next
    frame is exact.
    """
    setting = Setting.of(dut)
    core = setting.core
    shot = await setting.example(4, 3, "shadows")
    words = setting.words(shot.scene)
    watched = {"control.v": dut.control_state, "scene/loader.v": dut.load_section}
    names = {file: resets.states(file) for file in watched}

    async def begin() -> Any:
        """A frame that is drawn, then one with a word too many."""
        await core.reset(shot.registers)
        core.take(True)
        return cocotb.start_soon(send_all(core, [words, (*words, 0)]))

    def now() -> tuple[str, ...]:
        return tuple(names[file][int(signal.value)] for file, signal in watched.items())

    sender = await begin()
    ends = cocotb.start_soon(core.collect())
    trace: list[tuple[str, ...]] = []
    while not ends.done() and len(trace) < setting.clocks(setting.expected(shot)):
        await core.clocking.edge
        trace.append(now())
    sender.cancel()
    ends.cancel()
    moments = sorted({*resets.edges(trace), *range(0, len(trace), _BETWEEN)})
    for moment in moments:
        sender = await begin()
        await core.clocking.cycles(moment + 1)
        same(f"state {moment + 1} clocks behind the start", trace[moment], now())
        sender.cancel()
        await core.reset(shot.registers)
        same(f"busy behind reset in {trace[moment]}", False, core.busy)
        setting.same_since_reset(setting.same_picture(shot, await setting.draw(shot)))
    for place, (file, states) in enumerate(names.items()):
        never = set(states.values()) - {trace[moment][place] for moment in moments}
        if never:
            raise Mismatch(f"{file}: never reset in {', '.join(never)}")
    dut._log.info("reset at %d of %d clocks", len(moments), len(trace))
