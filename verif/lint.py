"""Lints the Verilog: every module as a top with Verilator, all warnings on, and with Icarus as Verilog-2005.

The core is linted in every named build. Exit code 1 where there is a warning.
"""

import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

from models.cores import CORES
from models.header import defines
from verif.env import sources
from verif.env.simulators import Simulator, available, verilator_root

_VERILATOR = ("--lint-only", "-Wall", "--quiet")
_ICARUS = ("iverilog", "-g2005", "-Wall", "-Wno-timescale", "-o", "/dev/null")


def _common(files: tuple[Path, ...], macros: dict[str, int]) -> list[str]:
    includes = [f"-I{path}" for path in sources.include_dirs()]
    return [*includes, *(f"-D{name}={value}" for name, value in macros.items()), *map(str, files)]


def _commands(simulators: tuple[Simulator, ...]) -> Iterator[tuple[str, list[str]]]:
    verilator = str(verilator_root() / "bin" / "verilator")
    tops = [path.stem for path in sorted(sources.HDL.rglob("*.v"))]
    for top in tops:
        for build, core in CORES.items() if top == "raytracer" else [("default", CORES["default"])]:
            common = _common(sources.closure(top), defines(core.knobs))
            values = core.parameters() if top == "raytracer" else {}
            given = [f"-G{name}={value}" for name, value in values.items()]
            yield f"{top} ({build})", [verilator, *_VERILATOR, *given, "--top-module", top, *common]
            if Simulator.ICARUS in simulators:
                given = [f"-P{top}.{name}={value}" for name, value in values.items()]
                yield f"{top} ({build})", [*_ICARUS, *given, "-s", top, *common]


def main() -> int:
    """Command line."""
    failed = 0
    for what, command in _commands(available()):
        result = subprocess.run(command, capture_output=True, text=True, check=False, cwd=sources.ROOT)
        if result.returncode or result.stdout.strip() or result.stderr.strip():
            failed += 1
            print(f"{what}: {Path(command[0]).name}\n{result.stdout}{result.stderr}", file=sys.stderr)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
