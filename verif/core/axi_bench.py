"""Tests of `raytracer_axi` as a system would use it: cocotbext-axi's master, source and sink around it.

Every channel pauses at random; the pictures are those of the bit-exact model, the counters too.
"""

from dataclasses import replace
from pathlib import Path
from typing import Any

import cocotb
import numpy as np
from cocotb.triggers import First, Timer, with_timeout
from hypothesis import strategies as st

from models.core import Registers, Rendering, registers, render
from models.cores import CORES
from models.limits import MAX_DEPTH, Fault
from models.registers import Build
from models.scene.frame import pack
from models.scene.load import load
from models.scene.strategies import whole_scenes
from models.scene.types import Scene, Triangle, View
from verif.core import registers as wires
from verif.core.full import STRIPES, USUAL, full_scene
from verif.core.strategies import light_at_the_point
from verif.env import context, sources
from verif.env.axi import CoreAgents
from verif.env.block import holds, same
from verif.env.clocking import PERIOD_NS, Clocking
from verif.env.pipelined import Mismatch

_FMTS = CORES["default"].formats
_SCENES = sources.ROOT / "models" / "scenes"
_PATIENCE = 400_000
"""Clocks after which a frame that has not ended hangs: a small picture with every channel pausing."""
_ANGLE = 45.0
_SINCE_RESET = ("LIGHTS_AT_POINT", "DEGENERATE")
_COST = 10
"""A frame behind AXI ports takes so much longer than an operand of a unit."""


class AxiBench:
    """The core between the agents of an AXI system."""

    def __init__(self, dut: Any) -> None:
        self.run = context.read()
        self._dut = dut
        self.clocking = Clocking(dut)
        self.agents: CoreAgents

    @classmethod
    async def create(cls, dut: Any, share: float) -> "AxiBench":
        """A bench whose core has been reset; every channel pauses in a share of the clocks."""
        bench = cls(dut)
        dut.rst.value = 1
        for name in ("s_axil_awvalid", "s_axil_wvalid", "s_axil_arvalid", "s_axis_frame_tvalid"):
            getattr(dut, name).value = 0
        for name in ("s_axil_bready", "s_axil_rready", "m_axis_video_tready"):
            getattr(dut, name).value = 0
        await bench.clocking.cycles(3)
        bench.agents = CoreAgents.around(dut)
        dut.rst.value = 0
        await bench.clocking.cycles(2)
        if share:
            bench.agents.roll(bench.run.generator(1), share)
        return bench

    async def size(self, size: Registers) -> None:
        """Writes the registers of a view; they hold from the first frame behind a reset of the core."""
        port = self.agents.registers
        await port.set("SIZE", width=size.width, height=size.height)
        await port.set("TAN_H", value=size.tan_h)
        await port.set("TAN_V", value=size.tan_v)
        await port.set("DEPTH", value=size.depth)

    async def reset_core(self, auto: int = 1) -> None:
        """CONTROL.reset; what the agents held is forgotten."""
        await self.agents.registers.set("CONTROL", auto=auto, reset=1)
        await self.clocking.cycles(10)
        self.agents.video.clear()
        await self.agents.registers.set("INTERRUPT", done=1, error=1)

    async def interrupt(self) -> dict[str, int]:
        """Waits for `irq`; the events that have come, cleared."""
        irq = self._dut.irq
        if not int(irq.value):
            late = Timer(_PATIENCE * PERIOD_NS, "ns")
            if await First(irq.value_change, late) is late:
                raise Mismatch(f"no interrupt within {_PATIENCE} clocks")
        events = await self.agents.registers.get("INTERRUPT")
        await self.agents.registers.set("INTERRUPT", **events)
        same("irq when its events are cleared", 0, int(irq.value))
        return events

    async def picture(self, size: Registers) -> np.ndarray[Any, Any]:
        """The next picture; a hang fails."""
        taking = self.agents.video.picture(size.width, size.height)
        return await with_timeout(taking, _PATIENCE * PERIOD_NS, "ns")

    async def draws(self, scene: Scene, size: Registers) -> Rendering:
        """Sends a frame, takes its picture and its interrupt, and compares all of it with the model."""
        self.agents.frames.send(pack(scene).words)
        wanted = render(scene, size, _FMTS)
        got = await self.picture(size)
        same("pixels that differ", 0, int((got != wanted.rgb).any(axis=-1).sum()))
        same("events", {"done": 1, "error": 0}, await self.interrupt())
        for name in ("primary_rays", "secondary_rays", "shadow_rays", "tests"):
            found = (await self.agents.registers.get(name.upper()))["value"]
            same(f"register {name.upper()}", getattr(wanted.counts, name), found)
        same("error code", int(Fault.NONE), (await self.agents.registers.get("ERROR"))["code"])
        return wanted


def _view(width: int, height: int, depth: int = MAX_DEPTH) -> Registers:
    return replace(registers(View.square(width, height, _ANGLE), _FMTS), depth=depth)


def _scene(name: str) -> Scene:
    return load(Path(_SCENES / f"{name}.toml")).scene


def _left_out() -> Scene:
    """A light at the point that all pixels see, and as many triangles as there may be, none with an area."""
    scene = light_at_the_point(_FMTS)
    step = scene.camera.position[2]
    flat = Triangle(scene.spheres[0].material, ((0, 0, -step), (0, step, -step), (0, 2 * step, -step)))
    return replace(scene, triangles=(flat,) * Build().triangles)


@cocotb.test()
async def drawn_scenes_behind_pausing_ports_are_exact_and_counted(dut: Any) -> None:
    """Any scene, size and depth; a quarter of the clocks pauses on each of the seven channels."""
    bench = await AxiBench.create(dut, 0.25)
    await bench.agents.registers.set("INTERRUPT_ENABLE", done=1, error=1)

    async def example(scene: Scene, width: int, height: int, depth: int) -> None:
        size = _view(width, height, depth)
        await bench.size(size)
        await bench.reset_core()
        await bench.draws(scene, size)

    sides = st.integers(1, 8)
    depths = st.integers(1, MAX_DEPTH)
    await holds(bench.run, example, whole_scenes(), sides, st.integers(1, 6), depths, cost=_COST)


@cocotb.test()
async def frames_back_to_back_leave_in_order_and_each_interrupts(dut: Any) -> None:
    """Three scenes are sent at once; their pictures come one behind the other, whatever pauses."""
    bench = await AxiBench.create(dut, 0.5)
    size = _view(8, 6)
    await bench.size(size)
    await bench.agents.registers.set("INTERRUPT_ENABLE", done=1, error=1)
    scenes = [_scene(name) for name in ("three_spheres", "tetrahedron", "mirrors")]
    for scene in scenes:
        bench.agents.frames.send(pack(scene).words)
    for number, scene in enumerate(scenes):
        got = await bench.picture(size)
        same(f"picture {number}", 0, int((got != render(scene, size, _FMTS).rgb).sum()))
    same("events", {"done": 1, "error": 0}, await bench.interrupt())
    same("frames", len(scenes), (await bench.agents.registers.get("FRAMES"))["value"])


@cocotb.test()
async def a_refused_frame_interrupts_with_its_code_and_the_next_is_exact(dut: Any) -> None:
    """A frame that ends early, one whose sphere has no radius, one whose camera looks nowhere."""
    bench = await AxiBench.create(dut, 0.25)
    size, scene = _view(5, 4), _scene("one_sphere")
    await bench.size(size)
    await bench.agents.registers.set("INTERRUPT_ENABLE", done=1, error=1)
    flat = replace(scene, spheres=(replace(scene.spheres[0], radius=0),))
    blind = replace(scene, camera=replace(scene.camera, center=scene.camera.position))
    words = pack(scene).words
    faulty = {
        Fault.FRAME_SHORT: words[:-1],
        Fault.RADIUS: pack(flat).words,
        Fault.CAMERA_POSITION: pack(blind).words,
    }
    for fault, frame in faulty.items():
        bench.agents.frames.send(frame)
        same(f"events of {fault.name}", {"done": 0, "error": 1}, await bench.interrupt())
        same("error code", int(fault), (await bench.agents.registers.get("ERROR"))["code"])
        same("lines of a refused frame", 0, bench.agents.video.lines)
    await bench.draws(scene, size)


@cocotb.test()
async def every_register_is_behind_the_port(dut: Any) -> None:
    """All addresses and words of all kinds, a quarter of the clocks paused on each channel."""
    bench = await AxiBench.create(dut, 0.25)
    await wires.every_address(bench.agents.registers)
    await wires.every_word(bench.agents.registers)


@cocotb.test()
async def a_picture_without_a_size_is_refused_until_reset(dut: Any) -> None:
    """A width too large to count becomes 0: each frame interrupts with its code, whatever is written then."""
    bench = await AxiBench.create(dut, 0.0)
    size, scene = _view(5, 4), _scene("one_sphere")
    await bench.agents.registers.set("INTERRUPT_ENABLE", done=1, error=1)
    await bench.size(replace(size, width=1 << 12))
    for _ in range(2):
        bench.agents.frames.send(pack(scene).words)
        same("events", {"done": 0, "error": 1}, await bench.interrupt())
        same("error code", int(Fault.SIZE), (await bench.agents.registers.get("ERROR"))["code"])
        await bench.size(size)
    await bench.reset_core()
    await bench.draws(scene, size)


@cocotb.test()
async def what_is_left_out_is_counted_until_reset(dut: Any) -> None:
    """Triangles without area, and a light at the point that every pixel sees, over several frames."""
    bench = await AxiBench.create(dut, 0.0)
    size, scene = Registers(4, 3, 0, 0), _left_out()
    await bench.agents.registers.set("INTERRUPT_ENABLE", done=1, error=1)
    await bench.size(size)
    for _ in range(2):
        await bench.reset_core()
        for frame in range(1, 4):
            wanted = await bench.draws(scene, size)
            same("lights left out of a frame", size.width * size.height, wanted.counts.lights_at_point)
            found = [(await bench.agents.registers.get(name))["value"] for name in _SINCE_RESET]
            same(f"{_SINCE_RESET}", [frame * wanted.counts.lights_at_point, frame * wanted.degenerate], found)


@cocotb.test()
async def all_that_the_core_holds_in_more_pixels_than_are_in_flight_is_exact(dut: Any) -> None:
    """Every object is seen, in usual colours and in large ones; primary rays wait for room."""
    bench = await AxiBench.create(dut, 0.0)
    size = _view(12, 12, depth=3)
    await bench.agents.registers.set("INTERRUPT_ENABLE", done=1, error=1)
    await bench.size(size)
    capacity = CORES["default"].capacity
    for values in (USUAL, STRIPES):
        wanted = await bench.draws(full_scene(capacity, values), size)
        seen = np.unique(wanted.hit[wanted.hit >= 0]).tolist()
        same("objects seen", list(range(capacity.spheres + capacity.triangles)), seen)


@cocotb.test()
async def without_auto_a_frame_waits_for_start(dut: Any) -> None:
    """Nothing is drawn before CONTROL.start, one frame for each."""
    bench = await AxiBench.create(dut, 0.0)
    size, scene = _view(4, 3), _scene("tilted")
    await bench.size(size)
    await bench.agents.registers.set("CONTROL", auto=0)
    bench.agents.frames.send(pack(scene).words)
    bench.agents.frames.send(pack(scene).words)
    wanted = render(scene, size, _FMTS).rgb
    for _ in range(2):
        await bench.clocking.cycles(3000)
        same("lines before start", 0, bench.agents.video.lines)
        same("busy before start", 0, (await bench.agents.registers.get("STATUS"))["busy"])
        await bench.agents.registers.set("CONTROL", auto=0, start=1)
        same("pixels that differ", 0, int((await bench.picture(size) != wanted).sum()))


@cocotb.test()
async def reset_of_the_core_at_any_moment_leaves_the_next_frame_exact(dut: Any) -> None:
    """CONTROL.reset while a frame is loaded, set up or drawn; registers keep their values."""
    bench = await AxiBench.create(dut, 0.0)
    await bench.agents.registers.set("INTERRUPT_ENABLE", done=1, error=1)
    size, scene = _view(8, 6), _scene("three_spheres")
    await bench.size(size)

    async def example(wait: int) -> None:
        await bench.reset_core()
        bench.agents.frames.send(pack(scene).words)
        await bench.clocking.cycles(wait)
        # The source must not send the rest of its frame into the core behind the reset.
        bench.agents.frames.clear()
        dut.rst.value = 1
        await bench.clocking.cycles(2)
        dut.rst.value = 0
        await bench.clocking.cycles(2)
        bench.agents.video.clear()
        await bench.agents.registers.set("INTERRUPT_ENABLE", done=1, error=1)
        await bench.size(size)
        await bench.draws(scene, size)

    await holds(bench.run, example, st.integers(0, 4000), cost=_COST)
