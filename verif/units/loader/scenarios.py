"""What closure plays on the loader: frames with and without each kind, each fault, waits, resets."""

from itertools import product
from typing import Any

from hypothesis import strategies as st
from numpy.random import Generator

from models.scene.frame import Capacity, pack
from models.scene.strategies import scenes
from models.scene.types import Scene, Sphere
from verif.coverage.subjects import Scenarios, of_block
from verif.env.context import Context
from verif.env.coverage.flow import LONG
from verif.env.draws import examples
from verif.units.loader.bench import LoaderBench, Words, frame_of

_WORD = 32
_COORD = 19
_CAMERA, _LIGHT, _SPHERE = 9 * _COORD, 6 * _COORD, 352
"""Bits of a camera, a light, a sphere."""


def _of(bench: LoaderBench, *most: int) -> Scene:
    """So many of each kind, or as many as there can be."""
    return frame_of(Capacity(*map(min, most, vars(bench.capacity).values())))


def _words(bench: LoaderBench, scene: Scene) -> Words:
    return pack(scene, bench.counters).words


def _flipped(words: Words, bit: int) -> Words:
    changed = list(words)
    changed[bit // _WORD] ^= 1 << (_WORD - 1 - bit % _WORD)
    return tuple(changed)


async def frames(bench: LoaderBench, _generator: Generator, _size: int) -> None:
    """Every choice of kinds, of each that is there two; then the most of each."""
    for most in (*product((0, 2), repeat=3), (255, 255, 255)):
        scene = _of(bench, *most)
        await bench.load(_words(bench, scene), (), 0, scene)


async def faults(bench: LoaderBench, _generator: Generator, _size: int) -> None:
    """Frames that are cut after each word, too long, with wrong kinds, without a radius, with too many."""
    scene = _of(bench, 1, 1, 1)
    words = _words(bench, scene)
    counters = sum(vars(bench.counters).values())
    sphere = _CAMERA + counters + _LIGHT
    spoilt = [words[:kept] for kept in range(1, len(words))]
    spoilt += [(*words, *range(more)) for more in (1, 2, 4 * LONG)]
    spoilt += [_flipped(words, sphere), _flipped(words, sphere + _SPHERE)]
    spoilt += [_flipped(words, sphere)[: sphere // _WORD + more] for more in range(1, 6)]
    round_nothing = tuple(Sphere(one.material, one.center, 0) for one in scene.spheres)
    spoilt.append(_words(bench, Scene(scene.camera, (), round_nothing, (), scene.ambient, scene.background)))
    spoilt += [_flipped(words, bit) for bit in range(_CAMERA, _CAMERA + counters)]
    for frame in spoilt:
        await bench.load(frame, (), 0, None)


async def too_many(bench: LoaderBench, _generator: Generator, _size: int) -> None:
    """One more of each kind than there can be, where the counters hold it."""
    most = vars(bench.capacity)
    for kind, limit in most.items():
        counts = dict.fromkeys(most, 0) | {kind: limit + 1}
        if limit < vars(bench.counters.capacity)[kind]:
            await bench.load(_words(bench, frame_of(Capacity(**counts))), (), 0, None)


async def cut_counts(bench: LoaderBench, _generator: Generator, _size: int) -> None:
    """A frame whose last word ends within the counters, where a word does."""
    kept = -(-_CAMERA // _WORD)
    if kept * _WORD < _CAMERA + sum(vars(bench.counters).values()):
        await bench.load(_words(bench, _of(bench, 1, 1, 1))[:kept], (), 0, None)


async def waits(bench: LoaderBench, _generator: Generator, _size: int) -> None:
    """Words that come late, a late next_ready, frames one behind the other."""
    scene = _of(bench, 1, 1, 1)
    words = _words(bench, scene)
    for idles, hold in (((), 2 * LONG), ((0, 1, 3, 0), 0), ((2 * LONG, *(0,) * len(words)), 0)):
        await bench.load(words, idles, hold, scene)
        await bench.load(_flipped(words, _CAMERA + 2), idles, 0, None)
    await bench.restart()
    bench.send(words, ())
    bench.send(words, ())
    bench.set(next_ready=1)
    for _ in range(2):
        await bench.end(20 * len(words))
    await bench.restart()


async def resets(bench: LoaderBench, _generator: Generator, _size: int) -> None:
    """Reset in each clock of a frame of all kinds that is too long."""
    words = (*_words(bench, _of(bench, 1, 1, 1)), *range(LONG))
    for clocks in range(2, 4 * len(words)):
        bench.send(words, ())
        bench.set(next_ready=1)
        for _ in range(clocks):
            await bench.step()
        await bench.restart()


async def at_random(bench: LoaderBench, generator: Generator, _size: int) -> None:
    """Drawn scenes, words that come with any gaps."""
    idles = st.lists(st.integers(0, 3), max_size=6)
    for scene, gaps in examples(st.tuples(scenes(bench.capacity), idles), generator, 4):
        await bench.load(_words(bench, scene), gaps, 0, scene)


async def closure_subject(dut: Any, run: Context) -> Scenarios:
    """The loader, ready to be played on."""
    bench = LoaderBench(dut, run.parameters)
    await bench.restart()
    played = {"frames": frames, "faults": faults, "waits": waits, "resets": resets}
    return of_block(bench, {**played, "too many": too_many, "cut counts": cut_counts}, at_random)
