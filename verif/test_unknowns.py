"""A design that looks at an input while its valid is low is caught, be it at one value in a million."""

import pytest

from verif.env import breaks, units
from verif.env.simulators import MissingTool, Simulator, version
from verif.env.unit import Break

_LOOKS = {
    "add_sub": Break(
        "arith/add_sub.v",
        "always @(posedge clk) sum_reg <= sum_next;",
        "reg last_reg; always @(posedge clk) begin"
        " last_reg <= a == 57'h1234567_89abcde; sum_reg <= sum_next ^ {LANES*W{last_reg}}; end",
    ),
    "sqrt_iter": Break(
        "arith/sqrt_iter.v",
        "assign root = q_reg;",
        "assign root = q_reg ^ {STEPS{radicand == 40'h5a5a5_a5a5a}};",
    ),
    "fifo": Break(
        "flow/fifo.v",
        "assign in_ready  = room_reg != {ADDR_W + 1{1'b0}};",
        "assign in_ready  = room_reg != {ADDR_W + 1{1'b0}} && (in_valid || in_data != 32'h5a5a_a5a5);",
    ),
}
"""A pipeline, a unit between streams, and a block."""


@pytest.mark.parametrize("unit", _LOOKS)
def test_looking_at_what_is_not_valid_is_caught_on_icarus(unit: str) -> None:
    """As an unknown bit of a result or a handshake."""
    try:
        version(Simulator.ICARUS)
    except MissingTool as missing:
        pytest.skip(str(missing))
    outcome = units.simulate(
        unit,
        Simulator.ICARUS,
        "default",
        seed=1,
        effort=units.Effort(examples=10, operands=100),
        replacements=breaks.changed(_LOOKS[unit]),
        run_name=f"unknowns-{unit}",
        shrink=False,
    )
    assert any("unknown bits" in (text or "") for text in outcome.tests.values()), outcome.complaint()
