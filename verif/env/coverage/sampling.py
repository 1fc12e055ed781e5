"""Coverage inside the simulator: a collector for each test, whose counts are kept when the test ends."""

from collections.abc import Callable
from functools import partial
from typing import Any

import cocotb
import cocotb.task
import numpy as np
from cocotb.handle import LogicObject
from cocotb.triggers import Event
from cocotb.utils import get_sim_time

from verif.env.clocking import PERIOD_NS
from verif.env.context import Context
from verif.env.coverage.collector import Collector
from verif.env.coverage.points import Coverage
from verif.env.inside import inside

_UNKNOWN = -1
_LONG_BITS = 32
"""Of a simulator's number, its sign among them."""


def clock_number() -> int:
    """Number of the clock that is under way."""
    return int(get_sim_time("ns")) // PERIOD_NS


def collector(run: Context, coverage: Coverage) -> Collector:
    """A collector that writes its record into the run's folder when the test ends, however it ends."""
    made, start = Collector(coverage, run.parameters, run.known), clock_number()
    test = cocotb.task.current_task().get_name().removeprefix("Test ")
    cocotb.start_soon(_until_the_end(made, run, test, start))
    return made


async def _until_the_end(made: Collector, run: Context, test: str, start: int) -> None:
    try:
        await Event().wait()
    finally:  # cocotb cancels all tasks of a test when it ends
        end = clock_number()
        made.flush(end)
        made.record(run.unit, run.parameter_set, test, end - start).write(run.directory)


class Signals:
    """Reads signals of a design by their names below the top, once a clock, and passes them on in bulk.

    Until a design is reset its state is of chance: where `rst` is among the signals, sampling begins behind
    its first clock.
    """

    _ENOUGH = 1024

    def __init__(self, dut: Any, run: Context, coverage: Coverage) -> None:
        self._reads = [_reader(inside(dut, name)) for name in coverage.signals]
        self._names = coverage.signals
        self._rows: list[list[int]] = []
        self._of_chance = "rst" in coverage.signals
        self.collector = collector(run, coverage)
        self.collector.pull = self._pass_on

    def sample(self) -> None:
        """To be called once a clock, where outputs have settled."""
        if not self._names:
            return
        if self._of_chance:
            self._of_chance = self._reads[self._names.index("rst")]() != 1
        else:
            self._rows.append([read() for read in self._reads])
        if len(self._rows) >= self._ENOUGH:
            self._pass_on()

    def _pass_on(self) -> None:
        if self._rows:
            table = np.array(self._rows, dtype=np.int64).T
            self._rows = []
            self.collector.add(dict(zip(self._names, table, strict=True)), clock_number())


def _reader(handle: Any) -> Callable[[], int]:
    """What reads a signal; one that this build has not is unknown.

    Verilator has no unknown bits: there a narrow one is read as a number, much faster than bit by bit.
    """
    if handle is None:
        return lambda: _UNKNOWN
    narrow = isinstance(handle, LogicObject) or len(handle) < _LONG_BITS
    if narrow and cocotb.SIM_NAME == "Verilator":
        read: Callable[[], int] = handle._handle.get_signal_val_long
        return read
    return partial(_number, handle)


def _number(handle: Any) -> int:
    try:
        return int(handle.value)
    except ValueError:  # an unknown bit
        return _UNKNOWN
