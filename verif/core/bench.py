"""End-to-end tests of the core: frames in, pixels out, against the bit-exact model.

A failure leaves the scene, shrunk, in the run's folder and says how to draw it with `make render`.
"""

from collections import Counter
from collections.abc import Coroutine, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, TypeVar

import cocotb
import numpy as np
from cocotb.triggers import SimTimeoutError, with_timeout
from cocotb.utils import get_sim_time
from hypothesis import strategies as st
from numpy.typing import NDArray

from models.core import Registers, Rendering, render
from models.core import registers as as_registers
from models.formats import BUILDS, Formats, formats
from models.limits import Fault
from models.scene import toml
from models.scene.frame import Frame, check, pack, unpack
from models.scene.load import load
from models.scene.toml_writer import to_toml
from models.scene.types import Camera, Light, Material, Scene, SceneFile, Sphere, Triangle
from verif.core.driver import CoreDriver, Picture, StreamedCore
from verif.core.strategies import Shot, camera_faults, crowded_scenes, drawable_scenes, shots
from verif.env import context, sources
from verif.env.block import holds, same
from verif.env.clocking import PERIOD_NS
from verif.env.pipelined import Mismatch
from verif.env.simulators import Simulator
from verif.render.job import CAPACITY, Job

T = TypeVar("T")

_SCENE = sources.ROOT / "models" / "scenes" / "one_sphere.toml"
_FRAME_CLOCKS = 2000
"""More than loading, set-up and the last pixel's way through the core take together."""
_PIXEL_CLOCKS = 32
"""More than a pixel takes in a core of few slots."""
_SHOWN = 3
_ENOUGH_EXAMPLES = 100
_PROMISED = 1.1
"""Clocks a pixel, set-up and drain included, of a picture of 128 x 128."""
_FULL_SLOTS = 256


@dataclass(frozen=True)
class Setting:
    """What the run is about, and the running core; kept: where a test leaves a scene that is drawn wrong."""

    run: context.Context
    core: CoreDriver
    build: str
    simulator: str
    most_pixels: int
    rate_size: int
    kept: Path

    @classmethod
    def of(cls, dut: Any) -> "Setting":
        """The setting of the simulation that this process is; its clock runs from here on."""
        run = context.read()
        extra: dict[str, Any] = dict(run.extra)
        return cls(
            run,
            CoreDriver(dut, own_clock=False),
            extra["build"],
            extra["simulator"],
            extra["most_pixels"],
            extra["rate_size"],
            run.directory / f"scene-{1 + len(list(run.directory.glob('scene-*.toml')))}.toml",
        )

    @property
    def fmts(self) -> Formats:
        """The formats of the build."""
        return formats(BUILDS[self.build])

    @property
    def slots(self) -> int:
        """Pixels in flight of the build."""
        return self.run.parameters.get("PIXELS_IN_FLIGHT", _FULL_SLOTS)

    def shots(self, scene: st.SearchStrategy[Scene] | None = None) -> st.SearchStrategy[Shot]:
        """Pictures small enough for this run."""
        return shots(self.fmts, self.most_pixels, scene)

    def expected(self, shot: Shot) -> Rendering:
        """The model's picture."""
        return render(shot.scene, shot.registers, self.fmts)

    async def example(self, width: int, height: int) -> Shot:
        """A picture of the project's first scene, on a core just reset."""
        file = load(_SCENE)
        view = file.view_for(width, height)
        size = as_registers(view, self.fmts)
        await self.core.reset(size)
        return Shot(file.scene, size, view)

    async def draw(self, shot: Shot) -> Picture:
        """The core's picture; a hang fails."""
        try:
            return await soon(self.core.draw(pack(shot.scene).words), shot.registers)
        except SimTimeoutError:
            raise Mismatch(f"the picture does not end\n{self._keep(shot, 0)}") from None

    def same_picture(self, shot: Shot, got: Picture) -> Rendering:
        """The model's picture, where the core's is the same in every pixel and hit, else Mismatch."""
        wanted = self.expected(shot)
        if got.fault:
            raise Mismatch(f"refused with {got.fault.name}\n{self._keep(shot, 0)}")
        if (text := differences(wanted, got.rgb, got.hit)) is not None:
            raise Mismatch(f"{text[1]}\n{self._keep(shot, text[0])}")
        return wanted

    def same_pixels(self, shot: Shot, rgb: NDArray[np.uint8]) -> None:
        """As `same_picture`, of colours alone."""
        wanted = self.expected(shot)
        if (text := differences(wanted, rgb, wanted.hit.ravel())) is not None:
            raise Mismatch(f"{text[1]}\n{self._keep(shot, text[0])}")

    def _keep(self, shot: Shot, pixel: int) -> str:
        """Leaves the scene in the run's folder; how to draw it again."""
        path = self.kept
        try:
            text = to_toml(shot.scene, shot.view, title="A scene that the core draws wrong")
        except ValueError:
            text = to_toml(shot.scene)
        path.write_text(text)
        size = shot.registers
        place = pixel % size.width, pixel // size.width
        if shot.view is None or not self._told(text, path, size):
            return f"scene: {path}; no scene file can say {size}, pixel {place[0]},{place[1]}"
        file = SceneFile(shot.scene, shot.view, (), path)
        job = Job(file, shot.view, self.build, Simulator(self.simulator), path.parent, None)
        return f"again: {job.command(place)}"

    def _told(self, text: str, path: Path, size: Registers) -> bool:
        """Whether the file, read again, leads to the same registers."""
        view = toml.parse(text, path).view_for(size.width, size.height)
        return as_registers(view, self.fmts) == size


def differences(wanted: Rendering, rgb: NDArray[np.uint8], hit: NDArray[np.int16]) -> tuple[int, str] | None:
    """Index of the first wrong pixel and a few lines that say what is wrong; None where nothing is."""
    colours, objects = wanted.rgb.reshape(-1, 3), wanted.hit.ravel()
    if len(rgb) != len(colours):
        return min(len(rgb), len(colours) - 1), f"{len(rgb)} pixels of {len(colours)}"
    (wrong,) = np.nonzero((rgb != colours).any(axis=-1) | (hit != objects))
    if not wrong.size:
        return None
    lines = [
        f"pixel {index}: expected {colours[index].tolist()} of object {objects[index]}, "
        f"got {rgb[index].tolist()} of object {hit[index]}"
        for index in wrong[:_SHOWN]
    ]
    return int(wrong[0]), "\n".join([f"{wrong.size} of {len(colours)} pixels are wrong:", *lines])


def clocks(registers: Registers) -> int:
    """More than one frame takes where its pixels are taken at once."""
    return _FRAME_CLOCKS + registers.width * registers.height * _PIXEL_CLOCKS


async def soon(work: Coroutine[Any, Any, T], registers: Registers, frames: int = 1) -> T:
    """The result of ``work`` if it comes within the time that some frames take: a hang fails and shrinks."""
    return await with_timeout(work, frames * clocks(registers) * PERIOD_NS, "ns")


async def once(signal: Any) -> None:
    """Waits for a change of a signal."""
    await signal.value_change


def classes(shot: Shot, wanted: Rendering) -> set[str]:
    """What is special about a picture."""
    scene = shot.scene
    found = {"hit"} if (wanted.hit == 0).any() else set()
    found |= {"miss"} if (wanted.hit != 0).any() else set()
    found |= {"light at the hit point"} if wanted.lights_at_point else set()
    found |= {"full channel"} if (wanted.rgb == 255).any() else set()
    found |= {"shade of grey"} if ((wanted.rgb > 0) & (wanted.rgb < 255)).any() else set()
    found |= set() if scene.spheres else {"no sphere"}
    found |= set() if scene.lights else {"no light"}
    for sphere in scene.spheres:
        found |= {"camera inside"} if inside(sphere, scene.camera.position) else set()
        found |= {"transparent"} if any(sphere.material.transparency) else set()
        found |= {"light inside"} if any(inside(sphere, light.position) for light in scene.lights) else set()
    return found


CLASSES = {"hit", "miss", "full channel", "shade of grey", "no sphere", "no light", "camera inside"}
"""Without these the pictures drawn would prove little. Rarer ones have tests of their own."""


def inside(sphere: Sphere, place: tuple[int, int, int]) -> bool:
    """Whether a place is nearer to the center than the radius."""
    squares = sum((a - b) ** 2 for a, b in zip(place, sphere.center, strict=True))
    return squares < (sphere.radius << 7) ** 2


@cocotb.test()
async def every_drawn_scene_is_exact_in_every_pixel_and_hit(dut: Any) -> None:
    """Any scene and any view, from reset; lights at hit points are counted as the model counts them."""
    setting = Setting.of(dut)
    seen: Counter[str] = Counter()

    async def example(shot: Shot) -> None:
        await setting.core.reset(shot.registers)
        wanted = setting.same_picture(shot, await setting.draw(shot))
        same("lights at the point", wanted.lights_at_point, setting.core.lights_at_point)
        seen.update(classes(shot, wanted))

    await holds(setting.run, example, setting.shots())
    dut._log.info("pictures by class: %s", dict(seen))
    if setting.run.examples >= _ENOUGH_EXAMPLES:
        assert seen.keys() >= CLASSES, f"never drawn: {CLASSES - seen.keys()}"


@cocotb.test()
async def a_light_at_the_hit_point_is_left_out_and_counted(dut: Any) -> None:
    """All pixels look along one axis, at the point of the sphere where the light is: ambient light alone."""
    setting = Setting.of(dut)
    size = Registers(3, 2, 0, 0)
    one = setting.fmts.coeff.one
    white = (one, one, one)
    sphere = Sphere(Material((one // 2, one // 4, one), white, white), (0, 0, 0), 8)
    surface = 8 << (setting.fmts.coord.frac_bits - setting.fmts.radius.frac_bits)
    camera = Camera((0, 0, 3 * surface), (0, surface, 0), (0, 0, 0))
    scene = Scene(camera, (Light((0, 0, surface), white),), (sphere,), (), white, (0, 0, 0))
    await setting.core.reset(size)
    shot = Shot(scene, size, None)
    got = await setting.draw(shot)
    setting.same_picture(shot, got)
    same("colours", [[127, 63, 255]] * 6, got.rgb.tolist())
    same("lights left out", 6, setting.core.lights_at_point)


@cocotb.test()
async def what_a_frame_lacks_is_not_taken_from_the_frames_before_it(dut: Any) -> None:
    """A frame without light, then one without sphere, behind frames that filled both banks of the memory."""
    setting = Setting.of(dut)
    full = await setting.example(4, 3)
    dark = replace(full, scene=replace(full.scene, lights=()))
    empty = replace(full, scene=replace(full.scene, spheres=()))
    pictures = [
        setting.same_picture(shot, await setting.draw(shot)).rgb for shot in (full, full, dark, empty, full)
    ]
    _, lit, unlit, nothing, _ = pictures
    assert (lit != unlit).any() and (unlit != nothing).any(), "the frames look alike: that shows nothing"


@cocotb.test()
async def waiting_on_either_side_neither_loses_nor_changes_a_pixel(dut: Any) -> None:
    """Drawn idles of the frame's words and drawn stalls of the pixels' consumer: the same stream of pixels.

    Start of frame on the first pixel alone, end of line on each last one; valid and what is offered hold
    until ready.
    """
    setting = Setting.of(dut)
    streams = StreamedCore(dut, setting.core)
    waits = st.lists(st.integers(0, 3) | st.integers(0, 40), max_size=6)

    async def example(shot: Shot, idles: list[int], stalls: list[int]) -> None:
        await streams.reset(shot.registers)
        streams.stall(stalls)
        width, number = shot.registers.width, shot.registers.width * shot.registers.height
        streams.send(pack(shot.scene).words, idles)
        got = await soon(streams.pixels(number), shot.registers, 2)
        rgb, first, last = zip(*got.words, strict=True)
        same("pixels", number, len(rgb))
        setting.same_pixels(shot, colours(rgb))
        same("pixels marked as first of the frame", [0], [n for n, mark in enumerate(first) if mark])
        ends = list(range(width - 1, number, width))
        same("pixels marked as last of a line", ends, [n for n, mark in enumerate(last) if mark])
        same("busy behind the last pixel", False, setting.core.busy)

    await holds(setting.run, example, setting.shots(), waits, waits)


def colours(words: Sequence[int]) -> NDArray[np.uint8]:
    """Pixels (n, 3) of video words."""
    packed = np.array(words)
    return np.stack([packed >> 16 & 255, packed >> 8 & 255, packed & 255], axis=-1).astype(np.uint8)


@cocotb.test()
async def frames_back_to_back_are_each_exact(dut: Any) -> None:
    """The next frame's words are offered while one is drawn, with no reset between."""
    setting = Setting.of(dut)

    async def example(shot: Shot, others: list[Scene]) -> None:
        core = setting.core
        scenes = [shot.scene, *others]
        await core.reset(shot.registers)
        core.take(True)
        sender = cocotb.start_soon(send_all(core, [pack(scene).words for scene in scenes]))
        at_point = 0
        for number, scene in enumerate(scenes):
            got = await soon(core.collect(), shot.registers)
            wanted = setting.same_picture(replace(shot, scene=scene), got)
            at_point += wanted.lights_at_point
            same(f"frame {number}: lights at the point", at_point, core.lights_at_point)
        await sender

    await holds(setting.run, example, setting.shots(), st.lists(drawable_scenes(), min_size=1, max_size=3))


async def send_all(core: CoreDriver, frames: Sequence[Sequence[int]]) -> None:
    """Frames one behind the other."""
    for words in frames:
        await core.send(words)


@cocotb.test()
async def the_next_frame_is_loaded_while_one_is_drawn(dut: Any) -> None:
    """Its last word is taken before the first picture's last pixel; the third frame waits until it may."""
    setting = Setting.of(dut)
    core = setting.core
    shot = await setting.example(16, 16)
    words = pack(shot.scene).words
    core.take(True)
    loaded: list[float] = []
    drawn: list[float] = []

    async def send() -> None:
        for _ in range(3):
            await core.send(words)
            loaded.append(get_sim_time("ns"))

    sender = cocotb.start_soon(send())
    for _ in range(3):
        setting.same_picture(shot, await soon(core.collect(), shot.registers))
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
    scene = load(_SCENE).scene
    shot, changed = Shot(scene, first, None), Shot(scene, other, None)
    await core.reset(first)
    core.take(True)
    cocotb.start_soon(core.send(pack(scene).words))
    await soon(once(dut.busy), first)
    await core.clocking.edge
    core.registers(other)
    setting.same_picture(shot, await soon(core.collect(), first))
    setting.same_picture(shot, await setting.draw(shot))
    await core.reset(other)
    setting.same_picture(changed, await setting.draw(changed))


def faulty_frames(scene: Scene) -> list[tuple[Fault, tuple[int, ...]]]:
    """A frame for each way to be refused, of a scene with one sphere and one light."""
    good = pack(scene).words
    camera, light, sphere = scene.camera, scene.lights[0], scene.spheres[0]
    triangle = Triangle(sphere.material, ((0, 0, 0), (1, 0, 0), (0, 1, 0)))
    kind_bit = 9 * 19 + 8 + 6 * 19
    return [
        (Fault.FRAME_SHORT, good[:-1]),
        (Fault.FRAME_SHORT, good[:1]),
        (Fault.FRAME_LONG, (*good, 0)),
        (Fault.FRAME_LONG, (*good, *good)),
        (Fault.CAPACITY, pack(replace(scene, lights=(light, light))).words),
        (Fault.CAPACITY, pack(replace(scene, spheres=(sphere, sphere))).words),
        (Fault.CAPACITY, pack(replace(scene, triangles=(triangle,))).words),
        (Fault.KIND, flipped(good, [kind_bit])),
        (Fault.RADIUS, pack(replace(scene, spheres=(replace(sphere, radius=0),))).words),
        (Fault.CAMERA_POSITION, pack(replace(scene, camera=replace(camera, center=camera.position))).words),
        (Fault.CAMERA_UP, pack(replace(scene, camera=replace(camera, up=(0, 0, 0)))).words),
        (Fault.CAMERA_UP, pack(replace(scene, camera=replace(camera, up=along(camera)))).words),
    ]


def along(camera: Camera) -> tuple[int, int, int]:
    """A vector along the direction of view."""
    x, y, z = (c - p for c, p in zip(camera.center, camera.position, strict=True))
    return (x, y, z)


def flipped(words: Sequence[int], bits: Sequence[int]) -> tuple[int, ...]:
    """Words with some bits changed; bit 0 is the first of the frame."""
    changed = list(words)
    for bit in bits:
        changed[bit // 32 % len(words)] ^= 1 << (31 - bit % 32)
    return tuple(changed)


@cocotb.test()
async def every_fault_is_told_by_its_code_and_draws_nothing(dut: Any) -> None:
    """One frame for each fault, all in a row; then a good frame is drawn exactly."""
    setting = Setting.of(dut)
    core = setting.core
    shot = await setting.example(4, 3)
    for fault, words in faulty_frames(shot.scene):
        same("the model's verdict", fault, check(words, capacity=CAPACITY))
        got = await soon(core.draw(words), shot.registers)
        same(f"{len(words)} words", (fault, 0), (got.fault, len(got.rgb)))
        same(f"busy behind {fault.name}", False, core.busy)
    setting.same_picture(shot, await setting.draw(shot))


@cocotb.test()
async def a_picture_without_a_size_is_a_fault_of_every_frame_until_reset(dut: Any) -> None:
    """SIZE comes before the camera's own faults and behind the loader's."""
    setting = Setting.of(dut)
    core = setting.core
    shot = await setting.example(4, 3)
    words = dict(faulty_frames(shot.scene))
    for none in (replace(shot.registers, width=0), replace(shot.registers, height=0)):
        await core.reset(none)
        for faulty, fault in (
            (pack(shot.scene).words, Fault.SIZE),
            (words[Fault.CAMERA_UP], Fault.SIZE),
            (words[Fault.KIND], Fault.KIND),
        ):
            got = await soon(core.draw(faulty), none)
            same("fault and pixels", (fault, 0), (got.fault, len(got.rgb)))
    await core.reset(shot.registers)
    setting.same_picture(shot, await setting.draw(shot))


@cocotb.test()
async def a_faulty_frame_behind_a_good_one_leaves_its_picture_alone(dut: Any) -> None:
    """The fault is told while the picture is drawn, and every pixel of the picture still comes, exact."""
    setting = Setting.of(dut)
    core = setting.core
    shot = await setting.example(16, 16)
    scene = replace(shot.scene, background=(0, 0, 0), spheres=(replace(shot.scene.spheres[0], radius=0),))
    core.take(True)
    await core.send(pack(shot.scene).words)
    await soon(once(dut.m_axis_video_tvalid), shot.registers)
    sender = cocotb.start_soon(core.send(pack(scene).words))
    before = await soon(core.collect(), shot.registers)
    same("fault", Fault.RADIUS, before.fault)
    behind = await soon(core.collect(), shot.registers)
    await sender
    assert len(before.rgb), "the fault was not told while the picture was drawn"
    rgb, hit = np.concatenate([before.rgb, behind.rgb]), np.concatenate([before.hit, behind.hit])
    setting.same_picture(shot, replace(behind, rgb=rgb, hit=hit))
    setting.same_picture(shot, await setting.draw(shot))


@cocotb.test()
async def flipped_bits_give_the_picture_they_describe_or_the_right_fault(dut: Any) -> None:
    """Any frame, any bits flipped, cut or continued, in any size: never a hang; the next frame is exact."""
    setting = Setting.of(dut)
    anywhere, counts = st.integers(0, 32 * 24), st.integers(9 * 19, 9 * 19 + 7)
    bits: st.SearchStrategy[list[int]] = (
        st.just([]) | st.lists(anywhere, max_size=4) | st.lists(counts, max_size=2)
    )
    scenes = st.one_of(drawable_scenes(), crowded_scenes(), camera_faults())
    no_side = st.sampled_from(("", "", "", "width", "height"))
    seen: Counter[str] = Counter()

    async def example(
        shot: Shot, words: tuple[int, ...], flips: list[int], surplus: int, without: str
    ) -> None:
        words = flipped(words, flips)
        words = words[:surplus] or words[:1] if surplus < 0 else (*words, *range(surplus))
        if without:
            shot = replace(shot, registers=replace(shot.registers, **{without: 0}), view=None)
        await setting.core.reset(shot.registers)
        fault = verdict(words, shot.registers)
        got = await soon(setting.core.draw(words), shot.registers)
        same("fault", fault.name, got.fault.name)
        seen[fault.name] += 1
        if fault is Fault.NONE:
            setting.same_picture(replace(shot, scene=unpack(Frame(words), capacity=CAPACITY)), got)
        same("pixels of a refused frame", 0, len(got.rgb) if fault else 0)
        if not without:
            setting.same_picture(shot, await setting.draw(shot))

    surplus = st.just(0) | st.integers(-3, 3)
    frames = scenes.map(lambda scene: pack(scene).words)
    await holds(setting.run, example, setting.shots(), frames, bits, surplus, no_side)
    dut._log.info("frames by fault: %s", dict(seen))
    if setting.run.examples >= _ENOUGH_EXAMPLES:
        assert seen[Fault.NONE.name] and len(seen) > 3, f"only seen: {dict(seen)}"


def verdict(words: Sequence[int], registers: Registers) -> Fault:
    """The fault of a frame: the loader's first, then the size's, then the camera's."""
    fault = check(words, capacity=CAPACITY)
    behind_size = fault in (Fault.NONE, Fault.CAMERA_POSITION, Fault.CAMERA_UP)
    return Fault.SIZE if behind_size and not (registers.width and registers.height) else fault


@cocotb.test()
async def reset_at_any_clock_leaves_a_core_as_new(dut: Any) -> None:
    """While a frame is loaded, set up, drawn or drained, pixels taken or not; the next frame is exact."""
    setting = Setting.of(dut)
    core = setting.core

    async def example(before: Shot, again: bool, taken: bool, wait: int, after: Shot) -> None:
        await core.reset(before.registers)
        core.take(taken)
        words = pack(before.scene).words
        sender = cocotb.start_soon(send_all(core, [words, words] if again else [words]))
        await core.clocking.cycles(wait)
        sender.cancel()
        await core.reset(after.registers)
        same("busy behind reset", False, core.busy)
        wanted = setting.same_picture(after, await setting.draw(after))
        same("lights at the point", wanted.lights_at_point, core.lights_at_point)

    moments = st.integers(0, 700)
    await holds(setting.run, example, setting.shots(), st.booleans(), st.booleans(), moments, setting.shots())


@cocotb.test()
async def a_pixel_costs_one_clock_and_a_frame_always_the_same(dut: Any) -> None:
    """A picture costs what its set-up costs and one clock a pixel, the second time too."""
    setting = Setting.of(dut)
    if setting.slots < _FULL_SLOTS:
        return
    side = setting.rate_size
    overheads = []
    for width, height in ((1, 1), (7, 3), (side, side)):
        shot = await setting.example(width, height)
        for _ in range(2 if width == 1 else 1):
            got = await setting.draw(shot)
            setting.same_picture(shot, got)
            overheads.append(got.cycles - width * height)
    dut._log.info("%d clocks beside the pixels", overheads[0])
    assert len(set(overheads)) == 1, f"clocks beside the pixels differ: {overheads}"
    each = (128 * 128 + overheads[0]) / (128 * 128)
    assert each <= _PROMISED, f"{each:.3f} clocks a pixel at 128 x 128, promised {_PROMISED}"


@cocotb.test()
async def what_is_in_a_scene_does_not_change_the_clocks_of_its_frame(dut: Any) -> None:
    """Frames of as many words and pictures of one size take the same clocks, whatever is hit."""
    setting = Setting.of(dut)
    if setting.slots < _FULL_SLOTS:
        return

    async def example(shot: Shot, other: Scene) -> None:
        most = len(shot.scene.lights), len(shot.scene.spheres)
        other = replace(other, lights=other.lights[: most[0]], spheres=other.spheres[: most[1]])
        taken = []
        for scene in (shot.scene, other):
            await setting.core.reset(shot.registers)
            taken.append((await setting.draw(replace(shot, scene=scene))).cycles)
        if len(pack(shot.scene).words) == len(pack(other).words):
            same("clocks", taken[0], taken[1])

    await holds(setting.run, example, setting.shots(), drawable_scenes())


@cocotb.test()
async def fewer_slots_than_clocks_of_latency_cost_time_and_no_pixel(dut: Any) -> None:
    """In a build of few slots a pixel waits until a slot is free: a slower picture, exact all the same."""
    setting = Setting.of(dut)
    if setting.slots == _FULL_SLOTS:
        return
    shot = await setting.example(32, 24)
    got = await setting.draw(shot)
    setting.same_picture(shot, got)
    each = got.cycles / (32 * 24)
    dut._log.info("%d slots: %.2f clocks a pixel", setting.slots, each)
    assert each > 2, f"{each:.2f} clocks a pixel with {setting.slots} slots: the slots do not limit it"
