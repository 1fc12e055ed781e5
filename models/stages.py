"""The stage table of `hdl/README.md`: latency, multipliers and result of each stage, from the tables here.

python -m models.stages            writes the tables into the page
python -m models.stages --check    exit code 1 where the page is not what the tables say
"""

import argparse
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

from models.cores import CORES
from models.fixed import Format
from models.formats import BUILDS, TABLE, Formats, formats
from models.latency import LATENCY
from models.limits import MEANING
from models.pages import replaced
from models.registers import REGISTERS, Build, Register

PAGE = Path(__file__).parents[1] / "hdl" / "README.md"

_PIECE = 17
_SHORT = 5
"""``PIECE_W`` of ``hdl/arith/mul.v``, ``SHORT_W`` of ``hdl/arith/mul_piece.v``; a test holds them equal."""


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
    """One stage: module, what it does, formats of its products, its result, how many of it there are."""

    module: str
    does: str
    products: Callable[[Formats], int]
    result: str
    copies: int = 1

    def multipliers(self, fmts: Formats) -> int:
        """18 x 18 multipliers of all copies."""
        return self.copies * self.products(fmts)


_OPERAND = Format(18, 0)
"""Operand of the shared multipliers of `intersection`: a number, or a piece of one."""


def _intersection(f: Formats) -> int:
    area = max(f.offset, f.unit, key=lambda fmt: fmt.width)
    return multipliers(f.unit, _OPERAND, 18) + multipliers(area, area, 6)


def _surface(f: Formats) -> int:
    inverse = Format(f.inv_radius.int_bits + 1, f.inv_radius.frac_bits)
    return multipliers(f.unit, f.point, 3) + multipliers(f.offset, inverse, 3)


def _refract(f: Formats) -> int:
    radicand = multipliers(f.cosine, f.cosine) + multipliers(f.eta_sq, f.sine_sq)
    signed_eta = Format(f.eta.int_bits + 1, f.eta.frac_bits)
    direction = multipliers(f.gain, f.unit, 3) + multipliers(signed_eta, f.unit, 3)
    return radicand + multipliers(f.eta, f.cosine) + direction


def _phong(f: Formats) -> int:
    cosines = multipliers(f.unit, f.unit, 6)
    power = multipliers(f.cosine, f.cosine, 4)
    return cosines + power + multipliers(f.coeff, f.cosine, 6) + multipliers(f.shade, f.coeff, 3)


def _normaliser(f: Formats) -> int:
    return multipliers(f.mantissa, f.mantissa, 3)


_WIDE = Format(20, 0)
"""Operands of the multipliers that set-ups share: differences of coordinates, tangents, coefficients."""


def _set_up(_: Formats) -> int:
    return multipliers(_WIDE, _WIDE)


def _dim(f: Formats) -> int:
    """Not cut by `mul`: synthesis gives whatever is above 18 bits a multiplier of its own."""
    return 3 * -(-f.shade.width // 18)


def _none(_: Formats) -> int:
    return 0


_UNITS = CORES["default"].units

STAGES = (
    Stage("camera", "basis of the screen, once a frame", _set_up, "screen, span"),
    Stage(
        "object_setup",
        "constants of an object, once a frame: of one sphere",
        lambda f: _set_up(f) + multipliers(f.radius, f.radius),
        "radius_sq, inv_radius, unit, shade",
    ),
    Stage("unit_vector", "direction of the primary ray; of basis and normals", _normaliser, "unit"),
    Stage(
        "intersection",
        f"ray against object, in {_UNITS} trace units",
        _intersection,
        "point, offset, half_chord",
        _UNITS,
    ),
    Stage(
        "dim",
        f"light behind an object, in {_UNITS} trace units",
        _dim,
        "shade",
        _UNITS,
    ),
    Stage("surface", "hit point and normal", _surface, "point, unit"),
    Stage("reflect", "mirrored direction", lambda f: multipliers(f.unit, f.unit, 6), "unit"),
    Stage("vec_mul", "weight of a child", lambda f: multipliers(f.shade, f.coeff, 3), "shade"),
    Stage("refract", "transmitted direction", _refract, "unit"),
    Stage("light_vector", "direction and distance of a light", _normaliser, "unit, point"),
    Stage("phong", "light of the hit point", _phong, "shade"),
    Stage("vec_mul", "times the ray's weight", lambda f: multipliers(f.shade, f.shade, 6), "shade"),
    Stage("rgb888", "bytes", _none, "channel"),
)


def _stage_table() -> Iterator[str]:
    builds = {name: formats(knobs) for name, knobs in BUILDS.items()}
    counted = " | ".join(f"18 x 18 multipliers, {name}" for name in builds)
    yield f"| stage | module | clocks | {counted} | result |"
    yield f"| --- | --- | --- | {' | '.join('---' for _ in builds)} | --- |"
    for stage in STAGES:
        counts = " | ".join(str(stage.multipliers(fmts)) for fmts in builds.values())
        clocks = LATENCY[stage.module]({})
        yield f"| {stage.does} | `{stage.module}` | {clocks} | {counts} | {stage.result} |"
    sums = " | ".join(str(sum(stage.multipliers(fmts) for stage in STAGES)) for fmts in builds.values())
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
        page = replaced(page, name, table())
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
