"""Tests of the unpacker against a string of bits, at every clock."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import cocotb
from hypothesis import strategies as st

from verif.env import context
from verif.env.block import Block, holds, same

_WORD = 32
_MORE = 4


@dataclass(frozen=True)
class Clock:
    """What the reader wants in one clock, and whether the sender has its next word out."""

    width: int
    take: bool
    offer: bool


class UnpackBench(Block):
    """A sender of words, a reader of fields, and the bits between them."""

    def __init__(self, dut: Any, parameters: Mapping[str, int]) -> None:
        super().__init__(
            dut, idle=("in_valid", "field_take", "flush"), carried={"in_valid": ("in_data", "in_last")}
        )
        self.field_w = parameters["FIELD_W"]
        self._bits = ""
        self._ended = False
        self._words: list[int] = []
        self._offered = False
        self.fields = 0

    async def restart(self) -> None:
        """Reset, in the middle of a frame or not."""
        self.set(field_width=1, in_data=0, in_last=0)
        await self.reset()
        self._forget()

    def _forget(self) -> None:
        self._bits, self._ended, self._words, self._offered, self.fields = "", False, [], False, 0

    def begin(self, words: Sequence[int]) -> None:
        """The words of the next frame, which the sender has."""
        self._words = list(words)

    async def step(self, wanted: Clock) -> None:
        """One clock: all outputs are those of the bits that are there; words stay on offer until taken."""
        self._offered = bool(self._words) and (self._offered or wanted.offer)
        valid = len(self._bits) >= wanted.width
        take = wanted.take and valid
        word = self._words[0] if self._offered else 0x5A5A_5A5A
        await self.clock(
            in_valid=int(self._offered),
            in_data=word,
            in_last=int(len(self._words) == 1),
            field_width=wanted.width,
            field_take=int(take),
        )
        same(
            f"field_valid of {wanted.width} of {len(self._bits)} bits", valid, bool(self.read("field_valid"))
        )
        if valid:
            same(
                f"{wanted.width} bits of {self._bits}", int(self._bits[: wanted.width], 2), self.read("field")
            )
        same("lacking", self._ended and not valid, bool(self.read("lacking")))
        same("ended", self._ended, bool(self.read("ended")))
        same(
            f"surplus with {len(self._bits)} bits left", len(self._bits) >= _WORD, bool(self.read("surplus"))
        )
        pushed = bool(self.read("in_ready"))
        left = len(self._bits) - (wanted.width if take else 0)
        same(f"room for a word beside {left} bits", not self._ended and left <= _WORD, pushed)
        if take:
            self._bits = self._bits[wanted.width :]
            self.fields += 1
        if pushed and self._offered:
            self._bits += f"{self._words.pop(0):0{_WORD}b}"
            self._ended, self._offered = not self._words, False

    async def finish(self) -> None:
        """What is left of the frame is sent, and forgotten with a flush."""
        for _ in range(4 * len(self._words) + _MORE):
            if self._ended:
                break
            await self.step(Clock(self.field_w, take=True, offer=True))
        same("ended", True, self._ended)
        await self.clock(in_valid=0, field_take=0, flush=1)
        self.set(flush=0)
        self._forget()


def _frames() -> st.SearchStrategy[list[int]]:
    word = st.sampled_from([0, (1 << _WORD) - 1]) | st.integers(0, (1 << _WORD) - 1)
    return st.integers(1, 8).flatmap(lambda size: st.lists(word, min_size=size, max_size=size))


def _clocks(bench: UnpackBench) -> st.SearchStrategy[list[Clock]]:
    width = st.sampled_from([1, bench.field_w]) | st.integers(1, bench.field_w)
    return st.lists(st.builds(Clock, width, st.booleans(), st.booleans()), max_size=40)


@cocotb.test()
async def fields_are_the_bits_of_the_words_in_order(dut: Any) -> None:
    """Drawn words, widths, takes and idle clocks; two frames with a flush between them."""
    run = context.read()
    bench = UnpackBench(dut, run.parameters)
    await bench.restart()

    async def example(first: list[int], then: list[Clock], second: list[int], after: list[Clock]) -> None:
        await bench.restart()
        for words, clocks in ((first, then), (second, after)):
            bench.begin(words)
            for wanted in clocks:
                await bench.step(wanted)
            await bench.finish()

    await holds(run, example, _frames(), _clocks(bench), _frames(), _clocks(bench))


@cocotb.test()
async def reset_in_the_middle_of_a_frame_forgets_it(dut: Any) -> None:
    """Its bits, and that it had ended."""
    run = context.read()
    bench = UnpackBench(dut, run.parameters)
    await bench.restart()

    async def example(first: list[int], then: list[Clock], second: list[int], after: list[Clock]) -> None:
        await bench.restart()
        bench.begin(first)
        for wanted in then:
            await bench.step(wanted)
        await bench.restart()
        bench.begin(second)
        for wanted in after:
            await bench.step(wanted)
        await bench.finish()

    await holds(run, example, _frames(), _clocks(bench), _frames(), _clocks(bench))


@cocotb.test()
async def rate_is_one_field_a_clock_where_words_come_fast_enough(dut: Any) -> None:
    """Every width, for 60 clocks: after the first word there is a field in each."""
    run = context.read()
    bench = UnpackBench(dut, run.parameters)
    generator = run.generator(0)
    clocks = 60
    for width in range(1, bench.field_w + 1):
        await bench.restart()
        bench.begin([int(word) for word in generator.integers(0, 1 << _WORD, 2 * clocks)])
        await bench.step(Clock(width, take=True, offer=True))
        for _ in range(clocks):
            await bench.step(Clock(width, take=True, offer=True))
        same(f"fields of {width} bits in {clocks} clocks", clocks, bench.fields)
