// SPDX-License-Identifier: Apache-2.0
//
// div: signed division a / b (book 10.1.4).
//
// The quotient is truncated toward zero and saturated. A division by zero raises div_by_zero and
// gives the largest value for a > 0, the smallest for a < 0 and 0 for 0 / 0.
//
// The magnitudes are divided (div_core) and the sign is put back. The quotient is out of range
// exactly where |a| >= |b| 2^(INT-1); the smallest value, -2^(INT-1), is in range but is also what
// a quotient of that magnitude saturates to, so one comparison decides for both signs.
//
// Parameters
//   INT, FRAC  format of a and b, signed
//   GUARD      fraction bits of the quotient beyond FRAC
//   TAG_W      bits of the caller's sideband data
//
// Ports     quotient: signed [INT.FRAC+GUARD]
//
// Latency INT + FRAC + GUARD + 1 (magnitudes 1, one a quotient bit but for the sign, sign 1),
// rate one division a clock.

`default_nettype none

module div #(
    parameter INT   = 9,
    parameter FRAC  = 10,
    parameter GUARD = 0,
    parameter TAG_W = 1
) (
    input  wire                      clk,
    input  wire                      rst,
    input  wire                      in_valid,
    input  wire [         TAG_W-1:0] in_tag,
    input  wire [      INT+FRAC-1:0] a,
    input  wire [      INT+FRAC-1:0] b,
    output wire                      out_valid,
    output wire [         TAG_W-1:0] out_tag,
    output wire [INT+FRAC+GUARD-1:0] quotient,
    output wire                      div_by_zero
);

    localparam W = INT + FRAC;
    localparam OUT_W = W + GUARD;
    // Bits of the magnitude of the quotient.
    localparam QUOT_W = OUT_W - 1;
    localparam NUM_W = W + FRAC + GUARD;

    generate
        if (INT < 1 || INT + FRAC + GUARD < 2) begin : g_bad_format
            div_needs_INT_of_1_or_more_and_a_quotient_of_2_bits_or_more error ();
        end
    endgenerate

    // Magnitudes: W unsigned bits hold 2^(W-1) too.
    reg [W-1:0] a_mag_reg;
    reg [W-1:0] b_mag_reg;
    reg negative_reg;

    always @(posedge clk) begin
        a_mag_reg <= a[W-1] ? -a : a;
        b_mag_reg <= b[W-1] ? -b : b;
        negative_reg <= a[W-1] ^ b[W-1];
    end

    wire mag_valid;
    wire [TAG_W-1:0] mag_tag;

    valid_pipe #(
        .TAG_W  (TAG_W),
        .LATENCY(1)
    ) u_mag_valid (
        .clk      (clk),
        .rst      (rst),
        .in_valid (in_valid),
        .in_tag   (in_tag),
        .out_valid(mag_valid),
        .out_tag  (mag_tag)
    );

    wire [NUM_W-1:0] num = {{NUM_W - W{1'b0}}, a_mag_reg} << (FRAC + GUARD);
    wire [NUM_W-1:0] num_high = num >> QUOT_W;
    wire [W-1:0] upper = num_high[W-1:0];
    wire a_zero = a_mag_reg == {W{1'b0}};
    wire b_zero = b_mag_reg == {W{1'b0}};
    // upper >= |b| is the same as |a| >= |b| 2^(INT-1).
    wire overflow = upper >= b_mag_reg;

    wire quot_valid;
    wire [TAG_W-1:0] quot_tag;
    wire quot_negative;
    wire quot_overflow;
    wire quot_zero;
    wire quot_by_zero;
    wire [QUOT_W-1:0] magnitude;
    wire [W-1:0] unused_remainder;

    div_core #(
        .DEN_W (W),
        .QUOT_W(QUOT_W),
        .LANES (1),
        .TAG_W (TAG_W + 4)
    ) u_div_core (
        .clk      (clk),
        .rst      (rst),
        .in_valid (mag_valid),
        .in_tag   ({mag_tag, negative_reg, overflow, a_zero, b_zero}),
        .upper    (upper),
        .lower    (num[QUOT_W-1:0]),
        .den      (b_mag_reg),
        .out_valid(quot_valid),
        .out_tag  ({quot_tag, quot_negative, quot_overflow, quot_zero, quot_by_zero}),
        .quotient (magnitude),
        .remainder(unused_remainder)
    );

    wire [OUT_W-1:0] positive = {1'b0, magnitude};
    reg [OUT_W-1:0] quotient_reg;
    reg div_by_zero_reg;

    generate
        if (NUM_W > W) begin : g_spare
            wire unused_high = &{1'b0, num_high[NUM_W-1:W]};
        end
    endgenerate

    always @(posedge clk) begin
        div_by_zero_reg <= quot_by_zero;
        if (quot_zero) quotient_reg <= {OUT_W{1'b0}};
        else if (quot_overflow) quotient_reg <= {quot_negative, {QUOT_W{!quot_negative}}};
        else quotient_reg <= quot_negative ? -positive : positive;
    end

    assign quotient = quotient_reg;
    assign div_by_zero = div_by_zero_reg;

    valid_pipe #(
        .TAG_W  (TAG_W),
        .LATENCY(1)
    ) u_valid (
        .clk      (clk),
        .rst      (rst),
        .in_valid (quot_valid),
        .in_tag   (quot_tag),
        .out_valid(out_valid),
        .out_tag  (out_tag)
    );

endmodule

`default_nettype wire
