"""Clock and reset, the same for every bench."""

from typing import Any

from cocotb.clock import Clock
from cocotb.triggers import RisingEdge

PERIOD_NS = 10


class Clocking:
    """The design's clock, running, and its synchronous reset.

    `edge` is one trigger object for all that wait: making one each time costs a third of the speed.
    """

    def __init__(self, dut: Any, own_clock: bool = False) -> None:
        """``own_clock``: the design's top makes the clock itself."""
        self._dut = dut
        self.edge = RisingEdge(dut.clk)
        if not own_clock:
            # Low at first: an edge at time 0 would come before the reset that it should see.
            Clock(dut.clk, PERIOD_NS, "ns", impl="gpi").start(start_high=False)

    async def reset(self, cycles: int = 1) -> None:
        """Holds reset for some clocks; one must do. Returns at the edge after which the design runs."""
        self._dut.rst.value = 1
        await self.cycles(cycles)
        self._dut.rst.value = 0
        await self.edge

    async def cycles(self, number: int) -> None:
        """Waits for some rising edges."""
        for _ in range(number):
            await self.edge
