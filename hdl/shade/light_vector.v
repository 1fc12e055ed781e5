// SPDX-License-Identifier: Apache-2.0
//
// light_vector: from a hit point to a light, direction and distance (book 8.2.3).
//
// Ports
//   point       hit point X, {x, y, z}, RT_POINT
//   light       position of the light, {x, y, z}, RT_COORD
//   direction   L = normalise(light - X), {x, y, z}, RT_UNIT
//   limit       distance to the light, RT_POINT, at most RT_INFINITY: where a shadow ray ends
//   degenerate  the light is at the hit point: it has no direction and lights nothing
//
// Latency 1 (difference) + that of unit_vector + 1 (limit), rate one vector a clock.

`default_nettype none
`include "raytracer.vh"

module light_vector #(
    parameter TAG_W = 1
) (
    input  wire                      clk,
    input  wire                      rst,
    input  wire                      in_valid,
    input  wire [         TAG_W-1:0] in_tag,
    input  wire [3*`RT_POINT_W-1:0] point,
    input  wire [3*`RT_COORD_W-1:0] light,
    output wire                      out_valid,
    output wire [         TAG_W-1:0] out_tag,
    output wire [ 3*`RT_UNIT_W-1:0] direction,
    output wire [  `RT_POINT_W-1:0] limit,
    output wire                      degenerate
);

    localparam REACH_W = `RT_REACH_W;
    localparam POINT_W = `RT_POINT_W;
    localparam UNIT_W = `RT_UNIT_W;
    localparam FRAC = `RT_POINT_FRAC;
    localparam SHIFT_W = $clog2(REACH_W);
    localparam NORM_W = UNIT_W + 1;
    localparam GROW = `RT_REACH_INT - 2 + FRAC - `RT_UNIT_FRAC;
    // A shifted vector is shorter than 2, so that its norm leaves the top bit 0, which weighs 2; the
    // vector's top bit before the shift weighs 2**(RT_REACH_INT - 1).
    localparam LENGTH_W = UNIT_W + GROW;
    localparam [POINT_W-1:0] FAR = `RT_INFINITY;
    localparam FAR_W = $clog2(`RT_INFINITY);

    generate
        if (GROW < 0) begin : g_bad_knobs
            light_vector_needs_an_RT_POINT_KNOB_nearer_to_RT_UNIT_KNOB error ();
        end
        // Then no number of UNIT_W bits lies between RT_INFINITY and the power of two above it.
        if (FAR_W > UNIT_W && FAR + (1 << (FAR_W - UNIT_W)) < 1 << FAR_W) begin : g_bad_infinity
            light_vector_needs_an_RT_INFINITY_next_to_a_power_of_two error ();
        end
    endgenerate

    reg [3*REACH_W-1:0] reach_reg;
    wire [3*REACH_W-1:0] reach_next;

    genvar lane;
    generate
        for (lane = 0; lane < 3; lane = lane + 1) begin : g_lane
            wire [`RT_COORD_W-1:0] l = light[lane*`RT_COORD_W+:`RT_COORD_W];
            wire [POINT_W-1:0] x = point[lane*POINT_W+:POINT_W];
            wire [REACH_W-1:0] l_wide = {
                {REACH_W - `RT_COORD_W - FRAC + `RT_COORD_FRAC{l[`RT_COORD_W-1]}},
                l,
                {FRAC - `RT_COORD_FRAC{1'b0}}
            };
            assign reach_next[lane*REACH_W+:REACH_W] =
                l_wide - {{REACH_W - POINT_W{x[POINT_W-1]}}, x};
        end
    endgenerate

    always @(posedge clk) reach_reg <= reach_next;

    wire reach_valid;
    wire [TAG_W-1:0] reach_tag;

    valid_pipe #(
        .TAG_W  (TAG_W),
        .LATENCY(1)
    ) u_reach (
        .clk      (clk),
        .rst      (rst),
        .in_valid (in_valid),
        .in_tag   (in_tag),
        .out_valid(reach_valid),
        .out_tag  (reach_tag)
    );

    wire unit_valid;
    wire [TAG_W-1:0] unit_tag;
    wire [3*UNIT_W-1:0] unit;
    wire [NORM_W-1:0] norm;
    wire [SHIFT_W-1:0] shift;
    wire unit_degenerate;

    unit_vector #(
        .IN_W (REACH_W),
        .TAG_W(TAG_W)
    ) u_unit (
        .clk       (clk),
        .rst       (rst),
        .in_valid  (reach_valid),
        .in_tag    (reach_tag),
        .vector    (reach_reg),
        .out_valid (unit_valid),
        .out_tag   (unit_tag),
        .unit      (unit),
        .norm      (norm),
        .shift     (shift),
        .degenerate(unit_degenerate)
    );

    wire unused_norm = norm[NORM_W-1];
    wire [LENGTH_W-1:0] length = {norm[UNIT_W-1:0], {GROW{1'b0}}} >> shift;
    wire far = length[LENGTH_W-1:FAR_W] != {LENGTH_W - FAR_W{1'b0}};
    wire [POINT_W-1:0] nearer = far ? FAR : {{POINT_W - FAR_W{1'b0}}, length[FAR_W-1:0]};
    reg [3*UNIT_W-1:0] direction_reg;
    reg [POINT_W-1:0] limit_reg;
    reg degenerate_reg;

    always @(posedge clk) begin
        direction_reg  <= unit;
        limit_reg      <= nearer;
        degenerate_reg <= unit_degenerate;
    end

    valid_pipe #(
        .TAG_W  (TAG_W),
        .LATENCY(1)
    ) u_limit (
        .clk      (clk),
        .rst      (rst),
        .in_valid (unit_valid),
        .in_tag   (unit_tag),
        .out_valid(out_valid),
        .out_tag  (out_tag)
    );

    assign direction  = direction_reg;
    assign limit      = limit_reg;
    assign degenerate = degenerate_reg;

endmodule

`default_nettype wire
