"""Tests of the registers, see `driver`."""

from collections.abc import Sequence
from typing import Any

import cocotb
from cocotb.triggers import Timer, with_timeout

from models.registers import REGISTERS, RESET_CLOCKS, WORD_BYTES, Access
from verif.env import axi, context
from verif.env.axi import OKAY, SLVERR, RegisterPort
from verif.env.block import holds, same
from verif.env.clocking import PERIOD_NS
from verif.units.axil_registers.driver import (
    ADDRESSES,
    ALL,
    CODE_W,
    PAUSES,
    WORD_W,
    Action,
    Read,
    RegistersBench,
    Wait,
    Write,
    actions,
    play,
)
from verif.units.axil_registers.model import COUNTERS, PULSES, RegisterModel

_MANY_FRAMES = (1 << 16) + 3


@cocotb.test()
async def no_output_is_unknown_before_any_reset(dut: Any) -> None:
    """The first test, on a block that has never been reset: on Icarus a register without a value shows."""
    bench = RegistersBench(dut, context.read())
    # The edge at time 0 comes before wires have got the initial values of registers.
    await bench.clock()
    for _ in range(4):
        await bench.clock()
        for name in RegisterModel(bench.build).outputs():
            bench.read(name)


@cocotb.test()
async def every_register_has_the_value_and_the_access_of_the_map(dut: Any) -> None:
    """Values after reset; then words of all kinds, each bit alone too: rw keeps what it can, wo holds
    nothing, ro refuses all."""
    bench, _ = await RegistersBench.create(dut)
    expected = {name: register.reset(bench.build) for name, register in REGISTERS.items()}
    same("values after reset", expected, await bench.sweep())
    for word in (ALL, 0, *(1 << bit for bit in range(WORD_W)), *(bench.word() for _ in range(8))):
        for name, register in REGISTERS.items():
            # A start or a reset would be seen elsewhere than in CONTROL.
            data = word & ~sum(field.mask for field in register.fields if field.access is Access.WO)
            same(f"write of {name}", OKAY if register.writable else SLVERR, await bench.put(name, data))
            if register.writable:
                expected[name] = register.written(expected[name], data, 0xF, bench.build)
        same(f"values after writes of {word:#x}", expected, await bench.sweep())


@cocotb.test()
async def an_address_without_a_register_is_refused(dut: Any) -> None:
    """All 256 byte addresses, read and written: where the answer is an error, nothing is read or changed."""
    bench, _ = await RegistersBench.create(dut)
    # No register holds 0, so that none can be read there unseen.
    bench.set(busy=1, **dict.fromkeys(COUNTERS, ALL))
    await bench.pulse("frame_done", "frame_error", error_code=(1 << CODE_W) - 1)
    await bench.put("INTERRUPT_ENABLE", ALL)
    before = await bench.sweep()
    same("registers that hold 0", [], [name for name, word in before.items() if not word])
    words = {register.address for register in REGISTERS.values()}
    for address in range(ADDRESSES):
        known = address // WORD_BYTES * WORD_BYTES in words
        answer = await bench.port.read(address)
        same(f"read of {address:#x}", OKAY if known else SLVERR, answer and answer.response)
        if not known:
            same(f"data of {address:#x}", 0, answer and answer.data)
            answer = await bench.port.write(address, b"\xff")
            same(f"write of {address:#x}", SLVERR, answer and answer.response)
    same("registers afterwards", before, await bench.sweep())


@cocotb.test()
async def a_strobe_writes_its_bytes_and_no_others(dut: Any) -> None:
    """All 16 strobes on every register, also on those bits that start, reset and clear."""
    bench, _ = await RegistersBench.create(dut)
    for register in REGISTERS.values():
        for strobe in range(1 << WORD_BYTES):
            await bench.restart()
            await bench.pulse("frame_done", "frame_error", error_code=5)
            old = await bench.look(register.name)
            data = bench.word() | bench.word() << 16 & ALL | 1
            answer = await bench.port.strobe(register.address, data, strobe)
            same(
                f"{register.name}, strobe {strobe:#x}", OKAY if register.writable else SLVERR, answer.response
            )
            new = register.written(old, data, strobe, bench.build) if register.writable else old
            if register.name != "STATUS":
                same(f"{register.name}, strobe {strobe:#x}", new, await bench.look(register.name))
            bench.check()


@cocotb.test()
async def address_and_data_come_in_any_order(dut: Any) -> None:
    """Either is kept back by up to 12 clocks: one write, one response, the right register."""
    bench, _ = await RegistersBench.create(dut)
    for late, early in (("aw", "w"), ("w", "aw")):
        for lead in range(12):
            await bench.restart()
            bench.port.pause(early, None)
            bench.port.pause(late, axi.repeated((True,) * lead))
            width = 100 + lead
            await bench.act(Write(REGISTERS["SIZE"].address, width.to_bytes(2, "little"), waits=True))
            same(f"width, {late} late by {lead}", width, bench.read("width"))
            await bench.act(Write(REGISTERS["TAN_V"].address, bytes([lead, 0, 0, 0]), waits=True))
            same(f"tan_v, {late} late by {lead}", lead, bench.read("tan_v"))
            await bench.finish()


@cocotb.test()
async def ready_never_depends_on_valid_nor_valid_on_ready(dut: Any) -> None:
    """Inputs flip in the middle of a clock, in every state of the port: no output of it moves."""
    bench = RegistersBench(dut, context.read())
    await bench.reset()
    inputs = [f"s_axil_{name}" for name in ("awvalid", "wvalid", "bready", "arvalid", "rready")]
    outputs = [f"s_axil_{name}" for name in ("awready", "wready", "bvalid", "arready", "rvalid")]
    seen = set()
    for _ in range(400):
        states = [int(roll) for roll in bench.generator.integers(0, 2, len(inputs))]
        await bench.clock(**dict(zip(inputs, states, strict=True)))
        await Timer(PERIOD_NS // 4, "ns")
        before = [bench.read(name) for name in outputs]
        seen.add(tuple(before))
        for flipped, state in zip(inputs, states, strict=True):
            bench.set(**{flipped: 1 - state})
            await Timer(1, "ns")
            same(f"{outputs} when {flipped} flips", before, [bench.read(name) for name in outputs])
            bench.set(**{flipped: state})
        await Timer(1, "ns")
    of_writes, of_reads = 5, 3
    same("states of the port that were met", of_writes * of_reads, len(seen))


@cocotb.test()
async def go_is_auto_or_a_start_that_waits(dut: Any) -> None:
    """Auto after reset; without it one frame a start, and STATUS tells that a start waits."""
    bench, _ = await RegistersBench.create(dut)
    port = bench.port
    same("go after reset", 1, bench.read("go"))
    await port.set("CONTROL", auto=0)
    await bench.clock()
    same("go without auto", 0, bench.read("go"))
    for _ in range(3):
        await port.set("CONTROL", start=1)
        await bench.clocks(20)
        same("go with a start that waits", 1, bench.read("go"))
        same("STATUS", {"busy": 0, "start": 1}, await port.get("STATUS"))
        same("CONTROL, which holds no start", {"start": 0, "auto": 0, "reset": 0}, await port.get("CONTROL"))
        await bench.pulse("frame_start", busy=1)
        await bench.clock()
        same("go when the frame has started", 0, bench.read("go"))
        same("STATUS", {"busy": 1, "start": 0}, await port.get("STATUS"))
        await bench.pulse("frame_done", busy=0)
    await port.set("CONTROL", start=1)
    await port.set("CONTROL", reset=1)
    await bench.clock()
    same("go after a reset of the core", 0, bench.read("go"))
    await port.set("CONTROL", start=1, reset=1)
    await bench.clock()
    same("go after a write of start and reset", 1, bench.read("go"))
    await port.set("CONTROL", auto=1)
    await bench.pulse("frame_start")
    await bench.clock()
    same("go with auto, after a frame's start", 1, bench.read("go"))
    bench.check()


@cocotb.test()
async def an_event_in_the_clock_of_its_clearing_is_not_lost(dut: Any) -> None:
    """Done, error and start, at each clock around the write that clears or starts."""
    bench, _ = await RegistersBench.create(dut)
    for moment in range(10):
        for pulses in (("frame_done",), ("frame_error",), ("frame_start",), PULSES):
            await bench.restart()
            await bench.port.set("CONTROL", auto=0)
            await bench.pulse("frame_done", "frame_error")
            await bench.act(Write(REGISTERS["INTERRUPT"].address, b"\x03", waits=False))
            await bench.clocks(moment)
            await bench.pulse(*pulses, error_code=7)
            await bench.settle()
            await bench.sweep()
            await bench.act(Write(REGISTERS["CONTROL"].address, b"\x01", waits=False))
            await bench.clocks(moment)
            await bench.pulse(*pulses)
            await bench.settle()
            await bench.sweep()


@cocotb.test()
async def the_interrupt_is_high_while_an_enabled_event_is_not_cleared(dut: Any) -> None:
    """All events, enables and clears: each of two bits on its own."""
    bench, _ = await RegistersBench.create(dut)
    for enabled in range(4):
        for happened in range(4):
            for cleared in range(4):
                await bench.restart()
                await bench.put("INTERRUPT_ENABLE", enabled)
                await bench.pulse(*(name for bit, name in enumerate(PULSES[1:]) if happened >> bit & 1))
                await bench.clock()
                same("irq", int(enabled & happened != 0), bench.read("irq"))
                same("INTERRUPT", happened, await bench.look("INTERRUPT"))
                await bench.put("INTERRUPT", cleared)
                same("INTERRUPT, cleared", happened & ~cleared, await bench.look("INTERRUPT"))
                same("irq, cleared", int(enabled & happened & ~cleared != 0), bench.read("irq"))


@cocotb.test()
async def a_reset_of_the_core_takes_its_clocks_and_no_register(dut: Any) -> None:
    """Core_rst is high for exactly so many clocks, and longer where it is written again."""
    bench, _ = await RegistersBench.create(dut)
    for name, register in REGISTERS.items():
        if register.writable and name not in ("CONTROL", "INTERRUPT"):
            await bench.put(name, 3)
    await bench.port.set("CONTROL", auto=0)
    await bench.pulse("frame_done", "frame_error", error_code=9)
    before = await bench.sweep()
    await bench.act(Write(REGISTERS["CONTROL"].address, b"\x04", waits=False))
    high = 0
    for _ in range(30):
        await bench.clock()
        high += bench.read("core_rst")
    same("clocks of core_rst", RESET_CLOCKS, high)
    await bench.settle()
    same("registers", before, await bench.sweep())
    for _ in range(3):
        await bench.act(Write(REGISTERS["CONTROL"].address, b"\x04", waits=False))
    high = 0
    for _ in range(60):
        await bench.clock()
        high += bench.read("core_rst")
    assert RESET_CLOCKS < high <= 3 * RESET_CLOCKS, f"core_rst is high for {high} clocks of three writes"
    await bench.settle()


@cocotb.test()
async def the_core_is_read_as_it_is(dut: Any) -> None:
    """Every counter in its own register, FRAMES and ERROR as frames end."""
    bench, _ = await RegistersBench.create(dut)
    frames = code = 0
    for _ in range(30):
        shown = {name: bench.word() for name in COUNTERS}
        busy, fault, drawn = (int(roll) for roll in bench.generator.integers(0, (2, 1 << CODE_W, 2)))
        await bench.pulse("frame_done" if drawn else "frame_error", busy=busy, error_code=fault, **shown)
        frames, code = frames + drawn, 0 if drawn else fault
        found = await bench.sweep()
        same("counters", shown, {name: found[name.upper()] for name in COUNTERS})
        same("FRAMES", frames, found["FRAMES"])
        same("ERROR", code, found["ERROR"])
        same("STATUS.busy", busy, REGISTERS["STATUS"].values(found["STATUS"])["busy"])


@cocotb.test()
async def frames_are_counted_beyond_sixteen_bits(dut: Any) -> None:
    """One ends in each clock, and nobody looks meanwhile; reset counts anew."""
    bench = RegistersBench(dut, context.read())
    await bench.reset()
    port = RegisterPort(dut)
    await bench.clock(frame_done=1)
    # The clock runs on by itself; half a period away from its edges no order of events matters.
    await Timer((_MANY_FRAMES - 1) * PERIOD_NS + PERIOD_NS // 2, "ns")
    bench.set(frame_done=0)
    same("FRAMES", _MANY_FRAMES, (await port.get("FRAMES"))["value"])
    await bench.reset()
    same("FRAMES after reset", 0, (await port.get("FRAMES"))["value"])


@cocotb.test()
async def every_sequence_of_accesses_and_events_is_as_the_map_says(dut: Any) -> None:
    """Drawn accesses, one behind or beside the other, events of the core, pauses of each channel."""
    bench, run = await RegistersBench.create(dut)

    async def example(drawn: list[Action], pauses: Sequence[Sequence[bool]]) -> None:
        await play(bench, drawn, pauses)

    await holds(run, example, actions(resets=False), PAUSES)


@cocotb.test()
async def reset_in_each_clock_of_an_access_drops_it(dut: Any) -> None:
    """A write beside a read, responses taken at once or kept waiting; the next accesses are whole."""
    bench, _ = await RegistersBench.create(dut)
    for kept_waiting in (0, 6):
        for moment in range(14):
            await bench.restart()
            for name in ("b", "r"):
                bench.port.pause(name, axi.repeated((True,) * kept_waiting))
            await bench.act(Write(REGISTERS["TAN_V"].address, bytes([moment, 1]), waits=False))
            await bench.act(Read(REGISTERS["ID"].address, waits=False))
            await bench.act(Wait(moment))
            await bench.act(Wait(0, reset=True))
            await bench.act(Write(REGISTERS["TAN_H"].address, bytes([moment, 2]), waits=True))
            await bench.act(Read(REGISTERS["TAN_V"].address, waits=True))
            await bench.finish()


@cocotb.test()
async def reset_at_any_moment_drops_what_is_under_way(dut: Any) -> None:
    """The same with resets among them: no answer of before comes after, the next access is exact."""
    bench, run = await RegistersBench.create(dut)

    async def example(drawn: list[Action], pauses: Sequence[Sequence[bool]]) -> None:
        await play(bench, drawn, pauses)

    await holds(run, example, actions(resets=True), PAUSES)


@cocotb.test()
async def a_long_run_with_rolled_pauses_is_as_the_map_says(dut: Any) -> None:
    """Volume: writes and reads at once, the core busy meanwhile, every channel paused by its own dice."""
    bench, run = await RegistersBench.create(dut)
    rounds = max(12, run.operands // 4_000)
    addresses = [register.address for register in REGISTERS.values()]
    for number in range(rounds):
        await bench.restart()
        share = (0.0, 0.3, 0.7)[number % 3]
        for name in axi.CHANNELS:
            bench.port.pause(name, axi.rolled(bench.generator.spawn(1)[0], share))
        for _ in range(40):
            address = int(bench.generator.choice(addresses))
            await bench.act(Write(address, bench.word().to_bytes(4, "little"), waits=False))
            await bench.act(Read(int(bench.generator.choice(addresses)), waits=False))
            bench.set(**{name: bench.word() for name in COUNTERS})
            for roll, code in bench.generator.integers(0, (1 << 8, 1 << CODE_W), (6, 2)).tolist():
                events = [name for bit, name in enumerate(PULSES) if roll >> bit & 9 == 9]
                await bench.pulse(*events, error_code=code)
        await with_timeout(bench.finish(), 100_000 * PERIOD_NS, "ns")
