"""What closure plays on the registers: accesses of all kinds, waits on every channel, events, resets."""

from typing import Any

import numpy as np
from hypothesis import strategies as st
from numpy.random import Generator

from models.registers import REGISTERS, WORD_BYTES
from verif.coverage.subjects import Scenarios, of_signals
from verif.env import axi
from verif.env.context import Context
from verif.env.draws import examples
from verif.units.axil_registers.driver import PAUSES, Read, RegistersBench, Wait, Write, actions, play

_FEW = 4


async def accesses(bench: RegistersBench, generator: Generator, _size: int) -> None:
    """Every register read and written, all strobes, and an address without a register."""
    await bench.restart()
    for register in REGISTERS.values():
        strobe = int(generator.integers(1 << WORD_BYTES))
        await bench.port.strobe(register.address, bench.word(), strobe)
    for strobe in (0, 1, 3, 15):
        await bench.port.strobe(REGISTERS["TAN_H"].address, bench.word(), strobe)
    await bench.sweep()
    nowhere = 1 + max(register.address for register in REGISTERS.values()) + WORD_BYTES
    await bench.port.read(nowhere)
    await bench.port.write(nowhere, b"\x01")
    bench.check()


async def waits(bench: RegistersBench, generator: Generator, size: int) -> None:
    """Drawn sequences with drawn pauses of every channel; then each channel late by turns."""
    for drawn, pauses in examples(st.tuples(actions(resets=False), PAUSES), generator, min(size, _FEW)):
        await play(bench, drawn, pauses)
    for late in axi.CHANNELS:
        await bench.restart()
        for name in axi.CHANNELS:
            bench.port.pause(name, axi.repeated((True,) * 5 + (False,)) if name == late else None)
        for _ in range(_FEW):
            await bench.act(Write(REGISTERS["TAN_V"].address, b"\x05", waits=False))
            await bench.act(Read(REGISTERS["ID"].address, waits=False))
        await bench.finish()


async def events(bench: RegistersBench, generator: Generator, size: int) -> None:
    """Frames that start, end and fail, interrupts, and a reset of the core."""
    await bench.restart()
    await bench.put("INTERRUPT_ENABLE", 3)
    for name in ("frame_start", "frame_done", "frame_error"):
        await bench.pulse(name, error_code=int(generator.integers(8)))
        await bench.clocks(2)
    await bench.port.set("CONTROL", reset=1)
    await bench.clocks(20)
    bench.check()


async def resets(bench: RegistersBench, generator: Generator, _size: int) -> None:
    """Resets while answers wait."""
    for moment in range(4, 10):
        await bench.restart()
        for name in ("b", "r"):
            bench.port.pause(name, axi.repeated((True,) * 8))
        await bench.act(Write(REGISTERS["TAN_V"].address, b"\x01", waits=False))
        await bench.act(Read(REGISTERS["ID"].address, waits=False))
        await bench.act(Wait(moment))
        await bench.act(Wait(0, reset=True))
    await bench.restart()


async def at_random(bench: RegistersBench, generator: Generator, _size: int) -> None:
    """Uniform words to and from uniform registers, nobody waits."""
    await bench.restart()
    addresses = np.array([register.address for register in REGISTERS.values()])
    for at in generator.choice(addresses, _FEW):
        word = int(generator.integers(1 << 32)) & ~1
        await bench.act(Write(int(at), word.to_bytes(WORD_BYTES, "little"), waits=True))
        await bench.act(Read(int(generator.choice(addresses)), waits=True))
    await bench.finish()


async def closure_subject(dut: Any, _run: Context) -> Scenarios:
    """The registers behind a master, ready to be played on."""
    bench, _ = await RegistersBench.create(dut)
    scenarios = {"accesses": accesses, "waits": waits, "events": events, "resets": resets}
    return of_signals(bench, bench.watched, scenarios, at_random)
