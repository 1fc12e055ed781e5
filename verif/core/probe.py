"""The probe of `core_tb.v`: what it keeps of one pixel, and how that compares with the model's stages."""

from collections.abc import Mapping

import numpy as np

from models.fixed import Raw
from models.formats import Formats
from verif.env.fields import Field, bit, split


def fields(fmts: Formats) -> tuple[Field, ...]:
    """The probe's fields in the order of its port, most significant first."""
    return (
        Field.of("screen", fmts.screen, lanes=3),
        Field.of("direction", fmts.unit, lanes=3),
        bit("hit"),
        bit("leaving"),
        Field.of("distance", fmts.point),
        Field.of("offset", fmts.offset, lanes=3),
        Field.of("half_chord", fmts.half_chord),
        Field.of("point", fmts.point, lanes=3),
        Field.of("normal", fmts.unit, lanes=3),
        Field.of("mirrored", fmts.unit, lanes=3),
        Field.of("light", fmts.unit, lanes=3),
        Field.of("limit", fmts.point),
        bit("shadowed"),
        Field.of("direct", fmts.shade, lanes=3),
        Field.of("colour", fmts.shade, lanes=3),
        Field.of("pixel", fmts.channel, lanes=3),
    )


def stages(fmts: Formats, word: int) -> dict[str, list[int]]:
    """The values by stage, raw, from the port's value."""
    return {name: values.ravel().tolist() for name, values in split(fields(fmts), [word]).items()}


_FORMATS = {"light": "unit", "limit": "point", "direct": "shade", "colour": "shade", "pixel": "channel"}
_FORMATS |= {"direction": "unit", "normal": "unit", "mirrored": "unit", "distance": "point"}


def table(fmts: Formats, rtl: Mapping[str, list[int]], model: Mapping[str, Raw]) -> list[str]:
    """One line a stage, in pipeline order: the model's value, the RTL's, and whether they differ."""
    lines = [f"{'stage':<12}{'model':<40}{'RTL':<40}"]
    for name, values in model.items():
        expected = np.asarray(values).ravel().tolist()
        got = rtl[name]
        fmt = getattr(fmts, _FORMATS.get(name, name), None)
        mark = "" if expected == got else "  <- differs"
        lines.append(f"{name:<12}{_numbers(expected, fmt):<40}{_numbers(got, fmt):<40}{mark}")
    return lines


def _numbers(values: list[int], fmt: object) -> str:
    one = getattr(fmt, "one", 1)
    return ", ".join(str(value) if one == 1 else f"{value / one:.6f}" for value in values)
