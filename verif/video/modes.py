"""Modes and stores by the parameters of the Verilog, and small ones, so that a frame is over soon."""

from collections.abc import Mapping

from models.video import Axis, Mode, Store

Parameters = Mapping[str, int]


def _axis(parameters: Parameters, letter: str) -> Axis:
    active, front, sync, back, positive = (
        parameters[f"{letter}_{part}"] for part in ("ACTIVE", "FRONT", "SYNC", "BACK", "POSITIVE")
    )
    return Axis(active, front, sync, back, bool(positive))


def mode_of(parameters: Parameters) -> Mode:
    """The mode that a module is built for."""
    return Mode("the module's mode", 1, _axis(parameters, "H"), _axis(parameters, "V"))


def store_of(parameters: Parameters) -> Store:
    """The frame buffer of a module."""
    return Store(parameters["WIDTH"], parameters["HEIGHT"], parameters["DEPTH_BITS"])


def mode_parameters(mode: Mode) -> dict[str, int]:
    """What `mode_of` made a mode of."""
    return {
        f"{letter}_{part.upper()}": int(getattr(axis, part))
        for letter, axis in (("H", mode.horizontal), ("V", mode.vertical))
        for part in ("active", "front", "sync", "back", "positive")
    }


def store_parameters(store: Store) -> dict[str, int]:
    """What `store_of` made a store of."""
    return {"WIDTH": store.width, "HEIGHT": store.height, "DEPTH_BITS": store.depth_bits}


SMALL = Mode("small", 1, Axis(20, 2, 3, 4), Axis(14, 1, 2, 3))
"""Both pulses low, as in the default mode."""

MIXED = Mode("mixed", 1, Axis(25, 1, 7, 3, positive=True), Axis(13, 3, 1, 1))
"""A line of 36 clocks, pulses of both polarities, a picture that is in the middle to half a pixel."""

WIDE = Mode("wide", 1, Axis(4093, 1, 1, 1), Axis(2, 1, 1, 1))
TALL = Mode("tall", 1, Axis(2, 1, 1, 1), Axis(4093, 1, 1, 1))
"""Lines, or columns, of 4,096: of a size all 12 bits are in use."""

TIGHT = Mode("tight", 1, Axis(13, 1, 1, 1), Axis(5, 1, 1, 1, positive=True))
"""A line of 16 clocks and 8 lines: the counters use all their values; nothing is longer than it must be."""

ODD = Mode("odd", 1, Axis(10, 1, 1, 3), Axis(12, 1, 1, 1))
"""A line of 15 clocks and 15 lines, so that what turns over in each of them does not come out even."""
