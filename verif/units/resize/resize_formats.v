// SPDX-License-Identifier: Apache-2.0
//
// resize_formats: one number in each kind of output format of `resize`, for the bench.
//
// Signed (s) and unsigned (u) outputs with 2 and 1 integer bits fewer, as many, and 1 more (i0 to
// i3) times 2 fraction bits fewer, as many, and 2 more (f0, f2, f4). Combinational: valid and tag
// pass straight through, so the bench of pipelined units fits, at latency 0.
//
// Parameters
//   IN_INT, IN_FRAC  format of the number, signed; IN_INT 3 or more, IN_FRAC 2 or more
//   TAG_W            bits of the tag

`default_nettype none

module resize_formats #(
    parameter IN_INT  = 11,
    parameter IN_FRAC = 20,
    parameter TAG_W   = 1
) (
    input  wire                      clk,
    input  wire                      rst,
    input  wire                      in_valid,
    input  wire [         TAG_W-1:0] in_tag,
    input  wire [IN_INT+IN_FRAC-1:0] number,
    output wire                      out_valid,
    output wire [         TAG_W-1:0] out_tag,
    output wire [IN_INT+IN_FRAC-5:0] s_i0_f0,
    output wire [IN_INT+IN_FRAC-3:0] s_i0_f2,
    output wire [IN_INT+IN_FRAC-1:0] s_i0_f4,
    output wire [IN_INT+IN_FRAC-4:0] s_i1_f0,
    output wire [IN_INT+IN_FRAC-2:0] s_i1_f2,
    output wire [IN_INT+IN_FRAC:0] s_i1_f4,
    output wire [IN_INT+IN_FRAC-3:0] s_i2_f0,
    output wire [IN_INT+IN_FRAC-1:0] s_i2_f2,
    output wire [IN_INT+IN_FRAC+1:0] s_i2_f4,
    output wire [IN_INT+IN_FRAC-2:0] s_i3_f0,
    output wire [IN_INT+IN_FRAC:0] s_i3_f2,
    output wire [IN_INT+IN_FRAC+2:0] s_i3_f4,
    output wire [IN_INT+IN_FRAC-5:0] u_i0_f0,
    output wire [IN_INT+IN_FRAC-3:0] u_i0_f2,
    output wire [IN_INT+IN_FRAC-1:0] u_i0_f4,
    output wire [IN_INT+IN_FRAC-4:0] u_i1_f0,
    output wire [IN_INT+IN_FRAC-2:0] u_i1_f2,
    output wire [IN_INT+IN_FRAC:0] u_i1_f4,
    output wire [IN_INT+IN_FRAC-3:0] u_i2_f0,
    output wire [IN_INT+IN_FRAC-1:0] u_i2_f2,
    output wire [IN_INT+IN_FRAC+1:0] u_i2_f4,
    output wire [IN_INT+IN_FRAC-2:0] u_i3_f0,
    output wire [IN_INT+IN_FRAC:0] u_i3_f2,
    output wire [IN_INT+IN_FRAC+2:0] u_i3_f4
);

    wire unused_controls = &{1'b0, clk, rst};

    assign out_valid = in_valid;
    assign out_tag = in_tag;

    resize #(.IN_INT(IN_INT), .IN_FRAC(IN_FRAC), .OUT_INT(IN_INT-2), .OUT_FRAC(IN_FRAC-2), .OUT_SIGNED(1))
        u_s_i0_f0 (.in(number), .out(s_i0_f0));
    resize #(.IN_INT(IN_INT), .IN_FRAC(IN_FRAC), .OUT_INT(IN_INT-2), .OUT_FRAC(IN_FRAC), .OUT_SIGNED(1))
        u_s_i0_f2 (.in(number), .out(s_i0_f2));
    resize #(.IN_INT(IN_INT), .IN_FRAC(IN_FRAC), .OUT_INT(IN_INT-2), .OUT_FRAC(IN_FRAC+2), .OUT_SIGNED(1))
        u_s_i0_f4 (.in(number), .out(s_i0_f4));
    resize #(.IN_INT(IN_INT), .IN_FRAC(IN_FRAC), .OUT_INT(IN_INT-1), .OUT_FRAC(IN_FRAC-2), .OUT_SIGNED(1))
        u_s_i1_f0 (.in(number), .out(s_i1_f0));
    resize #(.IN_INT(IN_INT), .IN_FRAC(IN_FRAC), .OUT_INT(IN_INT-1), .OUT_FRAC(IN_FRAC), .OUT_SIGNED(1))
        u_s_i1_f2 (.in(number), .out(s_i1_f2));
    resize #(.IN_INT(IN_INT), .IN_FRAC(IN_FRAC), .OUT_INT(IN_INT-1), .OUT_FRAC(IN_FRAC+2), .OUT_SIGNED(1))
        u_s_i1_f4 (.in(number), .out(s_i1_f4));
    resize #(.IN_INT(IN_INT), .IN_FRAC(IN_FRAC), .OUT_INT(IN_INT), .OUT_FRAC(IN_FRAC-2), .OUT_SIGNED(1))
        u_s_i2_f0 (.in(number), .out(s_i2_f0));
    resize #(.IN_INT(IN_INT), .IN_FRAC(IN_FRAC), .OUT_INT(IN_INT), .OUT_FRAC(IN_FRAC), .OUT_SIGNED(1))
        u_s_i2_f2 (.in(number), .out(s_i2_f2));
    resize #(.IN_INT(IN_INT), .IN_FRAC(IN_FRAC), .OUT_INT(IN_INT), .OUT_FRAC(IN_FRAC+2), .OUT_SIGNED(1))
        u_s_i2_f4 (.in(number), .out(s_i2_f4));
    resize #(.IN_INT(IN_INT), .IN_FRAC(IN_FRAC), .OUT_INT(IN_INT+1), .OUT_FRAC(IN_FRAC-2), .OUT_SIGNED(1))
        u_s_i3_f0 (.in(number), .out(s_i3_f0));
    resize #(.IN_INT(IN_INT), .IN_FRAC(IN_FRAC), .OUT_INT(IN_INT+1), .OUT_FRAC(IN_FRAC), .OUT_SIGNED(1))
        u_s_i3_f2 (.in(number), .out(s_i3_f2));
    resize #(.IN_INT(IN_INT), .IN_FRAC(IN_FRAC), .OUT_INT(IN_INT+1), .OUT_FRAC(IN_FRAC+2), .OUT_SIGNED(1))
        u_s_i3_f4 (.in(number), .out(s_i3_f4));
    resize #(.IN_INT(IN_INT), .IN_FRAC(IN_FRAC), .OUT_INT(IN_INT-2), .OUT_FRAC(IN_FRAC-2), .OUT_SIGNED(0))
        u_u_i0_f0 (.in(number), .out(u_i0_f0));
    resize #(.IN_INT(IN_INT), .IN_FRAC(IN_FRAC), .OUT_INT(IN_INT-2), .OUT_FRAC(IN_FRAC), .OUT_SIGNED(0))
        u_u_i0_f2 (.in(number), .out(u_i0_f2));
    resize #(.IN_INT(IN_INT), .IN_FRAC(IN_FRAC), .OUT_INT(IN_INT-2), .OUT_FRAC(IN_FRAC+2), .OUT_SIGNED(0))
        u_u_i0_f4 (.in(number), .out(u_i0_f4));
    resize #(.IN_INT(IN_INT), .IN_FRAC(IN_FRAC), .OUT_INT(IN_INT-1), .OUT_FRAC(IN_FRAC-2), .OUT_SIGNED(0))
        u_u_i1_f0 (.in(number), .out(u_i1_f0));
    resize #(.IN_INT(IN_INT), .IN_FRAC(IN_FRAC), .OUT_INT(IN_INT-1), .OUT_FRAC(IN_FRAC), .OUT_SIGNED(0))
        u_u_i1_f2 (.in(number), .out(u_i1_f2));
    resize #(.IN_INT(IN_INT), .IN_FRAC(IN_FRAC), .OUT_INT(IN_INT-1), .OUT_FRAC(IN_FRAC+2), .OUT_SIGNED(0))
        u_u_i1_f4 (.in(number), .out(u_i1_f4));
    resize #(.IN_INT(IN_INT), .IN_FRAC(IN_FRAC), .OUT_INT(IN_INT), .OUT_FRAC(IN_FRAC-2), .OUT_SIGNED(0))
        u_u_i2_f0 (.in(number), .out(u_i2_f0));
    resize #(.IN_INT(IN_INT), .IN_FRAC(IN_FRAC), .OUT_INT(IN_INT), .OUT_FRAC(IN_FRAC), .OUT_SIGNED(0))
        u_u_i2_f2 (.in(number), .out(u_i2_f2));
    resize #(.IN_INT(IN_INT), .IN_FRAC(IN_FRAC), .OUT_INT(IN_INT), .OUT_FRAC(IN_FRAC+2), .OUT_SIGNED(0))
        u_u_i2_f4 (.in(number), .out(u_i2_f4));
    resize #(.IN_INT(IN_INT), .IN_FRAC(IN_FRAC), .OUT_INT(IN_INT+1), .OUT_FRAC(IN_FRAC-2), .OUT_SIGNED(0))
        u_u_i3_f0 (.in(number), .out(u_i3_f0));
    resize #(.IN_INT(IN_INT), .IN_FRAC(IN_FRAC), .OUT_INT(IN_INT+1), .OUT_FRAC(IN_FRAC), .OUT_SIGNED(0))
        u_u_i3_f2 (.in(number), .out(u_i3_f2));
    resize #(.IN_INT(IN_INT), .IN_FRAC(IN_FRAC), .OUT_INT(IN_INT+1), .OUT_FRAC(IN_FRAC+2), .OUT_SIGNED(0))
        u_u_i3_f4 (.in(number), .out(u_i3_f4));

endmodule

`default_nettype wire
