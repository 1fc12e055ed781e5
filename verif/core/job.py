"""What is asked of `make render`, checked: every wrong request is one sentence before anything runs."""

from dataclasses import dataclass, replace
from pathlib import Path

from models.core import Registers, registers
from models.cores import CORES, Core, smallest
from models.formats import Formats
from models.limits import MAX_DEPTH
from models.scene.errors import SceneError
from models.scene.frame import Frame, pack
from models.scene.load import load
from models.scene.types import SceneFile, View
from verif.env.simulators import Simulator, version

LARGEST = 4095
"""Largest width and height: what the core's registers hold."""


class RequestError(Exception):
    """A request that cannot be met; the text is the whole message."""


@dataclass(frozen=True)
class Job:
    """One picture to draw: scene and view, build and simulator, where to; pixel: just that one, explained;
    depth: of the deepest ray."""

    file: SceneFile
    view: View
    build: str
    simulator: Simulator
    out: Path
    pixel: tuple[int, int] | None
    depth: int = MAX_DEPTH

    @property
    def name(self) -> str:
        """The scene's name."""
        return self.file.path.stem

    @property
    def core(self) -> Core:
        """The build."""
        return CORES[self.build]

    @property
    def formats(self) -> Formats:
        """The table of formats in the job's build."""
        return self.core.formats

    @property
    def frame(self) -> Frame:
        """The packed frame, with the build's counters."""
        return pack(self.file.scene, self.core.counters)

    @property
    def registers(self) -> Registers:
        """What the core is told of the view."""
        return replace(registers(self.view, self.formats), depth=self.depth)

    def command(self, pixel: tuple[int, int]) -> str:
        """The command that explains one pixel of this picture."""
        size = f"{self.view.width}x{self.view.height}"
        return (
            f"make render SCENE={self.file.path} SIZE={size} SIM={self.simulator} BUILD={self.build} "
            f"{'' if self.depth == MAX_DEPTH else f'DEPTH={self.depth} '}PIXEL={pixel[0]},{pixel[1]}"
        )


def _pair(text: str, separator: str, option: str, example: str) -> tuple[int, int]:
    first, found, second = text.lower().partition(separator)
    if not (found and first.isdecimal() and second.isdecimal()):
        raise RequestError(f"{option}={text}: is not two numbers like {example}")
    return int(first), int(second)


def _size(text: str | None, file: SceneFile) -> tuple[int, int]:
    if text is None:
        return (512, 512) if file.view is None else (file.view.width, file.view.height)
    width, height = _pair(text, "x", "SIZE", "512x512")
    if not (1 <= width <= LARGEST and 1 <= height <= LARGEST):
        raise RequestError(f"SIZE={text}: width and height are 1 to {LARGEST}")
    return width, height


def _view(file: SceneFile, width: int, height: int) -> View:
    try:
        view = file.view_for(width, height)
        registers(view, CORES["default"].formats)
    except ValueError as error:
        raise RequestError(f"SIZE={width}x{height}: {error}; choose another size") from None
    return view


def _too_large(file: SceneFile, build: str) -> SceneError:
    """What a scene has too many of for a build, and what to do."""
    capacity = CORES[build].capacity
    counts = {name: len(getattr(file.scene, name)) for name in ("lights", "spheres", "triangles")}
    parts = [
        f"{count} {name} (at most {getattr(capacity, name)})"
        for name, count in counts.items()
        if count > getattr(capacity, name)
    ]
    larger = smallest(file.scene)
    remedy = f"draw it with BUILD={larger}" if larger else "draw a smaller scene"
    problem = f"holds {', '.join(parts)}; {remedy}"
    return SceneError(file.path, None, "", f"is more than the build {build} draws: it {problem}")


def _build(file: SceneFile, wanted: str | None) -> str:
    """The build that is asked for, or else the first that holds the scene."""
    chosen = wanted or smallest(file.scene) or list(CORES)[-1]
    if not CORES[chosen].holds(file.scene):
        raise _too_large(file, chosen)
    return chosen


def _depth(text: str | None) -> int:
    if text is None:
        return MAX_DEPTH
    if not text.isdecimal() or not 1 <= int(text) <= MAX_DEPTH:
        raise RequestError(f"DEPTH={text}: is not 1 to {MAX_DEPTH}, the depths that the core traces to")
    return int(text)


def request(
    scene: str,
    size: str | None = None,
    out: str | None = None,
    sim: str = Simulator.VERILATOR,
    build: str | None = None,
    pixel: str | None = None,
    depth: str | None = None,
) -> Job:
    """The job that these words ask for.

    Raises SceneError for the scene, RequestError for the rest, MissingTool for the simulator.
    """
    if sim not in list(Simulator):
        raise RequestError(f"SIM={sim}: there is no such simulator; choose one of {', '.join(Simulator)}")
    if build is not None and build not in CORES:
        raise RequestError(f"BUILD={build}: there is no such build; choose one of {', '.join(CORES)}")
    simulator = Simulator(sim)
    version(simulator)
    file = load(scene, CORES[build or "default"].counters)
    chosen = _build(file, build)
    width, height = _size(size, file)
    view = _view(file, width, height)
    at = None if pixel is None else _pair(pixel, ",", "PIXEL", "17,4")
    if at is not None and not (at[0] < width and at[1] < height):
        raise RequestError(f"PIXEL={pixel}: is outside the picture of {width} x {height}")
    folder = Path(out) if out else Path("build") / "render" / file.path.stem
    if folder.exists() and not folder.is_dir():
        raise RequestError(f"OUT={folder}: is a file; name a folder")
    return Job(file, view, chosen, simulator, folder, at, _depth(depth))
