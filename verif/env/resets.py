"""Reset at every clock of a reference run, and so in every state: what runs behind it is exact.

    await resets.at_every_clock(bench.log, Reference(start, step, clocks, behind), dut.state_reg, "control.v")

Draws find such clocks now and then; this finds all of them, and says so where a state is never left by reset.
"""

import re
from collections.abc import Awaitable, Callable, Sequence
from dataclasses import dataclass
from logging import Logger
from typing import Any

import cocotb

from verif.env import sources
from verif.env.pipelined import Mismatch

_STATE = re.compile(r"localparam \[\d+:0\] (S_\w+) = (?:\d+'d(\d+)|`(RT_\w+));")
_HEADER = re.compile(r"`define (RT_\w+) (?:\d+'d)?(\d+)\s")


@dataclass(frozen=True)
class Reference:
    """A run that goes through every state, and the same each time.

    start: resets and begins it; step: one clock of it, ``clocks`` in all; behind: resets, wherever the run
    is, and holds the next run to its model.
    """

    start: Callable[[], Awaitable[object]]
    step: Callable[[], Awaitable[object]]
    clocks: int
    behind: Callable[[], Awaitable[object]]


def states(file: str) -> dict[int, str]:
    """States of a module by number: its local parameters S_*. file: relative to `hdl/`."""
    header = dict(_HEADER.findall("".join(path.read_text() for path in sources.headers())))
    found = _STATE.findall((sources.HDL / file).read_text())
    return {int(number or header[macro]): name for name, number, macro in found}


def edges(trace: Sequence[object]) -> list[int]:
    """Where something begins or ends in a trace."""
    last = len(trace) - 1
    inside = range(1, last)
    return [0, *(n for n in inside if trace[n] != trace[n - 1] or trace[n] != trace[n + 1]), last]


async def at_every_clock(
    log: Logger, run: Reference, register: Any, file: str, unreachable: Sequence[str] = ()
) -> None:
    """Resets at each clock of a run; on Icarus, which is slow, where the state has changed or will.

    Mismatch where a state of the module in ``file`` is never seen in ``register`` at such a clock, or one
    that is said to be unreachable is.
    """
    names = states(file)
    await run.start()
    trace: list[int] = []
    for _ in range(run.clocks):
        await run.step()
        trace.append(int(register.value))
    await run.behind()
    slow = "icarus" in cocotb.SIM_NAME.lower()
    moments = edges(trace) if slow else range(run.clocks)
    await _reset_at(moments, run, [names[state] for state in trace])
    never = set(names.values()) - {names[trace[moment]] for moment in moments}
    if never != set(unreachable):
        raise Mismatch(f"never reset in {', '.join(never) or 'no state'}; unreachable: {unreachable}")
    log.info("reset at %d clocks, in all %d states", len(moments), len(names) - len(never))


async def _reset_at(moments: Sequence[int], run: Reference, trace: Sequence[str]) -> None:
    for moment in moments:
        await run.start()
        for _ in range(moment + 1):
            await run.step()
        try:
            await run.behind()
        except AssertionError as error:
            error.add_note(f"behind a reset {moment + 1} clocks after the start, in {trace[moment]}")
            raise


async def in_each_state(run: Reference, register: Any) -> None:
    """Resets once in each state that a run goes through, in the first clock of it; for coverage, which counts
    states and not clocks.
    """
    await run.start()
    first: dict[int, int] = {}
    for clock in range(run.clocks):
        await run.step()
        first.setdefault(int(register.value), clock)
    await run.behind()
    for clock in first.values():
        await run.start()
        for _ in range(clock):
            await run.step()
        await run.behind()
