"""How the stage table counts multipliers is how the Verilog cuts its products."""

import re
from pathlib import Path

import pytest

from models import stages
from models.fixed import Format

_ARITH = Path(__file__).parents[2] / "hdl" / "arith"


def _constant(file: str, name: str) -> int:
    found = re.search(rf"localparam {name} = (\d+);", (_ARITH / file).read_text())
    assert found, f"{file} has no {name}"
    return int(found[1])


def test_pieces_are_as_wide_as_in_the_verilog() -> None:
    assert _constant("mul.v", "PIECE_W") == stages._PIECE
    assert _constant("mul_piece.v", "SHORT_W") == stages._SHORT


@pytest.mark.parametrize(
    ("a", "b", "expected"),
    [
        (Format(22, 0), Format(22, 0), 1),
        (Format(23, 0), Format(22, 0), 2),
        (Format(9, 12, signed=False), Format(9, 10, signed=False), 1),
        (Format(9, 13, signed=False), Format(9, 10, signed=False), 2),
        (Format(5, 0), Format(18, 0), 0),
    ],
    ids=lambda value: str(value),
)
def test_a_piece_of_up_to_five_bits_costs_no_multiplier(a: Format, b: Format, expected: int) -> None:
    assert stages.multipliers(a, b) == expected
