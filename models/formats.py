"""The table of formats: every number between two stages of the core, and the builds that exist.

One row a format. The fraction width is a constant where the frame fixes it and the name of a knob
(a field of `Knobs`) where guard bits are a choice; a build is one setting of the knobs. The
Verilog reads the same table as `hdl/raytracer.vh`, which `models.header` writes.
Source: project book, chapter 7.1; guard bits are this project's.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from types import MappingProxyType
from typing import Any

from models.fixed import Format


@dataclass(frozen=True)
class Knobs:
    """Guard fraction bits of one build.

    unit: unit directions, normals, cosines. point: positions, distances and what is derived from
    them. colour: colours inside the core. screen: directions before they are normalised.
    """

    unit: int = 16
    point: int = 15
    colour: int = 12
    screen: int = 18


BUILDS: Mapping[str, Knobs] = MappingProxyType(
    {"default": Knobs(), "book": Knobs(unit=10, point=10, colour=10, screen=10)}
)
"""Named builds; `book` has the book's ten fraction bits everywhere."""


@dataclass(frozen=True)
class Row:
    """What the table says of one format: integer bits (sign included), fraction bits or knob, use."""

    int_bits: int
    frac: int | str
    signed: bool
    use: str

    def format(self, knobs: Knobs) -> Format:
        """The row in one build."""
        frac = self.frac if isinstance(self.frac, int) else getattr(knobs, self.frac)
        return Format(self.int_bits, frac, self.signed)


def _signed(int_bits: int, frac: int | str, use: str) -> Any:
    return field(metadata={"row": Row(int_bits, frac, True, use)})


def _unsigned(int_bits: int, frac: int | str, use: str) -> Any:
    return field(metadata={"row": Row(int_bits, frac, False, use)})


@dataclass(frozen=True)
class Formats:
    """The table itself, a field a row, and its value in one build."""

    coord: Format = _signed(9, 10, "scene coordinate")
    coeff: Format = _unsigned(9, 10, "scene colour, intensity, coefficient")
    radius: Format = _unsigned(2, 3, "scene radius")
    radius_sq: Format = _unsigned(4, 6, "radius squared, exact")
    tan: Format = _unsigned(3, 16, "tangent of the half field of view (register)")
    unit: Format = _signed(2, "unit", "component of a unit vector")
    cosine: Format = _unsigned(1, "unit", "cosine clamped to zero and above; highlight")
    inv_radius: Format = _unsigned(4, "unit", "1 / radius")
    screen: Format = _signed(6, "screen", "component of a direction before it is normalised")
    span: Format = _unsigned(4, "screen", "magnitude of tangent * basis component")
    point: Format = _signed(10, "point", "position; distance along a ray")
    offset: Format = _signed(3, "point", "position relative to the center of a sphere that may be hit")
    half_chord: Format = _unsigned(2, "point", "half of the chord that a sphere cuts from a ray")
    reach: Format = _signed(11, "point", "light or corner minus a point; its length")
    facing: Format = _unsigned(1, 20, "magnitude of a triangle's normal times a ray's direction")
    plane: Format = _unsigned(10, 20, "distance of a triangle's plane from a point")
    eta: Format = _unsigned(2, 16, "ratio of refractive indices")
    eta_sq: Format = _unsigned(4, 16, "its square")
    sine_sq: Format = _unsigned(1, 24, "square of the sine of an angle of incidence")
    gain: Format = _signed(3, 16, "share of the normal in a transmitted direction")
    shade: Format = _unsigned(9, "colour", "colour, weight, attenuation inside the core")
    channel: Format = _unsigned(8, 0, "one channel of a pixel")

    @property
    def mantissa(self) -> Format:
        """Block floating point vector that enters a normaliser: as wide as a unit component."""
        return Format(1, self.unit.width - 1)


TABLE: Mapping[str, Row] = MappingProxyType({f.name: f.metadata["row"] for f in fields(Formats)})
"""The rows by name, in the order of the table."""


def formats(knobs: Knobs) -> Formats:
    """The table with these knobs."""
    return Formats(**{name: row.format(knobs) for name, row in TABLE.items()})
