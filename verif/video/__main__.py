"""`make video`: a film of a moving camera, through the video block, as a monitor at its wires sees it.

The bit-exact model draws the pictures, or with CORE=rtl the RTL of the core, each pixel compared with the
model, or they are given as PNG files; the RTL of the screen shows them at their rate on
a screen of 640 x 480 at 60 Hz. Every frame of the screen is compared with the model of what is seen.

Exit codes: 0 every frame is right; 1 a frame is not, or the simulation failed; 2 the request or the scene
is wrong, or a tool is missing, and nothing was written.
"""

import argparse
import json
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from models.core import registers, render
from models.cores import smallest
from models.formats import BUILDS, formats
from models.images import load_png
from models.scene.errors import SceneError
from models.scene.frame import FrameError
from models.scene.load import load
from models.video import STORE, VGA
from verif.env.build import CACHE, BuildError, ensure
from verif.env.simulators import MissingTool, Simulator, version
from verif.video import core_film
from verif.video.film import Film, FilmError, screen_build, show, times_ms, write
from verif.video.orbit import orbit

_SCENE = "models/scenes/three_spheres.toml"
_FRAMES, _RATE = 24, 24.0
_CORES = ("model", "rtl")
_SIMULATOR = Simulator.VERILATOR
"""Icarus takes a minute for a frame of the default screen; it runs the benches of small ones."""
_MOST = 1000
"""Frames of a film: more take the simulator hours."""


class RequestError(Exception):
    """A request that cannot be met; the text is the whole message."""


@dataclass(frozen=True)
class Request:
    """What is asked for, checked. draw: makes the pictures, as `core` says: model, rtl, given."""

    draw: Callable[[], NDArray[np.uint8]]
    core: str
    number: int
    rate: float
    out: Path
    name: str


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="make video", description=__doc__)
    parser.add_argument("--scene", help=f"scene file: .toml, .nff or .hex; without it {_SCENE}")
    parser.add_argument("--pictures", help="folder of PNG files, shown in the order of their names, instead")
    parser.add_argument(
        "--frames", help=f"pictures on the camera's way around the scene; without it {_FRAMES}"
    )
    parser.add_argument("--core", help="who draws the pictures: model or rtl; without it model")
    parser.add_argument("--rate", help=f"pictures a second; without it {_RATE:g}")
    parser.add_argument("--out", help="folder of the film; without it build/video")
    return parser.parse_args()


def _say(text: str) -> None:
    print(text, file=sys.stderr, flush=True)


def _number(text: str | None, option: str, default: float, least: float, most: float) -> float:
    try:
        value = default if text is None else float(text)
    except ValueError:
        raise RequestError(f"{option}={text}: is not a number") from None
    if not least <= value <= most:
        raise RequestError(f"{option}={text}: is {least:g} to {most:g}")
    return value


def _drawn(path: str, number: int, core: str) -> Callable[[], NDArray[np.uint8]]:
    """The core's pictures of a scene, as large as the frame buffer holds them."""
    file = load(path)
    build = smallest(file.scene)
    if core == "rtl" and build is None:
        raise RequestError(f"SCENE={path}: no build of the core holds it")
    fmts = formats(BUILDS["default"])
    size = registers(file.view_for(STORE.width, STORE.height), fmts)
    scenes = orbit(file.scene, number)

    def draw() -> NDArray[np.uint8]:
        renderings = []
        for done, scene in enumerate(scenes):
            _say(f"  picture {done + 1} of {number}")
            renderings.append(render(scene, size, fmts))
        if core == "rtl" and build is not None:
            _say("  drawing them through the RTL of the core ...")
            return core_film.draw(build, scenes, size, renderings, _SIMULATOR)
        return np.stack([rendering.rgb for rendering in renderings])

    return draw


def _given(folder: str) -> tuple[Callable[[], NDArray[np.uint8]], int]:
    """The PNG files of a folder, and how many."""
    paths = sorted(Path(folder).glob("*.png"))
    if not paths:
        raise RequestError(f"PICTURES={folder}: holds no .png file")
    pictures = [load_png(path) for path in paths]
    if len({picture.shape for picture in pictures}) > 1:
        raise RequestError(f"PICTURES={folder}: the pictures are not all of one size")
    return lambda: np.stack(pictures), len(pictures)


def _request(words: argparse.Namespace) -> Request:
    if words.scene is not None and words.pictures is not None:
        raise RequestError("SCENE and PICTURES: name one of them")
    if words.core is not None and words.pictures is not None:
        raise RequestError("CORE and PICTURES: name one of them")
    core = words.core or _CORES[0]
    if core not in _CORES:
        raise RequestError(f"CORE={core}: is {' or '.join(_CORES)}")
    version(_SIMULATOR)
    rate = _number(words.rate, "RATE", _RATE, 1, VGA.refresh_hz)
    out = CACHE / "video" if words.out is None else Path(words.out)
    if out.exists() and not out.is_dir():
        raise RequestError(f"OUT={out}: is a file; name a folder")
    if words.pictures is not None:
        draw, number = _given(words.pictures)
        return Request(draw, "given", number, rate, out, words.pictures)
    number = int(_number(words.frames, "FRAMES", _FRAMES, 1, _MOST))
    scene = words.scene or _SCENE
    try:
        return Request(_drawn(scene, number, core), core, number, rate, out, scene)
    except ValueError as error:
        raise RequestError(f"SCENE={scene}: {error}") from None


def _summary(request: Request, film: Film, drawing: float, simulating: float) -> dict[str, object]:
    return {
        "pictures": request.number,
        "drawn_by": request.core,
        "pictures_seen": len(film.shown),
        "rate": request.rate,
        "mode": VGA.name,
        "refresh_hz": round(VGA.refresh_hz, 3),
        "refreshes_of_each": film.refreshes[1:-1].tolist(),
        "times_ms": times_ms(film, request.rate),
        "wrong_frames": 0,
        "drawing_seconds": round(drawing, 2),
        "simulation_seconds": round(simulating, 2),
        "simulator": version(_SIMULATOR),
    }


def _film(request: Request) -> None:
    _say(f"{request.name}: {request.number} pictures at {request.rate:g} a second, {VGA.name}")
    build = screen_build(_SIMULATOR)
    if not build.ready:
        _say("  building the screen, once ...")
    ensure(build)
    start = time.perf_counter()
    pictures = request.draw()
    middle = time.perf_counter()
    _say("  showing them ...")
    film = show(pictures, request.rate, "video-film", _SIMULATOR)
    end = time.perf_counter()
    write(film, request.rate, request.out)
    summary = _summary(request, film, middle - start, end - middle)
    (request.out / "summary.json").write_text(json.dumps(summary, indent=2) + "\n")
    counts = film.refreshes[1:-1]
    each = f"{counts.min()} to {counts.max()} frames of the screen each" if counts.size else "one picture"
    print(f"seen      {len(film.shown)} of {request.number} pictures, {each}, every frame exact")
    print(f"seconds   drawing {middle - start:.1f}, simulation and comparison {end - middle:.1f}")
    print(f"film      {request.out / 'animation.png'}, {request.out / 'animation.gif'}")


def main() -> int:
    """Command line; see the module's docstring."""
    try:
        request = _request(_arguments())
    except (SceneError, FrameError, RequestError, MissingTool) as error:
        _say(str(error))
        return 2
    try:
        _film(request)
    except (FilmError, BuildError, FrameError) as error:
        _say(str(error))
        return 1
    except KeyboardInterrupt:
        _say("interrupted; nothing was written")
        return 130
    return 0


if __name__ == "__main__":
    sys.exit(main())
