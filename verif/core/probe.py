"""The probe of `core_tb.v`: the events of one pixel that it writes, and how they compare with the model's."""

from collections import Counter
from collections.abc import Sequence
from pathlib import Path

from models.core import Event
from models.formats import Formats
from verif.env.fields import Field, bit, split

LOG = "probe.txt"
"""The file that `core_tb` writes, in the folder of the run."""


def fields(fmts: Formats) -> dict[str, tuple[Field, ...]]:
    """What a line of each kind carries, most significant first; see `models.core.Event`."""
    direction = Field.of("direction", fmts.unit, lanes=3)
    colour = Field.of("colour", fmts.shade, lanes=3)
    return {
        "hit": (
            Field("object", 32, signed=False),
            bit("leaving"),
            direction,
            Field.of("point", fmts.point, lanes=3),
            Field.of("normal", fmts.unit, lanes=3),
        ),
        "miss": (direction,),
        "child": (Field.of("weight", fmts.shade, lanes=3), direction),
        "local": (colour,),
        "light": (colour, direction, Field.of("limit", fmts.point)),
        "left": (colour,),
        "pixel": (colour,),
    }


def read(path: Path, fmts: Formats) -> list[Event]:
    """The events of a probe's file."""
    events = []
    for line in path.read_text().splitlines():
        kind, depth, word = line.split()
        values = split(fields(fmts)[kind], [int(word, 16)]).values()
        events.append(Event(kind, int(depth), tuple(int(lane) for value in values for lane in value.ravel())))
    return events


def table(fmts: Formats, rtl: Sequence[Event], model: Sequence[Event]) -> list[str]:
    """One line an event of the model, marked where the RTL has no such event, then those of the RTL alone."""
    left = Counter(rtl)
    lines = []
    for event in model:
        if left[event]:
            left[event] -= 1
            lines.append(_line(fmts, event, ""))
        else:
            lines.append(_line(fmts, event, "  <- only in the model"))
    return [*lines, *(_line(fmts, event, "  <- only in the RTL") for event in left.elements())]


def _line(fmts: Formats, event: Event, mark: str) -> str:
    values, parts = list(event.values), []
    for field in fields(fmts)[event.kind]:
        lanes, values = values[: field.lanes], values[field.lanes :]
        parts.append(f"{field.name} {', '.join(_number(field, lane) for lane in lanes)}")
    depth = f"depth {event.depth}" if event.depth else ""
    return f"{event.kind:<6}{depth:<8} {'; '.join(parts)}{mark}"


def _number(field: Field, raw: int) -> str:
    return f"{raw / (1 << field.frac_bits):.6f}" if field.frac_bits else str(raw)
