"""One way to read a scene file, whatever its form."""

from collections.abc import Callable
from pathlib import Path

from models.scene import nff, toml
from models.scene.errors import SceneError
from models.scene.frame import DEFAULT_COUNTERS, CounterWidths, Frame, FrameError, unpack
from models.scene.types import SceneFile


def load(path: Path | str, counters: CounterWidths = DEFAULT_COUNTERS) -> SceneFile:
    """The scene of a .toml, .nff or .hex file; SceneError says in one line why there is none.

    `counters` are those of the packed frame in a .hex file; the other forms hold any number of objects.
    """
    path = Path(path)
    parsers: dict[str, Callable[[str, Path], SceneFile]] = {
        ".toml": toml.parse,
        ".nff": nff.parse,
        ".hex": lambda text, source: _parse_hex(text, source, counters),
    }
    if path.suffix.lower() not in parsers:
        raise SceneError(
            path, None, "", f"is not a scene file by its suffix; scenes end in {', '.join(parsers)}"
        )
    return parsers[path.suffix.lower()](_read(path), path)


def _read(path: Path) -> str:
    try:
        text = path.read_bytes().decode("utf-8-sig")
    except FileNotFoundError:
        raise SceneError(path, None, "", "does not exist; check the name and the working directory") from None
    except IsADirectoryError:
        raise SceneError(path, None, "", "is a directory; name a file in it") from None
    except OSError as error:
        problem = f"cannot be read ({error.strerror}); check its permissions"
        raise SceneError(path, None, "", problem) from None
    except UnicodeDecodeError:
        raise SceneError(path, None, "", "is not a text file; save it as UTF-8") from None
    if "\0" in text:
        raise SceneError(path, None, "", "is not a text file: it contains NUL characters")
    return text.replace("\r\n", "\n")


def _parse_hex(text: str, path: Path, counters: CounterWidths) -> SceneFile:
    try:
        scene = unpack(Frame.from_hex(text), counters)
    except FrameError as error:
        problem = f"{error.problem}; the core refuses this frame with {error.fault.name}"
        raise SceneError(path, None, error.field, problem) from None
    except ValueError as error:
        line, _, problem = str(error).partition(": ")
        raise SceneError(path, int(line.removeprefix("line ")), "", problem) from None
    return SceneFile(scene, None, (), path)
