"""The solver on designs of a few gates, whose mutants are equivalent or not by construction."""

from collections.abc import Callable
from dataclasses import replace
from itertools import chain, count

from verif.mutation import invariants
from verif.mutation.aig import Bit, Design
from verif.mutation.equivalence import Solver
from verif.mutation.netlist import SELECT
from verif.mutation.record import Judged, Mutant, Result, Status, Verdict

_MUTANT = Mutant(1, "inv", "A[0]", "hdl/flow/fifo.v:1", "")


class _Builder:
    """Collects gates. Inputs are mutsel, rst, a and b, in this order."""

    def __init__(self, latches: int = 0) -> None:
        names = (SELECT, "rst", "a", "b")
        self._names: tuple[Bit, ...] = tuple((name, 0) for name in names)
        self.select, self.rst, self.a, self.b = (2 * number for number in range(1, 5))
        self.latch = [2 * (5 + number) for number in range(latches)]
        self._first = count(5 + latches)
        self._gates: list[tuple[int, int]] = []

    def both(self, left: int, right: int) -> int:
        """A gate."""
        self._gates.append((left, right))
        return 2 * next(self._first)

    def either(self, left: int, right: int) -> int:
        """Or."""
        return self.both(left ^ 1, right ^ 1) ^ 1

    def differ(self, left: int, right: int) -> int:
        """Exclusive or."""
        return self.both(self.either(left, right), self.both(left, right) ^ 1)

    def design(self, out: int, *after: int) -> Design:
        """What was built, with one output."""
        return Design(self._names, after, {("out", 0): out}, tuple(self._gates))


def test_a_gate_that_nothing_needs_is_proven_equivalent() -> None:
    it = _Builder()
    out = it.both(it.a, it.either(it.a, it.both(it.b, it.select)))
    assert Solver(it.design(out)).decide(1).verdict is Verdict.EQUIVALENT


def test_a_visible_mutant_is_shown_with_the_operand_that_shows_it() -> None:
    it = _Builder()
    out = it.differ(it.a, it.both(it.b, it.select))
    found = Solver(it.design(out)).decide(1)
    assert found.verdict is Verdict.SHOWN
    assert found.witness[-1]["b"] == 1


def test_a_visible_mutant_behind_registers_is_shown_by_a_trace_from_reset() -> None:
    it = _Builder(latches=2)
    first, second = it.latch
    out = it.design(second, it.differ(it.a, it.select), first)
    found = Solver(out).decide(1)
    assert found.verdict is Verdict.SHOWN
    assert [clock["rst"] for clock in found.witness[:2]] == [1, 1]


def test_a_difference_that_no_output_sees_is_proven_equivalent() -> None:
    it = _Builder(latches=1)
    hidden = it.both(it.latch[0], it.both(it.a, it.a ^ 1))
    assert Solver(it.design(it.differ(it.b, hidden), it.select)).decide(1).verdict is Verdict.EQUIVALENT


def test_two_registers_that_always_agree_are_found_by_induction() -> None:
    it = _Builder(latches=2)
    one, other = it.latch
    chosen = it.either(it.both(one, it.select ^ 1), it.both(other, it.select))
    after = it.both(it.differ(one, it.a), it.rst ^ 1)
    after_other = it.both(it.differ(chosen, it.a), it.rst ^ 1)
    assert Solver(it.design(one, after, after_other)).decide(1).verdict is Verdict.EQUIVALENT


def test_feedback_that_differs_is_shown() -> None:
    it = _Builder(latches=1)
    after = it.both(it.differ(it.latch[0], it.either(it.a, it.select)), it.rst ^ 1)
    assert Solver(it.design(it.latch[0], after)).decide(1).verdict is Verdict.SHOWN


def _cleared_in_either_order() -> Design:
    """A register each that `a` and `b` set; behind a reset they are cleared one after the other, which the
    mutant does in the other order. Outputs: whether both have been, and what they then hold."""
    it = _Builder(latches=4)
    second, ready, first_bit, second_bit = it.latch
    begun = it.both(it.rst ^ 1, ready ^ 1)
    clears_second = it.both(ready ^ 1, it.differ(second, it.select))
    clears_first = it.both(ready ^ 1, it.differ(second, it.select) ^ 1)
    after = (
        it.both(begun, second ^ 1),
        it.both(it.rst ^ 1, it.either(ready, second)),
        it.both(clears_first ^ 1, it.either(first_bit, it.a)),
        it.both(clears_second ^ 1, it.either(second_bit, it.b)),
    )
    held = it.both(ready, it.both(first_bit, second_bit ^ 1))
    return replace(it.design(held, *after), outputs={("held", 0): held, ("ready", 0): ready})


def test_both_settle_in_the_same_state_behind_a_reset() -> None:
    settled = Solver(_cleared_in_either_order(), low_until={"a": "ready", "b": "ready"}).decide(1)
    assert settled.verdict is Verdict.EQUIVALENT
    assert Solver(_cleared_in_either_order()).decide(1).verdict is Verdict.SHOWN


def test_what_differs_only_long_behind_a_reset_is_no_equivalence() -> None:
    it = _Builder(latches=1)
    seen = it.both(it.both(it.a, it.select), it.b)
    held = it.both(it.rst ^ 1, it.either(it.latch[0], seen))
    assert Solver(it.design(it.latch[0], held)).decide(1).verdict is Verdict.SHOWN


def test_what_a_register_of_few_bits_never_holds_is_known_among_many() -> None:
    """Counters from 0 to 2, among more registers than could be looked at together, and too many for pairs."""
    counters, others = 40, 140
    it = _Builder(latches=2 * counters + others)
    words = list(zip(it.latch[: 2 * counters : 2], it.latch[1 : 2 * counters : 2], strict=True))
    steps = [
        (it.both(it.rst ^ 1, it.both(low ^ 1, high ^ 1)), it.both(it.rst ^ 1, low)) for low, high in words
    ]
    kept = [it.both(it.rst ^ 1, it.either(other, it.a)) for other in it.latch[2 * counters :]]
    design = it.design(it.latch[-1], *chain.from_iterable(steps), *kept)
    assert not invariants.find(design, seconds=8)
    named = replace(design, words=tuple((low >> 1, high >> 1) for low, high in words))
    assert invariants.find(named, seconds=8) == tuple((low ^ 1, high ^ 1) for low, high in words)


def test_an_output_that_means_nothing_tells_nothing() -> None:
    it = _Builder()
    out = it.either(it.b, it.both(it.a ^ 1, it.select))
    design = replace(it.design(out), outputs={("out", 0): out, ("valid", 0): it.a})
    assert Solver(design).decide(1).verdict is Verdict.SHOWN
    assert Solver(design.masked({"out": "valid"})).decide(1).verdict is Verdict.EQUIVALENT


def test_without_an_answer_a_mutant_is_undecided() -> None:
    it = _Builder()
    out = it.both(it.a, it.either(it.b, it.both(it.both(it.a, it.b), it.select)))
    assert Solver(it.design(out)).decide(1).verdict is Verdict.EQUIVALENT
    assert Solver(it.design(out), seconds=0).decide(1).verdict is Verdict.UNDECIDED


def _toggled_by_two_clocks(after_other: Callable[[_Builder, int], int]) -> Design:
    """Two registers that a reset of both clears. The first is turned over by its clock, `a`; what the second
    one takes is ``after_other`` of the first. The mutant shows where only the first is set."""
    it = _Builder(latches=2)
    first, second = it.latch
    after_first = it.both(it.rst ^ 1, it.differ(first, it.a))
    after_second = it.both(it.rst ^ 1, after_other(it, second))
    out = it.either(it.b, it.both(it.select, it.both(first, second ^ 1)))
    design = it.design(out, after_first, after_second)
    return replace(design, inputs=(*design.inputs[:2], ("clk", 0), ("pixel_clk", 0)))


def test_of_two_clocks_one_ticks_without_the_other() -> None:
    by_other = _toggled_by_two_clocks(lambda it, second: it.differ(second, it.b))
    found = Solver(by_other).decide(1)
    assert found.verdict is Verdict.SHOWN
    assert found.witness[0]["clk"] == found.witness[0]["pixel_clk"] == 1
    assert any(step["clk"] != step["pixel_clk"] for step in found.witness)
    by_one = _toggled_by_two_clocks(lambda it, second: it.differ(second, it.a))
    assert Solver(by_one).decide(1).verdict is Verdict.EQUIVALENT


def test_a_reset_of_either_side_is_one() -> None:
    it = _Builder(latches=2)
    first, second = it.latch
    design = it.design(
        it.both(it.select ^ 1, it.both(first, second)), it.both(it.rst ^ 1, first), it.both(it.a ^ 1, second)
    )
    two = replace(design, inputs=(*design.inputs[:2], ("pixel_rst", 0), ("b", 0)))
    assert two.begun == {"rst", "pixel_rst"}
    assert Solver(two).decide(1).verdict is Verdict.EQUIVALENT


def test_an_undecided_mutant_counts_against_the_score() -> None:
    killed = Judged(_MUTANT, Status.KILLED)
    undecided = Judged(_MUTANT, Status.SURVIVED, verdict=Verdict.UNDECIDED)
    equivalent = Judged(_MUTANT, Status.SURVIVED, verdict=Verdict.EQUIVALENT)
    result = Result("fifo", "default", (killed, killed, killed, undecided, equivalent), 0.0)
    assert result.score == 3 / 4
    assert result.undecided == 1 / 5
    assert result.survivors == (undecided,)


def test_registers_that_reset_does_not_set_but_begin_alike_are_found_to_stay_so() -> None:
    it = _Builder(latches=3)
    one, other, data = it.latch
    chosen = it.either(it.both(one, it.select ^ 1), it.both(other, it.select))
    after = it.both(it.differ(one, it.a), it.rst ^ 1)
    after_other = it.both(it.differ(chosen, it.a), it.rst ^ 1)
    held = it.either(it.both(data, chosen ^ 1), it.both(it.b, chosen))
    assert (
        Solver(it.design(it.both(data, one), after, after_other, held)).decide(1).verdict
        is Verdict.EQUIVALENT
    )
