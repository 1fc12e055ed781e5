"""What the benches of the shader's two ends share: steps in, and what comes of each a fixed time later.

A wrapper in the unit's folder has all of a step in the port `in`, valid on top, and all that comes in a clock
in the port `out`, where everything that no valid goes with is 0. So a whole clock is one number.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.random import Generator

from models.fixed import Format, Raw
from models.header import selected
from verif.env import unknowns, vectors
from verif.env.block import Block
from verif.env.coverage.points import Samples
from verif.env.coverage.sampling import clock_number
from verif.env.fields import Field, Operands, bit, describe_all, join, split
from verif.env.pipelined import Mismatch
from verif.env.unit import Parameters


@dataclass(frozen=True)
class Materials:
    """What the table of materials holds, by object number: (3, objects) each, ambient in `shade`, the rest in
    `coeff`."""

    ambient: Raw
    diffuse: Raw
    specular: Raw
    reflection: Raw
    transparency: Raw

    def rows(self, p: Parameters) -> list[int]:
        """The rows of the table, see object_setup."""
        fmts = selected(p)
        coefficients = ("diffuse", "specular", "reflection", "transparency")
        fields = [Field.of(name, fmts.coeff, lanes=3) for name in coefficients]
        return join((Field.of("ambient", fmts.shade, lanes=3), *fields), vars(self))


def colours(generator: Generator, size: int, fmt: Format) -> Raw:
    """Colours (3, n): none, usual ones, full, tiny, so large that products saturate."""
    usual = generator.integers(0, fmt.one, (3, size), endpoint=True)
    large = generator.integers(0, fmt.max, (3, size), endpoint=True)
    ends = generator.choice([0, 1, fmt.one, fmt.max], (3, size))
    tiny = usual >> generator.integers(1, fmt.frac_bits, size)
    return vectors.pick(generator, np.zeros_like(usual), usual, usual, ends, tiny, large)


class ShadingBench(Block):
    """Drives steps and compares what comes at every clock. latency: from a step to all that comes of it."""

    def __init__(
        self, dut: Any, p: Parameters, inputs: Sequence[Field], outputs: Sequence[Field], latency: int
    ):
        super().__init__(
            dut, idle=("in", "table_valid"), carried={"table_valid": ("table_index", "table_material")}
        )
        self.set(table_index=0, table_material=0)
        self.parameters, self.latency = p, latency
        self._inputs, self._outputs = tuple(inputs), tuple(outputs)
        self._bits = 1 + sum(field.bits for field in inputs)
        self._seen: list[int] = []
        self._flying = 0

    async def restart(self) -> None:
        """Reset for one clock, whatever is in flight."""
        self.covered("reset.busy" if self._flying > 0 else "reset.idle")
        await self.reset(cycles=1)
        self._flying = 0
        self._seen.clear()

    async def load(self, materials: Materials, settings: Mapping[str, int]) -> None:
        """A frame's table, and all else that holds still; nothing is in flight."""
        for index, row in enumerate(materials.rows(self.parameters)):
            await self._tick(table_valid=1, table_index=index, table_material=row)
        self.set(table_valid=0, **settings)

    async def _tick(self, word: int = 0, **inputs: int) -> None:
        self.set(**{"in": word or unknowns.idle(0, self._bits)})
        self._flying = self.latency if word else self._flying - 1
        await self.clock(**inputs)
        self._seen.append(self.read("out"))

    async def drive(self, steps: Operands, gaps: Sequence[int] = ()) -> list[int]:
        """One step a clock, ``gaps[i % len(gaps)]`` idle clocks before step i; numbers of their clocks."""
        number = next(iter(steps.values())).shape[-1]
        valid = np.ones(number, dtype=np.int64)
        clocks = []
        for index, word in enumerate(join((bit("valid"), *self._inputs), {"valid": valid, **steps})):
            for _ in range(gaps[index % len(gaps)] if gaps else 0):
                await self._tick()
            clocks.append(len(self._seen))
            await self._tick(word)
        return clocks

    async def drain(self) -> None:
        """Until all must have come, and then some."""
        for _ in range(self.latency + 4):
            await self._tick()

    async def run(self, steps: Operands, expected: Operands, gaps: Sequence[int] = ()) -> Operands:
        """Steps, and what came of each, all checked. Nothing is in flight before and after."""
        clocks = await self.drive(steps, gaps)
        await self.drain()
        due = [clock + self.latency for clock in clocks]
        self._check(steps, dict(zip(due, join(self._outputs, expected), strict=True)))
        got = [self._seen[clock] for clock in due]
        self._seen.clear()
        return split(self._outputs, got)

    def saw(self, samples: Samples) -> None:
        """Steps and what came of them, for the unit's cover points."""
        if self.signals is not None:
            self.signals.collector.add(samples, clock_number())

    async def nothing_comes(self) -> None:
        """Where nothing has been driven since the last reset."""
        await self.drain()
        self._check({}, {})
        self._seen.clear()

    def _check(self, steps: Operands, expected: Mapping[int, int]) -> None:
        """Every clock that was seen; those that are not expected show nothing."""
        order = {clock: index for index, clock in enumerate(expected)}
        for clock, got in enumerate(self._seen):
            if got == expected.get(clock, 0):
                continue
            shown = describe_all(self._outputs, split(self._outputs, [got]), 0)
            if clock not in expected:
                raise Mismatch(f"clock {clock}, where nothing is due:\n{shown}")
            wanted = split(self._outputs, [expected[clock]])
            found = split(self._outputs, [got])
            wrong = [port.name for port in self._outputs if (wanted[port.name] != found[port.name]).any()]
            given = describe_all(self._inputs, steps, order[clock])
            expectation = describe_all(self._outputs, wanted, 0)
            raise Mismatch(f"wrong {', '.join(wrong)}:\n{given}\nexpected\n{expectation}\ngot\n{shown}")
