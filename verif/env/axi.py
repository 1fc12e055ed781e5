"""The core's AXI ports, driven and taken by cocotbext-axi: agents that know the standard and not this core.

    port = RegisterPort(dut)
    port.pause("w", rolled(generator, 0.5))
    await port.set("SIZE", width=64, height=48)

Make them after the first reset: they stop at an unknown handshake. From then on they follow `rst` and forget
what was under way. This module is the only one that touches cocotbext-axi.
"""

import logging
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import cycle
from typing import Any

import numpy as np
from cocotbext.axi import (
    AxiLiteBus,
    AxiLiteMaster,
    AxiProt,
    AxiStreamBus,
    AxiStreamSink,
    AxiStreamSource,
)
from numpy.typing import NDArray

from models.registers import REGISTERS, WORD_BYTES
from verif.env.fields import Field
from verif.env.pipelined import Mismatch
from verif.env.streams import Naming, Stream

CHANNELS = ("aw", "w", "b", "ar", "r")
"""Of AXI4-Lite: write address, write data, write response, read address, read data."""

OKAY, SLVERR = 0, 2

_WORD_W, _PIXEL_W, _CHANNEL_W = 32, 24, 8
_PROTECTIONS = tuple(map(AxiProt, range(8)))


def rolled(generator: np.random.Generator, share: float) -> Iterator[bool]:
    """Pauses for ever, a new roll each clock: for volume. share: of the clocks that pause, below 1."""
    while True:
        yield from (generator.random(256) < share).tolist()


def repeated(pattern: Sequence[bool]) -> Iterator[bool]:
    """Pauses that a test has drawn, over and over, with a clock between in which there is none."""
    return cycle((*pattern, False))


def _pause(agent: Any, pauses: Iterable[bool] | None) -> None:
    agent.set_pause_generator(pauses)
    if pauses is None:
        agent.pause = False


def _quiet(agent: Any) -> Any:
    """cocotbext-axi reports every transfer, and each one that a reset drops as a warning."""
    agent.log.setLevel(logging.ERROR)
    return agent


def channel(name: str) -> Stream:
    """One channel of AXI4-Lite as a stream, for a monitor."""
    fields = {
        "aw": (Field("addr", 8, signed=False),),
        "w": (Field("data", _WORD_W, signed=False), Field("strb", WORD_BYTES, signed=False)),
        "b": (Field("resp", 2, signed=False),),
        "ar": (Field("addr", 8, signed=False),),
        "r": (Field("data", _WORD_W, signed=False), Field("resp", 2, signed=False)),
    }
    prefix = f"{{prefix}}_{name}"
    return Stream(name, fields[name], Naming(f"{prefix}valid", f"{prefix}ready", f"{prefix}{{field}}"))


@dataclass(frozen=True)
class Answer:
    """What a slave answered: response, and the data of a read."""

    response: int
    data: int = 0


class RegisterPort:
    """A master of the registers. What a reset drops is answered with None.

    Each access has the next kind of protection (privileged, not secure, instruction): none may matter.
    """

    def __init__(self, dut: Any, prefix: str = "s_axil") -> None:
        self._protections = cycle(_PROTECTIONS)
        self._master = AxiLiteMaster(AxiLiteBus.from_prefix(dut, prefix), dut.clk, dut.rst)
        write, read = _quiet(self._master.write_if), _quiet(self._master.read_if)
        self._channels = {
            "aw": write.aw_channel,
            "w": write.w_channel,
            "b": write.b_channel,
            "ar": read.ar_channel,
            "r": read.r_channel,
        }
        for agent in self._channels.values():
            _quiet(agent)

    def pause(self, channel: str, pauses: Iterable[bool] | None) -> None:
        """From now on, clocks in which a channel offers or takes nothing; None: no such clock."""
        _pause(self._channels[channel], pauses)

    async def read(self, address: int) -> Answer | None:
        """One word."""
        length, protection = WORD_BYTES - address % WORD_BYTES, next(self._protections)
        answer = await self._master.read(address, length, protection)
        return None if answer is None else Answer(int(answer.resp), int.from_bytes(answer.data, "little"))

    async def write(self, address: int, data: bytes) -> Answer | None:
        """Bytes of one word, from an address that need not be that of a word."""
        answer = await self._master.write(address, data, next(self._protections))
        return None if answer is None else Answer(int(answer.resp))

    async def strobe(self, address: int, data: int, strobe: int) -> Answer:
        """One write with any strobe, past the master's way to choose one; nothing else may be under way."""
        aw, w, b = (self._channels[name] for name in ("aw", "w", "b"))
        await aw.send(aw._transaction_obj(awaddr=address, awprot=next(self._protections)))
        await w.send(w._transaction_obj(wdata=data, wstrb=strobe))
        return Answer(int((await b.recv()).bresp))

    async def get(self, name: str) -> dict[str, int]:
        """The fields of a register. Mismatch where it is not read."""
        register = REGISTERS[name]
        answer = await self.read(register.address)
        if answer is None or answer.response != OKAY:
            raise Mismatch(f"read of {name}: {answer}")
        return register.values(answer.data)

    async def set(self, name: str, **fields: int) -> None:
        """Writes a register, fields that are not named as 0. Mismatch where it is refused."""
        register = REGISTERS[name]
        answer = await self.write(register.address, register.word(fields).to_bytes(WORD_BYTES, "little"))
        if answer is None or answer.response != OKAY:
            raise Mismatch(f"write of {name}: {answer}")


class FrameSource:
    """Sends packed frames, a word a transfer."""

    def __init__(self, dut: Any, prefix: str = "s_axis_frame") -> None:
        bus = AxiStreamBus.from_prefix(dut, prefix)
        self._source = _quiet(AxiStreamSource(bus, dut.clk, dut.rst, byte_size=_WORD_W))

    def pause(self, pauses: Iterable[bool] | None) -> None:
        """From now on, clocks in which no word is offered anew; None: no such clock."""
        _pause(self._source, pauses)

    def send(self, words: Sequence[int]) -> None:
        """Queues a frame."""
        self._source.send_nowait(list(words))

    async def sent(self) -> None:
        """Waits until all that was queued has been taken."""
        await self._source.wait()

    def clear(self) -> None:
        """Forgets the frames that have not begun; a reset ends the one that has."""
        self._source.clear()


class VideoSink:
    """Takes pixels and puts pictures together."""

    def __init__(self, dut: Any, prefix: str = "m_axis_video") -> None:
        bus = AxiStreamBus.from_prefix(dut, prefix)
        self._sink = _quiet(AxiStreamSink(bus, dut.clk, dut.rst, byte_size=_PIXEL_W))

    def pause(self, pauses: Iterable[bool] | None) -> None:
        """From now on, clocks in which no pixel is taken; None: no such clock."""
        _pause(self._sink, pauses)

    @property
    def lines(self) -> int:
        """Whole lines that wait to be taken with `picture`."""
        return int(self._sink.count())

    def clear(self) -> None:
        """Forgets the lines that have come."""
        self._sink.clear()

    async def picture(self, width: int, height: int) -> NDArray[np.uint8]:
        """The next picture, shape (height, width, 3). Mismatch where a line or the start is out of place."""
        rows = []
        for y in range(height):
            line = await self._sink.recv(compact=False)
            starts = [x for x, user in enumerate(line.tuser) if user]
            if len(line) != width or starts != [0] * (y == 0):
                raise Mismatch(f"line {y} of {width} x {height}: {len(line)} pixels, start at {starts}")
            rows.append(list(line.tdata))
        pixels = np.array(rows, dtype=np.uint32)
        shifts = np.arange(_PIXEL_W - _CHANNEL_W, -1, -_CHANNEL_W, dtype=np.uint32)
        return (pixels[..., np.newaxis] >> shifts & 0xFF).astype(np.uint8)


@dataclass(frozen=True)
class CoreAgents:
    """Everything that an AXI system would put around `raytracer_axi`."""

    registers: RegisterPort
    frames: FrameSource
    video: VideoSink

    @classmethod
    def around(cls, dut: Any) -> "CoreAgents":
        """Agents that never pause."""
        return cls(RegisterPort(dut), FrameSource(dut), VideoSink(dut))

    def roll(self, generator: np.random.Generator, share: float) -> None:
        """From now on every channel pauses in a share of the clocks, each on its own."""
        for name in CHANNELS:
            self.registers.pause(name, rolled(generator.spawn(1)[0], share))
        self.frames.pause(rolled(generator.spawn(1)[0], share))
        self.video.pause(rolled(generator.spawn(1)[0], share))
