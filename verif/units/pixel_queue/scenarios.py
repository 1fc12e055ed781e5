"""What closure plays on the queue of pixels: shapes, full queues, orders of return, waits, resets."""

from typing import Any

from numpy.random import Generator

from verif.coverage.subjects import Scenarios, of_block
from verif.env.context import Context
from verif.env.coverage.flow import LONG
from verif.units.pixel_queue.bench import Picture, QueueBench

_OLDEST, _YOUNGEST = 0, -1


def _filling(bench: QueueBench) -> Picture:
    """Nothing comes back until all slots are handed out, then some pixels slowly; more pixels than slots."""
    pixels = 2 * bench.slots
    return Picture(pixels, 1, (), (_OLDEST,), (bench.slots + 2 * LONG, 3, 3, *(0,) * pixels), ())


async def shapes(bench: QueueBench, _generator: Generator, _size: int) -> None:
    """One pixel, one line, one column, some lines; nobody waits."""
    for width, height in ((1, 1), (3, 1), (1, 3), (4, 3)):
        await bench.picture(Picture(width, height, (), (_OLDEST,), (), ()))


async def fills(bench: QueueBench, _generator: Generator, _size: int) -> None:
    """All slots are handed out before the first pixel comes back."""
    await bench.picture(_filling(bench))


async def orders(bench: QueueBench, generator: Generator, _size: int) -> None:
    """Pixels come back the youngest first, and in any order."""
    some = tuple(generator.integers(0, bench.slots, LONG).tolist())
    for returns in ((_YOUNGEST,), (_OLDEST,), some):
        for waits in ((0,), (2, *(0,) * 6)):
            await bench.picture(Picture(5, 8, (), returns, waits, ()))


async def waits(bench: QueueBench, _generator: Generator, _size: int) -> None:
    """Slots that are asked for late, pixels that come late, a consumer that stalls."""
    lengths = (0, 0, 1, 2 * LONG)
    for asks, late, stalls in ((lengths, (), ()), ((), lengths, ()), ((), (), (2 * LONG,)), ((), (), (1, 3))):
        await bench.picture(Picture(4, 3, asks, (_OLDEST,), late, stalls))


async def resets(bench: QueueBench, generator: Generator, _size: int) -> None:
    """Reset at rest, with slots handed out, with all of them, and with a pixel at the output."""
    await bench.restart()
    slow = Picture(bench.slots, 2, (), (_OLDEST,), (LONG,), (4 * LONG,))
    for clocks in (2, LONG + 2, 3 * LONG, bench.slots + 2 * LONG, int(generator.integers(4 * LONG))):
        await bench.start(slow)
        for clock in range(clocks):
            back = bench.flying.pop(0) if clock in (LONG, LONG + 4) and bench.flying else None
            await bench.step(slow, True, back)
        await bench.restart()


async def at_random(bench: QueueBench, generator: Generator, _size: int) -> None:
    """A picture of any size whose pixels come back in any order; all wait now and then."""
    asks, late, stalls = (tuple(generator.integers(0, 3, 20).tolist()) for _ in range(3))
    returns = tuple(generator.integers(0, bench.slots, 20).tolist())
    width, height = generator.integers(1, 20, 2).tolist()
    await bench.picture(Picture(width, height, asks, returns, late, stalls))


async def closure_subject(dut: Any, run: Context) -> Scenarios:
    """The queue, ready to be played on."""
    bench = QueueBench(dut, run.parameters)
    await bench.restart()
    played = {"shapes": shapes, "fills": fills, "orders": orders, "waits": waits, "resets": resets}
    return of_block(bench, played, at_random)
