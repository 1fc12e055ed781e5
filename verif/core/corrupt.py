"""Tests of one packed frame with every single thing wrong: each bit flipped in turn, cut and continued at
each word. Each is answered with the exact picture of what it says, or with its fault; the good frame behind
it is exact. Nothing is reset between.
"""

import dataclasses
from collections import Counter
from collections.abc import Iterator, Sequence
from typing import Any

import cocotb

from models.fixed import BOOK, COLOUR
from models.limits import Fault
from models.scene.frame import WORD_BITS, Frame, unpack
from models.scene.types import Camera, Light, Material, Scene, Sphere, Triangle, View
from verif.core.faults import verdict
from verif.core.setting import Setting
from verif.core.strategies import Shot, flipped
from verif.env.block import same

_DEPTH = 3
_SURPLUS = 40
"""Most words behind the end of a frame."""

FLIPS = {Fault.NONE, Fault.FRAME_LONG, Fault.KIND, Fault.RADIUS, Fault.CAMERA_POSITION, Fault.CAMERA_UP}
"""What one flipped bit of the scene can lead to: more objects than there are run into a kind bit."""


def scene() -> Scene:
    """One of each, so placed that every field decides a pixel, and one bit is from each fault: a sphere of
    glass seen beside and through a triangle of glass, both with highlights."""
    one, full = BOOK.one, COLOUR.one
    grey = (full // 2,) * 3
    ball = Material(
        ambient=(full // 8, full // 4, full // 16),
        diffuse=(full // 2, full // 4, full // 8),
        specular=grey,
        reflection=(full // 4, full // 8, full // 4),
        transparency=(full // 2, full // 2, full // 4),
        index=4,
    )
    pane = Material(
        ambient=(full // 8, full // 16, full // 4),
        diffuse=(full // 2, full // 2, full // 4),
        specular=(full // 4,) * 3,
        reflection=(full // 2, full // 2, full // 4),
        transparency=(full // 4, full // 4, full // 2),
        index=2,
    )
    corners = (
        (-3 * one, -2 * one, one // 2),
        (one // 4, -2 * one, one),
        (one // 4, 3 * one, one // 2),
    )
    return Scene(
        camera=Camera(position=(0, 0, 4 * one), up=(0, one, 0), center=(0, 0, 0)),
        lights=(Light((0, one, 3 * one), (full,) * 3),),
        spheres=(Sphere(ball, (one // 4, 0, -one), radius=8),),
        triangles=(Triangle(pane, corners),),
        ambient=grey,
        background=(full // 8, full // 4, full // 2),
    )


def fields(part: Any, name: str = "scene") -> Iterator[tuple[str, Any]]:
    """Every vector and scalar of a scene by name, objects by number."""
    if dataclasses.is_dataclass(part):
        for field in dataclasses.fields(part):
            yield from fields(getattr(part, field.name), f"{name}.{field.name}")
    elif isinstance(part, tuple) and part and not isinstance(part[0], int):
        for number, item in enumerate(part):
            yield from fields(item, f"{name}[{number}]")
    else:
        yield name, part


@dataclasses.dataclass(frozen=True)
class _Answers:
    """A core that is sent frames, spoilt and good ones in turn, and what the good one shows."""

    setting: Setting
    shot: Shot

    @classmethod
    async def of(cls, dut: Any) -> "_Answers":
        """A core just reset."""
        setting = Setting.of(dut)
        view = View.square(4, 3, 60)
        shot = Shot(scene(), setting.registers(view, _DEPTH), view)
        await setting.core.reset(shot.registers)
        setting.core.take(True)
        return cls(setting, shot)

    @property
    def words(self) -> tuple[int, ...]:
        """The good frame."""
        return self.setting.words(self.shot.scene)

    async def to(self, what: str, words: Sequence[int]) -> tuple[Fault, bool, Scene | None]:
        """The fault of a spoilt frame, whether its picture is another one, and the scene it says.

        Then the good frame is drawn. Mismatch where either answer is not the model's.
        """
        setting, shot = self.setting, self.shot
        fault = verdict(setting, words, shot.registers)
        good, other, said = setting.expected(shot), False, None
        if fault is Fault.NONE:
            said = unpack(Frame(tuple(words)), setting.design.counters)
            told = dataclasses.replace(shot, scene=said)
            wanted = setting.same_picture(told, await setting.collected(told, setting.core.draw(words)))
            other = bool((wanted.rgb != good.rgb).any())
        else:
            got = await setting.refused(words)
            same(f"{what}: fault and pixels", (fault.name, 0), (got.fault.name, len(got.rgb)))
        same(f"{what}: busy behind it", False, setting.core.busy)
        setting.same_picture(shot, await setting.draw(shot))
        return fault, other, said


@cocotb.test()
async def each_flipped_bit_gives_the_picture_it_describes_or_the_right_fault(dut: Any) -> None:
    """All bits of the frame, the padding of its last word among them; each field changes some picture."""
    answers = await _Answers.of(dut)
    words, good = answers.words, dict(fields(answers.shot.scene))
    seen: Counter[Fault] = Counter()
    deciding: set[str] = set()
    for bit in range(WORD_BITS * len(words)):
        fault, other, said = await answers.to(f"bit {bit} flipped", flipped(words, [bit]))
        seen[fault] += 1
        if other:
            deciding.update(name for name, value in fields(said) if value != good.get(name))
        if bit % 100 == 0:
            dut._log.info("bit %d of %d", bit, WORD_BITS * len(words))
    dut._log.info("flips by fault: %s", {fault.name: number for fault, number in seen.items()})
    assert set(seen) == FLIPS, f"only seen: {dict(seen)}"
    assert deciding >= good.keys(), f"these fields decide no pixel: {good.keys() - deciding}"


@cocotb.test()
async def frames_cut_or_continued_at_each_word_are_refused(dut: Any) -> None:
    """One word to one less than all, and up to many more than all, of any bits."""
    answers = await _Answers.of(dut)
    words, random = answers.words, answers.setting.run.generator(0)
    surplus = tuple(map(int, random.integers(0, 1 << WORD_BITS, _SURPLUS)))
    spoilt = [words[:length] for length in range(1, len(words))]
    spoilt += [(*words, *surplus[:more]) for more in range(1, _SURPLUS + 1)]
    seen = Counter([(await answers.to(f"{len(frame)} words", frame))[0] for frame in spoilt])
    assert seen == {Fault.FRAME_SHORT: len(words) - 1, Fault.FRAME_LONG: _SURPLUS}
