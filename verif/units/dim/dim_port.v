// SPDX-License-Identifier: Apache-2.0
//
// dim_port: dim with the ports of a pipelined unit, for the bench.
//
// Combinational: valid and tag pass straight through, so the bench of pipelined units fits, at
// latency 0.

`default_nettype none
`include "raytracer.vh"

module dim_port #(
    parameter TAG_W = 1
) (
    input  wire                    clk,
    input  wire                    rst,
    input  wire                    in_valid,
    input  wire [       TAG_W-1:0] in_tag,
    input  wire [3*`RT_SHADE_W-1:0] colour,
    input  wire [3*`RT_COEFF_W-1:0] share,
    output wire                    out_valid,
    output wire [       TAG_W-1:0] out_tag,
    output wire [3*`RT_SHADE_W-1:0] dimmed
);

    wire unused_controls = &{1'b0, clk, rst};

    assign out_valid = in_valid;
    assign out_tag   = in_tag;

    dim dut (
        .colour(colour),
        .share (share),
        .dimmed(dimmed)
    );

endmodule

`default_nettype wire
