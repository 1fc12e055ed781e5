// SPDX-License-Identifier: Apache-2.0
//
// mul_piece: the product of one piece of each operand, at its place in the whole product (see mul).
//
// A piece is PIECE_W unsigned bits of the operand from bit LOW on, or the signed rest of it where
// no more than PIECE_W + 1 bits are left. The product of two pieces is one signed multiplication
// of at most PIECE_W + 1 bits; where a piece has at most 5 bits it is a sum of shifted copies of
// the other, which spares a multiplier of the FPGA.
//
// Parameters
//   A_W, B_W      bits of the whole signed operands
//   A_LOW, B_LOW  first bit of the piece
//   PIECE_W       bits of a piece that is not the last one
//
// Ports     a, b: whole operands; p: A_W + B_W bits, the sum of all p is the product of a and b
//
// Latency 1, rate one a clock.

`default_nettype none

module mul_piece #(
    parameter A_W     = 19,
    parameter A_LOW   = 0,
    parameter B_W     = 19,
    parameter B_LOW   = 17,
    parameter PIECE_W = 17
) (
    input  wire               clk,
    input  wire [    A_W-1:0] a,
    input  wire [    B_W-1:0] b,
    output wire [A_W+B_W-1:0] p
);

    localparam A_LAST = A_W - A_LOW <= PIECE_W + 1 ? 1 : 0;
    localparam B_LAST = B_W - B_LOW <= PIECE_W + 1 ? 1 : 0;
    // Signed widths: the pieces below the last one get a zero on top.
    localparam AS_W = A_LAST != 0 ? A_W - A_LOW : PIECE_W + 1;
    localparam BS_W = B_LAST != 0 ? B_W - B_LOW : PIECE_W + 1;
    localparam SHORT_W = 5;

    wire signed [AS_W-1:0] a_piece;
    wire signed [BS_W-1:0] b_piece;
    wire signed [AS_W+BS_W-1:0] product_next;
    reg signed [AS_W+BS_W-1:0] product_reg;

    generate
        if (A_LAST != 0) begin : g_a_rest
            assign a_piece = a[A_W-1:A_LOW];
        end else begin : g_a_piece
            assign a_piece = {1'b0, a[A_LOW+:PIECE_W]};
        end

        if (B_LAST != 0) begin : g_b_rest
            assign b_piece = b[B_W-1:B_LOW];
        end else begin : g_b_piece
            assign b_piece = {1'b0, b[B_LOW+:PIECE_W]};
        end

        if (A_W != AS_W || B_W != BS_W) begin : g_rest
            wire unused_bits = &{1'b0, a, b};
        end

        if (AS_W <= SHORT_W || BS_W <= SHORT_W) begin : g_short
            localparam S_W = AS_W < BS_W ? AS_W : BS_W;
            localparam L_W = AS_W < BS_W ? BS_W : AS_W;
            wire signed [S_W-1:0] short_piece;
            wire signed [L_W-1:0] long_piece;
            wire signed [AS_W+BS_W-1:0] copy = {{S_W{long_piece[L_W-1]}}, long_piece};

            if (AS_W < BS_W) begin : g_short_a
                assign short_piece = a_piece;
                assign long_piece  = b_piece;
            end else begin : g_short_b
                assign short_piece = b_piece;
                assign long_piece  = a_piece;
            end

            // The top bit of a two's complement number counts negative.
            function [AS_W+BS_W-1:0] shift_and_add;
                input [S_W-1:0] short_bits;
                input [AS_W+BS_W-1:0] addend;
                integer i;
                begin
                    shift_and_add = {AS_W + BS_W{1'b0}};
                    for (i = 0; i < S_W - 1; i = i + 1)
                        if (short_bits[i]) shift_and_add = shift_and_add + (addend << i);
                    if (short_bits[S_W-1])
                        shift_and_add = shift_and_add - (addend << (S_W - 1));
                end
            endfunction

            assign product_next = shift_and_add(short_piece, copy);
        end else begin : g_multiplier
            assign product_next = a_piece * b_piece;
        end

        if (AS_W + BS_W == A_W + B_W) begin : g_all
            assign p = product_reg;
        end else begin : g_shift
            wire [A_W+B_W-1:0] extended =
                {{A_W + B_W - AS_W - BS_W{product_reg[AS_W+BS_W-1]}}, product_reg};
            assign p = extended << (A_LOW + B_LOW);
        end
    endgenerate

    always @(posedge clk) product_reg <= product_next;

endmodule

`default_nettype wire
