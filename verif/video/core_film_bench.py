"""What the simulator runs to draw a film's pictures: its frames one behind the other through the core."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import cocotb
import numpy as np
from cocotb.triggers import with_timeout

from models.core import Registers
from models.limits import Fault
from verif.core.driver import CoreDriver
from verif.env import context
from verif.env.block import same
from verif.env.clocking import PERIOD_NS

DRAWN = Path("drawn.npz")
"""What the core drew, in the folder of the run."""


async def _send(core: CoreDriver, frames: Sequence[Sequence[int]]) -> None:
    for words in frames:
        await core.send(words)


@cocotb.test()
async def draw(dut: Any) -> None:
    """Each frame is read while the one before it is drawn; a picture that takes too many clocks fails."""
    run = context.read()
    size, frames, clocks = Registers(*run.extra["registers"]), run.extra["frames"], run.extra["clocks"]
    core = CoreDriver(dut)
    await core.reset(size)
    core.take(True)
    sender = cocotb.start_soon(_send(core, frames))
    pictures = []
    for number, patience in enumerate(clocks):
        picture = await with_timeout(core.collect(), patience * PERIOD_NS, "ns")
        same(f"fault of frame {number}", Fault.NONE, picture.fault)
        same(f"pixels of picture {number}", size.width * size.height, len(picture.rgb))
        pictures.append(picture)
    await sender
    shape = len(pictures), size.height, size.width
    np.savez(
        run.directory / DRAWN,
        rgb=np.stack([picture.rgb for picture in pictures]).reshape(*shape, 3),
        hit=np.stack([picture.hit for picture in pictures]).reshape(shape),
    )
