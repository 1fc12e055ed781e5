"""Whether a surviving mutant can be seen at all: proven equivalent, shown by a trace, or undecided.

Mutant and unit are unrolled side by side over the same inputs, in one graph where everything is shared that
the mutation does not touch; a SAT solver looks for outputs that differ. Proofs, each sound by itself:

* From any state that both have, outputs and next states are the same: then they always are. Registers that
  may come to differ are let loose, in both copies apart, until no more of them do and the outputs still
  cannot.
* Where what the mutation touches has no feedback and reaches the outputs within d clocks, outputs depend on
  the last d clocks only: d clocks from any state of the rest, and all clocks up to it from reset, decide.
* Otherwise k-induction: outputs that were the same for k clocks are the same in the next one; or what always
  holds of the states of both side by side, such as registers that are equal, leaves no difference to see.
* A few clocks behind a reset both are in the same state, whatever they were in before, and until then the
  outputs are the same; and states that are the same stay so, but for reset, from where they are then.

Each but the last is tried from every state, then from those alone that `verif.mutation.invariants` does not
exclude.

A trace from reset after which outputs differ shows the mutant. It obeys no protocol of the inputs, but for
those that must be low until an output is high: whether it is legal is for a person to say. Mutants of clock
inputs are never made: of one clock the solver would not see them.

Where there are several clocks, any of them tick in a step, or none: that is every ratio and every phase. In
reset all tick. A reset of one side leaves the other as it is, so the last of the proofs is not tried there.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import TypeVar

from verif.mutation import invariants
from verif.mutation.aig import FALSE, TRUE, Design, Graph, Run
from verif.mutation.invariants import Clause, clause_literal
from verif.mutation.netlist import SELECT
from verif.mutation.record import Clock, Verdict
from verif.mutation.sat import Answer, Solution, any_of

_Key = TypeVar("_Key")

_RESET_CLOCKS = 2
_DEEPEST = 160
"""Clocks after which what a mutation touches counts as feedback."""

_LARGEST = 60_000
"""Gates up to which unit and mutant are looked at side by side."""

_SETTLED = 8
"""Clocks behind a reset within which both may come into the same state."""

_INDUCTIONS = (1, 2)
_DEPTHS = (6, 14)
"""Clocks behind reset in which a trace is looked for, where there is feedback."""


@dataclass(frozen=True)
class Decision:
    """verdict, the way it was reached, and the trace that shows the mutant, if one does."""

    verdict: Verdict
    why: str
    witness: tuple[Clock, ...] = ()


@dataclass
class _Pair:
    """Unit and mutant from states that agree but for the latches in ``loose``; the same inputs.

    reset: clocks of reset at the beginning; quiet: the clock until which there is none behind them.
    """

    design: Design
    mutant: int
    loose: frozenset[int] = frozenset()
    reset: int = 0
    quiet: int = 0

    def __post_init__(self) -> None:
        self.graph = Graph()
        self._inputs: dict[tuple[int, int], int] = {}
        self._common: dict[int, int] = {}
        self._apart: dict[tuple[int, int], int] = {}
        self.unit = self._run(0)
        self.changed = self._run(self.mutant)

    def _run(self, selected: int) -> Run:
        def given(position: int, clock: int) -> int:
            port, bit = self.design.inputs[position]
            if port == SELECT:
                return (selected >> bit) & 1
            if clock < self.reset and port in self.design.begun:
                return TRUE
            if clock < self.quiet and port == "rst":
                return FALSE
            return self._free(self._inputs, (position, clock))

        def state(latch: int) -> int:
            if selected and latch in self.loose:
                return self._free(self._apart, (latch, selected))
            return self._free(self._common, latch)

        return Run(self.design, self.graph, given, state)

    def _free(self, known: dict[_Key, int], key: _Key) -> int:
        if key not in known:
            known[key] = self.graph.leaf()
        return known[key]

    def reached(self, clauses: Sequence[Clause]) -> list[int]:
        """Literals that say that the unit's state at clock 0 breaks none of these."""
        return [clause_literal(self.graph, clause, self._common) for clause in clauses]

    def outputs(self, clock: int) -> list[int]:
        """Literals, one an output bit that may differ."""
        pairs = (
            (self.unit.literal(literal, clock), self.changed.literal(literal, clock))
            for literal in self.design.outputs.values()
        )
        return [self.graph.differ(left, right) for left, right in pairs if left != right]

    def legal(self, low_until: Mapping[str, str], clock: int) -> list[int]:
        """Literals that say of a clock that these inputs are low unless the unit's outputs are high."""
        ports = [port for port, _ in self.design.inputs]
        return [
            self.graph.both(
                self._free(self._inputs, (ports.index(port), clock)),
                self.unit.literal(self.design.outputs[output, 0], clock) ^ 1,
            )
            ^ 1
            for port, output in low_until.items()
        ]

    def states_at(self, latches: Iterable[int], clock: int) -> list[int]:
        """Literals, one a latch whose state in a clock may differ."""
        pairs = (
            (self.unit.literal(2 * latch, clock), self.changed.literal(2 * latch, clock)) for latch in latches
        )
        return [self.graph.differ(left, right) for left, right in pairs if left != right]

    def states(self, latches: Iterable[int]) -> Iterator[tuple[int, int]]:
        """Latch and literal, where the next state may differ."""
        for latch in latches:
            left, right = self.unit.after(latch, 0), self.changed.after(latch, 0)
            if left != right:
                yield latch, self.graph.differ(left, right)

    def product(self) -> tuple[Design, dict[int, int]]:
        """Unit and mutant as one design: its outputs are the differences, its latches those of the unit and
        the mutant's loose ones; by these, the unit's that they are copies of."""
        design, fan = self.design, self.graph.fan
        positions = [index for index, (port, _) in enumerate(design.inputs) if port != SELECT]
        latches, loose = list(range(design.first_latch, design.first_gate)), sorted(self.loose)
        apart = self.outputs(0)
        after = [self.unit.after(latch, 0) for latch in latches]
        after += [self.changed.after(latch, 0) for latch in loose]
        number = {0: 0}
        first_latch = len(positions) + 1
        for place, position in enumerate(positions, 1):
            number[self._free(self._inputs, (position, 0)) >> 1] = place
        for place, latch in enumerate(latches, first_latch):
            number[self._free(self._common, latch) >> 1] = place
        for place, latch in enumerate(loose, first_latch + len(latches)):
            number[self._free(self._apart, (latch, self.mutant)) >> 1] = place
        gates: list[tuple[int, int]] = []
        first_gate = first_latch + len(latches) + len(loose)

        def literal(it: int) -> int:
            return 2 * number[it >> 1] + (it & 1)

        # A node's operands have smaller numbers.
        for node, (left, right) in enumerate(fan):
            if node not in number and left >= 0:
                number[node] = first_gate + len(gates)
                gates.append((literal(left), literal(right)))
        place_of = dict(zip(latches, range(first_latch, first_gate), strict=False))
        copies = {place: place_of[latch] for place, latch in enumerate(loose, first_latch + len(latches))}
        outputs = {("", index): literal(it) for index, it in enumerate(apart)}
        inputs = tuple(design.inputs[position] for position in positions)
        return Design(inputs, tuple(map(literal, after)), outputs, tuple(gates)), copies

    def trace(self, solution: Solution, clocks: int) -> tuple[Clock, ...]:
        """The inputs that a solution has, clock by clock."""
        found: list[dict[str, int]] = [{} for _ in range(clocks)]
        for position, (port, bit) in enumerate(self.design.inputs):
            if port in ("", SELECT) or self.design.clocks == {port}:
                continue
            for clock in range(clocks):
                literal = self._inputs.get((position, clock), FALSE)
                held = port in self.design.begun and clock < self.reset
                value = held or (literal != FALSE and solution.holds(literal))
                found[clock][port] = found[clock].get(port, 0) | (int(value) << bit)
        return tuple(found)


def _leaves(graph: Graph) -> Callable[[int, int], int]:
    """Inputs that are free."""
    known: dict[tuple[int, int], int] = {}
    return lambda position, clock: known.setdefault((position, clock), graph.leaf())


@dataclass(frozen=True)
class Solver:
    """Decides about mutants of one design.

    seconds: for one question to the solver; low_until: inputs that nobody raises, with the output that must
    be high before, which depends on no input.
    """

    design: Design
    seconds: int = 8
    low_until: Mapping[str, str] = field(default_factory=dict)

    def decide(self, mutant: int) -> Decision:
        """The verdict on one mutant."""
        touched = self._by_induction(mutant, ())
        if isinstance(touched, Decision):
            return touched
        if self._never and isinstance(proof := self._by_induction(mutant, self._never), Decision):
            return proof
        depth = self._depth(touched)
        if depth is not None:
            found = self._without_feedback(mutant, touched, depth)
            if found.verdict is not Verdict.UNDECIDED:
                return found
        return self._with_feedback(mutant, touched)

    @cached_property
    def _never(self) -> tuple[Clause, ...]:
        return invariants.find(self.design, self.seconds)

    @cached_property
    def _latches(self) -> range:
        return range(self.design.first_latch, self.design.first_gate)

    def _by_induction(self, mutant: int, never: Sequence[Clause]) -> Decision | frozenset[int]:
        """A proof, or the latches that may differ after one clock from the same state."""
        loose: frozenset[int] = frozenset()
        first: frozenset[int] | None = None
        while True:
            pair = _Pair(self.design, mutant, loose)
            apart = dict(pair.states(self._latches))
            if first is None:
                first = frozenset(apart)
            reached = pair.reached(never)
            if any_of(pair.graph, pair.outputs(0), self.seconds, reached).answer is not Answer.NO:
                return first
            new = {latch: literal for latch, literal in apart.items() if latch not in loose}
            grown = self._that_differ(pair, new, reached)
            if grown is None:
                return first
            if not grown:
                why = "what differs is never seen" if loose else "the same from every state"
                why += " that is reached" if never else ""
                return Decision(Verdict.EQUIVALENT, why)
            loose |= grown

    def _that_differ(
        self, pair: _Pair, apart: dict[int, int], reached: Sequence[int]
    ) -> frozenset[int] | None:
        """Those of the latches that some input and state make differ; None where the solver cannot say."""
        found: set[int] = set()
        while True:
            left = {latch: literal for latch, literal in apart.items() if latch not in found}
            solution = any_of(pair.graph, list(left.values()), self.seconds, reached)
            if solution.answer is Answer.UNKNOWN:
                return None
            more = {
                latch for latch, it in left.items() if solution.answer is Answer.YES and solution.holds(it)
            }
            if not more:
                return frozenset(found)
            found |= more

    def _depth(self, touched: frozenset[int]) -> int | None:
        """Clocks until nothing of a difference in these latches is left; None where it may stay for ever."""
        reached, depth = set(touched), 0
        while reached and depth < _DEEPEST:
            reached = self.design.latches_behind(reached)
            depth += 1
        return None if reached else depth

    def _all_behind(self, touched: frozenset[int]) -> frozenset[int]:
        reached: set[int] = set(touched)
        while more := self.design.latches_behind(reached) - reached:
            reached |= more
        return frozenset(reached)

    def _trace(self, mutant: int, clocks: int) -> Decision | Answer:
        """A trace of so many clocks behind reset that shows the mutant, or why there is none."""
        pair = _Pair(self.design, mutant, reset=_RESET_CLOCKS)
        last = _RESET_CLOCKS + clocks
        apart = [pair.outputs(clock) for clock in range(_RESET_CLOCKS, last + 1)]
        legal = [literal for clock in range(last + 1) for literal in pair.legal(self.low_until, clock)]
        solution = any_of(pair.graph, [literal for one in apart for literal in one], self.seconds, legal)
        if solution.answer is not Answer.YES:
            return solution.answer
        end = next(index for index, one in enumerate(apart) if any(map(solution.holds, one)))
        length = _RESET_CLOCKS + end + 1
        return Decision(Verdict.SHOWN, f"outputs differ in clock {length}", pair.trace(solution, length))

    def _without_feedback(self, mutant: int, touched: frozenset[int], depth: int) -> Decision:
        """``depth`` clocks of anything decide."""
        found = self._trace(mutant, depth + 1)
        if isinstance(found, Decision):
            return found
        if found is Answer.NO:
            pair = _Pair(self.design, mutant, self._all_behind(touched))
            reached = pair.reached(self._never)
            if any_of(pair.graph, pair.outputs(depth), self.seconds, reached).answer is Answer.NO:
                return Decision(Verdict.EQUIVALENT, f"no feedback, the same in {depth} clocks")
        return Decision(Verdict.UNDECIDED, f"no answer over {depth} clocks")

    def _with_feedback(self, mutant: int, touched: frozenset[int]) -> Decision:
        """Traces and inductions, the short ones first."""
        loose = self._all_behind(touched)
        tried = 0
        large = len(self.design.gates) > _LARGEST
        if not large and len(self.design.clocks) < 2 and self._settles(mutant, loose):
            return Decision(Verdict.EQUIVALENT, "the same behind a reset, and then in the same state")
        for clocks in _DEPTHS[:1] if large else _DEPTHS:
            found = self._trace(mutant, clocks)
            if isinstance(found, Decision):
                return found
            if not tried:
                for length in _INDUCTIONS if found is Answer.NO and not large else ():
                    if self._inductive(mutant, loose, length):
                        return Decision(Verdict.EQUIVALENT, f"the same by induction over {length} clocks")
                if self._side_by_side(mutant, loose):
                    return Decision(Verdict.EQUIVALENT, "the same in all states that both reach together")
            if found is Answer.UNKNOWN:
                break
            tried = clocks
        return Decision(Verdict.UNDECIDED, f"no trace of {tried} clocks, no proof")

    def _settles(self, mutant: int, loose: frozenset[int]) -> bool:
        """Whatever both were in, they are in the same state behind a reset, and no output tells before."""
        for clock in range(1, _SETTLED + 1):
            pair = _Pair(self.design, mutant, loose, reset=1, quiet=clock)
            legal = [it for now in range(clock + 1) for it in pair.legal(self.low_until, now)]
            if not self._never_any(pair, pair.outputs(clock), legal):
                return False
            if self._never_any(pair, pair.states_at(loose, clock), legal):
                settled = {latch: pair.unit.literal(2 * latch, clock) for latch in self._latches}
                return self._stay(
                    mutant, {it: value for it, value in settled.items() if value in (FALSE, TRUE)}
                )
        return False

    def _stay(self, mutant: int, settled: Mapping[int, int]) -> bool:
        """From one state with registers of these values the outputs are the same, and but for a reset the
        next states are one again, with the same values of those that keep them."""
        while True:
            pair = _Pair(self.design, mutant, quiet=1)
            held = [pair.unit.literal(2 * latch, 0) ^ value ^ 1 for latch, value in settled.items()]
            held += pair.legal(self.low_until, 0)
            broken = {latch: pair.unit.after(latch, 0) ^ value for latch, value in settled.items()}
            solution = any_of(pair.graph, list(broken.values()), self.seconds, held)
            if solution.answer is not Answer.YES:
                break
            settled = {it: value for it, value in settled.items() if not solution.holds(broken[it])}
        if solution.answer is Answer.UNKNOWN:
            return False
        apart = [literal for _, literal in pair.states(self._latches)]
        if not self._never_any(pair, apart, held):
            return False
        pair = _Pair(self.design, mutant)
        held = [pair.unit.literal(2 * latch, 0) ^ value ^ 1 for latch, value in settled.items()]
        return self._never_any(pair, pair.outputs(0), [*held, *pair.legal(self.low_until, 0)])

    def _never_any(self, pair: _Pair, literals: Sequence[int], given: Sequence[int]) -> bool:
        return any_of(pair.graph, literals, self.seconds, given).answer is Answer.NO

    def _side_by_side(self, mutant: int, loose: frozenset[int]) -> bool:
        """What always holds of the states of both together, from reset on, leaves no difference to see."""
        if len(self.design.gates) > _LARGEST:
            return False
        both, copies = _Pair(self.design, mutant, loose).product()
        never = invariants.find(both, self.seconds, copies)
        if not never:
            return False
        graph, states = Graph(), dict[int, int]()
        run = Run(both, graph, _leaves(graph), lambda latch: states.setdefault(latch, graph.leaf()))
        given = [clause_literal(graph, clause, states) for clause in never]
        apart = [run.literal(literal, 0) for literal in both.outputs.values()]
        return any_of(graph, apart, self.seconds, given).answer is Answer.NO

    def _inductive(self, mutant: int, loose: frozenset[int], length: int) -> bool:
        """Outputs that were the same for so many clocks are so in the next; `_trace` has seen to the first
        ones."""
        pair = _Pair(self.design, mutant, loose)
        same = [literal ^ 1 for clock in range(length) for literal in pair.outputs(clock)]
        same += pair.reached(self._never)
        return any_of(pair.graph, pair.outputs(length), self.seconds, same).answer is Answer.NO
