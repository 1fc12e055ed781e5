"""Tests of `raytracer_vga`: frames in, on the screen the pictures of the bit-exact model, whole, in order.

The registers are written by an AXI master, and the monitor sees but the wires of the screen, whose clock is
of any ratio and phase to the core's.
"""

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any

import cocotb
from cocotb.triggers import with_timeout
from hypothesis import strategies as st

from models.core import Registers, registers, render
from models.cores import CORES
from models.images import Rgb
from models.scene.frame import pack
from models.scene.load import load
from models.scene.types import Scene, View
from models.video import screen
from verif.core import registers as wires
from verif.env import context, sources
from verif.env.axi import FrameSource, RegisterPort
from verif.env.block import holds, same
from verif.env.pipelined import Mismatch
from verif.video.clocks import PIXEL_PS, Clocks, Ratio, ratios
from verif.video.modes import mode_of, store_of
from verif.video.pictures import LARGEST, check_order
from verif.video.samples import Screen

_FMTS = CORES["default"].formats
_SCENES = sources.ROOT / "models" / "scenes"
_NAMES = ("three_spheres", "tetrahedron", "mirrors", "one_sphere", "shadows")
_ANGLE = 45.0
_NARROW = _FMTS.tan.one // 8
"""A tangent with which all pixels of the longest line or column see the sphere."""
_CLOCKS_A_PICTURE = 40_000
"""A picture of this size that takes more hangs."""
_DELAY = 4
"""Frames after which a picture that is complete has been seen: one under way, one for the crossing, and
those that the monitor has not told of."""
_ENOUGH_EXAMPLES = 100
_COST = 10
"""A film behind AXI ports takes so much longer than an operand of a unit."""


@dataclass(frozen=True)
class Film:
    """Frames that are sent one behind the other, and the size and view for which they are drawn."""

    names: tuple[str, ...]
    size: Registers

    @property
    def scenes(self) -> list[Scene]:
        """What the frames hold."""
        return [load(_SCENES / f"{name}.toml").scene for name in self.names]

    @property
    def pictures(self) -> list[Rgb]:
        """What the model draws of them."""
        return [render(scene, self.size, _FMTS).rgb for scene in self.scenes]

    @property
    def pixels(self) -> int:
        """Of one picture."""
        return self.size.width * self.size.height


def _film(names: Iterable[str], width: int, height: int, depth: int) -> Film:
    size = registers(View.square(width, height, _ANGLE), _FMTS)
    return Film(tuple(names), replace(size, depth=depth))


class VgaBench:
    """The core between an AXI master, a source of frames and a monitor."""

    def __init__(self, dut: Any) -> None:
        self.run = context.read()
        self._dut = dut
        self.store = store_of(self.run.parameters)
        self.mode = mode_of(self.run.parameters)
        self.clocks = Clocks(dut)
        self._screen = Screen(dut, self.mode, self.mode.clocks * PIXEL_PS)
        self.port: RegisterPort
        self.frames: FrameSource
        self.seen: list[Rgb] = []

    @classmethod
    async def create(cls, dut: Any) -> "VgaBench":
        """A bench whose agents stand: they may only be made where no handshake is unknown."""
        bench = cls(dut)
        for name in ("s_axil_awvalid", "s_axil_wvalid", "s_axil_arvalid", "s_axis_frame_tvalid"):
            getattr(dut, name).value = 0
        for name in ("s_axil_bready", "s_axil_rready"):
            getattr(dut, name).value = 0
        await bench.clocks.run(Ratio(PIXEL_PS))
        bench.port, bench.frames = RegisterPort(dut), FrameSource(dut)
        return bench

    async def restart(self, ratio: Ratio) -> None:
        """Both sides and the monitor anew."""
        self.frames.clear()
        await self.clocks.run(ratio)
        self._screen.plug()
        self.seen.clear()

    async def send(self, film: Film) -> None:
        """Writes the registers of a film, which hold from the core's reset on, and offers its frames."""
        await self.port.set("SIZE", width=film.size.width, height=film.size.height)
        await self.port.set("TAN_H", value=film.size.tan_h)
        await self.port.set("TAN_V", value=film.size.tan_v)
        await self.port.set("DEPTH", value=film.size.depth)
        for scene in film.scenes:
            self.frames.send(pack(scene).words)

    async def look(self, number: int) -> None:
        """Looks at so many more frames of the screen."""
        wanted = len(self.seen) + number
        while len(self.seen) < wanted:
            self.seen += [frame.picture for frame in await self._screen.frames()]

    async def drawn(self) -> int:
        """Frames that the core says it has drawn since `rst`."""
        return (await self.port.get("FRAMES"))["value"]

    @property
    def taken(self) -> int:
        """Pixels that the frame buffer has taken since `rst`."""
        return int(self._dut.taken.value.to_unsigned())

    @property
    def held(self) -> int:
        """Clocks since `rst` in which a pixel of the core waited."""
        return int(self._dut.held.value.to_unsigned())

    async def until_taken(self, pixels: int) -> None:
        """Waits until the frame buffer has taken so many pixels."""
        patience = _CLOCKS_A_PICTURE * self.clocks.ratio.slower_ps
        while self.taken < pixels:
            await with_timeout(self._dut.taken.value_change, patience, "ps")
        await self.clocks.core.edge

    async def interrupted(self) -> dict[str, int]:
        """Waits for `irq`; the events that it tells, cleared."""
        patience = _CLOCKS_A_PICTURE * self.clocks.ratio.slower_ps
        if not int(self._dut.irq.value):
            await with_timeout(self._dut.irq.value_change, patience, "ps")
        events = await self.port.get("INTERRUPT")
        await self.port.set("INTERRUPT", **events)
        same("irq when its events are cleared", 0, int(self._dut.irq.value))
        return events

    async def until_sent(self, film: Film) -> None:
        """Waits until the core has taken the frames."""
        patience = len(film.names) * _CLOCKS_A_PICTURE * self.clocks.ratio.slower_ps
        await with_timeout(self.frames.sent(), patience, "ps")

    def judge(self, pictures: Sequence[Rgb]) -> int:
        """Each frame seen is black, or a whole picture in its turn; the number of the last one."""
        return check_order(self.seen, [screen(picture, self.mode, self.store) for picture in pictures])

    async def watch(self, pictures: Sequence[Rgb]) -> None:
        """Looks until all pictures are drawn, and the last one is seen; judges all frames."""
        # What the screen has shown so far is no frame behind the last picture.
        await self.look(1)
        frame_ps = self.mode.clocks * self.clocks.ratio.pixel_ps
        frames = 1 + _CLOCKS_A_PICTURE * self.clocks.ratio.core_ps // frame_ps
        for _ in range(_DELAY + len(pictures) * frames):
            if await self.drawn() >= len(pictures):
                break
            await self.look(1)
        await self.look(_DELAY)
        same("last picture seen", len(pictures) - 1, self.judge(pictures))
        same("frames drawn", len(pictures), await self.drawn())


def _films(bench: VgaBench, least: int, most: int) -> st.SearchStrategy[Film]:
    """Different scenes behind each other, in pictures smaller and larger than what is stored."""
    names = st.permutations(_NAMES).flatmap(
        lambda order: st.integers(least, most).map(lambda number: tuple(order[:number]))
    )
    widths = st.sampled_from([bench.store.width]) | st.integers(3, bench.store.width + 2)
    heights = st.sampled_from([bench.store.height]) | st.integers(3, bench.store.height + 2)
    return st.builds(_film, names, widths, heights, st.integers(1, 5))


@cocotb.test()
async def frames_behind_each_other_are_each_seen_whole_and_in_order(dut: Any) -> None:
    """Three or four scenes, any size, clocks of any ratio and phase; what is seen is the model's picture."""
    bench = await VgaBench.create(dut)

    async def example(ratio: Ratio, film: Film) -> None:
        await bench.restart(ratio)
        await bench.send(film)
        await bench.watch(film.pictures)

    await holds(bench.run, example, ratios(slower=3), _films(bench, 3, 4), cost=_COST)


@cocotb.test()
async def the_longest_line_and_column_are_counted_and_cut(dut: Any) -> None:
    """Pictures of 4,095 pixels: the screen shows what the frame buffer keeps, the registers tell all rays."""
    bench = await VgaBench.create(dut)
    for width, height in ((LARGEST, 1), (1, LARGEST)):
        film = Film(("one_sphere",), Registers(width, height, _NARROW, _NARROW))
        await bench.restart(Ratio(PIXEL_PS))
        await bench.send(film)
        await bench.until_taken(film.pixels)
        await bench.watch(film.pictures)
        counts = render(film.scenes[0], film.size, _FMTS).counts
        for name in ("primary_rays", "secondary_rays", "shadow_rays", "tests"):
            same(name, getattr(counts, name), (await bench.port.get(name.upper()))["value"])


@cocotb.test()
async def every_register_is_behind_the_port(dut: Any) -> None:
    """All addresses, and words of all kinds."""
    bench = await VgaBench.create(dut)
    await bench.restart(Ratio(PIXEL_PS))
    await wires.every_address(bench.port)
    await wires.every_word(bench.port)


@cocotb.test()
async def each_picture_interrupts_when_it_is_drawn(dut: Any) -> None:
    """Two frames, one behind the other's interrupt; both are seen."""
    bench = await VgaBench.create(dut)
    film = _film(("mirrors", "one_sphere"), bench.store.width, bench.store.height, 5)
    await bench.restart(Ratio(PIXEL_PS // 4))
    await bench.port.set("INTERRUPT_ENABLE", done=1)
    await bench.send(replace(film, names=()))
    for scene in film.scenes:
        bench.frames.send(pack(scene).words)
        same("events", {"done": 1, "error": 0}, await bench.interrupted())
    await bench.watch(film.pictures)


@cocotb.test()
async def a_refused_frame_is_not_seen(dut: Any) -> None:
    """It ends too early: the picture before it stays, and the one behind it comes."""
    bench = await VgaBench.create(dut)
    film = _film(("mirrors", "one_sphere"), bench.store.width, bench.store.height, 5)
    first, second = film.scenes
    await bench.restart(Ratio(PIXEL_PS // 4))
    await bench.send(replace(film, names=()))
    bench.frames.send(pack(first).words)
    bench.frames.send(pack(first).words[:-1])
    bench.frames.send(pack(second).words)
    await bench.watch(film.pictures)
    same("events", {"done": 1, "error": 1}, await bench.port.get("INTERRUPT"))


@cocotb.test()
async def a_core_that_is_faster_than_the_screen_is_held_and_loses_nothing(dut: Any) -> None:
    """At each frame of the screen no more is drawn than is shown, waits, and was completed since."""
    bench = await VgaBench.create(dut)
    number = 5

    async def example(ratio: Ratio, order: list[str]) -> None:
        film = _film(order[:number], 8, 6, 2)
        await bench.restart(ratio)
        await bench.send(film)
        pictures = film.pictures
        for _ in range(number + _DELAY):
            drawn = await bench.drawn()
            await bench.look(1)
            # The picture of the frame that has just been seen, those before it, and one that waited.
            if drawn > bench.judge(pictures) + 2:
                raise Mismatch(f"{drawn} pictures drawn, the screen is at {bench.judge(pictures)}")
        same("last picture seen", number - 1, bench.judge(pictures))
        same("frames drawn", number, await bench.drawn())
        black = sum(not picture.any() for picture in bench.seen)
        changes = [bool((a != b).any()) for a, b in pairwise(bench.seen[black:])]
        same("changes of the picture", [True] * (number - 1), changes[: number - 1])
        frame_clocks = bench.mode.clocks * ratio.pixel_ps // ratio.core_ps
        if bench.held < frame_clocks:
            raise Mismatch(f"held for {bench.held} clocks, a frame of the screen has {frame_clocks}")

    fast = st.integers(PIXEL_PS // 24, PIXEL_PS // 20).map(lambda half: 2 * half)
    clocks = st.builds(Ratio, fast, phase_ps=st.integers(0, PIXEL_PS - 1))
    await holds(bench.run, example, clocks, st.permutations(_NAMES), cost=3 * _COST)


@cocotb.test()
async def reset_of_the_core_in_the_middle_of_a_picture_is_not_seen(dut: Any) -> None:
    """CONTROL.reset: what is complete is seen, the broken one never, those behind it whole, of their size."""
    bench = await VgaBench.create(dut)
    places: Counter[str] = Counter()

    async def example(ratio: Ratio, before: Film, share: float, after: Film) -> None:
        await bench.restart(ratio)
        await bench.send(before)
        # What a source sends behind the reset would be a frame of its own.
        await bench.until_sent(before)
        await bench.until_taken(1 + int(share * (len(before.names) * before.pixels - 1)))
        await bench.port.set("CONTROL", auto=1, reset=1)
        await bench.clocks.core.cycles(10)
        complete, rest = divmod(bench.taken, before.pixels)
        places["within a picture" if rest else "between pictures"] += 1
        same("frames drawn before the reset", complete, await bench.drawn())
        await bench.send(after)
        await bench.watch([*before.pictures[:complete], *after.pictures])

    films = _films(bench, 1, 2)
    shares = st.floats(0, 1, exclude_max=True)
    await holds(bench.run, example, ratios(slower=2), films, shares, films, cost=_COST)
    dut._log.info("resets: %s", dict(places))
    if bench.run.examples >= _ENOUGH_EXAMPLES:
        assert places["within a picture"], "no reset fell within a picture"
