"""Where cover points, bins and promises are declared: found in the text, so that the page can show the line.

Points are calls with the point's name as a literal, and bins are literals inside such a call. What is
declared another way is shown at the nearest place that is known: the point's, the unit's COVERAGE, or the
header of its module.
"""

import ast
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import PurePosixPath

_SHARED = "verif/env/coverage/flow.py"

Place = tuple[str, int]
"""Path from the project's root, and line from 1."""


@dataclass(frozen=True)
class _Call:
    """A call, or an assignment of texts: lines by the literals that it is given, and by all inside it."""

    own: Mapping[str, int]
    all: Mapping[str, int]


class Places:
    """Finds declarations in texts by path."""

    def __init__(self, files: Mapping[str, str]) -> None:
        self._files = files
        self._modules = {
            PurePosixPath(path).stem: path
            for path in files
            if path.startswith("hdl/") and path.endswith(".v")
        }
        self._calls = cache(lambda path: tuple(_calls(files[path])))

    def bin(self, unit: str, point: str, name: str) -> Place | None:
        """A bin's line, or what is nearest to it; None where nothing is known of the unit."""
        for path in self._declaring(unit):
            for call in self._calls(path):
                if point in call.own:
                    return path, call.all.get(name, call.own[point])
        return self._of_unit(unit)

    def point(self, unit: str, name: str) -> Place | None:
        """A point's line, or what is nearest to it."""
        return self.bin(unit, name, name)

    def promise(self, file: str, name: str) -> Place | None:
        """The line of a plan's file that names a promise; None where the file is not there."""
        if file not in self._files:
            return None
        return file, _line(self._files[file], rf'^id = "{re.escape(name)}"') or 1

    def module(self, name: str) -> Place | None:
        """The header of a module."""
        path = self._modules.get({"core": "raytracer"}.get(name, name))
        if path is None:
            return None
        return path, _line(self._files[path], r"^module\b") or 1

    def _declaring(self, unit: str) -> Iterator[str]:
        wanted = (f"verif/units/{unit}/coverage.py", f"verif/{unit}/coverage.py", _SHARED)
        return (path for path in wanted if path in self._files)

    def _of_unit(self, unit: str) -> Place | None:
        for path in self._declaring(unit):
            line = _line(self._files[path], r"^COVERAGE\b")
            if line:
                return path, line
        return self.module(unit)


def _line(text: str, pattern: str) -> int | None:
    found = re.search(pattern, text, re.MULTILINE)
    return text.count("\n", 0, found.start()) + 1 if found else None


def _calls(text: str) -> Iterator[_Call]:
    """Outermost first: a point's declaration is around the recipes that may name it too."""
    try:
        tree = ast.parse(text)
    except SyntaxError:
        return
    for node in ast.walk(tree):
        if isinstance(node, ast.Call | ast.Assign):
            yield _Call(dict(_literals(_given(node))), dict(_literals(ast.walk(node))))


def _given(node: ast.Call | ast.Assign) -> Iterable[ast.AST]:
    """Arguments of a call; what an assignment gives to names, one or several."""
    if isinstance(node, ast.Call):
        return [*node.args, *(word.value for word in node.keywords)]
    if isinstance(node.targets[0], ast.Tuple) and isinstance(node.value, ast.Tuple):
        return node.value.elts
    return [node.value]


def _literals(nodes: Iterable[ast.AST]) -> list[tuple[str, int]]:
    """Texts with their lines, from the last line on, so that of equal ones a mapping keeps the first."""
    found = [
        (node.value, node.lineno)
        for node in nodes
        if isinstance(node, ast.Constant) and isinstance(node.value, str)
    ]
    return sorted(found, key=lambda literal: -literal[1])
