"""Tests of the sums of pixels against a dictionary of pixels: which are complete, when, in what colour."""

from collections import deque
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import cycle, islice
from typing import Any

import cocotb
from hypothesis import strategies as st

from models.formats import Knobs, formats
from verif.env import context
from verif.env.block import Block, holds, same
from verif.env.fields import Field

_LATENCY = 2
_COLOUR = Field.of("term_colour", formats(Knobs()).shade, 3)
MOST = _COLOUR.high
"""Of a channel of a term."""
_PART = 200
"""Clocks of the long run with one manner."""

Colour = tuple[int, ...]

_BLACK: Colour = (0, 0, 0)


@dataclass(frozen=True)
class More:
    """So much more work for the pixel of a slot."""

    slot: int
    count: int


@dataclass(frozen=True)
class Term:
    """A term of the pixel of a slot."""

    slot: int
    colour: Colour


@dataclass(frozen=True)
class Clock:
    """Inputs of one clock."""

    more: More | None = None
    term: Term | None = None


@dataclass(frozen=True)
class Pixel:
    """A pixel under way: pieces of work that are outstanding, and what its terms make so far."""

    work: int = 1
    colour: Colour = _BLACK


def _added(one: Colour, other: Colour) -> Colour:
    return tuple(min(left + right, MOST) for left, right in zip(one, other, strict=True))


def _word(colour: Colour) -> int:
    word = 0
    for lane in colour:
        word = word << _COLOUR.width | lane
    return word


class Pixels:
    """What the accumulator must know. A term is looked at before a `more` of the same clock."""

    def __init__(self, most_work: int) -> None:
        self._most_work = most_work
        self.found: dict[int, Pixel] = {}

    def legal(self, inputs: Clock) -> Clock:
        """The same with no more work than the counts hold, whatever becomes of a term of this clock."""
        more = inputs.more
        if more is None:
            return inputs
        most = self._most_work - self.found.get(more.slot, Pixel()).work
        return Clock(More(more.slot, min(more.count, most)), inputs.term)

    def clock(self, inputs: Clock) -> tuple[int, Colour] | None:
        """The end of a clock: slot and colour of the pixel that its term completes."""
        complete = None if inputs.term is None else self._end(inputs.term)
        if inputs.more is not None:
            pixel = self.found.get(inputs.more.slot, Pixel())
            self.found[inputs.more.slot] = Pixel(pixel.work + inputs.more.count, pixel.colour)
        return complete

    def _end(self, term: Term) -> tuple[int, Colour] | None:
        pixel = self.found.pop(term.slot, Pixel())
        colour = _added(pixel.colour, term.colour)
        if pixel.work == 1:
            return term.slot, colour
        self.found[term.slot] = Pixel(pixel.work - 1, colour)
        return None


class AccumulatorBench(Block):
    """Announces work, sends terms, and compares what comes out at every clock."""

    def __init__(self, dut: Any, parameters: Mapping[str, int]) -> None:
        super().__init__(
            dut,
            idle=("more_valid", "term_valid"),
            carried={"more_valid": ("more_slot", "more_count"), "term_valid": ("term_slot", "term_colour")},
        )
        self.set(more_slot=0, more_count=0, term_slot=0, term_colour=0)
        self.slots = parameters["SLOTS"]
        self.most_work = 1 << parameters["COUNT_W"]
        self._start()

    def _start(self) -> None:
        self.pixels = Pixels(self.most_work)
        self._to_come: deque[tuple[int, Colour] | None] = deque([None] * _LATENCY)
        self.complete = 0

    async def restart(self) -> None:
        """Reset, whatever is under way; ready comes when it must."""
        await self.reset()
        self._start()
        same("clocks before ready", self.slots, await self.until("ready", self.slots + 2) - 1)

    async def step(self, inputs: Clock = Clock()) -> None:
        """One clock, all outputs checked."""
        inputs = self.pixels.legal(inputs)
        self.set(more_valid=int(inputs.more is not None), term_valid=int(inputs.term is not None))
        if inputs.more is not None:
            self.set(more_slot=inputs.more.slot, more_count=inputs.more.count)
        if inputs.term is not None:
            self.set(term_slot=inputs.term.slot, term_colour=_word(inputs.term.colour))
        await self.clock()
        self._to_come.append(self.pixels.clock(inputs))
        self._check(self._to_come.popleft())

    def _check(self, expected: tuple[int, Colour] | None) -> None:
        same(f"ready at clock {self.now}", 1, self.read("ready"))
        same(f"out_valid at clock {self.now}", int(expected is not None), self.read("out_valid"))
        if expected is not None:
            slot, colour = expected
            self.complete += 1
            same(f"out_slot at clock {self.now}", slot, self.read("out_slot"))
            same(f"out_colour at clock {self.now}", hex(_word(colour)), hex(self.read("out_colour")))

    async def steps(self, clocks: Iterable[Clock]) -> None:
        """Clocks one after the other."""
        for inputs in clocks:
            await self.step(inputs)

    async def finish(self) -> None:
        """The terms that are outstanding come, a slot after the other, and every pixel is complete."""
        for slot in sorted(self.pixels.found):
            for number in range(self.pixels.found[slot].work):
                await self.step(Clock(term=Term(slot, (number, slot, 1))))
        await self.steps([Clock()] * (_LATENCY + 1))
        same("pixels under way in the end", {}, self.pixels.found)


def _slots(bench: AccumulatorBench) -> st.SearchStrategy[list[int]]:
    """Few, so that work and terms meet."""
    return st.lists(st.integers(0, bench.slots - 1), min_size=1, max_size=3)


def _clocks(bench: AccumulatorBench, slots: list[int]) -> st.SearchStrategy[list[Clock]]:
    """Clocks of these slots, with work enough that some pixels take long."""
    most = bench.most_work - 1
    lane = st.sampled_from([0, 1, MOST // 2, MOST // 2 + 1, MOST]) | st.integers(0, MOST)
    count = st.sampled_from([min(count, most) for count in (0, 1, 1, 2, 5, most)])
    slot = st.sampled_from(slots)
    more = st.none() | st.builds(More, slot, count)
    term = st.none() | st.builds(Term, slot, st.tuples(lane, lane, lane))
    return st.lists(st.builds(Clock, more, term), max_size=40)


async def _bench(dut: Any) -> tuple[AccumulatorBench, context.Context]:
    run = context.read()
    bench = AccumulatorBench(dut, run.parameters)
    await bench.restart()
    return bench, run


@cocotb.test()
async def a_pixel_is_complete_when_nothing_is_outstanding(dut: Any) -> None:
    """Drawn work and terms of few slots, in bursts and interleaved; then all that is outstanding."""
    bench, run = await _bench(dut)

    async def example(clocks: list[Clock]) -> None:
        await bench.restart()
        await bench.steps(clocks)
        await bench.finish()

    await holds(run, example, _slots(bench).flatmap(partial(_clocks, bench)))


@cocotb.test()
async def a_long_run_matches_the_dictionary(dut: Any) -> None:
    """Volume: seeded, by turns with one slot, few and all, with little work and much, dark and bright."""
    bench, run = await _bench(dut)
    generator = run.generator(0)
    for _ in range(max(1, run.operands // (4 * _PART))):
        slots = generator.choice(bench.slots, size=int(generator.choice([1, 2, bench.slots])), replace=False)
        most = int(generator.choice([1, 2, 3, bench.most_work]))
        dense_more, dense_term = generator.choice([0.2, 0.5, 1.0]), generator.choice([0.5, 0.9, 1.0])
        bright = int(generator.choice([MOST >> 9, MOST >> 2, MOST]))
        mores, terms = generator.random((2, _PART)) < [[dense_more], [dense_term]]
        counts = generator.integers(0, min(most, bench.most_work), size=_PART)
        more_slots, term_slots = generator.choice(slots, size=(2, _PART)).tolist()
        colours = generator.integers(0, bright, size=(_PART, 3), endpoint=True).tolist()
        for number in range(_PART):
            more = More(more_slots[number], int(counts[number])) if mores[number] else None
            term = Term(term_slots[number], tuple(colours[number])) if terms[number] else None
            await bench.step(Clock(more, term))
    await bench.finish()
    bench.log.info("%d pixels checked", bench.complete)


@cocotb.test()
async def reset_at_any_moment_forgets_every_pixel(dut: Any) -> None:
    """After it no pixel of before comes, and each slot begins anew."""
    bench, run = await _bench(dut)

    def both(slots: list[int]) -> st.SearchStrategy[tuple[list[Clock], list[Clock]]]:
        return st.tuples(_clocks(bench, slots), _clocks(bench, slots))

    async def example(clocks: tuple[list[Clock], list[Clock]], waits: int) -> None:
        before, after = clocks
        await bench.steps(before)
        await bench.reset()
        await bench.clocks(waits)
        await bench.restart()
        await bench.steps(after)
        await bench.finish()

    await holds(run, example, _slots(bench).flatmap(both), st.integers(0, bench.slots))


@cocotb.test()
async def a_slot_completes_a_pixel_in_every_clock(dut: Any) -> None:
    """One term a pixel: the same slot all the time, two by turns, every slot in order."""
    bench, _ = await _bench(dut)
    orders: list[Sequence[int]] = [(0,), (0, bench.slots - 1), (1, 1, 0), range(bench.slots)]
    for order in orders:
        before, pixels = bench.complete, 2 * bench.slots
        slots = islice(cycle(order), pixels)
        await bench.steps(
            Clock(term=Term(slot, (number, MOST - number, slot))) for number, slot in enumerate(slots)
        )
        await bench.steps([Clock()] * _LATENCY)
        same("pixels", pixels, bench.complete - before)


@cocotb.test()
async def a_pixel_of_the_most_work_takes_as_many_terms(dut: Any) -> None:
    """All that its counts hold, several times over, a term in every clock; one lane saturates in each."""
    bench, _ = await _bench(dut)
    bright = MOST // (bench.most_work - 1)
    for lane in range(3):
        before = bench.complete
        await bench.step(Clock(More(lane % bench.slots, bench.most_work - 1)))
        colour = tuple(bright if lane == other else 1 for other in range(3))
        await bench.steps([Clock(term=Term(lane % bench.slots, colour))] * (bench.most_work - 1))
        await bench.steps([Clock()] * _LATENCY)
        same("pixels before the last term", before, bench.complete)
        await bench.step(Clock(term=Term(lane % bench.slots, colour)))
        await bench.steps([Clock()] * _LATENCY)
        same("pixels after the last term", before + 1, bench.complete)


@cocotb.test()
async def the_counts_of_every_slot_wrap(dut: Any) -> None:
    """Each slot has a pixel of the most work, then one with which both of its counts begin anew."""
    bench, _ = await _bench(dut)
    most, before = bench.most_work - 1, bench.complete
    for slot in range(bench.slots):
        for work in (most, 1):
            await bench.step(Clock(More(slot, work)))
            await bench.steps([Clock(term=Term(slot, (1, slot, 0)))] * (work + 1))
    await bench.finish()
    same("pixels", 2 * bench.slots, bench.complete - before)
