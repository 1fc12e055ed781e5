// SPDX-License-Identifier: Apache-2.0
//
// synchroniser: a level from another clock, through two registers.
//
// The first register may be caught in the moment of a change; the second gives it a clock to
// settle. One bit only: of the bits of a word, some would arrive a clock before the others. `in`
// comes from a register, and holds longer than two clocks of `clk` where no change may be missed.
//
// Latency 2 or 3 clocks, as the change falls.

`default_nettype none

module synchroniser (
    input  wire clk,
    input  wire in,
    output wire out
);

    // The attribute keeps the two side by side, and out of shift registers, where tools know it.
    (* async_reg = "true" *) reg [1:0] level_reg;

    always @(posedge clk) level_reg <= {level_reg[0], in};

    assign out = level_reg[1];

endmodule

`default_nettype wire
