// SPDX-License-Identifier: Apache-2.0
//
// highlight: the sixteenth power of a cosine, the book's shininess (7.1.3): four squarings.
//
// Ports     cosine, power: RT_COSINE; each square is floored and saturated
//
// Latency 4 x 4 = 16, rate one power a clock.

`default_nettype none
`include "raytracer.vh"

module highlight #(
    parameter TAG_W = 1
) (
    input  wire                     clk,
    input  wire                     rst,
    input  wire                     in_valid,
    input  wire [        TAG_W-1:0] in_tag,
    input  wire [`RT_COSINE_W-1:0] cosine,
    output wire                     out_valid,
    output wire [        TAG_W-1:0] out_tag,
    output wire [`RT_COSINE_W-1:0] power
);

    localparam SQUARINGS = 4;
    localparam W = `RT_COSINE_W;

    wire [SQUARINGS:0] valid;
    wire [(SQUARINGS+1)*TAG_W-1:0] tag;
    wire [(SQUARINGS+1)*W-1:0] value;

    assign valid[0]     = in_valid;
    assign tag[0+:TAG_W] = in_tag;
    assign value[0+:W]  = cosine;

    genvar k;
    generate
        for (k = 0; k < SQUARINGS; k = k + 1) begin : g_square
            vec_mul #(
                .A_INT   (`RT_COSINE_INT),
                .A_FRAC  (`RT_COSINE_FRAC),
                .B_INT   (`RT_COSINE_INT),
                .B_FRAC  (`RT_COSINE_FRAC),
                .OUT_INT (`RT_COSINE_INT),
                .OUT_FRAC(`RT_COSINE_FRAC),
                .LANES   (1),
                .SIGNED  (0),
                .TAG_W   (TAG_W)
            ) u_square (
                .clk      (clk),
                .rst      (rst),
                .in_valid (valid[k]),
                .in_tag   (tag[k*TAG_W+:TAG_W]),
                .a        (value[k*W+:W]),
                .b        (value[k*W+:W]),
                .out_valid(valid[k+1]),
                .out_tag  (tag[(k+1)*TAG_W+:TAG_W]),
                .p        (value[(k+1)*W+:W])
            );
        end
    endgenerate

    assign out_valid = valid[SQUARINGS];
    assign out_tag   = tag[SQUARINGS*TAG_W+:TAG_W];
    assign power     = value[SQUARINGS*W+:W];

endmodule

`default_nettype wire
