"""What closure plays on the core: scenes of a kind, trees, full rooms, faults, resets, frames in a row."""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Any

import cocotb
from hypothesis import strategies as st
from numpy.random import Generator

from models.fixed import BOOK, COLOUR, RADIUS
from models.limits import MAX_DEPTH, Fault
from models.scene.strategies import classes
from models.scene.types import INDEX, Camera, Light, Material, Scene, Sphere, Triangle, Vec3, View
from verif.core.coverage import scene as recipe_of
from verif.core.faults import verdict
from verif.core.setting import Setting
from verif.core.strategies import FAULTS, Shot, faulty_frames, splitting, without_area
from verif.coverage.subjects import Scenario
from verif.env.block import same
from verif.env.context import Context
from verif.env.coverage.collector import Collector
from verif.env.coverage.points import Recipe
from verif.env.draws import examples

_MOST = 12
"""Pixels of a picture that closure draws."""
_PORTION = 4
"""Pictures of a portion, at most."""
_TREES = ("glass_in_glass", "mirror_balls", "facing_mirrors", "sensible", "through")
"""Kinds of scenes whose rays go deep."""
_AHEAD = Camera((0, 0, -8 * BOOK.one), (0, BOOK.one, 0), (0, 0, 0))
_PLAIN = Material((COLOUR.one // 4,) * 3, (COLOUR.one // 2,) * 3, (COLOUR.one // 2,) * 3)
_MOMENTS = (30, 300, 900, 1500, 2500)
"""Clocks after which a frame is cut off by reset."""


def _some(size: int) -> int:
    return min(size, _PORTION)


async def draw(setting: Setting, shots: Iterable[Shot]) -> None:
    """Pictures, each after a reset."""
    for shot in shots:
        await setting.core.reset(shot.registers)
        setting.same_picture(shot, await setting.draw(shot))


def _scenes(kind: str) -> Scenario:
    async def play(setting: Setting, generator: Generator, size: int) -> None:
        shots = setting.shots(classes(setting.design.capacity)[kind], _MOST)
        await draw(setting, examples(shots, generator, _some(size)))

    return play


def _tree(setting: Setting, depth: int, side: int = 2) -> Shot:
    view = View.square(side, side, 70)
    return Shot(splitting(setting.design.capacity), setting.registers(view, depth), view)


async def trees(setting: Setting, generator: Generator, size: int) -> None:
    """Mirrors and glass, to every depth."""
    await draw(setting, [_tree(setting, int(generator.integers(1, MAX_DEPTH + 1)))])
    kinds = classes(setting.design.capacity)
    chosen = st.one_of([kinds[name] for name in _TREES if name in kinds])
    shots = examples(setting.shots(chosen, _MOST), generator, _some(size))
    deep = [replace(shot, registers=replace(shot.registers, depth=MAX_DEPTH)) for shot in shots]
    await draw(setting, deep)


async def room(setting: Setting, _generator: Generator, _size: int) -> None:
    """Where few places are for a depth, a tree in which every hit splits. Elsewhere many objects, and a ball
    before nothing: its hits keep the shader at work in every clock, and the misses beside them are terms more
    than can be added up.
    """
    if setting.small:
        await _held_up(setting, _tree(setting, MAX_DEPTH, side=5))
        return
    view = View.square(64, 64, 60)
    ball = Sphere(_PLAIN, (0, 0, 0), RADIUS.max)
    lights = tuple(Light((step * BOOK.one, 0, -12 * BOOK.one), (COLOUR.one,) * 3) for step in (-4, 0, 4))
    before_nothing = Scene(_AHEAD, lights, (ball,), (), (COLOUR.one // 8,) * 3, (COLOUR.one // 2,) * 3)
    await _held_up(setting, Shot(before_nothing, setting.registers(view, 1), view))
    await _held_up(setting, _tree(setting, 1, side=24))


async def _held_up(setting: Setting, shot: Shot) -> None:
    """A picture whose pixels nobody takes for a while."""
    core = setting.core
    await core.reset(shot.registers)
    core.take(False)
    await core.send(setting.words(shot.scene))
    counts = setting.expected(shot).counts
    await core.wait(2 * (counts.tests // setting.units + counts.primary_rays))
    core.take(True)
    setting.same_picture(shot, await setting.collected(shot, core.collect()))


async def counts(setting: Setting, generator: Generator, size: int) -> None:
    """As many lights, spheres and triangles as fit, none, and some without area."""
    capacity = setting.design.capacity
    shots = examples(setting.shots(classes(capacity)["crowd"], _MOST), generator, _some(size))
    flat = examples(without_area(), generator, 2)
    for number, shot in enumerate(shots):
        scene = shot.scene
        spare = capacity.triangles - len(scene.triangles)
        full = (*scene.triangles, *(scene.triangles[:1] or flat[:1]) * spare)
        most = (capacity.triangles, 0, 1, 2)[(number + size) % 4]
        triangles = (*flat[: int(generator.integers(3))], *full)[:most]
        lights = scene.lights[: int(generator.integers(capacity.lights + 1))]
        spheres = scene.spheres[: int(generator.integers(capacity.spheres + 1))]
        changed = replace(scene, lights=lights, spheres=spheres, triangles=triangles)
        await draw(setting, [replace(shot, scene=changed)])


async def faint(setting: Setting, generator: Generator, _size: int) -> None:
    """A tree whose mirrors and glass leave next to nothing."""
    tree = _tree(setting, MAX_DEPTH)
    share: Vec3 = (int(generator.integers(1, 64)), 1, 0)
    spheres = tuple(
        replace(ball, material=replace(ball.material, reflection=share, transparency=share))
        for ball in tree.scene.spheres
    )
    await draw(setting, [replace(tree, scene=replace(tree.scene, spheres=spheres))])


async def faults(setting: Setting, generator: Generator, _size: int) -> None:
    """Two refused frames behind each other, then a good one; the picture without a size too."""
    shot = examples(setting.shots(most=_MOST), generator, 2)[-1]
    for fault in FAULTS:
        await setting.core.reset(shot.registers)
        for frame in examples(faulty_frames(setting.design.counters, (fault,)), generator, 2):
            same("fault", frame.fault, (await setting.refused(frame.words)).fault)
        setting.same_picture(shot, await setting.draw(shot))
    none = replace(shot.registers, width=0)
    await setting.core.reset(none)
    words = setting.words(shot.scene)
    same("fault", verdict(setting, words, none), (await setting.refused(words)).fault)
    same("fault", Fault.SIZE, verdict(setting, words, none))


async def resets(setting: Setting, generator: Generator, _size: int) -> None:
    """Resets while a frame is loaded, set up, drawn and held up; the next one is exact."""
    core = setting.core
    for taken in (True, False):
        for moment in _MOMENTS:
            shot = _tree(setting, MAX_DEPTH if taken else 1, side=4)
            await core.reset(shot.registers)
            core.take(taken)
            sender = cocotb.start_soon(core.send(setting.words(shot.scene)))
            await core.wait(moment + int(generator.integers(100)))
            sender.cancel()
    tree = _tree(setting, 1)
    await draw(setting, [tree, tree])


async def frames(setting: Setting, generator: Generator, _size: int) -> None:
    """Frames behind each other: offered while one is drawn, and when none is."""
    core = setting.core
    shot = examples(setting.shots(most=_MOST), generator, 2)[-1]
    await core.reset(shot.registers)
    setting.same_picture(shot, await setting.draw(shot))
    setting.same_picture(shot, await setting.draw(shot))
    await core.reset(shot.registers)
    core.take(True)
    words = setting.words(shot.scene)

    async def send() -> None:
        await core.send(words)
        while not core.busy:
            await core.wait(1)
        await core.send(words)

    sender = cocotb.start_soon(send())
    for _ in range(2):
        setting.same_picture(shot, await setting.collected(shot, core.collect(), 2000))
    await sender


async def at_random(setting: Setting, generator: Generator, _size: int) -> None:
    """Scenes of uniform numbers around the place that the camera looks at."""
    scenes = [_uniform_scene(setting, generator) for _ in range(_PORTION)]
    view = View.square(4, 3, 60)
    await draw(setting, [Shot(scene, setting.registers(view), view) for scene in scenes])


def _uniform_scene(setting: Setting, generator: Generator) -> Scene:
    capacity = setting.design.capacity

    def place(reach: int) -> Vec3:
        x, y, z = (int(step) for step in generator.integers(-reach * BOOK.one, reach * BOOK.one, 3))
        return (x, y, z)

    def colour() -> Vec3:
        red, green, blue = (int(step) for step in generator.integers(0, COLOUR.one, 3, endpoint=True))
        return (red, green, blue)

    def material() -> Material:
        return Material(
            colour(), colour(), colour(), colour(), colour(), int(generator.integers(INDEX.max + 1))
        )

    def number(most: int) -> int:
        return int(generator.integers(most + 1))

    return Scene(
        _AHEAD,
        tuple(Light(place(8), colour()) for _ in range(number(capacity.lights))),
        tuple(
            Sphere(material(), place(4), int(generator.integers(1, RADIUS.max + 1)))
            for _ in range(number(capacity.spheres))
        ),
        tuple(
            Triangle(material(), (place(4), place(4), place(4))) for _ in range(number(capacity.triangles))
        ),
        colour(),
        colour(),
    )


@dataclass(frozen=True)
class CoreSubject:
    """The core, ready to be played on."""

    setting: Setting
    coverage: Collector
    largest: int = _PORTION

    async def undirected(self, generator: Generator) -> None:
        """Scenes of uniform numbers."""
        await at_random(self.setting, generator, 1)

    async def follow(self, recipe: Recipe, generator: Generator, size: int) -> None:
        """The scenario of the recipe. Raises KeyError where there is none."""
        await scenarios()[recipe.name](self.setting, generator, size)


def scenarios() -> dict[str, Scenario]:
    """By the names that recipes have."""
    kinds = {recipe_of(kind): _scenes(kind) for kind in classes()}
    plays: dict[str, Scenario] = {
        "trees": trees,
        "faint": faint,
        "room": room,
        "counts": counts,
        "faults": faults,
        "resets": resets,
        "frames": frames,
    }
    return {**kinds, **plays}


async def closure_subject(dut: Any, _run: Context) -> CoreSubject:
    """The core with its clock running, reset."""
    setting = Setting.of(dut)
    if setting.seen is None:
        raise ValueError("this run samples no coverage: its settings name no unit")
    await setting.core.reset(setting.registers(View.square(2, 2, 60)))
    return CoreSubject(setting, setting.seen.coverage)
