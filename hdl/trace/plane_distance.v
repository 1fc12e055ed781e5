// SPDX-License-Identifier: Apache-2.0
//
// plane_distance: how far along a ray the plane of a triangle is, |N.A| / |N.I|, truncated.
//
// Parameters
//   QUOTIENT_W  bits of the distance, of which RT_POINT_FRAC are fraction
//
// Ports
//   behind    N.A, exact: N the unit normal (RT_UNIT), A a corner seen from the ray's origin, as a mantissa
//             of RT_UNIT_W bits of which all but the sign are fraction, shifted by `shift` (see corners)
//   facing    N.I, exact: I the ray's direction (RT_UNIT); both are sums of three products of RT_UNIT_W bits
//   distance  0 where it is not possible
//   away      N.I > 0: the ray meets the back of the triangle
//   possible  the plane is not behind the ray, unless by 0, and the distance fits; no ray is parallel:
//             |N.I|, truncated to RT_FACING, is not 0
//
// |N.A| is truncated and saturated to RT_PLANE. Latency 2 + QUOTIENT_W, rate one distance a clock.

`default_nettype none
`include "raytracer.vh"

module plane_distance #(
    parameter QUOTIENT_W = 8 + `RT_POINT_FRAC,
    parameter SHIFT_W    = $clog2(`RT_REACH_W)
) (
    input  wire                  clk,
    input  wire                  rst,
    input  wire [ 2*`RT_UNIT_W:0] behind,
    input  wire [ 2*`RT_UNIT_W:0] facing,
    input  wire [   SHIFT_W-1:0] shift,
    output wire [QUOTIENT_W-1:0] distance,
    output wire                  away,
    output wire                  possible
);

    localparam UNIT_W = `RT_UNIT_W;
    // Bits of a sum's magnitude, which is below 3 times 2^(2 UNIT_W - 2).
    localparam SUM_W = 2 * UNIT_W;
    localparam FRAC = `RT_POINT_FRAC;
    localparam PLANE_W = `RT_PLANE_W;
    localparam FACING_W = `RT_FACING_W;
    localparam NEAR_INT = QUOTIENT_W - FRAC;
    // Weight of a mantissa's lowest bit in RT_PLANE's, before its own shift.
    localparam WEIGHT = `RT_REACH_INT - 1 + `RT_PLANE_FRAC - `RT_UNIT_FRAC - UNIT_W + 1;
    localparam BEHIND_W = SUM_W + WEIGHT;
    localparam FACING_DROP = 2 * `RT_UNIT_FRAC - `RT_FACING_FRAC;

    generate
        if (NEAR_INT < 1 || PLANE_W < NEAR_INT + FACING_W || FACING_DROP < 0
            || BEHIND_W <= PLANE_W) begin : g_bad_formats
            plane_distance_needs_formats_in_which_its_quotient_fits error ();
        end
    endgenerate

    // ------------------------------------------------ magnitudes and signs
    reg [SUM_W-1:0] behind_reg;
    reg [SUM_W-1:0] facing_reg;
    reg [SHIFT_W-1:0] shift_reg;
    reg [1:0] side_reg;

    wire behind_negative = behind[SUM_W];
    wire facing_negative = facing[SUM_W];
    wire facing_positive = !facing_negative && facing != {SUM_W + 1{1'b0}};
    wire [SUM_W-1:0] behind_part = behind[SUM_W-1:0];
    wire [SUM_W-1:0] facing_part = facing[SUM_W-1:0];

    always @(posedge clk) begin
        behind_reg <= behind_negative ? -behind_part : behind_part;
        facing_reg <= facing_negative ? -facing_part : facing_part;
        shift_reg  <= shift;
        side_reg   <= {facing_positive, facing_positive != behind_negative};
    end

    // ------------------------------------------------ both in their formats
    wire [BEHIND_W-1:0] plane_wide;
    reg [PLANE_W-1:0] plane_reg;
    reg [FACING_W-1:0] across_reg;
    reg [1:0] plane_side_reg;

    generate
        if (WEIGHT > 0) begin : g_raise
            assign plane_wide = {behind_reg, {WEIGHT{1'b0}}} >> shift_reg;
        end else begin : g_lower
            assign plane_wide = behind_reg[SUM_W-1:-WEIGHT] >> shift_reg;
        end
        if (WEIGHT < 0) begin : g_drop_behind
            wire unused_behind = &{1'b0, behind_reg[-WEIGHT-1:0]};
        end
        if (FACING_DROP > 0) begin : g_drop_facing
            wire unused_facing = &{1'b0, facing_reg[FACING_DROP-1:0]};
        end
    endgenerate

    wire plane_over = plane_wide[BEHIND_W-1:PLANE_W] != {BEHIND_W - PLANE_W{1'b0}};
    wire [SUM_W-FACING_DROP-1:0] across_wide = facing_reg[SUM_W-1:FACING_DROP];
    wire across_over =
        across_wide[SUM_W-FACING_DROP-1:FACING_W] != {SUM_W - FACING_DROP - FACING_W{1'b0}};

    always @(posedge clk) begin
        plane_reg      <= plane_wide[PLANE_W-1:0] | {PLANE_W{plane_over}};
        across_reg     <= across_wide[FACING_W-1:0] | {FACING_W{across_over}};
        plane_side_reg <= side_reg;
    end

    // ------------------------------------------------ quotient
    // Where it is not below 2^NEAR_INT, or the ray is parallel, the division means nothing.
    wire fits = {{FACING_W{1'b0}}, plane_reg}
              < {{PLANE_W - NEAR_INT{1'b0}}, across_reg, {NEAR_INT{1'b0}}};
    wire unused_valid;
    wire [FACING_W-1:0] unused_rest;
    wire unused_upper = &{1'b0, plane_reg[PLANE_W-1:NEAR_INT+FACING_W]};
    wire ahead;
    wire quotient_fits;
    wire [QUOTIENT_W-1:0] quotient;

    div_core #(
        .DEN_W (FACING_W),
        .QUOT_W(QUOTIENT_W),
        .TAG_W (3)
    ) u_quotient (
        .clk      (clk),
        .rst      (rst),
        .in_valid (1'b0),
        .in_tag   ({plane_side_reg, fits}),
        .upper    (plane_reg[NEAR_INT+:FACING_W]),
        .lower    ({plane_reg[NEAR_INT-1:0], {FRAC{1'b0}}}),
        .den      (across_reg),
        .out_valid(unused_valid),
        .out_tag  ({away, ahead, quotient_fits}),
        .quotient (quotient),
        .remainder(unused_rest)
    );

    assign distance = quotient & {QUOTIENT_W{quotient_fits}};
    assign possible = ahead && quotient_fits;

endmodule

`default_nettype wire
