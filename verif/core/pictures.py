"""Tests of single frames: any scene against the bit-exact model, pixel by pixel and counter by counter."""

from collections import Counter
from dataclasses import replace
from typing import Any

import cocotb
import numpy as np
from hypothesis import strategies as st

from models.core import Registers, Rendering
from models.limits import MAX_DEPTH
from models.scene.meshes import PinHole
from models.scene.strategies import pin_holes
from models.scene.types import Scene, Triangle, View
from verif.core.setting import Setting
from verif.core.strategies import Shot, depths, light_at_the_point, splitting, without_area
from verif.env.block import holds, same
from verif.env.pipelined import Mismatch

_ENOUGH_EXAMPLES = 300
_ENOUGH_WAITING = 100
_PIN_HOLE_SIZES = ((8, 6), (24, 18))
_FINE_PICTURES = 48
"""Most pixels of the drawn pictures of a run that has time for larger ones of meshes."""


def classes(shot: Shot, wanted: Rendering) -> set[str]:
    """What is special about a picture."""
    spheres, counts = len(shot.scene.spheres), wanted.counts
    found = {
        f"depth {shot.registers.depth}": True,
        "sphere hit": bool(((wanted.hit >= 0) & (wanted.hit < spheres)).any()),
        "triangle hit": bool((wanted.hit >= spheres).any()),
        "miss": bool((wanted.hit < 0).any()),
        "full channel": bool((wanted.rgb == 255).any()),
        "shade of grey": bool(((wanted.rgb > 0) & (wanted.rgb < 255)).any()),
        "no object": not shot.scene.objects,
        "no light": not shot.scene.lights,
        "shadow ray": counts.shadow_rays > 0,
        "secondary ray": counts.secondary_rays > 0,
        "more secondary rays than pixels": counts.secondary_rays > counts.primary_rays,
        "light at the hit point": counts.lights_at_point > 0,
        "triangle without area": wanted.degenerate > 0,
    }
    return {name for name, there in found.items() if there}


CLASSES = {f"depth {depth}" for depth in range(1, MAX_DEPTH + 1)} | {
    "sphere hit",
    "triangle hit",
    "miss",
    "full channel",
    "shade of grey",
    "no light",
    "shadow ray",
    "secondary ray",
    "more secondary rays than pixels",
}
"""Without these the pictures drawn would prove little. Rarer ones have tests of their own."""

SCARCE = {f"places for rays of depth {depth}" for depth in range(2, MAX_DEPTH + 1)} | {"free pixels"}
"""What a build of few slots and places must have waited for, or it proves no more than the usual one."""


@cocotb.test()
async def every_drawn_scene_is_exact_in_every_pixel_hit_and_counter(dut: Any) -> None:
    """Any scene, any view, any depth, from reset; what the core had to wait for is told in the log."""
    setting = Setting.of(dut)
    seen: Counter[str] = Counter()
    waits: Counter[str] = Counter()
    scenes: set[Scene] = set()

    async def example(shot: Shot) -> None:
        await setting.core.reset(shot.registers)
        wanted = setting.same_picture(shot, await setting.draw(shot))
        setting.same_since_reset(wanted)
        scenes.add(shot.scene)
        seen.update(classes(shot, wanted))
        waits.update(setting.core.waits)

    await holds(replace(setting.run, examples=setting.scenes), example, setting.shots())
    dut._log.info("%d scenes, pictures by class: %s", len(scenes), dict(seen))
    dut._log.info("pictures that waited for: %s", dict(waits))
    assert len(scenes) >= setting.scenes // 2, f"only {len(scenes)} different scenes"
    if setting.scenes >= _ENOUGH_EXAMPLES:
        assert seen.keys() >= CLASSES, f"never drawn: {CLASSES - seen.keys()}"
    if setting.scenes >= _ENOUGH_WAITING and setting.small:
        assert waits.keys() >= SCARCE, f"never waited for: {SCARCE - waits.keys()}"


@cocotb.test()
async def a_light_at_the_hit_point_is_left_out_and_counted(dut: Any) -> None:
    """All pixels look along one axis, at the point of the sphere where the light is: ambient light alone."""
    setting = Setting.of(dut)
    size = Registers(3, 2, 0, 0)
    await setting.core.reset(size)
    shot = Shot(light_at_the_point(setting.design.formats), size, None)
    got = await setting.draw(shot)
    setting.same_picture(shot, got)
    same("colours", [[127, 63, 255]] * 6, got.rgb.tolist())
    same("lights left out", 6, setting.core.counts.lights_at_point)


@cocotb.test()
async def triangles_without_area_are_left_out_and_counted(dut: Any) -> None:
    """The picture is that of the scene without them, wherever they stand among the triangles."""
    setting = Setting.of(dut)
    most = setting.design.capacity.triangles

    async def example(shot: Shot, flat: list[Triangle], place: int) -> None:
        full = shot.scene.triangles[: most - len(flat)]
        bare = replace(shot, scene=replace(shot.scene, triangles=full))
        place %= len(full) + 1
        mixed = (*full[:place], *flat, *full[place:])
        shot = replace(shot, scene=replace(shot.scene, triangles=mixed))
        await setting.core.reset(shot.registers)
        got = await setting.draw(shot)
        setting.same_since_reset(setting.same_picture(shot, got))
        without = setting.expected(bare)
        same("colours", without.rgb.reshape(-1, 3).tolist(), got.rgb.tolist())
        same("triangles without area", without.degenerate + len(flat), setting.core.degenerate)

    flat = st.lists(without_area(), min_size=1, max_size=3)
    await holds(setting.run, example, setting.shots(), flat, st.integers(0, most))


@cocotb.test()
async def what_a_frame_lacks_is_not_taken_from_the_frames_before_it(dut: Any) -> None:
    """Frames without light, spheres, triangles, behind frames that filled both banks of the memory."""
    setting = Setting.of(dut)
    full = await setting.example(8, 6, "shadows")
    scenes = [
        full.scene,
        full.scene,
        replace(full.scene, lights=()),
        replace(full.scene, spheres=()),
        replace(full.scene, triangles=()),
        replace(full.scene, spheres=(), triangles=()),
        full.scene,
    ]
    shots = [replace(full, scene=scene) for scene in scenes]
    pictures = [setting.same_picture(shot, await setting.draw(shot)).rgb for shot in shots]
    assert len(np.unique(pictures, axis=0)) == 5, "frames look alike: that shows nothing"


@cocotb.test()
async def rays_are_followed_to_the_depth_of_the_register_and_no_deeper(dut: Any) -> None:
    """A tree in which every hit splits: 2, 6, 14, 30 secondary rays a pixel at depths 2, 3, 4, 5."""
    setting = Setting.of(dut)
    scene = splitting(setting.design.capacity)
    view = View.square(2, 2, 60)
    for depth in range(1, MAX_DEPTH + 1):
        shot = Shot(scene, setting.registers(view, depth), view)
        await setting.core.reset(shot.registers)
        wanted = setting.same_picture(shot, await setting.draw(shot))
        same(f"secondary rays at depth {depth}", 4 * (2**depth - 2), wanted.counts.secondary_rays)


@cocotb.test()
async def nothing_is_seen_through_a_closed_mesh(dut: Any) -> None:
    """Shared-edge triangles before a wall, the camera aimed at a corner, an edge or a face of them."""
    setting = Setting.of(dut)
    sizes = st.sampled_from(_PIN_HOLE_SIZES if setting.most_pixels >= _FINE_PICTURES else _PIN_HOLE_SIZES[:1])

    async def example(scene: PinHole, size: tuple[int, int], angle: int, depth: int) -> None:
        view = View.square(*size, angle)
        shot = Shot(scene.scene, setting.registers(view, depth), view)
        await setting.core.reset(shot.registers)
        got = await setting.draw(shot)
        setting.same_picture(shot, got)
        picture = got.rgb.reshape(size[1], size[0], 3)
        # A back that is seen may be as near as the front, but for rounding: thin corners.
        leaks = scene.seen_through(picture, view) & (picture != PinHole.HIDDEN_COLOUR).any(axis=-1)
        if leaks.any():
            raise Mismatch(f"{leaks.sum()} pixels look through the mesh of {scene.scene}")

    most = min(15, setting.design.capacity.triangles)
    await holds(setting.run, example, pin_holes(most), sizes, st.sampled_from((1, 60)), depths())
