"""Asks yices whether literals of a graph can be true at once."""

import resource
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from pathlib import Path

from verif.mutation.aig import FALSE, TRUE, Graph


class Answer(StrEnum):
    """Yes, no, or nothing within the time."""

    YES = "sat"
    NO = "unsat"
    UNKNOWN = "unknown"


@dataclass(frozen=True)
class Solution:
    """An answer; true: nodes that are true where it is yes."""

    answer: Answer
    true: frozenset[int] = field(default_factory=frozenset)

    def holds(self, literal: int) -> bool:
        """The value of a literal; what the question did not depend on is false."""
        return ((literal >> 1) in self.true) != bool(literal & 1)


def _limit(seconds: int) -> None:
    """Processor time, so that a busy machine changes no verdict."""
    resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds))


def any_of(graph: Graph, literals: Sequence[int], seconds: int, given: Sequence[int] = ()) -> Solution:
    """Whether one of ``literals`` can be true while all of ``given`` are.

    seconds: of the solver's processor, at most; 0 ask nothing.
    """
    wanted = [literal for literal in literals if literal != FALSE]
    if not wanted or FALSE in given:
        return Solution(Answer.NO)
    if not seconds:
        return Solution(Answer.UNKNOWN)
    assumed = [literal for literal in given if literal != TRUE]
    clauses: list[list[int]] = [[literal] for literal in assumed]
    clauses += [] if TRUE in wanted else [wanted]
    return _ask(graph, clauses, seconds)


def _ask(graph: Graph, clauses: list[list[int]], seconds: int) -> Solution:
    numbers: dict[int, int] = {}
    pending = [literal >> 1 for clause in clauses for literal in clause]
    lines: list[str] = []
    for node in pending:
        numbers.setdefault(node, len(numbers) + 1)
    seen = set(numbers)
    while pending:
        node = pending.pop()
        if graph.is_leaf(node):
            continue
        left, right = graph.fan[node]
        for below in (left >> 1, right >> 1):
            if below not in seen:
                seen.add(below)
                numbers[below] = len(numbers) + 1
                pending.append(below)
        a, b, out = _signed(numbers, left), _signed(numbers, right), numbers[node]
        lines.append(f"{-out} {a} 0\n{-out} {b} 0\n{out} {-a} {-b} 0")
    pending_nodes = [
        " ".join(str(_signed(numbers, literal)) for literal in clause) + " 0" for clause in clauses
    ]
    count = 3 * len(lines) + len(pending_nodes)
    text = "\n".join([f"p cnf {len(numbers)} {count}", *lines, *pending_nodes, ""])
    with tempfile.NamedTemporaryFile("w", suffix=".cnf") as file:
        file.write(text)
        file.flush()
        solver = Path(sys.executable).with_name("yices-sat")
        done = subprocess.run(
            [str(solver), "--model", file.name],
            capture_output=True,
            text=True,
            preexec_fn=lambda: _limit(seconds),
            check=False,
        )
    words = done.stdout.split()
    if not words or words[0] not in (Answer.YES, Answer.NO):
        return Solution(Answer.UNKNOWN)
    positive = {int(word) for word in words[1:]}
    return Solution(
        Answer(words[0]), frozenset(node for node, number in numbers.items() if number in positive)
    )


def _signed(numbers: dict[int, int], literal: int) -> int:
    number = numbers[literal >> 1]
    return -number if literal & 1 else number
