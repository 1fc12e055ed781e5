"""Writes `hdl/raytracer.vh`: formats, limits, faults and registers for the Verilog, from the tables here.

python -m models.header            writes the file
python -m models.header --check    exit code 1 where the file is not what the tables say
"""

import argparse
import sys
from collections.abc import Mapping
from fractions import Fraction
from pathlib import Path

from models import limits, registers
from models.formats import TABLE, Formats, Knobs, Row, formats
from models.scene.types import INDEX
from models.video import STORE, VGA, Axis

HEADER = Path(__file__).parents[1] / "hdl" / "raytracer.vh"

_PREAMBLE = """\
// SPDX-License-Identifier: Apache-2.0
//
// Formats, limits, faults and registers of the core. Written by `python -m models.header`; do not edit.
//
// RT_<NAME>_INT, _FRAC, _W: integer bits (sign included), fraction bits and width of a format.
// A build sets the guard bits, RT_UNIT_KNOB, RT_POINT_KNOB, RT_COLOUR_KNOB and RT_SCREEN_KNOB, by
// defining them before this file is read.
`ifndef RAYTRACER_VH
`define RAYTRACER_VH
"""


def _knob(name: str) -> str:
    return f"RT_{name.upper()}_KNOB"


def _format(name: str, row: Row) -> list[str]:
    prefix = f"RT_{name.upper()}"
    frac = str(row.frac) if isinstance(row.frac, int) else f"`{_knob(row.frac)}"
    kind = "" if row.signed else "u"
    return [
        f"// {kind}[{row.int_bits}.{row.frac}] {row.use}",
        f"`define {prefix}_INT {row.int_bits}",
        f"`define {prefix}_FRAC {frac}",
        f"`define {prefix}_W ({row.int_bits} + {frac})",
    ]


def _constant(name: str, value: Fraction, row: str) -> str:
    """A constant with the fraction of a format; its denominator is a power of two that every build holds."""
    shift = value.denominator.bit_length() - 1
    return f"`define RT_{name} ({value.numerator} << (`RT_{row}_FRAC - {shift}))"


_ROWS = {
    "GEOMETRY": "3 + 3 * `RT_UNIT_W + 9 * `RT_COORD_W + 3 * `RT_COEFF_W",
    "SURFACE": "1 + `RT_INDEX_W + 3 * `RT_UNIT_W + 3 * `RT_COORD_W",
    "MATERIAL": "3 * `RT_SHADE_W + 12 * `RT_COEFF_W",
}
"""Widths of an object's rows in the tables of the objects; see hdl/scene/object_setup.v for their fields."""


def _rows() -> list[str]:
    lines = [
        "// Rows of the tables of the objects, see scene/object_setup.v.",
        f"`define RT_INDEX_W {INDEX.width}",
        f"`define RT_INDEX_ONE {int(1 / limits.INDEX_STEP)}",
    ]
    return lines + [f"`define RT_{name}_W ({width})" for name, width in _ROWS.items()]


def _axis(letter: str, axis: Axis) -> list[str]:
    parts = ("active", "front", "sync", "back", "positive")
    return [f"`define RT_VGA_{letter}_{part.upper()} {int(getattr(axis, part))}" for part in parts]


def _video() -> list[str]:
    return [
        f"// Screen: {VGA.name}, pixel clock {VGA.pixel_clock_hz / 1e6:g} MHz; clocks, lines.",
        *_axis("H", VGA.horizontal),
        *_axis("V", VGA.vertical),
        "",
        "// Stored picture: size, bits of a pixel.",
        f"`define RT_VIDEO_WIDTH {STORE.width}",
        f"`define RT_VIDEO_HEIGHT {STORE.height}",
        f"`define RT_VIDEO_DEPTH {STORE.depth_bits}",
    ]


def text() -> str:
    """The whole header."""
    knobs = Knobs()
    lines = [_PREAMBLE]
    for knob, default in vars(knobs).items():
        lines += [f"`ifndef {_knob(knob)}", f"`define {_knob(knob)} {default}", "`endif"]
    for name, row in TABLE.items():
        lines += ["", *_format(name, row)]
    lines += ["", "// Distances, with the fraction of RT_POINT."]
    lines += [_constant(name, getattr(limits, name), "POINT") for name in ("T_MIN", "INFINITY")]
    lines += ["", "// Secondary rays: smallest weight, with the fraction of RT_SHADE; greatest depth."]
    lines += [_constant("MIN_WEIGHT", limits.MIN_WEIGHT, "SHADE"), f"`define RT_MAX_DEPTH {limits.MAX_DEPTH}"]
    lines += ["", "// Trace units of the default build.", f"`define RT_UNITS {limits.UNITS}"]
    lines += ["", "// Fault codes."]
    lines += [f"`define RT_FAULT_{fault.name} {fault.value}" for fault in limits.Fault]
    bits = max(limits.Fault).bit_length()
    lines += [f"`define RT_FAULT_W {bits}", "", "// Records of a frame, see scene/loader.v."]
    lines += [f"`define RT_RECORD_{kind.name} {kind.value}" for kind in limits.Record]
    lines += [f"`define RT_RECORD_SLOTS {limits.RECORD_SLOTS}"]
    lines += [f"`define RT_SPHERE_SLOTS {limits.SPHERE_SLOTS}", "", *_rows()]
    lines += ["", "// Registers, see bus/axil_registers.v.", *registers.macros()]
    lines += ["", *_video(), "", "`endif", ""]
    return "\n".join(lines)


def defines(knobs: Knobs) -> dict[str, int]:
    """The macros that select a build."""
    return {_knob(name): value for name, value in vars(knobs).items()}


def selected(macros: Mapping[str, int]) -> Formats:
    """The formats of the build that macros select; a knob that they do not name has its default."""
    return formats(Knobs(**{name: macros.get(_knob(name), usual) for name, usual in vars(Knobs()).items()}))


def main() -> int:
    """Command line; see the module's docstring."""
    parser = argparse.ArgumentParser(description="Writes hdl/raytracer.vh from the tables.")
    parser.add_argument("--check", action="store_true", help="only compare")
    if not parser.parse_args().check:
        HEADER.write_text(text())
        return 0
    if HEADER.exists() and HEADER.read_text() == text():
        return 0
    print(f"{HEADER.name} is not what the tables say: run `python -m models.header`", file=sys.stderr)
    return 1


if __name__ == "__main__":
    sys.exit(main())
