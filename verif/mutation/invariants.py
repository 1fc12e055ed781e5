"""States that a design never reaches after reset: clauses over the registers that reset sets, proven by
induction.

A simulation of random inputs, many at once, says which clauses may hold; those that the solver cannot carry
from one clock to the next are dropped until all the others can be (Houdini's algorithm). Inputs are free, so
what is left holds whatever a user does.
"""

import itertools
import random
from collections.abc import Iterable, Iterator

from verif.mutation.aig import FALSE, TRUE, Design, Graph, Run
from verif.mutation.netlist import SELECT
from verif.mutation.sat import Answer, any_of

Clause = tuple[int, ...]
"""Literals of the design's latches, of which one is always true."""

_ALL, _TRIPLES, _PAIRS = 8, 22, 72
"""Registers up to which clauses of all of them, of three, of two are tried."""

_LANES, _CLOCKS, _SEED = 256, 160, 1
_ROUNDS = 80


def find(design: Design, seconds: float) -> tuple[Clause, ...]:
    """Clauses that always hold after reset; none where there are too many registers. seconds: a question."""
    after_reset = _after_reset(design)
    if not 0 < len(after_reset) <= _PAIRS:
        return ()
    return _inductive(design, list(_candidates(design, after_reset)), seconds)


def _free(graph: Graph, known: dict[int, int], key: int) -> int:
    if key not in known:
        known[key] = graph.leaf()
    return known[key]


def _run(design: Design, graph: Graph, states: dict[int, int], reset: bool) -> Run:
    inputs: dict[int, int] = {}

    def given(position: int, _: int) -> int:
        port = design.inputs[position][0]
        if port == SELECT:
            return FALSE
        return TRUE if reset and port == "rst" else _free(graph, inputs, position)

    return Run(design, graph, given, lambda latch: _free(graph, states, latch))


def _after_reset(design: Design) -> dict[int, bool]:
    """Latches that reset sets, whatever the state and inputs, to what it sets them."""
    run = _run(design, Graph(), {}, reset=True)
    latches = range(design.first_latch, design.first_gate)
    values = {latch: run.after(latch, 0) for latch in latches}
    return {latch: value == TRUE for latch, value in values.items() if value in (FALSE, TRUE)}


def _simulated(design: Design, after_reset: dict[int, bool]) -> Iterator[list[int]]:
    """Words of all variables, a lane a bit, clock by clock."""
    generator, mask = random.Random(_SEED), (1 << _LANES) - 1
    words = [0] * (design.first_gate + len(design.gates))
    for latch in range(design.first_latch, design.first_gate):
        known = after_reset.get(latch)
        words[latch] = generator.getrandbits(_LANES) if known is None else mask * known
    for _ in range(_CLOCKS):
        for position, (port, _bit) in enumerate(design.inputs):
            word = generator.getrandbits(_LANES)
            rare = word & generator.getrandbits(_LANES) & generator.getrandbits(_LANES)
            # A third of the lanes each: rare ones, even, rare zeros; reset hardly ever.
            third = _LANES // 3
            low, high = (1 << third) - 1, ((1 << third) - 1) << third
            mixed = (rare & low) | (word & high) | ((mask ^ rare) & (mask ^ low ^ high))
            words[position + 1] = {SELECT: 0, "rst": rare & generator.getrandbits(_LANES) & rare >> 7}.get(
                port, mixed
            )
        for gate, (left, right) in enumerate(design.gates, design.first_gate):
            first = words[left >> 1] ^ (mask if left & 1 else 0)
            words[gate] = first & (words[right >> 1] ^ (mask if right & 1 else 0))
        yield words
        after = [words[literal >> 1] ^ (mask if literal & 1 else 0) for literal in design.next]
        words[design.first_latch : design.first_gate] = after


def _candidates(design: Design, after_reset: dict[int, bool]) -> Iterator[Clause]:
    """Clauses that no simulated state breaks."""
    latches = sorted(after_reset)
    size = len(latches) if len(latches) <= _ALL else 3 if len(latches) <= _TRIPLES else 2
    history = dict.fromkeys(latches, 0)
    for clock, words in enumerate(_simulated(design, after_reset)):
        for latch in latches:
            history[latch] |= words[latch] << (clock * _LANES)
    whole = (1 << (_LANES * _CLOCKS)) - 1
    for chosen in itertools.combinations(latches, size):
        for inverted in itertools.product((0, 1), repeat=size):
            broken = whole
            for latch, bit in zip(chosen, inverted, strict=True):
                # A literal is false where the latch is its inversion.
                broken &= history[latch] if bit else whole ^ history[latch]
                if not broken:
                    break
            if not broken:
                yield tuple(2 * latch + bit for latch, bit in zip(chosen, inverted, strict=True))


def _inductive(design: Design, clauses: list[Clause], seconds: float) -> tuple[Clause, ...]:
    for _ in range(_ROUNDS):
        graph, states = Graph(), dict[int, int]()
        run = _run(design, graph, states, reset=False)
        before = [clause_literal(graph, clause, states) for clause in clauses]
        latches = {literal >> 1 for clause in clauses for literal in clause}
        next_states = {latch: run.after(latch, 0) for latch in latches}
        broken = [clause_literal(graph, clause, next_states) ^ 1 for clause in clauses]
        solution = any_of(graph, broken, seconds, before)
        if solution.answer is Answer.NO:
            return tuple(clauses)
        if solution.answer is Answer.UNKNOWN:
            return ()
        clauses = [clause for clause, it in zip(clauses, broken, strict=True) if not solution.holds(it)]
    return ()


def clause_literal(graph: Graph, clause: Iterable[int], states: dict[int, int]) -> int:
    """The graph's literal of a clause, where the latches have these literals; new leaves where they have
    none."""
    none: int = TRUE
    for literal in clause:
        none = graph.both(none, _free(graph, states, literal >> 1) ^ (literal & 1) ^ 1)
    return none ^ 1
