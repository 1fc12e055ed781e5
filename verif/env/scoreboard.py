"""Compares transactions in order with those expected; leftovers and extras fail as mismatches do.

It can run, passive, inside a larger bench: monitors feed it as transfers happen. It collects what
goes wrong and raises in `check`, so that a property can shrink the input that led there.
"""

from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from models.fixed import Raw
from verif.env.clocking import Clocking
from verif.env.fields import Field, describe
from verif.env.pipelined import Mismatch
from verif.env.streams import Transaction

_SHOWN = 3
"""Complaints that a failure prints."""


@dataclass(frozen=True)
class Expectation:
    """A transaction to come, and the operands that it comes from."""

    transaction: Transaction
    operands: Transaction | None = None


class Scoreboard:
    """In-order comparison of one stream. fields: of the results; operand_fields: of the operands."""

    def __init__(self, fields: Sequence[Field], operand_fields: Sequence[Field] = ()) -> None:
        self._fields, self._operand_fields = fields, operand_fields
        self._expected: deque[Expectation] = deque()
        self.complaints: list[str] = []
        self.compared = 0

    def expect(self, transaction: Transaction, operands: Transaction | None = None) -> None:
        """One more transaction that must come, after those expected before."""
        self._expected.append(Expectation(transaction, operands))

    def receive(self, transaction: Transaction) -> None:
        """The next transaction that came."""
        if not self._expected:
            self.complaints.append(f"extra:\n  got      {describe_one(self._fields, transaction)}")
            return
        expected = self._expected.popleft()
        if expected.transaction != transaction:
            self.complaints.append(self._difference(expected, transaction))
        self.compared += 1

    def _difference(self, expected: Expectation, got: Transaction) -> str:
        lines = [f"transaction {self.compared}:"]
        if expected.operands is not None:
            lines.append(f"  operands {describe_one(self._operand_fields, expected.operands)}")
        lines.append(f"  expected {describe_one(self._fields, expected.transaction)}")
        lines.append(f"  got      {describe_one(self._fields, got)}")
        return "\n".join(lines)

    @property
    def outstanding(self) -> int:
        """Transactions that are still to come."""
        return len(self._expected)

    def clear(self) -> None:
        """Forgets everything, as the design does when it is reset."""
        self._expected.clear()
        self.complaints.clear()
        self.compared = 0

    def check(self) -> None:
        """Raises Mismatch with the first complaints, or where transactions have not come."""
        complaints = self.complaints[:_SHOWN]
        if len(self.complaints) > _SHOWN:
            complaints.append(f"and {len(self.complaints) - _SHOWN} more")
        if self._expected:
            first = describe_one(self._fields, self._expected[0].transaction)
            complaints.append(f"{self.outstanding} never came, the first:\n  expected {first}")
        if complaints:
            raise Mismatch("\n".join(complaints))

    async def drain(self, clocking: Clocking, most: int) -> None:
        """Waits until all that is expected has come, ``most`` clocks at most, and checks."""
        for _ in range(most):
            if not self._expected:
                break
            await clocking.edge
        self.check()


def describe_one(fields: Sequence[Field], transaction: Transaction) -> str:
    """A transaction in fixed point and as numbers."""
    return "; ".join(describe(field, _column(getattr(transaction, field.name)), 0) for field in fields)


def _column(value: int | tuple[int, ...]) -> Raw:
    """One operand: shape (1,), or (lanes, 1)."""
    return np.array(value, dtype=np.int64)[..., np.newaxis]
