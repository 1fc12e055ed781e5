// SPDX-License-Identifier: Apache-2.0
//
// normalise: a vector divided by its norm (book 10.1.5.3).
//
//     unit = +-floor(|component| * 2^(OUT_FRAC+GUARD) / norm), component by component
//
// that is, truncated toward zero, with the norm as the unit `norm` gives it. No component is
// larger than the norm, so every result lies between -1 and 1. The zero vector gives zero and
// raises `degenerate`. Behind a block_shift short vectors keep their full precision.
//
// Parameters
//   INT, FRAC  format of the components, signed
//   OUT_FRAC   fraction bits of the result
//   GUARD      fraction bits of the norm beyond FRAC
//   TAG_W      bits of the caller's sideband data
//
// Ports     a: vector {x, y, z}; unit: vector, signed [2.OUT_FRAC];
//           norm: unsigned [INT+1.FRAC+GUARD]; degenerate: the vector is zero
//
// Latency INT + FRAC + GUARD + OUT_FRAC + 8 (norm INT + FRAC + GUARD + 6, division OUT_FRAC + 1,
// sign 1), rate one vector a clock.

`default_nettype none

module normalise #(
    parameter INT      = 9,
    parameter FRAC     = 10,
    parameter OUT_FRAC = 10,
    parameter GUARD    = 0,
    parameter TAG_W    = 1
) (
    input  wire                      clk,
    input  wire                      rst,
    input  wire                      in_valid,
    input  wire [         TAG_W-1:0] in_tag,
    input  wire [  3*(INT+FRAC)-1:0] a,
    output wire                      out_valid,
    output wire [         TAG_W-1:0] out_tag,
    output wire [3*(OUT_FRAC+2)-1:0] unit,
    output wire [  INT+FRAC+GUARD:0] norm,
    output wire                      degenerate
);

    localparam W = INT + FRAC;
    localparam ROOT_W = W + 1 + GUARD;
    localparam QUOT_W = OUT_FRAC + 1;
    localparam UNIT_W = OUT_FRAC + 2;

    wire norm_valid;
    wire [TAG_W-1:0] norm_tag;
    wire [ROOT_W-1:0] norm_root;
    // Magnitudes: W unsigned bits hold 2^(W-1) too.
    wire [2:0] in_negative;
    wire [3*W-1:0] in_magnitude;
    wire [2:0] norm_negative;
    wire [3*W-1:0] norm_magnitude;

    wire quot_valid;
    wire [TAG_W-1:0] quot_tag;
    wire [2:0] quot_negative;
    wire [ROOT_W-1:0] quot_root;
    wire quot_degenerate = quot_root == {ROOT_W{1'b0}};
    wire [3*ROOT_W-1:0] upper;
    wire [3*QUOT_W-1:0] lower;
    wire [3*QUOT_W-1:0] quotient;
    wire [3*ROOT_W-1:0] unused_remainder;

    reg [3*UNIT_W-1:0] unit_reg;
    reg [ROOT_W-1:0] norm_reg;
    reg degenerate_reg;

    norm #(
        .INT  (INT),
        .FRAC (FRAC),
        .GUARD(GUARD),
        .TAG_W(TAG_W + 3 + 3 * W)
    ) u_norm (
        .clk      (clk),
        .rst      (rst),
        .in_valid (in_valid),
        .in_tag   ({in_tag, in_negative, in_magnitude}),
        .a        (a),
        .out_valid(norm_valid),
        .out_tag  ({norm_tag, norm_negative, norm_magnitude}),
        .length   (norm_root)
    );

    genvar lane;
    generate
        for (lane = 0; lane < 3; lane = lane + 1) begin : g_lane
            wire [W-1:0] component = a[lane*W+:W];
            assign in_negative[lane] = component[W-1];
            assign in_magnitude[lane*W+:W] = component[W-1] ? -component : component;

            // The dividend is magnitude * 2^(GUARD+OUT_FRAC), cut above its low QUOT_W bits; its
            // upper half is at most norm / 2, so the quotient fits.
            wire [ROOT_W-1:0] scaled =
                {{GUARD + 1{1'b0}}, norm_magnitude[lane*W+:W]} << GUARD;
            wire [ROOT_W+OUT_FRAC-1:0] dividend = {{OUT_FRAC{1'b0}}, scaled} << OUT_FRAC;
            assign upper[lane*ROOT_W+:ROOT_W] = {1'b0, dividend[ROOT_W+OUT_FRAC-1:QUOT_W]};
            assign lower[lane*QUOT_W+:QUOT_W] = dividend[QUOT_W-1:0];

            wire [UNIT_W-1:0] positive = {1'b0, quotient[lane*QUOT_W+:QUOT_W]};

            always @(posedge clk) begin
                if (quot_degenerate) unit_reg[lane*UNIT_W+:UNIT_W] <= {UNIT_W{1'b0}};
                else unit_reg[lane*UNIT_W+:UNIT_W] <= quot_negative[lane] ? -positive : positive;
            end
        end
    endgenerate

    div_core #(
        .DEN_W (ROOT_W),
        .QUOT_W(QUOT_W),
        .LANES (3),
        .TAG_W (TAG_W + 3 + ROOT_W)
    ) u_div_core (
        .clk      (clk),
        .rst      (rst),
        .in_valid (norm_valid),
        .in_tag   ({norm_tag, norm_negative, norm_root}),
        .upper    (upper),
        .lower    (lower),
        .den      (norm_root),
        .out_valid(quot_valid),
        .out_tag  ({quot_tag, quot_negative, quot_root}),
        .quotient (quotient),
        .remainder(unused_remainder)
    );

    always @(posedge clk) begin
        norm_reg <= quot_root;
        degenerate_reg <= quot_degenerate;
    end

    assign unit = unit_reg;
    assign norm = norm_reg;
    assign degenerate = degenerate_reg;

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
