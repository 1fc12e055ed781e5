"""The registers clock by clock, from their table: what each output is, and what each access brings."""

from collections.abc import Mapping
from dataclasses import dataclass

from models.registers import REGISTERS, RESET_CLOCKS, WORD_BYTES, Build, at

OKAY, SLVERR = 0, 2

PULSES = ("frame_start", "frame_done", "frame_error")
COUNTERS = (
    "lights_at_point",
    "degenerate",
    "cycles",
    "primary_rays",
    "shadow_rays",
    "secondary_rays",
    "tests",
)
EVENTS = (*PULSES, "error_code")
CORE = (*EVENTS, "busy", *COUNTERS)
"""Inputs from the core; but for the events they matter only to reads."""

_KEPT = ("CONTROL", "INTERRUPT", "INTERRUPT_ENABLE", "SIZE", "TAN_H", "TAN_V", "DEPTH")


@dataclass(frozen=True)
class Clock:
    """Inputs of one clock. aw, w, ar: what is offered, None without valid; core: all where a read looks."""

    rst: bool
    aw: int | None
    w: tuple[int, int] | None
    b_ready: bool
    ar: int | None
    r_ready: bool
    core: Mapping[str, int]


@dataclass(frozen=True)
class Access:
    """A finished access: data is what was read, 0 for a write."""

    write: bool
    address: int
    response: int
    data: int = 0

    @property
    def bytes(self) -> int:
        """The data from the byte on that the address is of."""
        return self.data >> 8 * (self.address % WORD_BYTES)


class RegisterModel:
    """State after reset; `outputs` are those of a clock, `clock` ends it."""

    def __init__(self, build: Build) -> None:
        self._build = build
        self.finished: list[Access] = []
        self._reset()

    def _reset(self) -> None:
        self._words = {name: REGISTERS[name].reset(self._build) for name in _KEPT}
        self._start = False
        self._reset_left = self._code = self._frames = 0
        self._aw: int | None = None
        self._w: tuple[int, int] | None = None
        self._b: Access | None = None
        self._ar: int | None = None
        self._r: Access | None = None

    def outputs(self) -> dict[str, int]:
        """Every output; a response only while it is valid."""
        found = {
            "s_axil_awready": int(self._aw is None),
            "s_axil_wready": int(self._w is None),
            "s_axil_bvalid": int(self._b is not None),
            "s_axil_arready": int(self._ar is None),
            "s_axil_rvalid": int(self._r is not None),
            "go": self._fields("CONTROL")["auto"] | self._start,
            "core_rst": int(self._reset_left > 0),
            "irq": int(self._words["INTERRUPT"] & self._words["INTERRUPT_ENABLE"] != 0),
            "tan_h": self._words["TAN_H"],
            "tan_v": self._words["TAN_V"],
            "depth": self._words["DEPTH"],
            **self._fields("SIZE"),
        }
        if self._b is not None:
            found["s_axil_bresp"] = self._b.response
        if self._r is not None:
            found |= {"s_axil_rresp": self._r.response, "s_axil_rdata": self._r.data}
        return found

    def _fields(self, name: str) -> dict[str, int]:
        return REGISTERS[name].values(self._words[name])

    @property
    def looks(self) -> bool:
        """A read looks at the registers in this clock."""
        return self._ar is not None and self._r is None

    def word(self, name: str, core: Mapping[str, int]) -> int:
        """What a read of a register finds."""
        register = REGISTERS[name]
        if name in self._words:
            return self._words[name]
        if name.lower() in COUNTERS:
            return core[name.lower()]
        if name == "STATUS":
            return register.word({"busy": core["busy"], "start": int(self._start)})
        if name == "ERROR":
            return register.word({"code": self._code})
        return self._frames if name == "FRAMES" else register.reset(self._build)

    def clock(self, inputs: Clock) -> None:
        """The end of a clock."""
        if inputs.rst:
            self._reset()
            return
        # A read sees what the clock began with, whatever is written in it.
        self._reads(inputs)
        self._reset_left = max(0, self._reset_left - 1)
        self._start &= not inputs.core["frame_start"]
        self._writes(inputs)
        self._events(inputs.core)

    def _reads(self, inputs: Clock) -> None:
        if self._ar is None:
            self._ar = inputs.ar
        elif self._r is None:
            register = at(self._ar)
            if register is None or not register.readable:
                self._r = Access(False, self._ar, SLVERR)
            else:
                self._r = Access(False, self._ar, OKAY, self.word(register.name, inputs.core))
        elif inputs.r_ready:
            self.finished.append(self._r)
            self._ar = self._r = None

    def _writes(self, inputs: Clock) -> None:
        if self._b is not None:
            if inputs.b_ready:
                self.finished.append(self._b)
                self._aw = self._w = self._b = None
        elif self._aw is not None and self._w is not None:
            self._b = self._write(self._aw, *self._w)
        else:
            self._aw = inputs.aw if self._aw is None else self._aw
            self._w = inputs.w if self._w is None else self._w

    def _write(self, address: int, data: int, strobe: int) -> Access:
        register = at(address)
        if register is None or not register.writable:
            return Access(True, address, SLVERR)
        old = self._words[register.name]
        self._words[register.name] = register.written(old, data, strobe, self._build)
        asked = register.asked(data, strobe)
        if "reset" in asked:
            self._start, self._reset_left = False, RESET_CLOCKS
        self._start |= "start" in asked
        return Access(True, address, OKAY)

    def _events(self, core: Mapping[str, int]) -> None:
        interrupt = REGISTERS["INTERRUPT"]
        if core["frame_done"]:
            self._words["INTERRUPT"] |= interrupt.field("done").mask
            self._code = 0
            self._frames += 1
        if core["frame_error"]:
            self._words["INTERRUPT"] |= interrupt.field("error").mask
            self._code = core["error_code"]
