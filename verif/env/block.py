"""Bench of a block that is no pipeline: its ports by name, one clock at a time, and properties of it.

What is read after `clock` are the outputs of the clock that has just ended, settled with the inputs
that were set for it.
"""

from collections.abc import Awaitable, Callable, Mapping, Sequence
from dataclasses import replace
from types import MappingProxyType
from typing import Any

from cocotb.task import resume
from hypothesis import strategies as st

from models.fixed import Raw
from verif.env import context, properties, unknowns
from verif.env.clocking import Clocking
from verif.env.context import Context
from verif.env.coverage.declared import coverage_of_name
from verif.env.coverage.sampling import Signals, clock_number
from verif.env.fields import Field, Operands, join, split
from verif.env.pipelined import Mismatch
from verif.env.unknowns import Drive

_NONE: Mapping[str, Sequence[str]] = MappingProxyType({})


class Block:
    """A block under test.

    Inputs hold until they are set again; reset lowers those in ``idle``. ``carried``: by the name of a valid,
    the inputs that mean something only while it is high; in other clocks they are unknown. A valid of several
    bits has as many lanes of them. `now` counts clocks. Each clock the signals that the unit's `coverage.py`
    names are sampled.
    """

    def __init__(self, dut: Any, idle: Sequence[str], carried: Mapping[str, Sequence[str]] = _NONE) -> None:
        self._dut = dut
        self.clocking = Clocking(dut)
        self._idle = idle
        self._ports: dict[str, Any] = {}
        self._set: dict[str, Drive] = {}
        self._carried = carried
        self._shown: dict[str, int] = {}
        self.log = dut._log
        self.now = 0
        run = context.read()
        self.signals = Signals(dut, run, coverage_of_name(run.unit)) if run.unit else None

    def _port(self, name: str) -> Any:
        if name not in self._ports:
            self._ports[name] = getattr(self._dut, name)
        return self._ports[name]

    def set(self, **inputs: Drive) -> None:
        """Inputs from now on."""
        for name, value in inputs.items():
            if self._set.get(name) != value:
                self._port(name).value = value
                self._set[name] = value
                self._shown.pop(name, None)

    def set_fields(self, fields: Sequence[Field], operands: Operands) -> None:
        """Inputs that are vectors or signed; one operand."""
        self.set(**{field.name: join((field,), operands)[0] for field in fields})

    async def clock(self, **inputs: Drive) -> None:
        """Sets inputs and lets one clock pass."""
        self.set(**inputs)
        self._hide()
        await self.clocking.edge
        self.now += 1
        if self.signals is not None:
            self.signals.sample()

    def _hide(self) -> None:
        """Makes unknown what belongs to a low valid, and known again what does not."""
        for valid, names in self._carried.items():
            shown, lanes = int(self._set.get(valid, 0)), len(self._port(valid))
            for name in names:
                if self._shown.get(name) != shown:
                    port = self._port(name)
                    port.value = unknowns.partly(int(self._set.get(name, 0)), len(port), shown, lanes)
                    self._shown[name] = shown

    def covered(self, name: str) -> None:
        """Tells that a bin, `point.bin`, has been hit: one that no signal shows."""
        if self.signals is not None:
            self.signals.collector.tell(name, clock_number())

    async def clocks(self, number: int) -> None:
        """Lets clocks pass."""
        for _ in range(number):
            await self.clock()

    async def reset(self, cycles: int = 1) -> None:
        """Resets the block, wherever it is; the next clock is the first one after it.

        One clock must do: in a second one a state that is not reset would have moved on to one that is.
        """
        self.set(**dict.fromkeys(self._idle, 0))
        await self.clock(rst=1)
        for _ in range(cycles - 1):
            await self.clock()
        self.set(rst=0)

    def read(self, name: str, bits: int = 0) -> int:
        """An output, or so many of its low bits, as an unsigned number. Mismatch where one is unknown."""
        value = self._port(name).value
        try:
            return int(str(value)[-bits:], 2) if bits else int(value)
        except ValueError:
            raise Mismatch(f"clock {self.now}: {name} has unknown bits: {value}") from None

    def read_field(self, field: Field) -> Raw:
        """An output's numbers: shape (lanes, 1), or (1,) where it has one lane."""
        return split((field,), [self.read(field.name)])[field.name]

    async def until(self, name: str, limit: int) -> int:
        """Waits until an output is high; the number of clocks that took. Mismatch after ``limit``."""
        for waited in range(1, limit + 1):
            await self.clock()
            if self.read(name):
                return waited
        raise Mismatch(f"no {name} after {limit} clocks")


def same(what: str, expected: object, got: object) -> None:
    """Raises Mismatch where two values differ."""
    if expected != got:
        raise Mismatch(f"{what}: expected {expected}, got {got}")


async def holds(
    run: Context, example: Callable[..., Awaitable[None]], *strategies: st.SearchStrategy[Any], cost: int = 1
) -> None:
    """Property of the running design: ``example`` is a coroutine function of what is drawn.

    ``cost``: how much longer than usual an example takes; there are so many times fewer.
    """
    usual = replace(run, examples=max(1, run.examples // cost))
    step: Callable[..., Any] = resume(example)  # type: ignore[arg-type]
    await properties.check(usual, step, *strategies)
