"""What a run of the core's benches is about, and what they judge a picture by.

A failure leaves the scene, shrunk, in the run's folder and says how to draw it with `make render`.
"""

from collections.abc import Coroutine, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
from cocotb.triggers import SimTimeoutError, with_timeout
from hypothesis import strategies as st
from numpy.typing import NDArray

from models.core import Registers, Rendering
from models.core import registers as as_registers
from models.cores import CORES, Core
from models.limits import MAX_DEPTH
from models.scene import toml
from models.scene.frame import pack
from models.scene.load import load
from models.scene.strategies import whole_scenes
from models.scene.toml_writer import to_toml
from models.scene.types import Scene, SceneFile, View
from verif.core.coverage import COVERAGE
from verif.core.driver import CoreDriver, Picture
from verif.core.job import Job
from verif.core.seen import Seen, Traced
from verif.core.strategies import Shot, shots
from verif.env import context, sources
from verif.env.block import same
from verif.env.clocking import PERIOD_NS
from verif.env.coverage.sampling import collector
from verif.env.pipelined import Mismatch
from verif.env.simulators import Simulator

T = TypeVar("T")

SCENES = sources.ROOT / "models" / "scenes"

_FRAME_CLOCKS = 4000
"""More than loading, set-up and the last pixel's way through the core take together, but for the objects."""
_OBJECT_CLOCKS = 100
"""More than the set-up of an object takes."""
_RAY_CLOCKS = 150
"""More than a ray takes where few are under way."""
_USUAL_SLOTS = 512
_FEW_SLOTS = 16
_SHOWN = 3


@dataclass(frozen=True)
class Setting:
    """The running core and what it is; kept: where a test leaves a scene that is drawn wrong.

    most_pixels: of the drawn pictures. scenes: how many a test of single frames draws. rate_size: side of
    the square whose clocks are counted.
    """

    run: context.Context
    core: CoreDriver
    build: str
    simulator: str
    most_pixels: int
    scenes: int
    rate_size: int
    kept: Path
    seen: Seen | None = None

    @classmethod
    def of(cls, dut: Any) -> "Setting":
        """The setting of the simulation that this process is; its clock runs from here on."""
        run = context.read()
        extra: dict[str, Any] = dict(run.extra)
        core = CoreDriver(dut, own_clock=not extra["stepped"])
        seen = Seen(collector(run, COVERAGE)) if run.unit else None
        if seen is not None:
            core.listeners.append(seen.before_reset)
        return cls(
            run,
            core,
            extra["build"],
            extra["simulator"],
            extra["most_pixels"],
            extra["scenes"],
            extra["rate_size"],
            run.directory / f"scene-{1 + len(list(run.directory.glob('scene-*.toml')))}.toml",
            seen,
        )

    @property
    def design(self) -> Core:
        """The named build; the run's parameters may differ from it."""
        return CORES[self.build]

    @property
    def slots(self) -> int:
        """Pixels in flight."""
        return self.run.parameters.get("PIXELS_IN_FLIGHT", _USUAL_SLOTS)

    @property
    def units(self) -> int:
        """Trace units."""
        return self.run.parameters["UNITS"]

    @property
    def small(self) -> bool:
        """So few slots and places that the core waits for them all the time."""
        return self.slots <= _FEW_SLOTS

    def registers(self, view: View, depth: int = MAX_DEPTH) -> Registers:
        """A view as the core's registers hold it."""
        return replace(as_registers(view, self.design.formats), depth=depth)

    def any_scene(self) -> st.SearchStrategy[Scene]:
        """Scenes of all kinds that the core holds."""
        return whole_scenes(self.design.capacity)

    def shots(
        self, scene: st.SearchStrategy[Scene] | None = None, most: int | None = None
    ) -> st.SearchStrategy[Shot]:
        """Pictures small enough for this run."""
        return shots(
            self.design.formats, most or self.most_pixels, self.any_scene() if scene is None else scene
        )

    def words(self, scene: Scene) -> tuple[int, ...]:
        """The packed frame, with the build's counters."""
        return pack(scene, self.design.counters).words

    def expected(self, shot: Shot) -> Rendering:
        """The model's picture."""
        return _traced(shot.scene, shot.registers, self.build).picture

    async def example(self, width: int, height: int, name: str = "one_sphere") -> Shot:
        """A picture of a scene of the project, on a core just reset."""
        file = load(SCENES / f"{name}.toml")
        view = file.view_for(width, height)
        shot = Shot(file.scene, self.registers(view), view)
        await self.core.reset(shot.registers)
        return shot

    def clocks(self, wanted: Rendering | None = None) -> int:
        """More than a frame takes whose pixels are taken at once; without a picture: than a refused one."""
        capacity = self.design.capacity
        clocks = _FRAME_CLOCKS + self.slots + _OBJECT_CLOCKS * (capacity.spheres + capacity.triangles)
        if wanted is None:
            return clocks
        counts = wanted.counts
        rays = counts.primary_rays + counts.secondary_rays + counts.shadow_rays
        return clocks + _RAY_CLOCKS * rays + 2 * counts.tests

    async def soon(self, work: Coroutine[Any, Any, T], clocks: int) -> T:
        """The result of ``work`` if it comes within so many clocks: a hang fails and shrinks."""
        return await with_timeout(work, clocks * PERIOD_NS, "ns")

    async def refused(self, words: Sequence[int]) -> Picture:
        """What comes of a frame that is not drawn."""
        got = await self.soon(self.core.draw(words), self.clocks())
        if self.seen is not None:
            self.seen.refused(got.fault)
        return got

    async def draw(self, shot: Shot) -> Picture:
        """The core's picture; a hang fails."""
        return await self.collected(shot, self.core.draw(self.words(shot.scene)))

    async def collected(self, shot: Shot, work: Coroutine[Any, Any, T], spare: int = 0) -> T:
        """What ``work`` gives within the time that a picture takes, and some clocks; a hang fails."""
        try:
            return await self.soon(work, self.clocks(self.expected(shot)) + spare)
        except SimTimeoutError:
            raise Mismatch(f"the picture does not end\n{self._keep(shot, 0)}") from None

    def same_picture(self, shot: Shot, got: Picture) -> Rendering:
        """The model's picture, where the core's is the same in every pixel, hit, and counter of the frame."""
        if got.fault:
            raise Mismatch(f"refused with {got.fault.name}\n{self._keep(shot, 0)}")
        wanted = self._same(shot, got.rgb, got.hit)
        counts = replace(got.counts, lights_at_point=wanted.counts.lights_at_point)
        if counts != wanted.counts:
            raise Mismatch(f"expected {wanted.counts}, got {counts}\n{self._keep(shot, 0)}")
        return wanted

    def same_pixels(self, shot: Shot, rgb: NDArray[np.uint8]) -> Rendering:
        """As `same_picture`, of colours alone."""
        return self._same(shot, rgb, None)

    def same_since_reset(self, *pictures: Rendering) -> None:
        """What the core counts from reset on, over these frames."""
        lights = sum(picture.counts.lights_at_point for picture in pictures)
        same("lights at the hit point", lights, self.core.counts.lights_at_point)
        same("triangles without area", sum(p.degenerate for p in pictures), self.core.degenerate)

    def _same(self, shot: Shot, rgb: NDArray[np.uint8], hit: NDArray[np.int16] | None) -> Rendering:
        wanted = self.expected(shot)
        if (text := differences(wanted, rgb, hit)) is not None:
            raise Mismatch(f"{text[1]}\n{self._keep(shot, text[0])}")
        if self.core.breaches:
            raise Mismatch(f"{'; '.join(self.core.breaches)}\n{self._keep(shot, 0)}")
        if self.seen is not None:
            traced = _traced(shot.scene, shot.registers, self.build)
            self.seen.picture(shot, traced, self.design.formats)
            self.seen.sent(self.core.sent)
            self.seen.waits(self.core.waits)
        return wanted

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
        usual = self.design.parameters()
        changes = {key: value for key, value in self.run.parameters.items() if usual.get(key) != value}
        seen = f"seen with {changes}; " if changes else ""
        if shot.view is None or not self._told(text, path, size):
            return f"{seen}scene: {path}; no scene file can say {size}, pixel {place[0]},{place[1]}"
        file = SceneFile(shot.scene, shot.view, (), path)
        job = Job(file, shot.view, self.build, Simulator(self.simulator), path.parent, None, size.depth)
        return f"{seen}again: {job.command(place)}"

    def _told(self, text: str, path: Path, size: Registers) -> bool:
        """Whether the file, read again, leads to the same registers."""
        view = toml.parse(text, path).view_for(size.width, size.height)
        return self.registers(view, size.depth) == size


@lru_cache(maxsize=4)
def _traced(scene: Scene, registers: Registers, build: str) -> Traced:
    """A picture is asked for several times: how long it takes, what it is, and what was seen in it."""
    return Traced.of(scene, registers, CORES[build].formats)


def differences(
    wanted: Rendering, rgb: NDArray[np.uint8], hit: NDArray[np.int16] | None
) -> tuple[int, str] | None:
    """Index of the first wrong pixel and a few lines that say what is wrong; None where nothing is.

    hit: None where only colours are known.
    """
    colours, objects = wanted.rgb.reshape(-1, 3), wanted.hit.ravel()
    hit = objects if hit is None else hit
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
