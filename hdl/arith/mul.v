// SPDX-License-Identifier: Apache-2.0
//
// mul: exact point-wise products of two packed vectors (book 10.1.3, before its truncation).
//
// Each product is built of pieces that fit one signed 18 x 18 multiplier of an FPGA: an operand
// wider than 18 bits is cut into unsigned pieces of 17 bits and a signed rest on top. A piece of
// at most 5 bits takes no multiplier but an adder a bit, so a signed product of up to 22 x 22 bits
// costs one multiplier, 18 x 25 two, 25 x 25 four. Squares (a = b) share their mixed pieces once
// the design is flattened.
//
// Parameters
//   A_W, B_W  bits of an operand, at most 52 signed, 51 unsigned
//   LANES     products side by side; lane 0 is in the least significant bits
//   SIGNED    1: operands and products are two's complement; 0: unsigned
//   TAG_W     bits of the caller's sideband data
//
// Ports     a, b: LANES operands each; p: LANES products of A_W + B_W bits
//
// Latency 3 (operand registers, piece registers, sum register), rate one vector a clock.

`default_nettype none

module mul #(
    parameter A_W    = 19,
    parameter B_W    = 19,
    parameter LANES  = 3,
    parameter SIGNED = 1,
    parameter TAG_W  = 1
) (
    input  wire                       clk,
    input  wire                       rst,
    input  wire                       in_valid,
    input  wire [          TAG_W-1:0] in_tag,
    input  wire [      LANES*A_W-1:0] a,
    input  wire [      LANES*B_W-1:0] b,
    output wire                       out_valid,
    output wire [          TAG_W-1:0] out_tag,
    output wire [LANES*(A_W+B_W)-1:0] p
);

    localparam PIECE_W = 17;
    // Unsigned operands are signed ones with a zero on top.
    localparam SIGN_W = SIGNED != 0 ? 0 : 1;
    localparam AX_W = A_W + SIGN_W;
    localparam BX_W = B_W + SIGN_W;
    localparam SUM_W = AX_W + BX_W;
    localparam P_W = A_W + B_W;
    localparam A_PIECES = AX_W <= PIECE_W + 1 ? 1 : (AX_W + PIECE_W - 2) / PIECE_W;
    localparam B_PIECES = BX_W <= PIECE_W + 1 ? 1 : (BX_W + PIECE_W - 2) / PIECE_W;

    genvar lane, k;
    generate
        if (A_PIECES > 3 || B_PIECES > 3) begin : g_bad_width
            mul_needs_operands_of_at_most_52_bits error ();
        end

        for (lane = 0; lane < LANES; lane = lane + 1) begin : g_lane
            reg signed [AX_W-1:0] a_reg;
            reg signed [BX_W-1:0] b_reg;
            reg [P_W-1:0] p_reg;

            if (SIGNED != 0) begin : g_signed
                always @(posedge clk) begin
                    a_reg <= a[lane*A_W+:A_W];
                    b_reg <= b[lane*B_W+:B_W];
                end
            end else begin : g_unsigned
                always @(posedge clk) begin
                    a_reg <= {1'b0, a[lane*A_W+:A_W]};
                    b_reg <= {1'b0, b[lane*B_W+:B_W]};
                end
            end

            for (k = 0; k < A_PIECES * B_PIECES; k = k + 1) begin : g_piece
                localparam A_LOW = k / B_PIECES * PIECE_W;
                localparam B_LOW = k % B_PIECES * PIECE_W;
                wire [SUM_W-1:0] term;
                wire [SUM_W-1:0] total;

                mul_piece #(
                    .A_W    (AX_W),
                    .A_LOW  (A_LOW),
                    .B_W    (BX_W),
                    .B_LOW  (B_LOW),
                    .PIECE_W(PIECE_W)
                ) u_piece (
                    .clk(clk),
                    .a  (a_reg),
                    .b  (b_reg),
                    .p  (term)
                );

                if (k == 0) begin : g_first
                    assign total = term;
                end else begin : g_next
                    assign total = g_piece[k-1].total + term;
                end
            end

            wire [SUM_W-1:0] p_next = g_piece[A_PIECES*B_PIECES-1].total;

            if (SUM_W > P_W) begin : g_spare
                wire unused_sign = &{1'b0, p_next[SUM_W-1:P_W]};
            end

            always @(posedge clk) p_reg <= p_next[P_W-1:0];

            assign p[lane*P_W+:P_W] = p_reg;
        end
    endgenerate

    valid_pipe #(
        .TAG_W  (TAG_W),
        .LATENCY(3)
    ) u_valid (
        .clk      (clk),
        .rst      (rst),
        .in_valid (in_valid),
        .in_tag   (in_tag),
        .out_valid(out_valid),
        .out_tag  (out_tag)
    );

endmodule

`default_nettype wire
