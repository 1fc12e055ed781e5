"""The registers with cocotbext-axi's master before them, and a model beside them at every clock."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import cocotb
from cocotb.task import Task
from hypothesis import strategies as st

from models.registers import REGISTERS, WORD_BYTES, Build
from verif.env import axi, context
from verif.env.axi import OKAY, Answer, RegisterPort
from verif.env.block import Block, same
from verif.env.pipelined import Mismatch
from verif.units.axil_registers.model import CORE, COUNTERS, EVENTS, PULSES, Clock, RegisterModel

ADDRESSES = 1 << 8
WORD_W = 8 * WORD_BYTES
ALL = (1 << WORD_W) - 1
_BUS = ("awvalid", "awaddr", "wvalid", "wdata", "wstrb", "bready", "arvalid", "araddr", "rready")
CODE_W = REGISTERS["ERROR"].field("code").width


@dataclass(frozen=True)
class Write:
    """Bytes of one word. waits: nothing else is asked for before its response."""

    address: int
    data: bytes
    waits: bool


@dataclass(frozen=True)
class Read:
    """A word. waits: nothing else is asked for before its response."""

    address: int
    waits: bool


@dataclass(frozen=True)
class Core:
    """One clock in which the core tells something, and what it shows from then on."""

    pulses: frozenset[str]
    shown: Mapping[str, int]


@dataclass(frozen=True)
class Wait:
    """Clocks in which nothing new is asked for; a reset, if it is one."""

    clocks: int
    reset: bool = False


Action = Write | Read | Core | Wait


@dataclass
class Asked:
    """Tasks of the accesses under way, in order; each ends with its answer, None where a reset dropped it."""

    writes: list[Task[Answer | None]] = field(default_factory=list)
    reads: list[Task[Answer | None]] = field(default_factory=list)


class RegistersBench(Block):
    """A master, the core's side, and the model, which sees what the registers see."""

    def __init__(self, dut: Any, run: context.Context) -> None:
        super().__init__(dut, idle=PULSES)
        # The master lets clocks pass too: `_watch` samples, not `clock`.
        self.watched, self.signals = self.signals, None
        self.build = Build.of(run.parameters)
        self.generator = run.generator(0)
        self.set(rst=0, **dict.fromkeys(CORE, 0))
        self.set(**{f"s_axil_{name}": 0 for name in (*_BUS, "awprot", "arprot")})
        self._model = RegisterModel(self.build)
        self._complaint: Mismatch | None = None
        self._asked = Asked()
        self._monitors = [axi.channel(name).monitor(dut, "s_axil", self.clocking) for name in axi.CHANNELS]
        self._master: RegisterPort | None = None

    @classmethod
    async def create(cls, dut: Any) -> tuple["RegistersBench", context.Context]:
        """A bench whose clock runs, whose block has been reset and which has a master."""
        run = context.read()
        bench = cls(dut, run)
        await bench.reset()
        bench.watch()
        bench._master = RegisterPort(dut)
        return bench, run

    @property
    def port(self) -> RegisterPort:
        """The master."""
        if self._master is None:
            raise RuntimeError("no master before the first reset")
        return self._master

    def watch(self) -> None:
        """From the next clock on compares every output with the model; `check` tells."""
        cocotb.start_soon(self._watch())
        for monitor in self._monitors:
            monitor.start()

    async def _watch(self) -> None:
        while self._complaint is None:
            await self.clocking.edge
            if self.watched is not None:
                self.watched.sample()
            try:
                for name, expected in self._model.outputs().items():
                    same(name, expected, self.read(name))
                self._model.clock(self._sample())
            except Mismatch as mismatch:
                self._complaint = Mismatch(f"clock {self.now + 1}: {mismatch}")

    def _sample(self) -> Clock:
        bus = {
            name: self.read(f"s_axil_{name}") for name in ("awvalid", "wvalid", "arvalid", "bready", "rready")
        }
        return Clock(
            rst=bool(self.read("rst")),
            aw=self.read("s_axil_awaddr") if bus["awvalid"] else None,
            w=(self.read("s_axil_wdata"), self.read("s_axil_wstrb")) if bus["wvalid"] else None,
            b_ready=bool(bus["bready"]),
            ar=self.read("s_axil_araddr") if bus["arvalid"] else None,
            r_ready=bool(bus["rready"]),
            core={name: self.read(name) for name in (CORE if self._model.looks else EVENTS)},
        )

    def check(self) -> None:
        """Raises Mismatch where an output was not the model's, or a channel broke the protocol."""
        if self._complaint is not None:
            raise self._complaint
        if breaches := [breach for monitor in self._monitors for breach in monitor.breaches]:
            raise Mismatch("\n".join(breaches[:4]))

    async def reset(self, cycles: int = 2) -> None:
        """Resets the block, wherever it is; a response that this drops breaks no protocol."""
        self.check()
        for monitor in self._monitors:
            monitor.stop()
            monitor.clear()
        await super().reset(cycles)
        for monitor in self._monitors:
            monitor.start()

    async def restart(self, pauses: Sequence[Sequence[bool]] = ()) -> None:
        """Reset, whatever is under way; these pauses of the channels from then on."""
        patterns = pauses or ((),) * len(axi.CHANNELS)
        for name, pattern in zip(axi.CHANNELS, patterns, strict=True):
            self.port.pause(name, axi.repeated(pattern) if any(pattern) else None)
        self.set(**dict.fromkeys(CORE, 0))
        await self.reset()
        self._asked = Asked()
        self._model.finished.clear()
        # The agents start a clock after reset: without it a drawn sequence would begin before them.
        await self.clock()

    async def pulse(self, *names: str, **shown: int) -> None:
        """One clock in which the core tells these."""
        self.set(**shown)
        await self.clock(**dict.fromkeys(names, 1))
        self.set(**dict.fromkeys(names, 0))

    async def act(self, action: Action) -> None:
        """Does it, or has it begun."""
        match action:
            case Write(address, data, waits):
                task = cocotb.start_soon(self.port.write(address, data))
                self._asked.writes.append(task)
                if waits:
                    await self._finished([task])
            case Read(address, waits):
                task = cocotb.start_soon(self.port.read(address))
                self._asked.reads.append(task)
                if waits:
                    await self._finished([task])
            case Core(pulses, shown):
                await self.pulse(*pulses, **shown)
            case Wait(clocks, reset):
                if reset:
                    await self.reset(clocks + 1)
                else:
                    await self.clocks(clocks)

    async def _finished(self, tasks: Sequence[Task[Answer | None]], each: int = 200) -> None:
        for _ in range(each * len(tasks) + 1):
            if all(task.done() for task in tasks):
                return
            await self.clock()
        self.check()
        raise Mismatch(f"an access is not answered after {each * len(tasks)} clocks")

    async def settle(self) -> None:
        """All that `act` began is answered."""
        await self._finished([*self._asked.writes, *self._asked.reads])
        await self.clocks(4)
        self.check()

    async def finish(self) -> None:
        """The same, where `act` alone made accesses since `restart`: the answers are the model's, no more."""
        await self.settle()
        for what, tasks, write in (
            ("writes", self._asked.writes, True),
            ("reads", self._asked.reads, False),
        ):
            answers = [answer for task in tasks if (answer := task.result()) is not None]
            expected = [Answer(a.response, a.bytes) for a in self._model.finished if a.write == write]
            same(f"answers to {what}", expected, answers)

    async def sweep(self) -> dict[str, int]:
        """Reads every register."""
        found = {}
        for name, register in REGISTERS.items():
            answer = await self.port.read(register.address)
            same(f"response of {name}", OKAY, answer and answer.response)
            found[name] = answer.data if answer else 0
        self.check()
        return found

    async def put(self, name: str, word: int) -> int:
        """Writes a register; the response."""
        answer = await self.port.write(REGISTERS[name].address, word.to_bytes(WORD_BYTES, "little"))
        self.check()
        return -1 if answer is None else answer.response

    async def look(self, name: str) -> int:
        """Reads a register that can be read."""
        answer = await self.port.read(REGISTERS[name].address)
        self.check()
        same(f"response of {name}", OKAY, answer and answer.response)
        return answer.data if answer else 0

    def word(self) -> int:
        """Any word: mostly of few bits, so that numbers are near what the registers can hold."""
        return int(self.generator.integers(0, 1 << int(self.generator.integers(1, WORD_W + 1))))


def actions(resets: bool) -> st.SearchStrategy[list[Action]]:
    """One to thirty of them; resets: these among them."""
    known = st.sampled_from([register.address for register in REGISTERS.values()])
    written = st.sampled_from([register.address for register in REGISTERS.values() if register.writable])
    words = st.integers(0, ALL) | st.integers(0, 8) | st.sampled_from([0x02000200, 0x93CD, 0x1000, 0x80000])
    waits = st.booleans()

    def write(address: int, offset: int, length: int, word: int, waits: bool) -> Write:
        return Write(address + offset, word.to_bytes(4, "little")[offset : offset + length], waits)

    write_word = st.builds(write, written, st.just(0), st.just(4), words, waits)
    write_part = st.builds(write, known | written, st.integers(0, 3), st.integers(1, 4), words, waits)
    write_nowhere = st.builds(
        write, st.integers(0, 63).map(lambda word: 4 * word), st.just(0), st.just(4), words, waits
    )
    read = st.builds(Read, known | st.integers(0, ADDRESSES - 1), waits)
    shown = st.fixed_dictionaries(
        {"error_code": st.integers(0, (1 << CODE_W) - 1), "busy": st.integers(0, 1)},
        optional={name: st.integers(0, ALL) for name in COUNTERS},
    )
    core = st.builds(Core, st.frozensets(st.sampled_from(PULSES)), shown)
    wait = st.builds(Wait, st.integers(0, 8))
    kinds: list[st.SearchStrategy[Action]] = [
        write_word,
        write_word,
        write_part,
        write_nowhere,
        read,
        core,
        core,
        wait,
    ]
    if resets:
        kinds.append(st.builds(Wait, st.integers(0, 3), st.just(True)))
    return st.lists(st.one_of(kinds), min_size=1, max_size=30)


PAUSES = st.tuples(*(st.lists(st.booleans(), max_size=6) for _ in axi.CHANNELS))


async def play(bench: RegistersBench, sequence: Sequence[Action], pauses: Sequence[Sequence[bool]]) -> None:
    """A sequence from reset, with pauses of the channels; all answers are the model's."""
    await bench.restart(pauses)
    for action in sequence:
        await bench.act(action)
    await bench.finish()
    await bench.sweep()
