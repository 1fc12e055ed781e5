"""A design as an and-inverter graph, and that graph unrolled over clocks, with everything shared that is the
same."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

FALSE, TRUE = 0, 1
"""Literals: twice the number of a node, plus 1 where it is inverted. Node 0 is the constant."""

_REGISTER = "_reg"
"""How names of registers end."""

Bit = tuple[str, int]
"""Port and number of the bit."""


@dataclass(frozen=True)
class Design:
    """Variables are numbered as in AIGER: from 1 the inputs, the latches, the gates. inputs: by position;
    next: literal of each latch's next value; outputs: literals by port bit; gates: two literals each; words:
    variables of the latches that are one register of the Verilog."""

    inputs: tuple[Bit, ...]
    next: tuple[int, ...]
    outputs: Mapping[Bit, int]
    gates: tuple[tuple[int, int], ...]
    words: tuple[tuple[int, ...], ...] = ()

    @property
    def clocks(self) -> frozenset[str]:
        """Ports that are clocks. Of several each is high in the steps in which its registers take their next
        values, see `netlist.design`; a single one ticks in every step."""
        return frozenset(port for port, _ in self.inputs if port == "clk" or port.endswith("_clk"))

    @property
    def begun(self) -> frozenset[str]:
        """Ports that are high where a design is reset as a whole: its resets, and all clocks tick."""
        return self.clocks | {port for port, _ in self.inputs if port == "rst" or port.endswith("_rst")}

    @property
    def first_latch(self) -> int:
        """Variable of the first latch."""
        return len(self.inputs) + 1

    @property
    def first_gate(self) -> int:
        """Variable of the first gate."""
        return self.first_latch + len(self.next)

    @cached_property
    def users(self) -> list[list[int]]:
        """Variables of the gates that read each variable."""
        found: list[list[int]] = [[] for _ in range(self.first_gate + len(self.gates))]
        for gate, (left, right) in enumerate(self.gates, self.first_gate):
            found[left >> 1].append(gate)
            found[right >> 1].append(gate)
        return found

    def masked(self, only_with: Mapping[str, str]) -> "Design":
        """The design whose outputs of these ports are 0 while another output, of one bit, is low."""
        outputs, gates = dict(self.outputs), list(self.gates)
        for (port, bit), literal in self.outputs.items():
            if port in only_with:
                outputs[port, bit] = 2 * (self.first_gate + len(gates))
                # Operands of a gate come in AIGER's order, the larger one first.
                operands = (literal, self.outputs[only_with[port], 0])
                gates.append((max(operands), min(operands)))
        return replace(self, outputs=outputs, gates=tuple(gates))

    def latches_behind(self, variables: Iterable[int]) -> set[int]:
        """Variables of the latches whose next value may depend on these within a clock."""
        reached = set(variables)
        pending = list(reached)
        while pending:
            for user in self.users[pending.pop()]:
                if user not in reached:
                    reached.add(user)
                    pending.append(user)
        return {
            self.first_latch + index for index, literal in enumerate(self.next) if literal >> 1 in reached
        }


def read(file: Path, names: Path) -> Design:
    """Reads binary AIGER and the map of its symbols, as yosys writes both."""
    data = file.read_bytes()
    head, _, rest = data.partition(b"\n")
    _, inputs, latches, outputs, gates = map(int, head.split()[1:6])
    lines = rest.split(b"\n", latches + outputs)
    body = lines[latches + outputs]
    after = tuple(int(line.split()[0]) for line in lines[:latches])
    out = [int(line) for line in lines[latches : latches + outputs]]
    named: dict[str, dict[int, Bit]] = {"input": {}, "output": {}}
    words: dict[str, set[int]] = {}
    for line in names.read_text().splitlines():
        kind, position, bit, name = line.split()[:4]
        if kind in named:
            named[kind][int(position)] = (name, int(bit))
        elif name.endswith(_REGISTER):
            words.setdefault(name, set()).add(inputs + 1 + int(position))
    return Design(
        tuple(named["input"].get(index, ("", index)) for index in range(inputs)),
        after,
        # Where two bits are one signal, yosys names one of them.
        {named["output"].get(index, ("", index)): literal for index, literal in enumerate(out)},
        tuple(_gates(body, inputs + latches + 1, gates)),
        tuple(dict.fromkeys(tuple(sorted(word)) for word in words.values())),
    )


def _gates(data: bytes, first: int, number: int) -> Iterable[tuple[int, int]]:
    at = 0

    def delta() -> int:
        nonlocal at
        value = shift = 0
        while data[at] & 0x80:
            value |= (data[at] & 0x7F) << shift
            shift += 7
            at += 1
        value |= data[at] << shift
        at += 1
        return value

    for variable in range(first, first + number):
        left = 2 * variable - delta()
        yield left, left - delta()


class Graph:
    """Nodes shared by structure: the same gate of the same operands is one node."""

    def __init__(self) -> None:
        self.fan: list[tuple[int, int]] = [(-1, -1)]
        self._known: dict[tuple[int, int], int] = {}

    def leaf(self) -> int:
        """A new free variable; its literal."""
        self.fan.append((-1, -1))
        return 2 * (len(self.fan) - 1)

    def both(self, left: int, right: int) -> int:
        """The literal of left and right."""
        if left > right:
            left, right = right, left
        if left == FALSE or left == right ^ 1:
            return FALSE
        if left in (TRUE, right):
            return right
        found = self._known.get((left, right))
        if found is None:
            self.fan.append((left, right))
            found = self._known[left, right] = 2 * (len(self.fan) - 1)
        return found

    def differ(self, left: int, right: int) -> int:
        """The literal of exactly one of them."""
        if left == right:
            return FALSE
        if left == right ^ 1:
            return TRUE
        return self.both(self.both(left, right) ^ 1, self.both(left ^ 1, right ^ 1) ^ 1)

    def is_leaf(self, node: int) -> bool:
        """A free variable or the constant."""
        return self.fan[node][0] < 0


class Run:
    """A design over clocks from 0 on, evaluated where something asks for it.

    given: literal of an input by position and clock; state: of a latch's variable at clock 0.
    """

    def __init__(
        self,
        design: Design,
        graph: Graph,
        given: Callable[[int, int], int],
        state: Callable[[int], int],
    ) -> None:
        self._design, self._graph = design, graph
        self._given, self._state = given, state
        self._values: list[dict[int, int]] = []

    def _at(self, clock: int) -> dict[int, int]:
        while len(self._values) <= clock:
            self._values.append({0: FALSE})
        return self._values[clock]

    def literal(self, literal: int, clock: int) -> int:
        """The graph's literal of one of the design's, in a clock."""
        return self._value(literal >> 1, clock) ^ (literal & 1)

    def after(self, latch: int, clock: int) -> int:
        """What a latch, by its variable, takes at the end of a clock."""
        return self.literal(self._design.next[latch - self._design.first_latch], clock)

    def _value(self, variable: int, clock: int) -> int:
        found = self._at(clock).get(variable)
        if found is not None:
            return found
        design, both = self._design, self._graph.both
        first_latch, first_gate, gates = design.first_latch, design.first_gate, design.gates
        pending = [(variable, clock)]
        while pending:
            asked, now = pending[-1]
            values = self._at(now)
            if asked in values:
                pending.pop()
            elif asked >= first_gate:
                left, right = gates[asked - first_gate]
                left_value, right_value = values.get(left >> 1), values.get(right >> 1)
                if left_value is None:
                    pending.append((left >> 1, now))
                elif right_value is None:
                    pending.append((right >> 1, now))
                else:
                    values[asked] = both(left_value ^ (left & 1), right_value ^ (right & 1))
                    pending.pop()
            elif asked < first_latch:
                values[asked] = self._given(asked - 1, now)
                pending.pop()
            elif now == 0:
                values[asked] = self._state(asked)
                pending.pop()
            else:
                literal = design.next[asked - first_latch]
                value = self._at(now - 1).get(literal >> 1)
                if value is None:
                    pending.append((literal >> 1, now - 1))
                else:
                    values[asked] = value ^ (literal & 1)
                    pending.pop()
        return self._at(clock)[variable]
