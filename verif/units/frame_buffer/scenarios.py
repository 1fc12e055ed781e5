"""What closure plays: see `verif.video.scenarios`."""

from typing import Any

from verif.coverage.subjects import Scenarios
from verif.env.context import Context
from verif.units.frame_buffer.bench import BufferBench
from verif.video.scenarios import scenarios


async def closure_subject(dut: Any, _run: Context) -> Scenarios:
    """The bench, ready to be played on."""
    bench = BufferBench(dut)
    return scenarios(bench, bench.seen)
