// SPDX-License-Identifier: Apache-2.0
//
// norm: length of a vector (book 10.1.5.3).
//
//     length = floor(sqrt(x^2 + y^2 + z^2) * 2^(FRAC+GUARD))
//
// The squares are summed exactly; the sum is the radicand [2(INT+1).2(FRAC+GUARD)] of the square
// root, [20.20] by default as in the book.
//
// Parameters
//   INT, FRAC  format of the components, signed
//   GUARD      fraction bits of the length beyond FRAC
//   TAG_W      bits of the caller's sideband data
//
// Ports     a: vector {x, y, z}; length: unsigned [INT+1.FRAC+GUARD]
//
// Latency INT + FRAC + GUARD + 6 (multiplier 3, sum 1, square root INT + FRAC + GUARD + 2),
// rate one norm a clock.

`default_nettype none

module norm #(
    parameter INT   = 9,
    parameter FRAC  = 10,
    parameter GUARD = 0,
    parameter TAG_W = 1
) (
    input  wire                    clk,
    input  wire                    rst,
    input  wire                    in_valid,
    input  wire [       TAG_W-1:0] in_tag,
    input  wire [3*(INT+FRAC)-1:0] a,
    output wire                    out_valid,
    output wire [       TAG_W-1:0] out_tag,
    output wire [INT+FRAC+GUARD:0] length
);

    localparam W = INT + FRAC;
    localparam SQUARE_W = 2 * W;
    localparam ROOT_W = W + 1 + GUARD;
    localparam D_W = 2 * ROOT_W;

    wire square_valid;
    wire [TAG_W-1:0] square_tag;
    wire [3*SQUARE_W-1:0] square;
    wire sum_valid;
    wire [TAG_W-1:0] sum_tag;
    // A square is at most 2^(SQUARE_W-2), so three of them need no further bit.
    reg [SQUARE_W-1:0] sum_reg;
    wire [ROOT_W:0] unused_remainder;

    mul #(
        .A_W   (W),
        .B_W   (W),
        .LANES (3),
        .SIGNED(1),
        .TAG_W (TAG_W)
    ) u_mul (
        .clk      (clk),
        .rst      (rst),
        .in_valid (in_valid),
        .in_tag   (in_tag),
        .a        (a),
        .b        (a),
        .out_valid(square_valid),
        .out_tag  (square_tag),
        .p        (square)
    );

    always @(posedge clk)
        sum_reg <= square[2*SQUARE_W+:SQUARE_W] + square[SQUARE_W+:SQUARE_W] + square[0+:SQUARE_W];

    valid_pipe #(
        .TAG_W  (TAG_W),
        .LATENCY(1)
    ) u_sum_valid (
        .clk      (clk),
        .rst      (rst),
        .in_valid (square_valid),
        .in_tag   (square_tag),
        .out_valid(sum_valid),
        .out_tag  (sum_tag)
    );

    sqrt #(
        .D_W  (D_W),
        .TAG_W(TAG_W)
    ) u_sqrt (
        .clk      (clk),
        .rst      (rst),
        .in_valid (sum_valid),
        .in_tag   (sum_tag),
        .radicand ({{D_W - SQUARE_W{1'b0}}, sum_reg} << (2 * GUARD)),
        .out_valid(out_valid),
        .out_tag  (out_tag),
        .root     (length),
        .remainder(unused_remainder)
    );

endmodule

`default_nettype wire
