"""Tests of the loader: frames of drawn scenes, whole and spoilt, against the model of the packed frame."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import cocotb
from hypothesis import strategies as st

from models.formats import Knobs, formats
from models.limits import RECORD_SLOTS, SPHERE_SLOTS, Fault, Record
from models.scene.frame import Capacity, CounterWidths, check, pack
from models.scene.strategies import scenes
from models.scene.types import Camera, Light, Material, Scene, Sphere, Triangle
from verif.env import context, resets
from verif.env.block import Block, holds, same
from verif.env.fields import Field
from verif.env.pipelined import Mismatch
from verif.env.resets import Reference
from verif.env.streams import Stream

_SLOT_W = formats(Knobs()).coord.width
_WORD = 32
_WORDS = Stream("frame", (Field("data", _WORD, signed=False), Field("last", 1, signed=False)))
_SLOTS = {
    Record.CAMERA: 9,
    Record.LIGHT: 6,
    Record.SPHERE: SPHERE_SLOTS,
    Record.TRIANGLE: RECORD_SLOTS,
    Record.TAIL: 6,
}
_CAMERA_FAULTS = (Fault.CAMERA_POSITION, Fault.CAMERA_UP)

Words = tuple[int, ...]


@dataclass(frozen=True)
class Entry:
    """A record as it is handed on: its fields in slots, the last one in the low bits."""

    kind: Record
    index: int
    slots: tuple[int, ...]

    def packed(self) -> int:
        """The slots, as wide as they are together."""
        word = 0
        for slot in self.slots:
            word = word << _SLOT_W | slot & ((1 << _SLOT_W) - 1)
        return word


def _material(material: Material) -> list[int]:
    colours = (material.ambient, material.diffuse, material.specular, material.reflection)
    return [*(channel for colour in (*colours, material.transparency) for channel in colour), material.index]


def _sphere(sphere: Sphere) -> list[int]:
    return [0, *_material(sphere.material), *sphere.center, sphere.radius]


def _triangle(triangle: Triangle) -> list[int]:
    return [1, *_material(triangle.material), *(place for vertex in triangle.vertices for place in vertex)]


def entries(scene: Scene) -> Iterator[Entry]:
    """The records of a scene, in the order of its frame."""
    camera = scene.camera
    yield Entry(Record.CAMERA, 0, (*camera.position, *camera.up, *camera.center))
    for index, light in enumerate(scene.lights):
        yield Entry(Record.LIGHT, index, (*light.position, *light.intensity))
    for index, sphere in enumerate(scene.spheres):
        yield Entry(Record.SPHERE, index, tuple(_sphere(sphere)))
    for index, triangle in enumerate(scene.triangles):
        yield Entry(Record.TRIANGLE, index, tuple(_triangle(triangle)))
    yield Entry(Record.TAIL, 0, (*scene.ambient, *scene.background))


class LoaderBench(Block):
    """Sends frames and looks at records and ends of frames at every clock."""

    def __init__(self, dut: Any, parameters: Mapping[str, int]) -> None:
        super().__init__(dut, idle=("next_ready",))
        widths = [parameters[f"{kind}_COUNT_W"] for kind in ("LIGHT", "SPHERE", "TRIANGLE")]
        most = [parameters[f"MAX_{kind}S"] for kind in ("LIGHT", "SPHERE", "TRIANGLE")]
        self.counters, self.capacity = CounterWidths(*widths), Capacity(*most)
        self._source = _WORDS.source(dut, "in", self.clocking)
        self._monitor = _WORDS.monitor(dut, "in", self.clocking)
        self._entries: list[tuple[Record, int, int]] = []

    async def restart(self) -> None:
        """Reset, whatever is under way."""
        for agent in (self._source, self._monitor):
            agent.stop()
            agent.clear()
        await self.reset()
        for agent in (self._source, self._monitor):
            agent.start()
        self._entries = []

    def fault(self, words: Words) -> Fault:
        """What the loader must say of a frame: the camera is not its business."""
        found = check(words, self.counters, self.capacity)
        return Fault.NONE if found in _CAMERA_FAULTS else found

    def send(self, words: Words, idles: Sequence[int]) -> None:
        """Queues a frame."""
        self._source.idle(idles)
        last = len(words) - 1
        self._source.send_words([(word, int(number == last)) for number, word in enumerate(words)])

    @property
    def taken(self) -> int:
        """Words taken since reset."""
        return len(self._monitor.transfers.words)

    async def step(self) -> Fault | None:
        """One clock; the fault where a frame ends in it."""
        await self.clock()
        if self.read("record_valid"):
            kind = Record(self.read("record_kind"))
            record = self.read("record", _SLOTS[kind] * _SLOT_W)
            self._entries.append((kind, self.read("record_index"), record))
        return Fault(self.read("fault")) if self.read("done") else None

    async def end(self, limit: int) -> Fault:
        """Steps to the end of the frame under way; there must be one."""
        for _ in range(limit):
            fault = await self.step()
            if fault is not None:
                return fault
        raise Mismatch(f"the frame has not ended after {limit} clocks")

    async def load(self, words: Words, idles: Sequence[int], hold: int, scene: Scene | None) -> None:
        """One frame, `next_ready` held low for some clocks before it; every output of it is checked."""
        self.send(words, idles)
        before, self._entries = self.taken, []
        for _ in range(hold):
            same("end of a frame that has not begun", None, await self.step())
        same("words taken while next_ready is low", before, self.taken)
        self.set(next_ready=1)
        # A field takes a clock, a word its idle clocks; fields are not more than bits.
        fields = 40 + 26 * (sum(vars(self.counters.capacity).values()) + 1)
        limit = fields + len(words) * (2 + max(idles, default=0))
        # One clock of next_ready starts a frame; the next one waits for its own.
        same("end of a frame in its first clock", None, await self.step())
        self.set(next_ready=0)
        fault = await self.end(limit)
        same("fault", self.fault(words), fault)
        same("words taken", before + len(words), self.taken)
        if scene is not None and fault is Fault.NONE:
            self._compare(scene)
        for _ in range(3):
            same("a second end of the frame", None, await self.step())
        same("breaches of the stream's protocol", [], self._monitor.breaches)

    def _compare(self, scene: Scene) -> None:
        wanted = list(entries(scene))
        got = [(kind, index) for kind, index, _ in self._entries]
        same("records", [(entry.kind, entry.index) for entry in wanted], got)
        for entry, (_, _, record) in zip(wanted, self._entries, strict=True):
            same(f"slots of {entry.kind.name} {entry.index}", hex(entry.packed()), hex(record))
        counts = [len(objects) for objects in (scene.lights, scene.spheres, scene.triangles)]
        same("counts", counts, [self.read(name) for name in ("lights", "spheres", "triangles")])


@dataclass(frozen=True)
class Sent:
    """A frame as it is sent; its scene, where nothing was done to it."""

    words: Words
    scene: Scene | None


_IDLES = st.lists(st.integers(0, 3), max_size=6)
_WORD_VALUES = st.integers(0, (1 << _WORD) - 1)


def _whole(bench: LoaderBench) -> st.SearchStrategy[Sent]:
    def build(scene: Scene) -> Sent:
        return Sent(pack(scene, bench.counters).words, scene)

    return scenes(bench.capacity).map(build)


def _flipped(bench: LoaderBench) -> st.SearchStrategy[Sent]:
    """Bits flipped, in the counters more often than elsewhere."""
    place = st.integers(9 * _SLOT_W, 9 * _SLOT_W + 8) | st.integers(0, 1 << 14)

    def build(sent: Sent, places: list[int]) -> Sent:
        words = list(sent.words)
        for at in places:
            index = at % (len(words) * _WORD)
            words[index // _WORD] ^= 1 << (_WORD - 1 - index % _WORD)
        return Sent(tuple(words), None)

    return st.builds(build, _whole(bench), st.lists(place, min_size=1, max_size=3))


def _shortened(bench: LoaderBench) -> st.SearchStrategy[Sent]:
    def build(sent: Sent, kept: int) -> Sent:
        return Sent(sent.words[: 1 + kept % len(sent.words)], None)

    return st.builds(build, _whole(bench), st.integers(0, 1 << 10))


def _lengthened(bench: LoaderBench) -> st.SearchStrategy[Sent]:
    more = st.lists(_WORD_VALUES, min_size=1, max_size=5)
    return st.builds(lambda sent, words: Sent((*sent.words, *words), None), _whole(bench), more)


def _objects_spoilt(bench: LoaderBench) -> st.SearchStrategy[Sent]:
    """Spheres without a radius; more objects than the capacity, within the counters."""

    def without_radius(scene: Scene) -> Sent:
        spheres = tuple(Sphere(sphere.material, sphere.center, 0) for sphere in scene.spheres)
        changed = Scene(scene.camera, scene.lights, spheres, scene.triangles, scene.ambient, scene.background)
        return Sent(pack(changed, bench.counters).words, None)

    def too_many(scene: Scene) -> Sent:
        return Sent(pack(scene, bench.counters).words, None)

    return scenes(bench.capacity).map(without_radius) | scenes(bench.counters.capacity).map(too_many)


def _random() -> st.SearchStrategy[Sent]:
    sizes = st.integers(1, 40)
    return sizes.flatmap(lambda size: st.lists(_WORD_VALUES, min_size=size, max_size=size)).map(
        lambda words: Sent(tuple(words), None)
    )


def _any_frame(bench: LoaderBench) -> st.SearchStrategy[Sent]:
    return st.one_of(
        _whole(bench),
        _flipped(bench),
        _shortened(bench),
        _lengthened(bench),
        _objects_spoilt(bench),
        _random(),
    )


async def _bench(dut: Any) -> tuple[LoaderBench, context.Context]:
    run = context.read()
    bench = LoaderBench(dut, run.parameters)
    await bench.restart()
    return bench, run


@cocotb.test()
async def every_record_of_every_frame_is_handed_on_exactly(dut: Any) -> None:
    """Drawn scenes and idle clocks; slot by slot."""
    bench, run = await _bench(dut)

    async def example(sent: Sent, idles: list[int], hold: int) -> None:
        await bench.restart()
        await bench.load(sent.words, idles, hold, sent.scene)

    await holds(run, example, _whole(bench), _IDLES, st.integers(0, 5), cost=2)


@cocotb.test()
async def every_fault_is_named_and_the_next_frame_is_exact(dut: Any) -> None:
    """Spoilt frames of every kind, the fault as the model names it; a whole frame follows."""
    bench, run = await _bench(dut)

    async def example(spoilt: Sent, after: Sent, idles: list[int], hold: int) -> None:
        await bench.restart()
        await bench.load(spoilt.words, idles, 0, spoilt.scene)
        await bench.load(after.words, idles, hold, after.scene)

    await holds(run, example, _any_frame(bench), _whole(bench), _IDLES, st.integers(0, 3), cost=2)


@cocotb.test()
async def frames_in_one_queue_are_told_apart(dut: Any) -> None:
    """Any frames, back to back, `next_ready` high throughout: as many ends, in order, each with its fault."""
    bench, run = await _bench(dut)

    async def example(frames: list[Sent], idles: list[int]) -> None:
        await bench.restart()
        for sent in frames:
            bench.send(sent.words, idles)
        bench.set(next_ready=1)
        words = sum(len(sent.words) for sent in frames)
        faults = []
        for _ in range(600 * len(frames) + words * (2 + max(idles, default=0))):
            fault = await bench.step()
            if fault is not None:
                faults.append(fault)
            if len(faults) == len(frames) and bench.taken == words:
                break
        for _ in range(8):
            same("an end without a frame", None, await bench.step())
        same("faults", [bench.fault(sent.words) for sent in frames], faults)
        same("words taken", words, bench.taken)

    await holds(run, example, st.lists(_any_frame(bench), min_size=1, max_size=4), _IDLES, cost=4)


@cocotb.test()
async def reset_in_the_middle_of_a_frame_forgets_it(dut: Any) -> None:
    """Reset at a drawn clock; the next frame is exact."""
    bench, run = await _bench(dut)

    async def example(before: Sent, wait: int, after: Sent, idles: list[int]) -> None:
        await bench.restart()
        bench.send(before.words, idles)
        bench.set(next_ready=1)
        for _ in range(wait):
            await bench.step()
        await bench.restart()
        await bench.load(after.words, idles, 2, after.scene)

    await holds(run, example, _any_frame(bench), st.integers(0, 200), _whole(bench), _IDLES, cost=4)


def frame_of(number: Capacity) -> Scene:
    """So many objects of each kind, all alike."""
    sphere = Sphere(Material((1, 2, 3), (4, 5, 6), (7, 8, 9)), (10, 11, 12), 13)
    triangle = Triangle(sphere.material, ((1, 2, 3), (4, 5, 6), (7, 8, 9)))
    return Scene(
        camera=Camera((1, 2, 3), (4, 5, 6), (7, 8, 9)),
        lights=(Light((1, 2, 3), (4, 5, 6)),) * number.lights,
        spheres=(sphere,) * number.spheres,
        triangles=(triangle,) * number.triangles,
        ambient=(1, 2, 3),
        background=(4, 5, 6),
    )


def _fields(scene: Scene) -> int:
    """Fields of a frame."""
    return 3 + sum(len(entry.slots) for entry in entries(scene))


@cocotb.test()
async def rate_is_one_field_a_clock(dut: Any) -> None:
    """The largest frame, its words without a gap: hardly more clocks than fields."""
    bench, _ = await _bench(dut)
    scene = frame_of(bench.capacity)
    before = bench.now
    await bench.load(pack(scene, bench.counters).words, [], 0, scene)
    fields, behind = _fields(scene), 3
    assert bench.now - before <= fields + behind + 6, f"{bench.now - before} clocks for {fields} fields"


@cocotb.test()
async def reset_in_each_clock_of_each_section_forgets_the_frame(dut: Any) -> None:
    """Of a frame of every kind of record that is too long, and so drained; the next one is exact."""
    bench, _ = await _bench(dut)
    triangles = min(1, bench.capacity.triangles)
    scene = frame_of(Capacity(1, 1, triangles))
    words, surplus = pack(scene, bench.counters).words, (1, 2, 3, 4)

    async def start() -> None:
        await bench.restart()
        bench.send((*words, *surplus), ())
        bench.set(next_ready=1)

    async def behind() -> None:
        bench.set(next_ready=0)
        await bench.restart()
        await bench.load(words, (), 1, scene)

    run = Reference(start, bench.step, _fields(scene) + len(surplus) + 6, behind)
    unreachable = () if triangles else ("S_TRIANGLE",)
    await resets.at_every_clock(bench.log, run, dut.section_reg, "scene/loader.v", unreachable)
