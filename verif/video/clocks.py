"""Two clocks of any ratio and phase, for designs with `clk` and `pixel_clk`, and their resets."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from cocotb.clock import Clock
from cocotb.triggers import RisingEdge, Timer
from hypothesis import strategies as st

from verif.env.clocking import Clocking

PIXEL_PS = 40_000
_NEARLY_PS = 200
_RESET_CLOCKS = 4
"""Of the slower clock: what the header of `video` asks for."""


@dataclass(frozen=True)
class Ratio:
    """Periods of the core's clock and of the pixel clock, and how much later the first one starts."""

    core_ps: int
    pixel_ps: int = PIXEL_PS
    phase_ps: int = 0

    @property
    def slower_ps(self) -> int:
        """The longer of the two periods."""
        return max(self.core_ps, self.pixel_ps)


def ratios(slower: int = 12, faster: int = 12) -> st.SearchStrategy[Ratio]:
    """The core's clock equal to the pixel clock, nearly so, up to so many times slower or faster.

    Periods are even numbers of picoseconds; the phase is anything below a pixel clock.
    """
    half = PIXEL_PS // 2
    shortest, longest = half // faster, half * slower
    halves = st.one_of(
        st.just(half),
        st.integers(max(shortest, half - _NEARLY_PS), min(longest, half + _NEARLY_PS)),
        st.integers(shortest, half),
        st.integers(half, longest),
    )
    return st.builds(Ratio, halves.map(lambda value: 2 * value), phase_ps=st.integers(0, PIXEL_PS - 1))


class Clocks:
    """Both clocks; they stand still until `run`. core: for agents of the core's side.

    ``restarted`` hear of each `run`, ``resets`` of each reset of one side: "core" or "screen".
    """

    def __init__(self, dut: Any) -> None:
        self._dut = dut
        self._running: list[Clock] = []
        self.restarted: list[Callable[[Ratio], None]] = []
        self.resets: list[Callable[[str], None]] = []
        self.ratio = Ratio(PIXEL_PS)
        self.core = Clocking(dut, own_clock=True)
        self.pixel_edge = RisingEdge(dut.pixel_clk)

    async def run(self, ratio: Ratio) -> None:
        """From now on with this ratio, in reset, which ends on either side with an edge of its clock."""
        for clock in self._running:
            clock.stop()
        self._dut.rst.value = 1
        self._dut.pixel_rst.value = 1
        self.ratio = ratio
        pixel = Clock(self._dut.pixel_clk, ratio.pixel_ps, "ps", impl="gpi")
        core = Clock(self._dut.clk, ratio.core_ps, "ps", impl="gpi")
        self._running = [pixel, core]
        pixel.start()
        if ratio.phase_ps:
            await Timer(ratio.phase_ps, "ps")
        core.start()
        await self._pixel_reset(0)
        await self.core.edge
        self._dut.rst.value = 0
        for listener in self.restarted:
            listener(ratio)

    async def pixel_reset(self, more: int = 0) -> None:
        """Resets the screen's side for as long as it needs, and some of the slower clocks more."""
        for listener in self.resets:
            listener("screen")
        await self._pixel_reset(more)

    async def _pixel_reset(self, more: int) -> None:
        await self.pixel_edge
        self._dut.pixel_rst.value = 1
        await Timer((_RESET_CLOCKS + more) * self.ratio.slower_ps, "ps")
        await self.pixel_edge
        self._dut.pixel_rst.value = 0

    async def core_reset(self, clocks: int) -> None:
        """Resets the core's side alone."""
        for listener in self.resets:
            listener("core")
        self._dut.rst.value = 1
        await self.core.cycles(clocks)
        self._dut.rst.value = 0
