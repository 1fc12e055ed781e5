"""What must have been seen of the objects' set-up: rows of each kind, radii, ambient terms, resets."""

from models.fixed import RADIUS
from models.formats import Knobs, formats
from verif.env.coverage.classes import scenario, values
from verif.env.coverage.handshake import Found, lasting, was
from verif.env.coverage.points import Bin, Coverage, Holds, Point, Samples, cross
from verif.env.unit import Parameters

FRAMES, FULL, RESETS = map(scenario, ("frames", "full frames", "resets"))

STATES = ("idle", "next", "read", "start", "products", "ask", "wait", "write")
"""Names of `state_reg`, in the order of their codes."""
_SHADE = formats(Knobs()).shade
_AMBIENT = 6
"""The product of the first channel of the ambient term; two more follow."""


def _in(s: Samples, state: str) -> Found:
    return s["state_reg"] == STATES.index(state)


def _starts(s: Samples) -> Found:
    return _in(s, "idle") & (s["start"] == 1) & (s["rst"] == 0)


def _row(s: Samples) -> Found:
    return s["table_valid"] == 1


def _sphere(s: Samples) -> Found:
    return _row(s) & (s["is_triangle_reg"] == 0)


def _triangle(s: Samples) -> Found:
    return _row(s) & (s["is_triangle_reg"] == 1)


def _most(p: Parameters, kind: str) -> int:
    """As many as the index holds, and a count of eight bits."""
    return min(1 << p[f"{kind}_INDEX_W"], 255)


def _channel(number: int, value: int) -> Holds:
    """An ambient term of this value."""

    def holds(_p: Parameters, s: Samples) -> Found:
        comes = (s["collect_valid"] == 1) & (s["collect"] == _AMBIENT + number)
        return comes & (s["shade"] == value)

    return holds


def _marks(reflects: int, transmits: int) -> Holds:
    return lambda _p, s: (s["done"] == 1) & (s["reflects"] == reflects) & (s["transmits"] == transmits)


def _reset(state: str) -> Holds:
    return lambda _p, s: _in(s, state) & (s["rst"] == 1)


KIND = Point(
    "kind",
    "of an object",
    (
        Bin("sphere", FRAMES, lambda _p, s: _sphere(s)),
        Bin("triangle", FRAMES, lambda _p, s: _triangle(s) & (s["dead"] == 0)),
        Bin("dead_triangle", FRAMES, lambda _p, s: _triangle(s) & (s["dead"] == 1)),
    ),
)
GLASS = Point(
    "glass",
    "whether it lets light through",
    (
        Bin("opaque", FRAMES, lambda _p, s: _row(s) & (s["glass"] == 0)),
        Bin("glass", FRAMES, lambda _p, s: _row(s) & (s["glass"] == 1)),
    ),
)
MIRROR = Point(
    "mirror",
    "whether it reflects",
    (
        Bin("dull", FRAMES, lambda _p, s: _row(s) & (s["mirror"] == 0)),
        Bin("mirror", FRAMES, lambda _p, s: _row(s) & (s["mirror"] == 1)),
    ),
)

COVERAGE = Coverage(
    signals=(
        "rst",
        "start",
        "done",
        "state_reg",
        "is_triangle_reg",
        "spheres",
        "triangles",
        "table_valid",
        "dead",
        "glass",
        "mirror",
        "radius",
        "collect_valid",
        "collect",
        "shade",
        "unit_valid",
        "reflects",
        "transmits",
    ),
    points=(
        values("state_reg", "states", {name: (code, FRAMES) for code, name in enumerate(STATES)}, "state"),
        Point(
            "objects",
            "of the frame",
            (
                Bin("none", FRAMES, lambda _p, s: _starts(s) & (s["spheres"] == 0) & (s["triangles"] == 0)),
                Bin(
                    "spheres_alone",
                    FRAMES,
                    lambda _p, s: _starts(s) & (s["spheres"] > 0) & (s["triangles"] == 0),
                ),
                Bin(
                    "triangles_alone",
                    FRAMES,
                    lambda _p, s: _starts(s) & (s["spheres"] == 0) & (s["triangles"] > 0),
                ),
                Bin(
                    "one_of_each",
                    FRAMES,
                    lambda _p, s: _starts(s) & (s["spheres"] == 1) & (s["triangles"] == 1),
                ),
                Bin(
                    "many_of_each",
                    FRAMES,
                    lambda _p, s: _starts(s) & (s["spheres"] > 1) & (s["triangles"] > 1),
                ),
                Bin("most_spheres", FULL, lambda p, s: _starts(s) & (s["spheres"] == _most(p, "SPHERE"))),
                Bin(
                    "most_triangles", FULL, lambda p, s: _starts(s) & (s["triangles"] == _most(p, "TRIANGLE"))
                ),
            ),
        ),
        cross(KIND, GLASS, recipe=FRAMES),
        cross(KIND, MIRROR, recipe=FRAMES),
        Point(
            "radius",
            "of a sphere",
            (
                Bin("least", FULL, lambda _p, s: _sphere(s) & (s["radius"] == 1)),
                Bin(
                    "power_of_two",
                    FULL,
                    lambda _p, s: _sphere(s) & (s["radius"] > 1) & (s["radius"] & (s["radius"] - 1) == 0),
                ),
                Bin(
                    "any_other",
                    FULL,
                    lambda _p, s: (
                        _sphere(s) & (s["radius"] & (s["radius"] - 1) > 0) & (s["radius"] < RADIUS.max)
                    ),
                ),
                Bin("most", FULL, lambda _p, s: _sphere(s) & (s["radius"] == RADIUS.max)),
            ),
        ),
        Point(
            "ambient_none",
            "a channel that is black",
            tuple(Bin(f"channel_{n}", FRAMES, _channel(n, 0)) for n in range(3)),
        ),
        Point(
            "ambient_saturated",
            "a channel that saturates",
            tuple(Bin(f"channel_{n}", FRAMES, _channel(n, _SHADE.max)) for n in range(3)),
        ),
        Point(
            "ambient",
            "of a channel",
            (
                Bin("one", FRAMES, _channel(0, _SHADE.one)),
                Bin(
                    "some",
                    FRAMES,
                    lambda _p, s: (
                        (s["collect_valid"] == 1)
                        & (s["collect"] >= _AMBIENT)
                        & (s["shade"] > 0)
                        & (s["shade"] < _SHADE.one)
                    ),
                ),
            ),
        ),
        Point(
            "normaliser",
            "how long it takes",
            (
                Bin("one_clock", FRAMES, lambda _p, s: (s["unit_valid"] == 1) & was(_in(s, "ask"))),
                Bin(
                    "long",
                    FRAMES,
                    lambda _p, s: lasting(
                        _in(s, "wait") & (s["is_triangle_reg"] == 1) & (s["unit_valid"] == 0)
                    ),
                ),
            ),
        ),
        Point(
            "marks",
            "of the frame, when it is done",
            (
                Bin("neither", FRAMES, _marks(0, 0)),
                Bin("reflects", FRAMES, _marks(1, 0)),
                Bin("transmits", FRAMES, _marks(0, 1)),
                Bin("both", FRAMES, _marks(1, 1)),
                Bin(
                    "forgotten",
                    FRAMES,
                    lambda _p, s: (
                        was(_starts(s) & (s["reflects"] == 1) & (s["transmits"] == 1)) & (s["reflects"] == 0)
                    ),
                ),
            ),
        ),
        Point(
            "start",
            "of a frame",
            (
                Bin("at_once_behind_another", FRAMES, lambda _p, s: _starts(s) & was(s["done"] == 1)),
                Bin(
                    "behind_a_rest",
                    FRAMES,
                    lambda _p, s: _starts(s) & was(lasting(_in(s, "idle") & (s["rst"] == 0))),
                ),
            ),
        ),
        Point("reset", "in each state", tuple(Bin(state, RESETS, _reset(state)) for state in STATES)),
    ),
)
