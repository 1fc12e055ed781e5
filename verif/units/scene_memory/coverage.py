"""What must have been seen of the scene memory: records written and read, swaps, resets."""

import numpy as np
from numpy.typing import NDArray

from models.limits import Record
from verif.env.coverage.classes import before, scenario
from verif.env.coverage.points import Bin, Coverage, Holds, Point, Samples
from verif.env.unit import Parameters

FRAMES, MIXED = scenario("frames"), scenario("mixed")
_MANY = (Record.LIGHT, Record.SPHERE, Record.TRIANGLE)


def _last(p: Parameters, kind: Record) -> int:
    return p[f"{kind.name}S"] - 1


def _written(kind: Record, last: bool) -> Holds:
    def holds(p: Parameters, s: Samples) -> NDArray[np.bool_]:
        writes = (s["write_valid"] == 1) & (s["write_kind"] == kind)
        if kind not in _MANY:
            return np.asarray(writes)
        return np.asarray(writes & (s["write_index"] == (_last(p, kind) if last else 0)))

    return holds


def _read(kind: Record, last: bool) -> Holds:
    def holds(p: Parameters, s: Samples) -> NDArray[np.bool_]:
        return np.asarray(s[f"{kind.name.lower()}_index"] == (_last(p, kind) if last else 0))

    return holds


def _ignored(_p: Parameters, s: Samples) -> NDArray[np.bool_]:
    return np.asarray((s["write_valid"] == 1) & ~np.isin(s["write_kind"], [int(kind) for kind in Record]))


def _swap(case: str) -> Holds:
    def holds(_p: Parameters, s: Samples) -> NDArray[np.bool_]:
        swaps = s["swap"] == 1
        cases = {
            "alone": s["write_valid"] == 0,
            "with_a_write": s["write_valid"] == 1,
            "twice": before(s["swap"]) == 1,
        }
        return np.asarray(swaps & cases[case])

    return holds


_WRITES = tuple(
    Bin(f"{kind.name.lower()}_{'last' if last else 'first'}", FRAMES, _written(kind, last))
    for kind in _MANY
    for last in (False, True)
)
_READS = tuple(
    Bin(f"{kind.name.lower()}_{'last' if last else 'first'}", FRAMES, _read(kind, last))
    for kind in _MANY
    for last in (False, True)
)

COVERAGE = Coverage(
    signals=(
        "rst",
        "write_valid",
        "write_kind",
        "write_index",
        "swap",
        "light_index",
        "sphere_index",
        "triangle_index",
    ),
    points=(
        Point(
            "write",
            "records written",
            (
                *_WRITES,
                Bin("camera", FRAMES, _written(Record.CAMERA, False)),
                Bin("tail", FRAMES, _written(Record.TAIL, False)),
                Bin("no_record", MIXED, _ignored),
            ),
        ),
        Point("read", "records read", _READS),
        Point(
            "swap",
            "a swap",
            tuple(Bin(case, MIXED, _swap(case)) for case in ("alone", "with_a_write", "twice")),
        ),
        Point(
            "reset",
            "reset",
            (Bin("any", MIXED, lambda _p, s: np.asarray((s["rst"] == 1) & (before(s["rst"]) == 0))),),
        ),
    ),
)
