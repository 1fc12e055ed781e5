// SPDX-License-Identifier: Apache-2.0
//
// vec_mul: point-wise product of two vectors (book 10.1.3).
//
// The full product loses the fraction bits that do not fit (floor) and saturates where the
// integer bits that do not fit were significant.
//
// Parameters
//   A_INT, A_FRAC, B_INT, B_FRAC  formats of the operands' components
//   OUT_INT, OUT_FRAC             format of the product's components
//   LANES                         components; 3 for a vector {x, y, z}, 1 for a scalar
//   SIGNED                        1: all formats are signed; 0: all are unsigned
//   TAG_W                         bits of the caller's sideband data
//
// Ports     a, b: operands; p: product, all packed alike
//
// Latency 4 (multiplier 3, result register 1), rate one vector a clock.

`default_nettype none

module vec_mul #(
    parameter A_INT    = 9,
    parameter A_FRAC   = 10,
    parameter B_INT    = 9,
    parameter B_FRAC   = 10,
    parameter OUT_INT  = 9,
    parameter OUT_FRAC = 10,
    parameter LANES    = 3,
    parameter SIGNED   = 1,
    parameter TAG_W    = 1
) (
    input  wire                                clk,
    input  wire                                rst,
    input  wire                                in_valid,
    input  wire [                   TAG_W-1:0] in_tag,
    input  wire [    LANES*(A_INT+A_FRAC)-1:0] a,
    input  wire [    LANES*(B_INT+B_FRAC)-1:0] b,
    output wire                                out_valid,
    output wire [                   TAG_W-1:0] out_tag,
    output wire [LANES*(OUT_INT+OUT_FRAC)-1:0] p
);

    localparam PRODUCT_INT = A_INT + B_INT;
    localparam PRODUCT_FRAC = A_FRAC + B_FRAC;
    localparam PRODUCT_W = PRODUCT_INT + PRODUCT_FRAC;
    localparam OUT_W = OUT_INT + OUT_FRAC;
    // resize takes signed numbers: an unsigned one gets a zero on top.
    localparam SIGN_W = SIGNED != 0 ? 0 : 1;

    wire product_valid;
    wire [TAG_W-1:0] product_tag;
    wire [LANES*PRODUCT_W-1:0] product;
    wire [LANES*OUT_W-1:0] p_next;
    reg [LANES*OUT_W-1:0] p_reg;

    mul #(
        .A_W   (A_INT + A_FRAC),
        .B_W   (B_INT + B_FRAC),
        .LANES (LANES),
        .SIGNED(SIGNED),
        .TAG_W (TAG_W)
    ) u_mul (
        .clk      (clk),
        .rst      (rst),
        .in_valid (in_valid),
        .in_tag   (in_tag),
        .a        (a),
        .b        (b),
        .out_valid(product_valid),
        .out_tag  (product_tag),
        .p        (product)
    );

    genvar lane;
    generate
        for (lane = 0; lane < LANES; lane = lane + 1) begin : g_lane
            wire [PRODUCT_W+SIGN_W-1:0] full;

            if (SIGNED != 0) begin : g_signed
                assign full = product[lane*PRODUCT_W+:PRODUCT_W];
            end else begin : g_unsigned
                assign full = {1'b0, product[lane*PRODUCT_W+:PRODUCT_W]};
            end

            resize #(
                .IN_INT    (PRODUCT_INT + SIGN_W),
                .IN_FRAC   (PRODUCT_FRAC),
                .OUT_INT   (OUT_INT),
                .OUT_FRAC  (OUT_FRAC),
                .OUT_SIGNED(SIGNED)
            ) u_resize (
                .in (full),
                .out(p_next[lane*OUT_W+:OUT_W])
            );
        end
    endgenerate

    always @(posedge clk) p_reg <= p_next;

    assign p = p_reg;

    valid_pipe #(
        .TAG_W  (TAG_W),
        .LATENCY(1)
    ) u_valid (
        .clk      (clk),
        .rst      (rst),
        .in_valid (product_valid),
        .in_tag   (product_tag),
        .out_valid(out_valid),
        .out_tag  (out_tag)
    );

endmodule

`default_nettype wire
