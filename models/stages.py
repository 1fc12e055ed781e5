"""The stage table of `hdl/README.md`: latency, multipliers and result of each stage, from the tables here.

python -m models.stages            writes the tables into the page
python -m models.stages --check    exit code 1 where the page is not what the tables say
"""

import argparse
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

from models.fixed import Format
from models.formats import BUILDS, TABLE, Formats, formats
from models.latency import LATENCY
from models.limits import MEANING
from models.registers import REGISTERS, Build, Register

PAGE = Path(__file__).parents[1] / "hdl" / "README.md"

_PIECE = 17
_SHORT = 5
"""``PIECE_W`` of ``hdl/arith/mul.v`` and ``SHORT_W`` of ``hdl/arith/mul_piece.v``; a test holds them equal."""


def multipliers(a: Format, b: Format, count: int = 1) -> int:
    """18 x 18 multipliers of ``count`` products, cut as ``hdl/arith/mul.v`` cuts them: pieces of 17 bits, a
    signed rest of up to 18; a piece of up to 5 bits is made of adders."""

    def large_pieces(fmt: Format) -> int:
        width = fmt.width + (0 if fmt.signed else 1)
        pieces = 1 if width <= _PIECE + 1 else -(-(width - 1) // _PIECE)
        last = width - _PIECE * (pieces - 1)
        return pieces - (last <= _SHORT)

    return count * large_pieces(a) * large_pieces(b)


@dataclass(frozen=True)
class Stage:
    """One stage: module, what it does, where its latency is, formats of its products, its result."""

    module: str
    does: str
    products: Callable[[Formats], int]
    result: str


def _phong(f: Formats) -> int:
    cosines = multipliers(f.unit, f.unit, 6)
    power = multipliers(f.cosine, f.cosine, 4)
    parts = multipliers(f.coeff, f.cosine, 6) + multipliers(f.coeff, f.coeff, 3)
    return cosines + power + parts + multipliers(f.shade, f.shade, 3)


def _sphere(f: Formats) -> int:
    return multipliers(f.unit, f.point, 6) + multipliers(f.offset, f.offset, 3)


def _surface(f: Formats) -> int:
    chord = Format(f.half_chord.int_bits + 1, f.half_chord.frac_bits)
    inverse = Format(f.inv_radius.int_bits + 1, f.inv_radius.frac_bits)
    return multipliers(f.unit, chord, 3) + multipliers(f.offset, inverse, 3)


_WIDE = Format(20, 0)
"""Operands of the multipliers that set-ups share: differences of coordinates, tangents, coefficients."""

STAGES = (
    Stage("camera", "basis of the screen, once a frame", lambda _: multipliers(_WIDE, _WIDE), "screen, span"),
    Stage(
        "object_setup",
        "constants of the objects, once a frame: of one sphere",
        lambda _: multipliers(_WIDE, _WIDE),
        "radius_sq, inv_radius, unit, shade",
    ),
    Stage(
        "unit_vector",
        "direction of the primary ray",
        lambda f: multipliers(f.mantissa, f.mantissa, 3),
        "unit",
    ),
    Stage("sphere_intersect", "primary ray against the sphere", _sphere, "point, offset, half_chord"),
    Stage("surface", "hit point and normal", _surface, "point, unit"),
    Stage("reflect", "mirrored direction", lambda f: multipliers(f.unit, f.unit, 6), "unit"),
    Stage(
        "light_vector",
        "direction and distance of the light",
        lambda f: multipliers(f.mantissa, f.mantissa, 3),
        "unit, point",
    ),
    Stage("sphere_intersect", "shadow ray against the sphere", _sphere, "hit or not"),
    Stage("phong", "light of the hit point", _phong, "shade"),
    Stage("colour_add", "plus ambient", lambda _: 0, "shade"),
    Stage("vec_mul", "times the ray's weight", lambda f: multipliers(f.shade, f.shade, 3), "shade"),
    Stage("rgb888", "bytes", lambda _: 0, "channel"),
)


def _stage_table() -> Iterator[str]:
    builds = {name: formats(knobs) for name, knobs in BUILDS.items()}
    counted = " | ".join(f"18 x 18 multipliers, {name}" for name in builds)
    yield f"| stage | module | clocks | {counted} | result |"
    yield f"| --- | --- | --- | {' | '.join('---' for _ in builds)} | --- |"
    for stage in STAGES:
        counts = " | ".join(str(stage.products(fmts)) for fmts in builds.values())
        clocks = LATENCY[stage.module]({})
        yield f"| {stage.does} | `{stage.module}` | {clocks} | {counts} | {stage.result} |"
    sums = " | ".join(str(sum(stage.products(fmts) for stage in STAGES)) for fmts in builds.values())
    yield f"| sum | | | {sums} | |"


def _format_table() -> Iterator[str]:
    builds = {name: formats(knobs) for name, knobs in BUILDS.items()}
    yield f"| format | {' | '.join(builds)} | what it carries |"
    yield f"| --- | {' | '.join('---' for _ in builds)} | --- |"
    for name, row in TABLE.items():
        values = " | ".join(f"`{getattr(fmts, name)}`" for fmts in builds.values())
        yield f"| {name} | {values} | {row.use} |"


def _fault_table() -> Iterator[str]:
    yield "| code | fault |"
    yield "| --- | --- |"
    for fault, meaning in MEANING.items():
        yield f"| {fault.value} | `RT_FAULT_{fault.name}`: {meaning} |"


def _register_rows(register: Register, build: Build) -> Iterator[str]:
    first = f"0x{register.address:02x} | `{register.name}`"
    for field in register.fields:
        bits = str(field.high) if field.width == 1 else f"{field.high}:{field.low}"
        reset = str(build.number(field.reset))
        if isinstance(field.reset, str):
            reset = f"{reset}: `{field.reset.upper()}`"
        yield f"| {first} | {bits} | {field.name} | {field.access.value} | {reset} | {field.meaning} |"
        first = "|"


def _register_table() -> Iterator[str]:
    yield "| address | register | bits | field | access | reset | meaning |"
    yield "| --- | --- | --- | --- | --- | --- | --- |"
    for register in REGISTERS.values():
        yield from _register_rows(register, Build())


_TABLES = {
    "stages": _stage_table,
    "formats": _format_table,
    "registers": _register_table,
    "faults": _fault_table,
}


def refreshed(page: str) -> str:
    """The page with each table between its markers made anew."""
    for name, table in _TABLES.items():
        start, end = f"<!-- {name} -->", f"<!-- end of {name} -->"
        head, found, rest = page.partition(start)
        _, closed, tail = rest.partition(end)
        if not (found and closed):
            raise ValueError(f"{PAGE.name} has no {start} ... {end}")
        page = "\n".join([f"{head}{start}", *table(), f"{end}{tail}"])
    return page


def main() -> int:
    """Command line; see the module's docstring."""
    parser = argparse.ArgumentParser(description="Writes the tables of hdl/README.md.")
    parser.add_argument("--check", action="store_true", help="only compare")
    page = PAGE.read_text()
    if not parser.parse_args().check:
        PAGE.write_text(refreshed(page))
        return 0
    if refreshed(page) == page:
        return 0
    print("hdl/README.md is not what the tables say: run `python -m models.stages`", file=sys.stderr)
    return 1


if __name__ == "__main__":
    sys.exit(main())
