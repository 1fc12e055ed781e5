"""Tests of the steps of a hit against a model, at every clock; no step begins without room for its end."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from typing import Any

import cocotb
from hypothesis import strategies as st

from models.latency import LATENCY
from verif.env import context
from verif.env.block import Block, holds, same
from verif.env.pipelined import Mismatch

_MOST_BACK = 2
_PART = 200
"""Clocks of the long run with one number of lights and one manner."""


@dataclass(frozen=True)
class Hit:
    """A hit, or a miss; branching: it may have two children."""

    item: int
    hit: bool
    branching: bool

    def steps(self, lights: int) -> int:
        """How many it takes: one a light, one a child that is to be sent, one at least; a miss one."""
        return max(lights, 1 + self.branching, 1) if self.hit else 1


@dataclass(frozen=True)
class Clock:
    """Inputs of one clock: the hit that is offered, if any, and how many places are given back, if taken."""

    offer: Hit | None
    direct_back: int = 0
    shadow_back: int = 0


class Model:
    """The hit at hand, and the places that its steps have taken."""

    def __init__(self, room: int) -> None:
        self._room = room
        self.hit: Hit | None = None
        self._step = self._steps = 0
        self.taken = {"direct": 0, "shadow": 0}

    def may_give_back(self, kind: str, most: int) -> int:
        """No more places than have been taken."""
        return min(most, self.taken[kind])

    @property
    def step(self) -> tuple[int, int] | None:
        """The step of this clock, if there is one: its number, and that of its hit's last."""
        if self.hit is None or max(self.taken.values()) >= self._room:
            return None
        return self._step, self._steps - 1

    @property
    def ready(self) -> bool:
        """Whether a hit is taken in this clock: none is at hand, or the last step of it goes."""
        return self.hit is None or self.step == (self._steps - 1, self._steps - 1)

    def clock(self, lights: int, offer: Hit | None, back: Mapping[str, int]) -> None:
        """The end of a clock."""
        stepped, ready = self.step is not None, self.ready
        for kind, places in back.items():
            self.taken[kind] += stepped - places
        self._step += stepped
        if ready:
            self.hit, self._step = offer, 0
            self._steps = 0 if offer is None else offer.steps(lights)


class StepsBench(Block):
    """Offers hits until they are taken, gives places back, and compares all outputs at every clock."""

    def __init__(self, dut: Any, parameters: Mapping[str, int]) -> None:
        super().__init__(
            dut,
            idle=("in_valid", "direct_back", "shadow_back"),
            carried={"in_valid": ("in_item", "in_hit", "in_branching")},
        )
        self.set(in_item=0, in_hit=0, in_branching=0, lights=0)
        self.parameters = parameters
        self._mask = (1 << parameters["ITEM_W"]) - 1
        self.most_lights = (1 << parameters["LIGHT_W"]) - 1
        self.room = parameters["ROOM"]
        self.lights = 0
        self._offered: Hit | None = None
        self.model = Model(self.room)
        self.given = self.steps = self.owed = 0

    async def restart(self, lights: int = 0) -> None:
        """Reset for one clock, whatever is at hand; and the number of lights of the frame."""
        self._offered = None
        self.light(lights)
        await self.reset(cycles=1)
        self.model = Model(self.room)
        self.given = self.steps = self.owed = 0

    def light(self, lights: int) -> None:
        """Another frame has so many lights; no hit is at hand."""
        self.lights = lights
        self.set(lights=lights)

    async def step(self, inputs: Clock) -> None:
        """One clock, all outputs checked. A hit that is offered stays until it is taken."""
        if self._offered is None and inputs.offer is not None:
            self._offered = Hit(inputs.offer.item & self._mask, inputs.offer.hit, inputs.offer.branching)
        offer = self._offered
        self.set(in_valid=int(offer is not None))
        if offer is not None:
            self.set(in_item=offer.item, in_hit=int(offer.hit), in_branching=int(offer.branching))
        wanted = {"direct": inputs.direct_back, "shadow": inputs.shadow_back}
        back = {kind: self.model.may_give_back(kind, most) for kind, most in wanted.items()}
        await self.clock(**{f"{kind}_back": places for kind, places in back.items()})
        self._check()
        if offer is not None and self.model.ready:
            self.given += 1
            self.owed += offer.steps(self.lights)
            self._offered = None
        self.model.clock(self.lights, offer, back)
        if max(self.model.taken.values()) > self.room:
            raise Mismatch(f"clock {self.now}: {self.model.taken} places are taken, of {self.room}")

    def _check(self) -> None:
        now, step = f"at clock {self.now}", self.model.step
        same(f"in_ready {now}", int(self.model.ready), self.read("in_ready"))
        same(f"out_valid {now}", int(step is not None), self.read("out_valid"))
        if step is not None and self.model.hit is not None:
            self.steps += 1
            same(f"out_step, out_more {now}", step, (self.read("out_step"), self.read("out_more")))
            same(f"out_item {now}", self.model.hit.item, self.read("out_item"))

    async def play(self, clocks: Iterable[Clock]) -> None:
        """Clocks one after the other."""
        for inputs in clocks:
            await self.step(inputs)

    async def drain(self) -> None:
        """Every hit that was offered takes its steps, while all places come back."""
        while self._offered is not None or self.model.hit is not None or any(self.model.taken.values()):
            await self.step(Clock(None, _MOST_BACK, _MOST_BACK))
        await self.step(Clock(None))
        same("steps", self.owed, self.steps)

    async def fill(self) -> None:
        """Hits of one step while no place comes back: as many steps as there are places, all of them free."""
        self.light(1)
        steps = self.steps
        await self.play([Clock(Hit(1, True, False))] * (2 * self.room + 4))
        same("steps without a place given back", self.room, self.steps - steps)

    async def hits(self, hits: Sequence[Hit]) -> int:
        """Hits without a gap, while all places come back; the clocks from the first until its last step."""
        start = self.now
        for hit in hits:
            given = self.given
            while self.given == given:
                await self.step(Clock(hit, _MOST_BACK, _MOST_BACK))
        while self.model.hit is not None:
            await self.step(Clock(None, _MOST_BACK, _MOST_BACK))
        return self.now - start


def _clocks(bench: StepsBench) -> st.SearchStrategy[list[Clock]]:
    hit = st.builds(Hit, st.integers(0, (1 << 64) - 1), st.booleans(), st.booleans())
    back = st.integers(0, _MOST_BACK)
    clock = st.builds(Clock, st.none() | hit, back, back)
    return st.lists(clock, max_size=50)


def _lights(bench: StepsBench) -> st.SearchStrategy[int]:
    return st.integers(0, bench.most_lights)


async def _bench(dut: Any) -> tuple[StepsBench, context.Context]:
    run = context.read()
    bench = StepsBench(dut, run.parameters)
    await bench.restart()
    return bench, run


@cocotb.test()
async def a_hit_takes_its_steps_and_each_has_room(dut: Any) -> None:
    """Drawn hits, gaps, and places that come back late, one kind or the other."""
    bench, run = await _bench(dut)

    async def example(lights: int, clocks: list[Clock]) -> None:
        await bench.restart(lights)
        await bench.play(clocks)
        await bench.drain()

    await holds(run, example, _lights(bench), _clocks(bench))


@cocotb.test()
async def a_long_run_never_takes_a_place_that_is_not_there(dut: Any) -> None:
    """Volume: seeded, with hits and places that come back fast and slowly by turns, one kind scarce."""
    bench, run = await _bench(dut)
    generator = run.generator(0)
    for _ in range(max(2, run.operands // (5 * _PART))):
        bench.light(int(generator.integers(0, bench.most_lights, endpoint=True)))
        offers = generator.random(_PART) < generator.choice([0.1, 0.5, 1.0])
        kinds = (generator.random((2, _PART)) < 0.7).tolist()
        items = generator.integers(0, 1 << 63, _PART).tolist()
        rates = generator.choice([0.0, 0.2, 0.5, 1.0], (2, 1))
        backs = generator.integers(0, _MOST_BACK, (2, _PART), endpoint=True)
        backs = (backs * (generator.random((2, _PART)) < rates)).tolist()
        for number in range(_PART):
            hit = Hit(items[number], kinds[0][number], kinds[1][number]) if offers[number] else None
            await bench.step(Clock(hit, backs[0][number], backs[1][number]))
        await bench.drain()
    bench.log.info("%d steps checked", bench.steps)
    await bench.fill()


@cocotb.test()
async def the_number_of_steps_is_that_of_lights_or_children(dut: Any) -> None:
    """Every number of lights, hits and misses, with two children and without: counted."""
    bench, _ = await _bench(dut)
    for lights in range(bench.most_lights + 1):
        for hit, branching in product((False, True), repeat=2):
            await bench.restart(lights)
            await bench.hits([Hit(lights, hit, branching)])
            at_least = 2 if branching else 1
            same(
                f"steps with {lights} lights, hit {hit}, branching {branching}",
                max(lights, at_least) if hit else 1,
                bench.steps,
            )


@cocotb.test()
async def rate_is_one_step_a_clock(dut: Any) -> None:
    """Hits of all kinds without a gap: the first step one clock behind the first hit, then one a clock."""
    bench, _ = await _bench(dut)
    # A place comes back a clock behind its step at the earliest, two steps later: two places are enough.
    for lights in range(bench.most_lights + 1):
        await bench.restart(lights)
        kinds = list(product((False, True), repeat=2)) * 5
        clocks = await bench.hits([Hit(number, *kind) for number, kind in enumerate(kinds)])
        same("clocks", LATENCY["steps"](bench.parameters) + bench.steps, clocks)


@cocotb.test()
async def no_step_begins_without_a_place_of_either_kind(dut: Any) -> None:
    """As many steps as places; then one more only where both kinds have come back."""
    bench, _ = await _bench(dut)
    hit = Hit(1, True, False)
    for number, one in enumerate([Clock(hit, 1, 0), Clock(hit, 0, 1)]):
        await bench.restart()
        await bench.fill()
        await bench.play([one, one, Clock(hit), Clock(hit), Clock(hit)])
        same(f"steps with places of kind {number} alone", bench.room, bench.steps)
        await bench.play([Clock(hit, one.shadow_back, one.direct_back), Clock(hit), Clock(hit)])
        same("steps with a place more of both", bench.room + 1, bench.steps)
        await bench.drain()


@cocotb.test()
async def reset_at_any_moment_forgets_the_hit_and_frees_all_places(dut: Any) -> None:
    """No step of before comes; all places are there again."""
    bench, run = await _bench(dut)

    async def example(lights: int, before: list[Clock], others: int, after: list[Clock]) -> None:
        await bench.restart(lights)
        await bench.play([*before, Clock(Hit(0, True, True))])
        await bench.restart(others)
        await bench.play([Clock(None)] * 2)
        await bench.play(after)
        await bench.drain()

    await holds(run, example, _lights(bench), _clocks(bench), _lights(bench), _clocks(bench), cost=2)
