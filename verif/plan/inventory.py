"""What there is to be promised: tests and cover points, found without running any, and units."""

import ast
import importlib
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType

from verif.env import units
from verif.env.sources import ROOT
from verif.plan.records import NamedTest, PlanError

_BENCH_MARKS = ("\n@cocotb.test(", "standard_tests(", "standard_stream_tests(")
"""What the text of every module with cocotb tests holds one of."""


@dataclass(frozen=True)
class CoverPoint:
    """A functional cover point. name: `<folder>.<point>`. file: that declares it. bins: their short names."""

    name: str
    file: str
    bins: tuple[str, ...]

    @property
    def full(self) -> tuple[str, ...]:
        """The bins' full names."""
        return tuple(f"{self.name}.{found}" for found in self.bins)


@dataclass(frozen=True)
class Inventory:
    """All tests and cover points there are, and the folders of units, from the project's root."""

    tests: frozenset[NamedTest]
    points: tuple[CoverPoint, ...]
    units: tuple[Path, ...]


def _imported(file: Path) -> ModuleType:
    """A module by its file from the project's root. Raises PlanError."""
    try:
        return importlib.import_module(".".join(file.with_suffix("").parts))
    except Exception as error:
        raise PlanError(f"{file}: cannot be imported: {error!r}; correct the module") from error


def cocotb_tests(root: Path = ROOT) -> Iterator[NamedTest]:
    """Those of every bench. Benches make tests at import, so they are imported; that needs no simulator.

    What stands in a folder `tests` is part of a test of pytest, made up for it.
    """
    for path in sorted((root / "verif").rglob("*.py")):
        of_pytest = path.name.startswith("test_") or path.parent.name == "tests"
        if of_pytest or not any(mark in path.read_text() for mark in _BENCH_MARKS):
            continue
        module = _imported(path.relative_to(root))
        for found in vars(module).values():
            # What `cocotb.test()` leaves in a module.
            if hasattr(found, "generate_tests") and found.module == module.__name__:
                yield NamedTest(found.module, found.name)


def pytest_tests(root: Path = ROOT) -> Iterator[NamedTest]:
    """Functions that pytest collects. Parsed, not imported."""
    settings = tomllib.loads((root / "pyproject.toml").read_text())["tool"]["pytest"]["ini_options"]
    for folder in settings["testpaths"]:
        for path in sorted((root / folder).rglob("test_*.py")):
            file = path.relative_to(root).as_posix()
            for node in ast.parse(path.read_text()).body:
                if isinstance(node, ast.FunctionDef) and node.name.startswith("test_"):
                    yield NamedTest(file, node.name)


def cover_points(root: Path = ROOT) -> Iterator[CoverPoint]:
    """Each point of each `coverage.py` that declares some."""
    for path in sorted((root / "verif").rglob("coverage.py")):
        file = path.relative_to(root)
        declared = getattr(_imported(file), "COVERAGE", None)
        for point in declared.points if declared else ():
            bins = tuple(found.name for found in point.bins)
            yield CoverPoint(f"{path.parent.name}.{point.name}", file.as_posix(), bins)


def inventory() -> Inventory:
    """The project's own."""
    folders = tuple((units.UNITS / name).relative_to(ROOT) for name in units.names())
    return Inventory(frozenset([*cocotb_tests(), *pytest_tests()]), tuple(cover_points()), folders)
