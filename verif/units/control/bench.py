"""Tests of the control: blocks of drawn speed and drawn faults around it, and what each frame must bring."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import cocotb
from hypothesis import strategies as st

from models.limits import Fault
from verif.env import context, resets
from verif.env.block import Block, holds, same
from verif.env.pipelined import Mismatch
from verif.env.resets import Reference

_FAULTS = tuple(fault for fault in Fault if fault)
"""Of loader and camera alike: the control does not know which of them finds which."""
_OUTPUTS = (
    "load_ready",
    "swap",
    "frame_start",
    "camera_start",
    "object_start",
    "draw_start",
    "size_lock",
    "frame_done",
    "frame_error",
    "busy",
)
Going = tuple[bool, ...]
"""Clocks of the input `go`, repeated."""

_SCATTER = 2_654_435_761
"""Odd, and large: multiples of it scatter over all bits."""

_OVERHEAD = 12
"""Clocks of a frame beside the work of the blocks, at most."""


def _of_loads(events: Sequence[str], chosen: bool) -> list[str]:
    """The errors of loads, or all other events."""
    return [event for event in events if event.endswith("of the load") == chosen]


@dataclass(frozen=True)
class Job:
    """A frame: clocks that each block takes for it, and what they find; `ready`: clocks from its swap to
    draw_ready."""

    wait: int
    load: int
    load_fault: Fault
    camera: int
    camera_fault: Fault
    object: int
    ready: int
    draw: int

    @property
    def clocks(self) -> int:
        """All the work of it, one block after the other."""
        return self.wait + self.load + self.camera + self.object + self.ready + self.draw + _OVERHEAD

    def events(self) -> list[str]:
        """What must be seen of this frame, in order."""
        if self.load_fault:
            return [f"error {self.load_fault.name} of the load"]
        start = ["swap", "camera_start"]
        if self.camera_fault:
            return [*start, f"error {self.camera_fault.name} of the camera"]
        return [*start, "object_start", "draw_start", "frame_done"]


@dataclass
class Timer:
    """A block at work: counts down the clocks to its `done`."""

    left: int = 0

    def start(self, clocks: int) -> None:
        """Done comes ``clocks`` clocks after this one."""
        self.left = clocks

    def tick(self) -> bool:
        """One clock; whether the block is done in it."""
        self.left = max(self.left - 1, -1) if self.left > 0 else -1
        return self.left == 0


@dataclass
class Blocks:
    """The loader, camera, set-up of the objects and drawing that the control sees."""

    jobs: Sequence[Job]
    loading: Timer = field(default_factory=Timer)
    camera: Timer = field(default_factory=Timer)
    object: Timer = field(default_factory=Timer)
    ready: Timer = field(default_factory=Timer)
    draw: Timer = field(default_factory=Timer)
    drawable: bool = False
    loaded: int = 0
    good: Iterator[Job] = field(init=False)
    current: Job | None = None
    quiet: int = 0

    def __post_init__(self) -> None:
        self.good = iter([job for job in self.jobs if not job.load_fault])
        self.quiet = self.jobs[0].wait if self.jobs else 0


class ControlBench(Block):
    """One control, the blocks around it, and the rules of its outputs."""

    def __init__(self, dut: Any) -> None:
        super().__init__(
            dut,
            idle=("load_done", "camera_done", "object_done", "draw_done", "go", "draw_ready"),
            carried={"load_done": ("load_fault",), "camera_done": ("camera_fault",)},
        )
        self._blocks = Blocks(())
        self._going: Going = (True,)
        self._ticks = 0
        self._locked = False
        self._busy = False
        self._occupied = False
        self._waiting = False
        self._due = False
        self.events: list[str] = []

    @classmethod
    async def create(cls, dut: Any) -> "ControlBench":
        """A bench whose clock runs and whose block has been reset."""
        bench = cls(dut)
        await bench.restart(())
        return bench

    async def restart(self, jobs: Sequence[Job], going: Going = (True,)) -> None:
        """Reset, with the blocks around; these frames come next, while `go` repeats its clocks."""
        self.set(load_fault=0, camera_fault=0)
        await self.reset()
        self._blocks = Blocks(jobs)
        self._going, self._ticks = going, 0
        self._locked = self._busy = self._occupied = self._waiting = self._due = False
        self.events = []

    async def step(self) -> None:
        """One clock of everything."""
        blocks = self._blocks
        load_done, camera_done = blocks.loading.tick(), blocks.camera.tick()
        object_done, draw_done = blocks.object.tick(), blocks.draw.tick()
        load_fault = blocks.jobs[blocks.loaded].load_fault if load_done else Fault.NONE
        camera_fault = blocks.current.camera_fault if camera_done and blocks.current else Fault.NONE
        blocks.drawable |= blocks.ready.tick()
        go = self._going[self._ticks % len(self._going)]
        self._ticks += 1
        # Without its done a fault says nothing, and a done of a block that is not at work is nobody's.
        stray = self._ticks * _SCATTER >> 8
        await self.clock(
            load_done=int(load_done),
            load_fault=int(load_fault) if load_done else stray & 15,
            camera_done=int(camera_done or (blocks.camera.left < 0 and stray >> 4 & 1)),
            camera_fault=int(camera_fault) if camera_done else stray >> 5 & 15,
            object_done=int(object_done or (blocks.object.left < 0 and stray >> 9 & 1)),
            draw_done=int(draw_done or (blocks.draw.left < 0 and stray >> 10 & 1)),
            go=int(go),
            draw_ready=int(blocks.drawable),
        )
        seen = {name: bool(self.read(name)) for name in _OUTPUTS}
        loaded = load_done and not load_fault
        self._swaps(seen, go, loaded)
        self._rules(seen, loaded, bool(camera_fault))
        self._errors(seen, load_fault, camera_fault)
        self._react(seen, load_done)

    def _swaps(self, seen: dict[str, bool], go: bool, loaded: bool) -> None:
        """A swap one clock after a frame has waited, nothing was set up or drawn, and go was high."""
        same("swap", self._due, seen["swap"])
        same("frame_start", self._due, seen["frame_start"])
        self._due = go and self._waiting and not seen["busy"]
        self._waiting = (self._waiting or loaded) and not seen["swap"]

    def _rules(self, seen: dict[str, bool], loaded: bool, refused: bool) -> None:
        """What must hold at every clock, whatever the frames are."""
        if seen["size_lock"] and (self._locked or not seen["swap"]):
            raise Mismatch("size_lock without the swap of the first frame after reset")
        if seen["swap"] and not self._locked and not seen["size_lock"]:
            raise Mismatch("the first swap after reset without size_lock")
        self._locked |= seen["size_lock"]
        self._busy |= seen["swap"]
        same("busy, from swap to the frame's end", self._busy, seen["busy"])
        if seen["load_ready"] and self._occupied:
            raise Mismatch("load_ready while a frame waits or is set up")
        if seen["frame_done"] or refused:
            self._busy = False
        if seen["object_start"] and self._blocks.camera.left >= 0:
            raise Mismatch("object_start before the camera has been done")
        if seen["draw_start"] and self._blocks.object.left >= 0:
            raise Mismatch("draw_start before the objects have been set up")
        if seen["draw_start"] and not self._blocks.drawable:
            raise Mismatch("draw_start without draw_ready")
        # From the end of a load to the start of drawing, or the refusal, the records are needed.
        self._occupied = (self._occupied or loaded) and not (seen["draw_start"] or refused)

    def _errors(self, seen: dict[str, bool], load_fault: Fault, camera_fault: Fault) -> None:
        """An error in the clock of its cause, with its code, and never two."""
        if load_fault and camera_fault:
            raise Mismatch("two frames refused in one clock: load_ready came too early")
        same("frame_error", bool(load_fault or camera_fault), seen["frame_error"])
        if seen["frame_error"]:
            same("error_code", load_fault or camera_fault, Fault(self.read("error_code")))
            block = "load" if load_fault else "camera"
            self.events.append(f"error {Fault(self.read('error_code')).name} of the {block}")

    def _react(self, seen: dict[str, bool], load_done: bool) -> None:
        """The blocks take what the control tells them."""
        blocks = self._blocks
        names = ("swap", "camera_start", "object_start", "draw_start", "frame_done")
        self.events += [name for name in names if seen[name]]
        if seen["swap"]:
            blocks.current = next(blocks.good)
        if seen["swap"] or seen["draw_start"]:
            blocks.drawable = False
        if blocks.current is not None:
            for name, timer, clocks in (
                ("camera_start", blocks.camera, blocks.current.camera),
                ("object_start", blocks.object, blocks.current.object),
                ("swap", blocks.ready, blocks.current.ready),
                ("draw_start", blocks.draw, blocks.current.draw),
            ):
                if seen[name]:
                    timer.start(clocks)
        if load_done:
            blocks.loaded += 1
            if blocks.loaded < len(blocks.jobs):
                blocks.quiet = blocks.jobs[blocks.loaded].wait
        elif seen["load_ready"] and blocks.loading.left <= 0 and blocks.loaded < len(blocks.jobs):
            if blocks.quiet:
                blocks.quiet -= 1
            else:
                blocks.loading.start(blocks.jobs[blocks.loaded].load)

    async def run(self, jobs: Sequence[Job]) -> None:
        """All frames: each ends in done or error, exactly as its blocks say, and nothing else happens."""
        limit = sum(job.clocks + len(self._going) for job in jobs)
        ends = [job.events()[-1] for job in jobs]
        for _ in range(limit):
            await self.step()
            if sum(event == "frame_done" or event.startswith("error") for event in self.events) == len(ends):
                break
        for _ in range(4):
            await self.step()
        self.judge(jobs)

    def judge(self, jobs: Sequence[Job]) -> None:
        """The events against those of the frames: load errors fall where they may, the rest is in order."""
        expected = [event for job in jobs for event in job.events()]
        for what, chosen in (("frames refused by the loader", True), ("events of the other frames", False)):
            same(what, _of_loads(expected, chosen), _of_loads(self.events, chosen))
        same("load_ready at rest", 1, self.read("load_ready"))
        same("busy at rest", 0, self.read("busy"))


def job_lists() -> st.SearchStrategy[list[Job]]:
    """One to six frames, a third of them with a fault."""
    clocks = st.integers(1, 12)
    good = st.just(Fault.NONE)
    job = st.builds(
        Job,
        wait=st.integers(0, 12),
        load=clocks,
        load_fault=good | good | st.sampled_from(_FAULTS),
        camera=clocks,
        camera_fault=good | good | st.sampled_from(_FAULTS),
        object=st.integers(1, 24),
        ready=st.integers(1, 60),
        draw=st.integers(1, 40),
    )
    return st.lists(job, min_size=1, max_size=6)


def goings() -> st.SearchStrategy[Going]:
    """Clocks of `go`, which is high in one of them at least."""
    clocks = st.lists(st.booleans(), max_size=12)
    return st.just((True,)) | st.builds(lambda drawn: (*drawn, True), clocks)


def _a_good_job(load: int = 5, draw: int = 30) -> Job:
    return Job(0, load, Fault.NONE, 6, Fault.NONE, 9, 1, draw)


@cocotb.test()
async def every_frame_ends_in_done_or_error_in_the_right_order(dut: Any) -> None:
    """Drawn frames and clocks of `go`; at every clock the rules of all outputs hold."""
    bench = await ControlBench.create(dut)

    async def example(jobs: list[Job], going: Going) -> None:
        await bench.restart(jobs, going)
        await bench.run(jobs)

    await holds(context.read(), example, job_lists(), goings())


@cocotb.test()
async def reset_at_any_moment_forgets_every_frame(dut: Any) -> None:
    """After it no event comes of a frame of before; the size is taken anew with the first one."""
    bench = await ControlBench.create(dut)

    async def example(before: list[Job], wait: int, quiet: int, after: list[Job], going: Going) -> None:
        await bench.restart(before, going)
        for _ in range(wait):
            await bench.step()
        await bench.restart(())
        for _ in range(quiet):
            await bench.step()
        same("events after reset without a frame", [], bench.events)
        await bench.restart(after, going)
        await bench.run(after)

    quiet = st.integers(0, 8)
    await holds(context.read(), example, job_lists(), st.integers(0, 80), quiet, job_lists(), goings())


@cocotb.test()
async def the_next_frame_is_loaded_while_one_is_drawn(dut: Any) -> None:
    """A load that takes as long as the drawing costs no clock beside the set-up."""
    bench = await ControlBench.create(dut)
    frames = 5
    jobs = [_a_good_job(load=20, draw=40) for _ in range(frames)]
    await bench.restart(jobs)
    before = bench.now
    await bench.run(jobs)
    set_up = jobs[0].camera + jobs[0].object + _OVERHEAD
    limit = jobs[0].load + frames * (set_up + jobs[0].draw)
    assert bench.now - before <= limit, f"{bench.now - before} clocks, more than {limit}"


@cocotb.test()
async def drawing_waits_for_camera_objects_and_draw_ready(dut: Any) -> None:
    """All pairs of times up to 8 clocks, and draw_ready before, with and after them."""
    bench = await ControlBench.create(dut)
    states = 3
    for camera in range(1, 9):
        for objects in range(1, 9):
            for ready in range(1, camera + objects + 10):
                job = Job(0, 1, Fault.NONE, camera, Fault.NONE, objects, ready, 1)
                await bench.restart([job])
                while "swap" not in bench.events:
                    await bench.step()
                swapped = bench.now
                while "draw_start" not in bench.events and bench.now < swapped + job.clocks:
                    await bench.step()
                earliest = max(camera + objects + states, ready)
                waited = bench.now - swapped
                assert earliest < waited <= earliest + 2, (
                    f"{waited} clocks to draw_start, ready after {earliest}: {job}"
                )
                await bench.run([job])


@cocotb.test()
async def a_frame_waits_for_go(dut: Any) -> None:
    """`go` high in one clock of a hundred: in each of them one frame begins, the next one waits meanwhile."""
    bench = await ControlBench.create(dut)
    period, low = 100, 30
    jobs = [_a_good_job(load=3, draw=20) for _ in range(3)]
    await bench.restart(jobs, tuple(clock == low for clock in range(period)))
    drawn: list[str] = []
    for job in jobs:
        for _ in range(low):
            await bench.step()
        same("events before go", drawn, bench.events)
        same("load_ready while a frame waits for go", 0, bench.read("load_ready"))
        for _ in range(period - low):
            await bench.step()
        drawn += job.events()
        same("events after go", drawn, bench.events)
    same("load_ready at rest", 1, bench.read("load_ready"))


@cocotb.test()
async def reset_in_each_clock_of_each_state_leaves_a_control_as_new(dut: Any) -> None:
    """Of a good frame and one behind it whose camera is refused; the next ones are whole."""
    bench = await ControlBench.create(dut)
    refused = replace(_a_good_job(), camera_fault=Fault.CAMERA_UP)
    jobs, after = [_a_good_job(), refused], [_a_good_job(load=3, draw=4), refused]

    async def start() -> None:
        await bench.restart(jobs)

    async def behind() -> None:
        await bench.restart(after)
        await bench.run(after)

    run = Reference(start, bench.step, sum(job.clocks for job in jobs), behind)
    await resets.at_every_clock(bench.log, run, dut.state_reg, "control.v")
