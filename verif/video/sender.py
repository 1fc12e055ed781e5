"""Sends pictures to a design's `s_axis_video`, and knows from what was taken which of them are complete."""

from collections.abc import Callable, Iterable, Sequence
from typing import Any

import numpy as np

from models.images import Rgb
from models.video import Store
from verif.env import context
from verif.env.block import same
from verif.env.clocking import Clocking
from verif.video.pictures import SIZE_W, VIDEO, Assembler, Painter, Shot, words


class Sender:
    """Source, monitor and model of the stream; they stand still until `start`.

    ``listeners`` hear of each picture that is queued.
    """

    def __init__(self, dut: Any, clocking: Clocking, store: Store) -> None:
        self._generator = context.read().generator(0)
        self._store = store
        self._clocking = clocking
        self._painter = Painter(self._generator, store)
        self._source = VIDEO.source(dut, "s_axis_video", clocking)
        self._monitor = VIDEO.monitor(dut, "s_axis_video", clocking)
        self._monitor.listeners.append(lambda word: self.assembler.receive(word))
        self.assembler = Assembler()
        self.queued = 0
        self.listeners: list[Callable[[Shot], None]] = []

    def stop(self) -> None:
        """Offers nothing any more, and forgets what was queued; what was taken is known."""
        self._source.stop()
        self._source.clear()

    def start(self) -> None:
        """Offers what is queued."""
        self._source.start()
        self._monitor.start()

    def restart(self) -> None:
        """Everything anew, pictures other than before; the design is in reset."""
        self.stop()
        self._monitor.stop()
        self._monitor.clear()
        self.assembler = Assembler()
        self._painter = Painter(self._generator, self._store)
        self.queued = 0

    def drop(self) -> None:
        """The core has been reset, with the source stopped before: what is not complete is lost."""
        self._monitor.clear()
        self.assembler.drop()
        self.queued = self.assembler.taken

    async def send(self, shots: Iterable[Shot], idles: Sequence[int] = ()) -> list[Rgb]:
        """Queues pictures at the next clock, whatever clock the caller is at; those that are whole."""
        await self._clocking.edge
        self._source.idle(idles)
        whole = []
        for shot in shots:
            picture = self._painter.paint(shot.width, shot.height)
            queued = list(words(shot, picture, self._generator))
            self._source.send_words(queued)
            self.queued += len(queued)
            for listener in self.listeners:
                listener(shot)
            if shot.whole:
                whole.append(picture)
        return whole

    async def send_rest(self, number: int, *, last: bool = False) -> None:
        """Queues words of a picture whose beginning nobody knows. last: each is said to end a line."""
        await self._clocking.edge
        high = [1 << 24, 1, 2, 1 << SIZE_W, 1 << SIZE_W]
        drawn = self._generator.integers(0, np.array(high), (number, len(high)))
        drawn[:, 2] |= last
        self._source.send_words(map(tuple, drawn.tolist()))
        self.queued += number

    @property
    def sent(self) -> bool:
        """All that was queued has been taken."""
        return self.assembler.taken >= self.queued

    def check(self) -> None:
        """Raises Mismatch where the stream broke its protocol."""
        same("breaches of the stream's protocol", [], self._monitor.breaches[:4])
