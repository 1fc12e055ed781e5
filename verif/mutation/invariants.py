"""States that a design never reaches after reset: clauses over the registers that reset sets, proven by
induction.

A simulation of random inputs, many at once, says which clauses may hold; those that the solver cannot carry
from one clock to the next are dropped until all the others can be (Houdini's algorithm). Inputs are free, so
what is left holds whatever a user does.
"""

import itertools
import random
from collections.abc import Iterable, Iterator, Mapping, Sequence
from types import MappingProxyType
from typing import TypeVar

from verif.mutation.aig import FALSE, TRUE, Design, Graph, Run
from verif.mutation.netlist import SELECT
from verif.mutation.sat import Answer, any_of

Clause = tuple[int, ...]
"""Literals of the design's latches, of which one is always true."""

_ALL, _TRIPLES, _PAIRS = 8, 22, 72
"""Registers up to which clauses of all of them, of three, of two are tried."""

_MOST = 200
"""Registers and pairs up to which more is tried than the bits of each register by itself."""

_GATES = 200_000
"""Gates up to which anything is tried."""

_CONDITIONAL = 4_000
"""Clauses about pairs while a third register has some value, at most."""

_RESET_CLOCKS = 2
_Key = TypeVar("_Key")

_LANES, _CLOCKS, _SEED = 256, 160, 1
_ROUNDS = 80


def find(
    design: Design, seconds: int, copies: Mapping[int, int] = MappingProxyType({})
) -> tuple[Clause, ...]:
    """Clauses that always hold after reset; none where the design is too large. seconds: a question.

    copies: pairs of latches that begin alike, before reset: that they stay so is tried too, always or
    while a third one has some value.
    """
    after_reset = _after_reset(design)
    if len(after_reset) + len(copies) > _MOST:
        few = {latch for word in _few(design, after_reset) for latch in word}
        after_reset, copies = {latch: after_reset[latch] for latch in sorted(few)}, {}
    if not after_reset or len(design.gates) > _GATES:
        return ()
    clauses = list(_candidates(design, after_reset, copies))
    while clauses:
        kept = _true_after_reset(design, clauses, seconds, copies)
        if kept == clauses:
            return _inductive(design, clauses, seconds)
        clauses = kept
    return ()


def _free(graph: Graph, known: dict[_Key, int], key: _Key) -> int:
    if key not in known:
        known[key] = graph.leaf()
    return known[key]


def _run(design: Design, graph: Graph, states: dict[int, int], reset: bool, copies: Mapping[int, int]) -> Run:
    inputs: dict[tuple[int, int], int] = {}

    def given(position: int, clock: int) -> int:
        port = design.inputs[position][0]
        if port == SELECT:
            return FALSE
        return TRUE if reset and port in design.begun else _free(graph, inputs, (position, clock))

    return Run(design, graph, given, lambda latch: _free(graph, states, copies.get(latch, latch)))


def _true_after_reset(
    design: Design, clauses: list[Clause], seconds: int, copies: Mapping[int, int]
) -> list[Clause]:
    """Those that reset makes true; none where the solver cannot say."""
    graph = Graph()
    run = _run(design, graph, {}, True, copies)
    latches = {literal >> 1 for clause in clauses for literal in clause}
    states = {latch: run.literal(2 * latch, _RESET_CLOCKS) for latch in latches}
    broken = [clause_literal(graph, clause, states) ^ 1 for clause in clauses]
    solution = any_of(graph, broken, seconds)
    if solution.answer is Answer.YES:
        return [clause for clause, it in zip(clauses, broken, strict=True) if not solution.holds(it)]
    return clauses if solution.answer is Answer.NO else []


def _after_reset(design: Design) -> dict[int, bool]:
    """Latches that reset sets, whatever the state and inputs, to what it sets them."""
    run = _run(design, Graph(), {}, True, {})
    latches = range(design.first_latch, design.first_gate)
    values = {latch: run.after(latch, 0) for latch in latches}
    return {latch: value == TRUE for latch, value in values.items() if value in (FALSE, TRUE)}


def _simulated(
    design: Design, after_reset: dict[int, bool], copies: Mapping[int, int]
) -> Iterator[list[int]]:
    """Words of all variables, a lane a bit, clock by clock."""
    generator, mask = random.Random(_SEED), (1 << _LANES) - 1
    words = [0] * (design.first_gate + len(design.gates))
    for latch in range(design.first_latch, design.first_gate):
        known = after_reset.get(latch)
        words[latch] = generator.getrandbits(_LANES) if known is None else mask * known
    for copy, latch in copies.items():
        if copy not in after_reset:
            words[copy] = words[latch]
    resets = design.begun - design.clocks
    for _ in range(_CLOCKS):
        for position, (port, _bit) in enumerate(design.inputs):
            word = generator.getrandbits(_LANES)
            rare = word & generator.getrandbits(_LANES) & generator.getrandbits(_LANES)
            # A third of the lanes each: rare ones, even, rare zeros; reset hardly ever.
            third = _LANES // 3
            low, high = (1 << third) - 1, ((1 << third) - 1) << third
            mixed = (rare & low) | (word & high) | ((mask ^ rare) & (mask ^ low ^ high))
            if port in resets:
                mixed = rare & generator.getrandbits(_LANES) & rare >> 7
            words[position + 1] = 0 if port == SELECT else mixed
        for gate, (left, right) in enumerate(design.gates, design.first_gate):
            first = words[left >> 1] ^ (mask if left & 1 else 0)
            words[gate] = first & (words[right >> 1] ^ (mask if right & 1 else 0))
        yield words
        after = [words[literal >> 1] ^ (mask if literal & 1 else 0) for literal in design.next]
        words[design.first_latch : design.first_gate] = after


def _candidates(design: Design, after_reset: dict[int, bool], copies: Mapping[int, int]) -> Iterator[Clause]:
    """Clauses that no simulated state breaks."""
    latches = sorted(after_reset)
    history = dict.fromkeys([*latches, *copies, *copies.values()], 0)
    for clock, words in enumerate(_simulated(design, after_reset, copies)):
        for latch in history:
            history[latch] |= words[latch] << (clock * _LANES)
    whole = (1 << (_LANES * _CLOCKS)) - 1

    def possible(clause: Clause) -> bool:
        broken = whole
        for literal in clause:
            # A literal is false where the latch is its inversion.
            seen = history[literal >> 1]
            broken &= seen if literal & 1 else whole ^ seen
        return not broken

    tried: dict[Clause, None] = {}
    if len(latches) <= _PAIRS:
        size = len(latches) if len(latches) <= _ALL else 3 if len(latches) <= _TRIPLES else 2
        tried.update(dict.fromkeys(_clauses(latches, size)))
    for word in _few(design, after_reset):
        tried.update(dict.fromkeys(_clauses(word, len(word))))
    yield from filter(possible, tried)
    equal = [(2 * copy, 2 * latch + 1) for copy, latch in copies.items()]
    equal += [(2 * copy + 1, 2 * latch) for copy, latch in copies.items()]
    always = set(filter(possible, equal))
    yield from always
    others = [clause for clause in equal if clause not in always]
    if 2 * len(others) * len(latches) <= _CONDITIONAL:
        conditional = ((2 * latch + bit, *clause) for clause in others for latch in latches for bit in (0, 1))
        yield from filter(possible, conditional)


def _few(design: Design, after_reset: dict[int, bool]) -> list[tuple[int, ...]]:
    """Registers of few bits, all of which reset sets."""
    return [word for word in design.words if 1 < len(word) <= _ALL and all(it in after_reset for it in word)]


def _clauses(latches: Sequence[int], size: int) -> Iterator[Clause]:
    for chosen in itertools.combinations(latches, size):
        for inverted in itertools.product((0, 1), repeat=size):
            yield tuple(2 * latch + bit for latch, bit in zip(chosen, inverted, strict=True))


def _inductive(design: Design, clauses: list[Clause], seconds: int) -> tuple[Clause, ...]:
    for _ in range(_ROUNDS):
        graph, states = Graph(), dict[int, int]()
        run = _run(design, graph, states, False, {})
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
