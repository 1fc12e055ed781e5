// SPDX-License-Identifier: Apache-2.0
//
// colour_add: sum of two colours, saturated; no term is negative, so the order of sums is no matter.
//
// Ports     a, b, sum: {r, g, b}, RT_SHADE
//
// Latency 1, rate one sum a clock.

`default_nettype none
`include "raytracer.vh"

module colour_add #(
    parameter TAG_W = 1
) (
    input  wire                      clk,
    input  wire                      rst,
    input  wire                      in_valid,
    input  wire [         TAG_W-1:0] in_tag,
    input  wire [3*`RT_SHADE_W-1:0] a,
    input  wire [3*`RT_SHADE_W-1:0] b,
    output wire                      out_valid,
    output wire [         TAG_W-1:0] out_tag,
    output wire [3*`RT_SHADE_W-1:0] sum
);

    localparam W = `RT_SHADE_W;

    reg [3*W-1:0] sum_reg;

    genvar lane;
    generate
        for (lane = 0; lane < 3; lane = lane + 1) begin : g_lane
            wire [W:0] wide = {1'b0, a[lane*W+:W]} + {1'b0, b[lane*W+:W]};

            always @(posedge clk) sum_reg[lane*W+:W] <= wide[W-1:0] | {W{wide[W]}};
        end
    endgenerate

    valid_pipe #(
        .TAG_W  (TAG_W),
        .LATENCY(1)
    ) u_valid (
        .clk      (clk),
        .rst      (rst),
        .in_valid (in_valid),
        .in_tag   (in_tag),
        .out_valid(out_valid),
        .out_tag  (out_tag)
    );

    assign sum = sum_reg;

endmodule

`default_nettype wire
