// SPDX-License-Identifier: Apache-2.0
//
// vec_scale: a scalar times a vector (book 10.1.3), each component truncated (floor) and saturated.
//
// Parameters
//   A_INT, A_FRAC      format of the vector's components
//   B_INT, B_FRAC      format of the scalar
//   OUT_INT, OUT_FRAC  format of the product's components
//   LANES              components of the vector
//   SIGNED             1: all formats are signed; 0: all are unsigned
//   TAG_W              bits of the caller's sideband data
//
// Ports     s: scalar; a: vector; p: product
//
// Latency 4, rate one vector a clock.

`default_nettype none

module vec_scale #(
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
    input  wire [            B_INT+B_FRAC-1:0] s,
    input  wire [    LANES*(A_INT+A_FRAC)-1:0] a,
    output wire                                out_valid,
    output wire [                   TAG_W-1:0] out_tag,
    output wire [LANES*(OUT_INT+OUT_FRAC)-1:0] p
);

    vec_mul #(
        .A_INT   (A_INT),
        .A_FRAC  (A_FRAC),
        .B_INT   (B_INT),
        .B_FRAC  (B_FRAC),
        .OUT_INT (OUT_INT),
        .OUT_FRAC(OUT_FRAC),
        .LANES   (LANES),
        .SIGNED  (SIGNED),
        .TAG_W   (TAG_W)
    ) u_vec_mul (
        .clk      (clk),
        .rst      (rst),
        .in_valid (in_valid),
        .in_tag   (in_tag),
        .a        (a),
        .b        ({LANES{s}}),
        .out_valid(out_valid),
        .out_tag  (out_tag),
        .p        (p)
    );

endmodule

`default_nettype wire
