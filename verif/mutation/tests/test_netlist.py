"""What the solver is given of a netlist."""

from collections.abc import Mapping

from verif.env.sources import relative
from verif.mutation import netlist
from verif.mutation.aig import FALSE, TRUE, Design, Graph, Run
from verif.mutation.netlist import Netlist
from verif.mutation.record import FOLDER

_TWO_CLOCKS = """
module two_clocks (input clk, pixel_clk, d, output reg q, pixel_q);
    always @(posedge clk) q <= d;
    always @(posedge pixel_clk) pixel_q <= d;
endmodule
"""


def _two_clocks() -> Design:
    folder = FOLDER / "work" / "two_clocks"
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "two_clocks.v").write_text(_TWO_CLOCKS)
    (at,) = relative([folder])
    script = f"read_verilog {at}/two_clocks.v\nprep -top two_clocks\nwrite_rtlil {at}/netlist.il"
    netlist.yosys(folder, "list", script)
    return netlist.design(Netlist("two_clocks", (), (), folder))


def _after(design: Design, inputs: Mapping[str, int], held: int) -> dict[str, int]:
    """Outputs behind a step with these inputs, of registers that all hold the same."""

    def given(position: int, _clock: int) -> int:
        return inputs[design.inputs[position][0]]

    run = Run(design, Graph(), given, lambda _: held)
    return {port: run.literal(literal, 1) for (port, _), literal in design.outputs.items()}


def test_a_register_takes_its_next_value_where_its_own_clock_ticks() -> None:
    design = _two_clocks()
    assert design.clocks == {"clk", "pixel_clk"}
    for clk, pixel_clk in ((FALSE, FALSE), (TRUE, FALSE), (FALSE, TRUE), (TRUE, TRUE)):
        inputs = {"clk": clk, "pixel_clk": pixel_clk, "d": TRUE}
        assert _after(design, inputs, FALSE) == {"q": clk, "pixel_q": pixel_clk}
    assert _after(design, {"clk": FALSE, "pixel_clk": FALSE, "d": FALSE}, TRUE) == {
        "q": TRUE,
        "pixel_q": TRUE,
    }
