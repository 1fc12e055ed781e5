"""The events of a pixel as the probe's file holds them, and the table that compares them with the model's."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from models.core import Event, registers, trace_pixel
from models.formats import BUILDS, formats
from models.scene.load import load
from verif.core import probe
from verif.env import sources
from verif.env.fields import join

_FMTS = formats(BUILDS["default"])
_ONE = _FMTS.shade.one
_LOCAL = Event("local", 0, (_ONE, _ONE // 2, 0))
_MISS = Event("miss", 2, (0, -_FMTS.unit.one, 1))
_PIXEL = Event("pixel", 0, (_ONE, _ONE, _ONE))


def _line(event: Event) -> str:
    """What `core_tb` writes of an event."""
    fields, values = probe.fields(_FMTS)[event.kind], list(event.values)
    operands = {}
    for field in fields:
        lanes, values = values[: field.lanes], values[field.lanes :]
        operands[field.name] = np.array(lanes).reshape((-1, 1) if field.lanes > 1 else (1,))
    return f"{event.kind} {event.depth} {join(fields, operands)[0]:x}\n"


def _marks(rtl: Sequence[Event], model: Sequence[Event]) -> list[str]:
    """The marks of the table's lines."""
    return [line.partition("  <- ")[2] for line in probe.table(_FMTS, rtl, model)]


def test_all_that_pixels_do_is_read_back(tmp_path: Path) -> None:
    """Events of every kind, with signs, vectors and single bits."""
    events: list[Event] = []
    for name in ("glass", "mirrors"):
        file = load(sources.ROOT / "models" / "scenes" / f"{name}.toml")
        size = registers(file.view_for(24, 16), _FMTS)
        for place in ((0, 0), (11, 8), (12, 12)):
            events += trace_pixel(file.scene, size, _FMTS, *place)
    path = tmp_path / probe.LOG
    path.write_text("".join(map(_line, events)))
    assert probe.read(path, _FMTS) == events
    assert {event.kind for event in events} == set(probe.fields(_FMTS))


def test_the_same_events_have_no_mark_whatever_their_order() -> None:
    assert _marks([_PIXEL, _LOCAL, _MISS], [_MISS, _LOCAL, _PIXEL]) == ["", "", ""]


def test_an_event_of_one_side_alone_is_marked() -> None:
    other = Event("local", 0, (_ONE, _ONE // 2, 1))
    assert _marks([_MISS, other], [_MISS, _LOCAL, _PIXEL]) == [
        "",
        "only in the model",
        "only in the model",
        "only in the RTL",
    ]


def test_an_event_that_comes_once_too_often_is_marked_once() -> None:
    assert _marks([_LOCAL, _LOCAL], [_LOCAL]) == ["", "only in the RTL"]
    assert _marks([_LOCAL], [_LOCAL, _LOCAL]) == ["", "only in the model"]


def test_an_event_at_another_depth_is_another_event() -> None:
    assert _marks([Event("miss", 3, _MISS.values)], [_MISS]) == ["only in the model", "only in the RTL"]


def test_a_pixel_without_events_has_no_lines() -> None:
    assert probe.table(_FMTS, [], []) == []


def test_numbers_are_shown_in_the_units_of_the_scene() -> None:
    light = Event("light", 0, (_ONE, 0, 0, 0, 0, -_FMTS.unit.one, 3 * _FMTS.point.one // 2))
    hit = Event("hit", 1, (17, 1, *[0] * 9))
    first, second, third = probe.table(_FMTS, [], [light, hit, _MISS])
    assert "colour 1.000000, 0.000000, 0.000000" in first
    assert "direction 0.000000, 0.000000, -1.000000" in first
    assert "limit 1.500000" in first
    assert "object 17; leaving 1; " in second and second.startswith("hit   depth 1 ")
    assert third.startswith("miss  depth 2 ")
