"""What must have been seen of the control: states, ways between them, resets and faults in every state."""

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from models.limits import Fault
from verif.env.coverage.classes import before, scenario, values
from verif.env.coverage.points import Bin, Coverage, Holds, Point, Recipe, Samples
from verif.env.unit import Parameters

STATES = (
    "idle",
    "swap",
    "read",
    "start_camera",
    "camera",
    "start_object",
    "object",
    "ready",
    "start_draw",
    "draw",
)
"""Names of `state_reg`, in the order of their codes."""

FRAMES, RESETS = scenario("frames"), scenario("resets")


def _code(name: str) -> int:
    return STATES.index(name)


def _in_state(name: str, other: str, value: int = 1) -> Holds:
    """A signal has a value while the control is in a state."""

    def holds(_p: Parameters, s: Samples) -> NDArray[np.bool_]:
        return np.asarray((s["state_reg"] == _code(name)) & (s[other] == value))

    return holds


def _way(first: str, second: str) -> Holds:
    def holds(_p: Parameters, s: Samples) -> NDArray[np.bool_]:
        came = (before(s["state_reg"]) == _code(first)) & (s["state_reg"] == _code(second))
        return np.asarray(came & (before(s["rst"]) == 0))

    return holds


def _each(names: Iterable[str], signal: str, recipe: Recipe, value: int = 1) -> tuple[Bin, ...]:
    return tuple(Bin(name, recipe, _in_state(name, signal, value)) for name in names)


_WAITS = ("idle", "camera", "object", "ready", "draw")

COVERAGE = Coverage(
    signals=("state_reg", "rst", "go", "waiting_reg", "load_done", "load_fault", "camera_fault", "draw_done"),
    points=(
        values("state_reg", "states", {name: (_code(name), FRAMES) for name in STATES}, "state"),
        Point("stays", "states that wait for a block", tuple(Bin(n, FRAMES, _way(n, n)) for n in _WAITS)),
        Point(
            "ends",
            "how a frame leaves the control",
            (
                Bin("drawn", FRAMES, _way("draw", "idle")),
                Bin("refused_by_camera", FRAMES, _way("camera", "idle")),
            ),
        ),
        Point("reset", "reset in every state", _each(STATES, "rst", RESETS)),
        Point("load_done", "a frame read while", _each(("idle", "draw"), "load_done", FRAMES)),
        Point("waiting", "the next frame waits while", _each(("idle", "draw"), "waiting_reg", FRAMES)),
        Point("held", "a frame that waits for go", (Bin("idle", FRAMES, _in_state("idle", "go", 0)),)),
        values(
            "load_fault",
            "faults of the loader",
            {
                fault.name.lower(): (int(fault), FRAMES)
                for fault in (
                    Fault.FRAME_SHORT,
                    Fault.FRAME_LONG,
                    Fault.CAPACITY,
                    Fault.KIND,
                    Fault.RADIUS,
                )
            },
        ),
        values(
            "camera_fault",
            "faults of the camera",
            {
                fault.name.lower(): (int(fault), FRAMES)
                for fault in (Fault.SIZE, Fault.CAMERA_POSITION, Fault.CAMERA_UP)
            },
        ),
    ),
)
