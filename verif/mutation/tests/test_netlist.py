"""What the solver is given of a netlist."""

from verif.env.sources import relative
from verif.mutation import netlist
from verif.mutation.aig import FALSE, TRUE, Design, Graph, Run
from verif.mutation.netlist import FOLDER, Netlist

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


def test_a_register_takes_its_next_value_where_its_own_clock_ticks() -> None:
    design = _two_clocks()
    assert design.clocks == {"clk", "pixel_clk"}
    for clk, pixel_clk in ((FALSE, FALSE), (TRUE, FALSE), (FALSE, TRUE), (TRUE, TRUE)):
        inputs = {"clk": clk, "pixel_clk": pixel_clk, "d": TRUE}
        run = Run(design, Graph(), lambda at, _, given=inputs: given[design.inputs[at][0]], lambda _: FALSE)
        q, pixel_q = (run.literal(design.outputs[port, 0], 1) for port in ("q", "pixel_q"))
        assert (q, pixel_q) == (clk, pixel_clk)
    held = Run(design, Graph(), lambda *_: FALSE, lambda _: TRUE)
    assert {held.literal(literal, 1) for literal in design.outputs.values()} == {TRUE}
