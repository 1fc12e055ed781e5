"""What must have been seen of the camera: states, faults, sizes, tangents, signs of the spans, resets."""

from collections.abc import Iterable

from models.formats import Knobs, formats
from models.limits import Fault
from verif.env.coverage.classes import scenario, values
from verif.env.coverage.handshake import Found, lasting, was
from verif.env.coverage.points import Bin, Coverage, Holds, Point, Recipe, Samples
from verif.env.unit import Parameters

VIEWS, FAULTS, RESETS = map(scenario, ("views", "faults", "resets"))

STATES = (
    "idle",
    "view",
    "right",
    "ask_d",
    "ask_u",
    "wait_d",
    "wait_u",
    "down",
    "ask_v",
    "wait_v",
    "spans",
    "divide",
    "done",
)
"""Names of the camera's `state_reg`, in the order of their codes."""
_STATE, _ASKED = "u_camera.state_reg", "u_camera.divided_reg"
_TANGENT = formats(Knobs()).tan


def _in(s: Samples, state: str) -> Found:
    return s[_STATE] == STATES.index(state)


def _started(s: Samples) -> Found:
    return (s["start"] == 1) & (s["rst"] == 0)


def _way(first: str, second: str) -> Holds:
    return lambda _p, s: was(_in(s, first) & (s["rst"] == 0)) & _in(s, second)


def _drawn(s: Samples) -> Found:
    return (s["done"] == 1) & (s["fault"] == 0)


def _largest(p: Parameters) -> int:
    return (1 << p["SIZE_W"]) - 1


def _size(name: str) -> Point:
    return Point(
        name,
        f"{name} of the picture",
        (
            Bin("none", FAULTS, lambda _p, s: _started(s) & (s[name] == 0)),
            Bin("one", VIEWS, lambda _p, s: _started(s) & (s[name] == 1)),
            Bin(
                "power_of_two",
                VIEWS,
                lambda _p, s: _started(s) & (s[name] > 1) & (s[name] & (s[name] - 1) == 0),
            ),
            Bin("largest", VIEWS, lambda p, s: _started(s) & (s[name] == _largest(p))),
        ),
    )


def _tangent(name: str) -> Point:
    return Point(
        name,
        f"{name} of the field of view",
        (
            Bin("none", VIEWS, lambda _p, s: _started(s) & (s[name] == 0)),
            Bin("below_one", VIEWS, lambda _p, s: _started(s) & (s[name] > 0) & (s[name] < _TANGENT.one)),
            Bin("one", VIEWS, lambda _p, s: _started(s) & (s[name] == _TANGENT.one)),
            Bin("most", VIEWS, lambda _p, s: _started(s) & (s[name] == _TANGENT.max)),
        ),
    )


def _signs(name: str) -> Point:
    """Of each component of the spans of columns or rows; x is lane 2."""

    def case(lane: int, negative: int) -> Holds:
        return lambda _p, s: _drawn(s) & (s[name] >> lane & 1 == negative)

    bins = tuple(
        Bin(f"{axis}_{'negative' if negative else 'positive'}", VIEWS, case(2 - place, negative))
        for place, axis in enumerate("xyz")
        for negative in (0, 1)
    )
    return Point(name, "signs of the components, of pictures that are drawn", bins)


def _reset(states: Iterable[str]) -> tuple[Bin, ...]:
    def case(state: str) -> Holds:
        return lambda _p, s: _in(s, state) & (s["rst"] == 1)

    return tuple(Bin(state, RESETS, case(state)) for state in states)


_FAULTS: tuple[tuple[Fault, Recipe], ...] = (
    (Fault.NONE, VIEWS),
    (Fault.SIZE, FAULTS),
    (Fault.CAMERA_POSITION, FAULTS),
    (Fault.CAMERA_UP, FAULTS),
)


def _ends(fault: Fault) -> Holds:
    return lambda _p, s: (s["done"] == 1) & (s["fault"] == fault)


def _division(number: int) -> Holds:
    return lambda _p, s: _in(s, "divide") & (s[_ASKED] == number)


SHAPE = Point(
    "shape",
    "of the picture",
    (
        Bin("square", VIEWS, lambda _p, s: _started(s) & (s["width"] == s["height"]) & (s["width"] > 0)),
        Bin("wide", VIEWS, lambda _p, s: _started(s) & (s["width"] > s["height"]) & (s["height"] > 0)),
        Bin("high", VIEWS, lambda _p, s: _started(s) & (s["width"] < s["height"]) & (s["width"] > 0)),
    ),
)

COVERAGE = Coverage(
    signals=(
        "rst",
        "start",
        "done",
        "fault",
        "width",
        "height",
        "tan_h",
        "tan_v",
        "column_negative",
        "row_negative",
        _STATE,
        _ASKED,
    ),
    points=(
        values(_STATE, "states", {name: (code, VIEWS) for code, name in enumerate(STATES)}, "state"),
        Point(
            "fault",
            "how a set-up ends",
            tuple(Bin(fault.name.lower(), recipe, _ends(fault)) for fault, recipe in _FAULTS),
        ),
        Point(
            "ends_from",
            "the state before done",
            (
                Bin("view", FAULTS, _way("view", "done")),
                Bin("right", FAULTS, _way("right", "done")),
                Bin("ask_d", FAULTS, _way("ask_d", "done")),
                Bin("divide", VIEWS, _way("divide", "done")),
            ),
        ),
        _size("width"),
        _size("height"),
        Point(
            "no_size",
            "width and height of 0",
            (
                Bin("both", FAULTS, lambda _p, s: _started(s) & (s["width"] == 0) & (s["height"] == 0)),
                Bin("width_alone", FAULTS, lambda _p, s: _started(s) & (s["width"] == 0) & (s["height"] > 0)),
                Bin(
                    "height_alone", FAULTS, lambda _p, s: _started(s) & (s["width"] > 0) & (s["height"] == 0)
                ),
            ),
        ),
        SHAPE,
        _tangent("tan_h"),
        _tangent("tan_v"),
        _signs("column_negative"),
        _signs("row_negative"),
        Point(
            "divisions",
            "one behind the other",
            tuple(Bin(f"number_{n}", VIEWS, _division(n)) for n in range(6)),
        ),
        Point(
            "start",
            "of a set-up",
            (
                Bin("behind_a_good_one", VIEWS, lambda _p, s: _started(s) & was(_drawn(s))),
                Bin(
                    "behind_a_fault",
                    FAULTS,
                    lambda _p, s: _started(s) & was((s["done"] == 1) & (s["fault"] > 0)),
                ),
                Bin("behind_a_rest", VIEWS, lambda _p, s: _started(s) & was(lasting(_in(s, "idle")))),
            ),
        ),
        Point("reset", "in each state", _reset(STATES)),
    ),
)
