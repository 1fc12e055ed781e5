"""The register map: what stands behind the core's AXI4-Lite port, for the Verilog, the page and the benches.

A register has 32 bits and fields; a field has its bits, an access, and the rule by which it keeps what is
written. Numbers that a build decides (its capacity, say) stand here by name, as `Build` calls them.
`models.header` writes the addresses into `hdl/raytracer.vh`, `models.stages` the table into `hdl/README.md`.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from enum import Enum
from math import radians, tan
from types import MappingProxyType

from models.formats import Knobs, formats
from models.limits import BOOK_HALF_ANGLE_DEGREES, MAX_DEPTH, UNITS, Fault
from models.scene.frame import DEFAULT_COUNTERS

WORD_BYTES = 4
ADDRESS_W = 8
"""Bits of a byte address; the lowest two are ignored."""

VERSION = (0, 1)
"""Of the core, as in `pyproject.toml`: major, minor."""

CORE = int.from_bytes(b"RT")
"""What the register ID says that this is."""

RESET_CLOCKS = 4
"""Clocks for which CONTROL.reset resets the core."""

_TAN = formats(Knobs()).tan
_BOOK_TAN = round(tan(radians(BOOK_HALF_ANGLE_DEGREES)) * _TAN.one)
_BOOK_SIZE = 512
_CAPACITY = DEFAULT_COUNTERS.capacity
_WORD = (1 << 8 * WORD_BYTES) - 1


class Access(Enum):
    """What software may do with a field. wo: reads 0; rw1c: a written 1 clears the bit."""

    RW = "rw"
    RO = "ro"
    WO = "wo"
    RW1C = "rw1c"


@dataclass(frozen=True)
class Build:
    """What the registers have to know of a build: the parameters of `hdl/bus/axil_registers.v`."""

    units: int = UNITS
    size_w: int = 12
    max_depth: int = MAX_DEPTH
    lights: int = _CAPACITY.lights
    spheres: int = _CAPACITY.spheres
    triangles: int = _CAPACITY.triangles

    @classmethod
    def of(cls, parameters: Mapping[str, int]) -> "Build":
        """The build with these parameters of the Verilog."""
        return cls(**{name.lower(): value for name, value in parameters.items()})

    @property
    def max_size(self) -> int:
        """Largest width and height."""
        return (1 << self.size_w) - 1

    def number(self, value: int | str) -> int:
        """A number of the map in this build."""
        found = getattr(self, value) if isinstance(value, str) else value
        return int(found)


@dataclass(frozen=True)
class Range:
    """What a field can hold. A larger number becomes ``above``, a smaller one ``least``."""

    least: int
    most: int | str
    above: int | str

    def kept(self, written: int, build: Build) -> int:
        """What becomes of a number that is written."""
        if written > build.number(self.most):
            return build.number(self.above)
        return max(written, self.least)


@dataclass(frozen=True)
class Field:
    """Bits ``high`` to ``low`` of a register. range: what it can hold, where that is not all of its bits."""

    name: str
    access: Access
    high: int
    low: int
    meaning: str
    reset: int | str = 0
    range: Range | None = None

    @property
    def width(self) -> int:
        """Bits of the field."""
        return self.high - self.low + 1

    @property
    def mask(self) -> int:
        """The field's bits in its register."""
        return (1 << self.width) - 1 << self.low

    def read(self, word: int) -> int:
        """The field in a word."""
        return (word & self.mask) >> self.low

    def written(self, old: int, data: int, lanes: int, build: Build) -> int:
        """The field in a register that held ``old`` when ``data`` is written to the bits ``lanes``."""
        if self.access is Access.RW:
            merged = self.read(old & ~lanes | data & lanes)
            return merged if self.range is None else self.range.kept(merged, build)
        if self.access is Access.RW1C:
            return self.read(old & ~(data & lanes))
        return self.read(old)


@dataclass(frozen=True)
class Register:
    """One register; its address counts bytes."""

    name: str
    address: int
    fields: tuple[Field, ...]

    @property
    def access(self) -> Access:
        """That of its fields, or rw where these differ."""
        kinds = {field.access for field in self.fields}
        return kinds.pop() if len(kinds) == 1 else Access.RW

    @property
    def writable(self) -> bool:
        """Whether a write is no error."""
        return self.access is not Access.RO

    @property
    def readable(self) -> bool:
        """Whether a read is no error."""
        return self.access is not Access.WO

    def field(self, name: str) -> Field:
        """A field by its name. Raises KeyError where there is none."""
        for field in self.fields:
            if field.name == name:
                return field
        raise KeyError(f"{self.name} has no field {name}")

    def reset(self, build: Build) -> int:
        """The register after reset."""
        return self.word({field.name: build.number(field.reset) for field in self.fields})

    def word(self, values: Mapping[str, int]) -> int:
        """The register with these fields, the others 0. Raises ValueError where one does not fit."""
        word = 0
        for name, value in values.items():
            field = self.field(name)
            if not 0 <= value < 1 << field.width:
                raise ValueError(f"{self.name}.{name}: {value} does not fit {field.width} bits")
            word |= value << field.low
        return word

    def values(self, word: int) -> dict[str, int]:
        """The fields in a word."""
        return {field.name: field.read(word) for field in self.fields}

    def written(self, old: int, data: int, strobe: int, build: Build) -> int:
        """The register after a write, one bit of ``strobe`` a byte. Fields that are wo hold nothing."""
        lanes = byte_lanes(strobe)
        kept = [field for field in self.fields if field.access is not Access.WO]
        return self.word({field.name: field.written(old, data, lanes, build) for field in kept})

    def asked(self, data: int, strobe: int) -> frozenset[str]:
        """The wo fields that a write puts a 1 into."""
        ones = data & byte_lanes(strobe)
        return frozenset(
            field.name for field in self.fields if field.access is Access.WO and ones & field.mask
        )


def byte_lanes(strobe: int) -> int:
    """The bits that a strobe selects."""
    return sum(0xFF << 8 * byte for byte in range(WORD_BYTES) if strobe >> byte & 1)


_FAULT_W = max(Fault).bit_length()


def _bit(name: str, access: Access, bit: int, meaning: str, reset: int = 0) -> Field:
    return Field(name, access, bit, bit, meaning, reset)


def _number(
    access: Access, meaning: str, reset: int | str = 0, range: Range | None = None
) -> tuple[Field, ...]:
    return (Field("value", access, 31, 0, meaning, reset, range),)


def _counter(meaning: str) -> tuple[Field, ...]:
    return _number(Access.RO, meaning)


def _size(name: str, high: int) -> Field:
    meaning = f"{name} of the picture; more than the core can count becomes 0, and 0 refuses the frame"
    return Field(name, Access.RW, high, high - 15, meaning, _BOOK_SIZE, Range(0, "max_size", 0))


def _tangent(side: str) -> tuple[Field, ...]:
    meaning = f"tangent of the half field of view, {side}, in the format `tan`; more becomes its largest"
    return _number(Access.RW, meaning, _BOOK_TAN, Range(0, _TAN.max, _TAN.max))


def _rows() -> Iterator[tuple[str, tuple[Field, ...]]]:
    rw, ro, wo, rw1c = Access.RW, Access.RO, Access.WO, Access.RW1C
    major, minor = VERSION
    yield (
        "ID",
        (
            Field("core", ro, 31, 16, 'the letters "RT"', CORE),
            Field("major", ro, 15, 8, "version", major),
            Field("minor", ro, 7, 0, "version", minor),
        ),
    )
    yield (
        "CONTROL",
        (
            _bit("start", wo, 0, "1 draws one frame: the one that waits, or the next"),
            _bit("auto", rw, 1, "every frame is drawn as it arrives", 1),
            _bit(
                "reset",
                wo,
                2,
                f"1 resets the core for {RESET_CLOCKS} clocks and takes back a start written before; "
                "the registers stay",
            ),
        ),
    )
    yield (
        "STATUS",
        (
            _bit("busy", ro, 0, "a frame is set up or drawn"),
            _bit("start", ro, 1, "a start waits for its frame"),
        ),
    )
    yield (
        "INTERRUPT",
        (
            _bit("done", rw1c, 0, "a frame has been drawn"),
            _bit("error", rw1c, 1, "a frame has been refused"),
        ),
    )
    yield (
        "INTERRUPT_ENABLE",
        (
            _bit("done", rw, 0, "`irq` is high while this and INTERRUPT.done are set"),
            _bit("error", rw, 1, "the same for INTERRUPT.error"),
        ),
    )
    code = "fault of the frame that was refused last, 0 after one that was drawn"
    yield "ERROR", (Field("code", ro, _FAULT_W - 1, 0, code),)
    yield "SIZE", (_size("width", 15), _size("height", 31))
    yield "TAN_H", _tangent("horizontal")
    yield "TAN_V", _tangent("vertical")
    depth = "depth to which rays are followed, 1 is the primary ray; clamped to 1 to MAX_DEPTH"
    yield "DEPTH", _number(rw, depth, "max_depth", Range(1, "max_depth", "max_depth"))
    yield "LIGHTS_AT_POINT", _counter("lights left out since the core's reset: they were at the hit point")
    yield "DEGENERATE", _counter("triangles skipped since the core's reset: they have no area")
    yield "CYCLES", _counter("clocks of the frame that is drawn, or was drawn last")
    yield "PRIMARY_RAYS", _counter("primary rays of that frame")
    yield "SHADOW_RAYS", _counter("shadow rays of that frame")
    yield "SECONDARY_RAYS", _counter("mirrored and transmitted rays of that frame")
    yield "TESTS", _counter("rays tested against objects, of that frame")
    units = "trace units: utilisation is TESTS / (UNITS * CYCLES)"
    yield "UNITS", _number(ro, units, "units")
    yield "FRAMES", _counter("frames drawn since `rst`")
    yield (
        "CAPACITY",
        (
            Field("lights", ro, 7, 0, "most that a frame may hold", "lights"),
            Field("spheres", ro, 15, 8, "most that a frame may hold", "spheres"),
            Field("triangles", ro, 23, 16, "most that a frame may hold", "triangles"),
        ),
    )


def _table() -> Mapping[str, Register]:
    rows = enumerate(_rows())
    return MappingProxyType(
        {name: Register(name, WORD_BYTES * place, fields) for place, (name, fields) in rows}
    )


REGISTERS: Mapping[str, Register] = _table()
"""The registers by name, in the order of their addresses."""


def at(address: int) -> Register | None:
    """The register that a byte address selects, if any."""
    word = address // WORD_BYTES * WORD_BYTES
    return next((register for register in REGISTERS.values() if register.address == word), None)


def macros() -> list[str]:
    """The map as the Verilog reads it: addresses, places of fields, the values after reset that every build
    has, and which words may be written and read, a bit a word."""
    lines = []
    for register in REGISTERS.values():
        prefix = f"RT_REG_{register.name}"
        lines.append(f"`define {prefix} {ADDRESS_W}'h{register.address:02x}")
        for field in register.fields:
            if field.mask != _WORD:
                lines.append(f"`define {prefix}_{field.name.upper()}_LOW {field.low}")
        of_build = any(isinstance(field.reset, str) for field in register.fields)
        if not of_build and (register.access is Access.RW or register.reset(Build())):
            lines.append(f"`define {prefix}_AT_RESET 32'h{register.reset(Build()):08x}")
    words = 1 << ADDRESS_W - 2
    for what, chosen in (
        ("WRITABLE", [register for register in REGISTERS.values() if register.writable]),
        ("READABLE", [register for register in REGISTERS.values() if register.readable]),
    ):
        bits = sum(1 << register.address // WORD_BYTES for register in chosen)
        lines.append(f"`define RT_REG_{what} {words}'h{bits:0{words // 4}x}")
    return [*lines, f"`define RT_REG_RESET_CLOCKS {RESET_CLOCKS}"]
