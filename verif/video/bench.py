"""What the simulator runs for a film: pictures at their rate through the video block, and the frames seen."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import cocotb
import numpy as np
from cocotb.triggers import Timer
from numpy.typing import NDArray

from models.images import Rgb
from models.video import VGA, screen
from verif.env import context
from verif.env.block import same
from verif.env.pipelined import Mismatch
from verif.video.pictures import check_order
from verif.video.samples import Screen

STREAM, SEEN = Path("stream.bin"), "seen.npz"
"""What `stream_player` plays, in the folder of the run; what the monitor saw."""

_RESET_NS = 2_000
_FRAME_PS = round(1e12 / VGA.refresh_hz)
_DELAY = 4
"""Frames from the time a picture is due until it has been seen, at most."""


def stream(pictures: NDArray[np.uint8]) -> bytes:
    """Pictures (n, h, w, 3) as the words that the player reads."""
    red, green, blue = np.moveaxis(pictures.astype(np.uint32), -1, 0)
    words = red << 16 | green << 8 | blue
    words[:, 0, 0] |= 1 << 25
    words[:, :, -1] |= 1 << 24
    return bytes(words.astype(">u4").tobytes())


async def _hand_out(dut: Any, number: int, rate: float) -> None:
    """Makes a picture due at its time."""
    for picture in range(number):
        dut.due.value = picture + 1
        await Timer(round(1e12 / rate), "ps")


def _leave(path: Path, seen: Sequence[Rgb], starts: Sequence[int]) -> None:
    """The frames that are other than those before them, and where each begins, in samples."""
    changed = [n for n, picture in enumerate(seen) if n == 0 or (picture != seen[n - 1]).any()]
    np.savez(path, pictures=np.stack([seen[n] for n in changed]), starts=[starts[n] for n in changed])


@cocotb.test()
async def show(dut: Any) -> None:
    """Each picture is seen whole and in its turn, each frame is the mode's in every figure."""
    run = context.read()
    pictures = np.load(run.extra["pictures"])
    number, rate = len(pictures), run.extra["rate"]
    STREAM.write_bytes(stream(pictures))
    monitor = Screen(dut, VGA, _FRAME_PS)
    dut.rst.value, dut.due.value = 1, 0
    dut.height.value, dut.width.value = pictures.shape[1:3]
    await Timer(_RESET_NS, "ns")
    monitor.plug()
    dut.rst.value = 0
    player = cocotb.start_soon(_hand_out(dut, number, rate))
    seen: list[Rgb] = []
    starts: list[int] = []
    after = 0
    # The film is over when the last picture has been seen as long as it lasts.
    while after < _DELAY + VGA.refresh_hz / rate:
        for frame in await monitor.frames():
            seen.append(frame.picture)
            starts.append(frame.start)
            after += player.done()
    _leave(run.directory / SEEN, seen, starts)
    same("pictures sent", number, int(dut.sent.value))
    same("last picture seen", number - 1, check_order(seen, [screen(picture) for picture in pictures]))
    if not seen:
        raise Mismatch("nothing was seen")
