"""What must have been seen of the registers: each read, written and refused, strobes, waits, events."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from models.registers import REGISTERS, WORD_BYTES
from verif.env.coverage.classes import before, scenario
from verif.env.coverage.points import Bin, Coverage, Holds, Point, Recipe, Samples
from verif.env.unit import Parameters

ACCESSES, WAITS, RESETS, EVENTS = (scenario(name) for name in ("accesses", "waits", "resets", "events"))
_BUS = tuple(f"{channel}{side}" for channel in ("aw", "w", "b", "ar", "r") for side in ("valid", "ready"))
_OKAY, _SLVERR = 0, 2


def _of(s: Samples, name: str) -> NDArray[np.int64]:
    return s[f"s_axil_{name}"]


def _passes(s: Samples, channel: str) -> NDArray[np.bool_]:
    return np.asarray((_of(s, f"{channel}valid") == 1) & (_of(s, f"{channel}ready") == 1))


def _addressed(channel: str, name: str) -> Holds:
    def holds(_p: Parameters, s: Samples) -> NDArray[np.bool_]:
        at = REGISTERS[name].address // WORD_BYTES
        return np.asarray(_passes(s, channel) & (_of(s, f"{channel}addr") // WORD_BYTES == at))

    return holds


def _nowhere(channel: str) -> Holds:
    def holds(_p: Parameters, s: Samples) -> NDArray[np.bool_]:
        known = [register.address // WORD_BYTES for register in REGISTERS.values()]
        return np.asarray(_passes(s, channel) & ~np.isin(_of(s, f"{channel}addr") // WORD_BYTES, known))

    return holds


def _answered(channel: str, response: int) -> Holds:
    def holds(_p: Parameters, s: Samples) -> NDArray[np.bool_]:
        return np.asarray(_passes(s, channel) & (_of(s, f"{channel}resp") == response))

    return holds


def _strobe(strobes: Sequence[int]) -> Holds:
    def holds(_p: Parameters, s: Samples) -> NDArray[np.bool_]:
        return np.asarray(_passes(s, "w") & np.isin(_of(s, "wstrb"), strobes))

    return holds


def _waits(channel: str, clocks: int) -> Holds:
    """What is offered has not been taken for so many clocks."""

    def holds(_p: Parameters, s: Samples) -> NDArray[np.bool_]:
        valid, ready = _of(s, f"{channel}valid"), _of(s, f"{channel}ready")
        offered = np.ones(valid.shape, dtype=np.bool_)
        for back in range(clocks + 1):
            offered &= (before(valid, back) if back else valid) == 1
        return np.asarray(offered & (before(ready) == 0) & _passes(s, channel))

    return holds


def _order(case: str) -> Holds:
    def holds(_p: Parameters, s: Samples) -> NDArray[np.bool_]:
        address, data = _passes(s, "aw"), _passes(s, "w")
        cases = {
            "together": address & data,
            "address_first": address & (_of(s, "wvalid") == 0),
            "data_first": data & (_of(s, "awvalid") == 0),
        }
        return np.asarray(cases[case])

    return holds


def _both(first: str, second: str) -> Holds:
    def holds(_p: Parameters, s: Samples) -> NDArray[np.bool_]:
        return np.asarray(_passes(s, first) & _passes(s, second))

    return holds


def _high(name: str) -> Holds:
    def holds(_p: Parameters, s: Samples) -> NDArray[np.bool_]:
        return np.asarray(s[name] == 1)

    return holds


def _reset_with(signal: str) -> Holds:
    def holds(_p: Parameters, s: Samples) -> NDArray[np.bool_]:
        return np.asarray((s["rst"] == 1) & (_of(s, signal) == 1))

    return holds


def _bins(cases: dict[str, Holds], recipe: Recipe) -> tuple[Bin, ...]:
    return tuple(Bin(name, recipe, holds) for name, holds in cases.items())


def _accesses(channel: str) -> tuple[Bin, ...]:
    known = {name.lower(): _addressed(channel, name) for name in REGISTERS}
    return _bins({**known, "nowhere": _nowhere(channel)}, ACCESSES)


def _answers(channel: str) -> tuple[Bin, ...]:
    return _bins({"okay": _answered(channel, _OKAY), "slverr": _answered(channel, _SLVERR)}, ACCESSES)


_STROBES = {"none": (0,), "one": (1, 2, 4, 8), "some": (3, 5, 6, 7, 9, 10, 11, 12, 13, 14), "all": (15,)}

COVERAGE = Coverage(
    signals=(
        "rst",
        "go",
        "irq",
        "core_rst",
        "frame_start",
        "frame_done",
        "frame_error",
        *(f"s_axil_{name}" for name in _BUS),
        *(f"s_axil_{name}" for name in ("awaddr", "araddr", "wstrb", "bresp", "rresp")),
    ),
    points=(
        Point("write", "registers that are written, or would be", _accesses("aw")),
        Point("read", "registers that are read", _accesses("ar")),
        Point("write_answer", "responses to writes", _answers("b")),
        Point("read_answer", "responses to reads", _answers("r")),
        Point(
            "strobe",
            "bytes of a write",
            _bins({name: _strobe(strobes) for name, strobes in _STROBES.items()}, ACCESSES),
        ),
        Point(
            "order",
            "which of address and data is taken first",
            _bins({name: _order(name) for name in ("together", "address_first", "data_first")}, WAITS),
        ),
        Point("held", "offers that wait", _bins({name: _waits(name, 1) for name in ("b", "r")}, WAITS)),
        Point("offered", "taken", _bins({name: _waits(name, 1) for name in ("aw", "w", "ar")}, WAITS)),
        Point("at_once", "a read beside a write", _bins({"answers": _both("b", "r")}, WAITS)),
        Point(
            "event",
            "what the core tells and is told",
            _bins(
                {
                    name: _high(name)
                    for name in ("frame_start", "frame_done", "frame_error", "go", "irq", "core_rst")
                },
                EVENTS,
            ),
        ),
        Point(
            "reset",
            "reset with an answer that waits",
            _bins({"write": _reset_with("bvalid"), "read": _reset_with("rvalid")}, RESETS),
        ),
    ),
)
