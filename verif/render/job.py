"""What is asked of `make render`, checked: every wrong request is one sentence before anything runs."""

from dataclasses import dataclass
from pathlib import Path

from models import limits
from models.core import Registers, registers
from models.formats import BUILDS, Formats, formats
from models.scene.errors import SceneError
from models.scene.frame import Capacity, pack
from models.scene.load import load
from models.scene.types import SceneFile, View
from verif.env.simulators import Simulator, version

LARGEST = 4095
"""Largest width and height: what the core's registers hold."""

CAPACITY = Capacity(limits.MAX_LIGHTS, limits.MAX_SPHERES, limits.MAX_TRIANGLES)


class RequestError(Exception):
    """A request that cannot be met; the text is the whole message."""


@dataclass(frozen=True)
class Job:
    """One picture to draw: scene and view, build and simulator, where to; pixel: just that one, explained."""

    file: SceneFile
    view: View
    build: str
    simulator: Simulator
    out: Path
    pixel: tuple[int, int] | None

    @property
    def name(self) -> str:
        """The scene's name."""
        return self.file.path.stem

    @property
    def formats(self) -> Formats:
        """The table of formats in the job's build."""
        return formats(BUILDS[self.build])

    @property
    def registers(self) -> Registers:
        """What the core is told of the view."""
        return registers(self.view, self.formats)

    def command(self, pixel: tuple[int, int]) -> str:
        """The command that explains one pixel of this picture."""
        size = f"{self.view.width}x{self.view.height}"
        return (
            f"make render SCENE={self.file.path} SIZE={size} SIM={self.simulator} BUILD={self.build} "
            f"PIXEL={pixel[0]},{pixel[1]}"
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
        registers(view, formats(BUILDS["default"]))
    except ValueError as error:
        raise RequestError(f"SIZE={width}x{height}: {error}; choose another size") from None
    return view


def _fits(file: SceneFile) -> None:
    scene = file.scene
    parts = []
    for name in ("lights", "spheres", "triangles"):
        count, most = len(getattr(scene, name)), getattr(CAPACITY, name)
        if count > most:
            parts.append(f"{count} {name} (at most {most})")
    if parts:
        problem = f"holds {', '.join(parts)}; draw a scene with one sphere and one light"
        raise SceneError(file.path, None, "", f"is more than this core draws: it {problem}")
    pack(scene)


def request(scene: str, size: str | None, out: str | None, sim: str, build: str, pixel: str | None) -> Job:
    """The job that these words ask for.

    Raises SceneError for the scene, RequestError for the rest, MissingTool for the simulator.
    """
    if build not in BUILDS:
        raise RequestError(f"BUILD={build}: there is no such build; choose one of {', '.join(BUILDS)}")
    if sim not in list(Simulator):
        raise RequestError(f"SIM={sim}: there is no such simulator; choose one of {', '.join(Simulator)}")
    simulator = Simulator(sim)
    version(simulator)
    file = load(scene)
    _fits(file)
    width, height = _size(size, file)
    view = _view(file, width, height)
    at = None if pixel is None else _pair(pixel, ",", "PIXEL", "17,4")
    if at is not None and not (at[0] < width and at[1] < height):
        raise RequestError(f"PIXEL={pixel}: is outside the picture of {width} x {height}")
    folder = Path(out) if out else Path("build") / "render" / file.path.stem
    if folder.exists() and not folder.is_dir():
        raise RequestError(f"OUT={folder}: is a file; name a folder")
    return Job(file, view, build, simulator, folder, at)
