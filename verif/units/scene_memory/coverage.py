"""What must have been seen of the scene memory: writes of each kind to either bank, swaps, reads, resets."""

from collections.abc import Callable

from models.limits import Record
from verif.env.coverage.classes import before, scenario
from verif.env.coverage.handshake import Found, was
from verif.env.coverage.points import Bin, Coverage, Point, Recipe, Samples, cross

FRAMES, MIXED, RESETS = map(scenario, ("frames", "mixed", "resets"))

_MANY = {Record.LIGHT: "LIGHTS", Record.SPHERE: "SPHERES", Record.TRIANGLE: "TRIANGLES"}


def _writes(s: Samples, kind: Record) -> Found:
    return (s["write_valid"] == 1) & (s["write_kind"] == kind)


def _each(case: Callable[[Record], Bin]) -> tuple[Bin, ...]:
    return tuple(map(case, _MANY))


def _bank(bank: int) -> Bin:
    return Bin(f"bank_{bank}", FRAMES, lambda _p, s: s["bank_reg"] == bank)


def _written(kind: Record) -> Bin:
    return Bin(kind.name.lower(), FRAMES, lambda _p, s: _writes(s, kind))


def _with_swap(kind: Record) -> Bin:
    return Bin(kind.name.lower(), MIXED, lambda _p, s: _writes(s, kind) & (s["swap"] == 1))


def _first(kind: Record) -> Bin:
    return Bin(kind.name.lower(), FRAMES, lambda _p, s: _writes(s, kind) & (s["write_index"] == 0))


def _last(kind: Record) -> Bin:
    return Bin(
        kind.name.lower(), FRAMES, lambda p, s: _writes(s, kind) & (s["write_index"] == p[_MANY[kind]] - 1)
    )


def _read(kind: Record, last: bool) -> Bin:
    index = f"{kind.name.lower()}_index"
    return Bin(
        kind.name.lower(),
        FRAMES,
        lambda p, s: (s[index] == (p[_MANY[kind]] - 1 if last else 0)) & (s["rst"] == 0),
    )


def _beside(kind: Record) -> Bin:
    """A record is read while one of the same place is written, to the other bank."""
    index = f"{kind.name.lower()}_index"
    return Bin(kind.name.lower(), MIXED, lambda _p, s: _writes(s, kind) & (s[index] == s["write_index"]))


BANK = Point("drawn", "the bank that is drawn", (_bank(0), _bank(1)))
WRITTEN = Point("written", "kinds of records", tuple(map(_written, Record)))


def _nothing(name: str, recipe: Recipe, case: Callable[[Samples], Found]) -> Bin:
    return Bin(name, recipe, lambda _p, s: case(s))


COVERAGE = Coverage(
    signals=(
        "rst",
        "write_valid",
        "write_kind",
        "write_index",
        "swap",
        "bank_reg",
        "light_index",
        "sphere_index",
        "triangle_index",
    ),
    points=(
        cross(BANK, WRITTEN, recipe=FRAMES),
        Point("written_first", "the first of a kind", _each(_first)),
        Point("written_last", "the last of a kind", _each(_last)),
        Point("read_first", "the first of a kind", _each(lambda kind: _read(kind, last=False))),
        Point("read_last", "the last of a kind", _each(lambda kind: _read(kind, last=True))),
        Point("read_as_written", "of one place, in two banks", _each(_beside)),
        Point(
            "ignored",
            "writes that are none",
            (
                _nothing(
                    "unknown_kind", MIXED, lambda s: (s["write_valid"] == 1) & (s["write_kind"] > max(Record))
                ),
                _nothing("not_valid", FRAMES, lambda s: (s["write_valid"] == 0) & (s["rst"] == 0)),
            ),
        ),
        Point(
            "written_as_they_swap",
            "the record goes to the bank that is drawn next",
            tuple(map(_with_swap, Record)),
        ),
        Point(
            "swap",
            "of the banks",
            (
                _nothing("alone", FRAMES, lambda s: (s["swap"] == 1) & (s["write_valid"] == 0)),
                _nothing("twice_in_a_row", MIXED, lambda s: (s["swap"] == 1) & was(s["swap"] == 1)),
                _nothing(
                    "back",
                    FRAMES,
                    lambda s: (s["bank_reg"] == 0) & (before(s["bank_reg"]) == 1) & was(s["rst"] == 0),
                ),
            ),
        ),
        Point(
            "reset",
            "which bank was drawn",
            (
                _nothing("first", RESETS, lambda s: (s["rst"] == 1) & (s["bank_reg"] == 0)),
                _nothing("second", RESETS, lambda s: (s["rst"] == 1) & (s["bank_reg"] == 1)),
            ),
        ),
    ),
)
