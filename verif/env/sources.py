"""Finds the Verilog files that a top module needs: one module a file, the file named after it."""

import re
from collections.abc import Iterable
from functools import cache
from pathlib import Path

ROOT = Path(__file__).parents[2]
HDL = ROOT / "hdl"
VERIF = ROOT / "verif"

# A directive's file name is no module's: `include "raytracer.vh"` does not use the core.
_COMMENT = re.compile(r"//.*?$|/\*.*?\*/|^`include.*?$", re.MULTILINE | re.DOTALL)
_WORD = re.compile(r"[A-Za-z_]\w*")


@cache
def _modules() -> dict[str, Path]:
    """Every module of the design and of the benches, by name."""
    paths = [*sorted(HDL.rglob("*.v")), *sorted(VERIF.rglob("*.v"))]
    return {path.stem: path for path in paths}


def _words(text: str) -> set[str]:
    return set(_WORD.findall(_COMMENT.sub("", text)))


def closure(top: str) -> tuple[Path, ...]:
    """The files of ``top`` and of every module below it, sorted.

    Raises KeyError where no file is named after ``top``.
    """
    return _below({top})


def used_by(text: str) -> tuple[Path, ...]:
    """The files of every module that some Verilog text names, and of those below them, sorted."""
    return _below(_words(text) & _modules().keys())


def _below(tops: set[str]) -> tuple[Path, ...]:
    modules = _modules()
    found: dict[str, Path] = {}
    pending = list(tops)
    while pending:
        name = pending.pop()
        if name not in found:
            found[name] = modules[name]
            pending += _words(modules[name].read_text()) & (modules.keys() - found.keys())
    return tuple(sorted(found.values()))


def headers() -> tuple[Path, ...]:
    """Every include file of the design."""
    return tuple(sorted(HDL.rglob("*.vh")))


def include_dirs() -> tuple[Path, ...]:
    """Where the include files are."""
    return tuple(sorted({path.parent for path in headers()}))


def relative(paths: Iterable[Path]) -> list[str]:
    """Paths as seen from the root of the project."""
    return [str(path.relative_to(ROOT)) for path in paths]
