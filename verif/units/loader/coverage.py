"""What must have been seen of the loader: sections, ways between them, faults by section, resets in each."""

from collections.abc import Iterable

from models.limits import Fault
from verif.env.coverage.classes import before, scenario, values
from verif.env.coverage.handshake import Found, handshake, lasting, was
from verif.env.coverage.points import Bin, Coverage, Holds, Point, Recipe, Samples
from verif.env.unit import Parameters

FRAMES, FAULTS, WAITS, RESETS = map(scenario, ("frames", "faults", "waits", "resets"))
TOO_MANY, CUT_COUNTS = scenario("too many"), scenario("cut counts")

SECTIONS = ("camera", "light", "sphere", "triangle", "tail", "counts", "end", "drain")
"""Names of `section_reg`, in the order of their codes."""
_READ = SECTIONS[:6]
_COUNTS = {"lights": "MAX_LIGHTS", "spheres": "MAX_SPHERES", "triangles": "MAX_TRIANGLES"}


def _in(s: Samples, section: str) -> Found:
    return (s["section_reg"] == SECTIONS.index(section)) & (s["busy_reg"] == 1)


def _way(first: str, second: str) -> Holds:
    """From a section's last field to a section's first one, by way of a field that is taken."""

    def holds(_p: Parameters, s: Samples) -> Found:
        return was(_in(s, first)) & _in(s, second) & (s["field_reg"] == 0) & (before(s["field_reg"]) != 0)

    return holds


def _ways(*ways: tuple[str, str]) -> tuple[Bin, ...]:
    return tuple(Bin(f"{one}_to_{other}", FRAMES, _way(one, other)) for one, other in ways)


def _where(signal: str, sections: Iterable[str], recipe: Recipe, **recipes: Recipe) -> tuple[Bin, ...]:
    def case(section: str) -> Holds:
        return lambda _p, s: _in(s, section) & (s[signal] == 1)

    return tuple(Bin(section, recipes.get(section, recipe), case(section)) for section in sections)


def _count(kind: str, most: bool) -> Holds:
    return lambda p, s: (
        (s["finish"] == 1) & (s["fault_reg"] == 0) & (s[f"{kind}_reg"] == (p[_COUNTS[kind]] if most else 0))
    )


def _too_many(field: int) -> Holds:
    return lambda _p, s: _in(s, "counts") & (s["wrong"] == 1) & (s["field_reg"] == field)


def _kind(section: str) -> Holds:
    return lambda _p, s: _in(s, section) & (s["wrong"] == 1) & (s["field_reg"] == 0)


_NAMED = (Fault.NONE, Fault.FRAME_SHORT, Fault.FRAME_LONG, Fault.CAPACITY, Fault.KIND, Fault.RADIUS)


_RECIPES = {Fault.NONE: FRAMES, Fault.CAPACITY: TOO_MANY}


def _ends_in(fault: Fault) -> Holds:
    return lambda _p, s: (s["finish"] == 1) & (s["fault_reg"] == fault)


COVERAGE = Coverage(
    signals=(
        "rst",
        "section_reg",
        "field_reg",
        "busy_reg",
        "in_valid",
        "in_ready",
        "in_last",
        "next_ready",
        "finish",
        "fault_reg",
        "wrong",
        "starved",
        "too_long",
        "ended",
        *(f"{kind}_reg" for kind in _COUNTS),
    ),
    points=(
        values(
            "section_reg",
            "sections",
            {name: (code, FRAMES if name != "drain" else FAULTS) for code, name in enumerate(SECTIONS)},
            "section",
        ),
        Point(
            "way",
            "from one section to the next that has anything in it",
            _ways(
                ("camera", "counts"),
                ("counts", "light"),
                ("counts", "sphere"),
                ("counts", "triangle"),
                ("counts", "tail"),
                ("light", "light"),
                ("light", "sphere"),
                ("light", "triangle"),
                ("light", "tail"),
                ("sphere", "sphere"),
                ("sphere", "triangle"),
                ("sphere", "tail"),
                ("triangle", "triangle"),
                ("triangle", "tail"),
                ("tail", "end"),
            ),
        ),
        Point(
            "none_of",
            "good frames without a kind",
            tuple(Bin(kind, FRAMES, _count(kind, most=False)) for kind in _COUNTS),
        ),
        Point(
            "most_of",
            "good frames with as many as there can be",
            tuple(Bin(kind, FRAMES, _count(kind, most=True)) for kind in _COUNTS),
        ),
        Point(
            "fault",
            "how frames end",
            tuple(Bin(fault.name.lower(), _RECIPES.get(fault, FAULTS), _ends_in(fault)) for fault in _NAMED),
        ),
        Point(
            "short", "the frame ends within a section", _where("starved", _READ, FAULTS, counts=CUT_COUNTS)
        ),
        Point(
            "capacity",
            "a count that is too large",
            tuple(Bin(kind, TOO_MANY, _too_many(field)) for field, kind in enumerate(_COUNTS)),
        ),
        Point(
            "kind",
            "a wrong bit of kind",
            tuple(Bin(kind, FAULTS, _kind(kind)) for kind in ("sphere", "triangle")),
        ),
        Point(
            "long",
            "words behind the frame",
            (
                Bin("one", FAULTS, lambda _p, s: (s["too_long"] == 1) & (s["ended"] == 1)),
                Bin("many", FAULTS, lambda _p, s: (s["too_long"] == 1) & (s["ended"] == 0)),
            ),
        ),
        Point(
            "drained",
            "the rest of a faulty frame",
            (
                Bin(
                    "none", FAULTS, lambda _p, s: _in(s, "drain") & ~was(_in(s, "drain")) & (s["ended"] == 1)
                ),
                Bin(
                    "one_word",
                    FAULTS,
                    lambda _p, s: (
                        _in(s, "drain")
                        & ~was(_in(s, "drain"))
                        & (s["in_valid"] == 1)
                        & (s["in_last"] == 1)
                        & (s["in_ready"] == 1)
                    ),
                ),
                Bin(
                    "many_words",
                    FAULTS,
                    lambda _p, s: lasting(_in(s, "drain") & (s["in_valid"] == 1) & (s["in_ready"] == 1), 4),
                ),
                Bin(
                    "waits",
                    WAITS,
                    lambda _p, s: _in(s, "drain") & (s["in_valid"] == 0) & (s["in_ready"] == 1),
                ),
            ),
        ),
        handshake("words", "in_valid", "in_ready", WAITS),
        Point(
            "start",
            "of a frame",
            (
                Bin(
                    "waits_for_next_ready",
                    WAITS,
                    lambda _p, s: lasting(
                        (s["busy_reg"] == 0) & (s["in_valid"] == 1) & (s["next_ready"] == 0)
                    ),
                ),
                Bin("waits_for_words", WAITS, lambda _p, s: lasting(_in(s, "camera") & (s["in_valid"] == 0))),
                Bin(
                    "at_once_behind_another",
                    WAITS,
                    lambda _p, s: (s["busy_reg"] == 1) & was(s["finish"] == 1, 2),
                ),
            ),
        ),
        Point("reset", "within a section", _where("rst", SECTIONS, RESETS)),
    ),
)
