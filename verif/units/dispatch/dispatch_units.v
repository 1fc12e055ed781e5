// SPDX-License-Identifier: Apache-2.0
//
// dispatch_units: dispatch to one, two, three and four units, side by side, for the bench.
//
// Fewer units look at the low bits of ray_free and shadow_free. Outputs of k units end with _k.
// Combinational: valid and tag pass straight through, so the bench of pipelined units fits, at
// latency 0.

`default_nettype none

module dispatch_units #(
    parameter TAG_W = 1
) (
    input  wire             clk,
    input  wire             rst,
    input  wire             in_valid,
    input  wire [TAG_W-1:0] in_tag,
    input  wire             ray_valid,
    input  wire             shadow_valid,
    input  wire [      3:0] ray_free,
    input  wire [      3:0] shadow_free,
    output wire             out_valid,
    output wire [TAG_W-1:0] out_tag,
    output wire [      3:0] ray_ready,
    output wire [      3:0] shadow_ready,
    output wire             ray_start_1,
    output wire             shadow_start_1,
    output wire [      1:0] ray_start_2,
    output wire [      1:0] shadow_start_2,
    output wire [      2:0] ray_start_3,
    output wire [      2:0] shadow_start_3,
    output wire [      3:0] ray_start_4,
    output wire [      3:0] shadow_start_4
);

    wire unused_controls = &{1'b0, clk, rst};

    assign out_valid = in_valid;
    assign out_tag   = in_tag;

    wire [15:0] ray_start;
    wire [15:0] shadow_start;

    genvar k;
    generate
        for (k = 1; k <= 4; k = k + 1) begin : g_units
            dispatch #(
                .UNITS(k)
            ) u_dispatch (
                .ray_valid   (ray_valid),
                .ray_ready   (ray_ready[k-1]),
                .shadow_valid(shadow_valid),
                .shadow_ready(shadow_ready[k-1]),
                .ray_free    (ray_free[k-1:0]),
                .shadow_free (shadow_free[k-1:0]),
                .ray_start   (ray_start[4*(k-1)+:k]),
                .shadow_start(shadow_start[4*(k-1)+:k])
            );
        end
    endgenerate

    assign ray_start_1    = ray_start[0];
    assign shadow_start_1 = shadow_start[0];
    assign ray_start_2    = ray_start[4+:2];
    assign shadow_start_2 = shadow_start[4+:2];
    assign ray_start_3    = ray_start[8+:3];
    assign shadow_start_3 = shadow_start[8+:3];
    assign ray_start_4    = ray_start[12+:4];
    assign shadow_start_4 = shadow_start[12+:4];

endmodule

`default_nettype wire
