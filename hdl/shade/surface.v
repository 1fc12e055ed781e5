// SPDX-License-Identifier: Apache-2.0
//
// surface: point and normal where a ray hits a sphere (book 8.2.3).
//
// With q from the ray's nearest point to the center and h half of the chord, the center seen from
// the hit point is m = q + h I at the near end of the chord and m = q - h I at the far one, so
//
//     X = center - m        N = -m / r (near), m / r (far), turned toward the viewer
//
// Taking both from the center keeps X on the sphere and N a unit vector however far the viewer is.
//
// Ports
//   direction   I, {x, y, z}, RT_UNIT
//   offset, half_chord, leaving   from sphere_intersect
//   center      RT_COORD; inv_radius: RT_INV_RADIUS
//   point       X, {x, y, z}, RT_POINT
//   normal      N, {x, y, z}, RT_UNIT
//
// Latency 4 (h I) + 1 (m) + 4 (N) = 9, rate one hit a clock.

`default_nettype none
`include "raytracer.vh"

module surface #(
    parameter TAG_W = 1
) (
    input  wire                         clk,
    input  wire                         rst,
    input  wire                         in_valid,
    input  wire [            TAG_W-1:0] in_tag,
    input  wire [    3*`RT_UNIT_W-1:0] direction,
    input  wire [  3*`RT_OFFSET_W-1:0] offset,
    input  wire [`RT_HALF_CHORD_W-1:0] half_chord,
    input  wire                         leaving,
    input  wire [   3*`RT_COORD_W-1:0] center,
    input  wire [`RT_INV_RADIUS_W-1:0] inv_radius,
    output wire                         out_valid,
    output wire [            TAG_W-1:0] out_tag,
    output wire [   3*`RT_POINT_W-1:0] point,
    output wire [    3*`RT_UNIT_W-1:0] normal
);

    localparam OFFSET_W = `RT_OFFSET_W;
    localparam POINT_W = `RT_POINT_W;
    localparam FRAC = `RT_POINT_FRAC;
    localparam CENTER_W = 3 * `RT_COORD_W;

    // h I
    wire chord_valid;
    wire [TAG_W-1:0] chord_tag;
    wire chord_leaving;
    wire [3*OFFSET_W-1:0] chord_offset;
    wire [CENTER_W-1:0] chord_center;
    wire [`RT_INV_RADIUS_W-1:0] chord_inv_radius;
    wire [3*OFFSET_W-1:0] chord;

    vec_scale #(
        .A_INT   (`RT_UNIT_INT),
        .A_FRAC  (`RT_UNIT_FRAC),
        .B_INT   (`RT_HALF_CHORD_INT + 1),
        .B_FRAC  (FRAC),
        .OUT_INT (`RT_OFFSET_INT),
        .OUT_FRAC(FRAC),
        .TAG_W   (1 + 3*OFFSET_W + CENTER_W + `RT_INV_RADIUS_W + TAG_W)
    ) u_chord (
        .clk      (clk),
        .rst      (rst),
        .in_valid (in_valid),
        .in_tag   ({leaving, offset, center, inv_radius, in_tag}),
        .a        (direction),
        .s        ({1'b0, half_chord}),
        .out_valid(chord_valid),
        .out_tag  ({chord_leaving, chord_offset, chord_center, chord_inv_radius, chord_tag}),
        .p        (chord)
    );

    // m, and m turned toward the viewer; X = center - m
    wire [3*OFFSET_W-1:0] turned_next;
    wire [3*POINT_W-1:0] point_next;
    reg [3*OFFSET_W-1:0] turned_reg;
    reg [3*POINT_W-1:0] point_reg;

    genvar lane;
    generate
        for (lane = 0; lane < 3; lane = lane + 1) begin : g_lane
            wire [OFFSET_W-1:0] q = chord_offset[lane*OFFSET_W+:OFFSET_W];
            wire [OFFSET_W-1:0] h = chord[lane*OFFSET_W+:OFFSET_W];
            wire [OFFSET_W:0] q_wide = {q[OFFSET_W-1], q};
            wire [OFFSET_W:0] h_wide = {h[OFFSET_W-1], h};
            wire [OFFSET_W:0] m = chord_leaving ? q_wide - h_wide : q_wide + h_wide;
            wire [OFFSET_W+1:0] m_wide = {m[OFFSET_W], m};
            wire [`RT_COORD_W-1:0] c = chord_center[lane*`RT_COORD_W+:`RT_COORD_W];
            wire [POINT_W:0] c_wide = {
                {POINT_W + 1 - `RT_COORD_W - FRAC + `RT_COORD_FRAC{c[`RT_COORD_W-1]}},
                c,
                {FRAC - `RT_COORD_FRAC{1'b0}}
            };

            resize #(
                .IN_INT  (`RT_OFFSET_INT + 2),
                .IN_FRAC (FRAC),
                .OUT_INT (`RT_OFFSET_INT),
                .OUT_FRAC(FRAC)
            ) u_turned (
                .in (chord_leaving ? m_wide : -m_wide),
                .out(turned_next[lane*OFFSET_W+:OFFSET_W])
            );

            resize #(
                .IN_INT  (`RT_POINT_INT + 1),
                .IN_FRAC (FRAC),
                .OUT_INT (`RT_POINT_INT),
                .OUT_FRAC(FRAC)
            ) u_point (
                .in (c_wide - {{POINT_W - OFFSET_W{m[OFFSET_W]}}, m}),
                .out(point_next[lane*POINT_W+:POINT_W])
            );
        end
    endgenerate

    always @(posedge clk) begin
        turned_reg <= turned_next;
        point_reg  <= point_next;
    end

    wire turned_valid;
    wire [TAG_W-1:0] turned_tag;
    wire [`RT_INV_RADIUS_W-1:0] turned_inv_radius;

    valid_pipe #(
        .TAG_W  (`RT_INV_RADIUS_W + TAG_W),
        .LATENCY(1)
    ) u_turned_valid (
        .clk      (clk),
        .rst      (rst),
        .in_valid (chord_valid),
        .in_tag   ({chord_inv_radius, chord_tag}),
        .out_valid(turned_valid),
        .out_tag  ({turned_inv_radius, turned_tag})
    );

    vec_scale #(
        .A_INT   (`RT_OFFSET_INT),
        .A_FRAC  (FRAC),
        .B_INT   (`RT_INV_RADIUS_INT + 1),
        .B_FRAC  (`RT_INV_RADIUS_FRAC),
        .OUT_INT (`RT_UNIT_INT),
        .OUT_FRAC(`RT_UNIT_FRAC),
        .TAG_W   (3*POINT_W + TAG_W)
    ) u_normal (
        .clk      (clk),
        .rst      (rst),
        .in_valid (turned_valid),
        .in_tag   ({point_reg, turned_tag}),
        .a        (turned_reg),
        .s        ({1'b0, turned_inv_radius}),
        .out_valid(out_valid),
        .out_tag  ({point, out_tag}),
        .p        (normal)
    );

endmodule

`default_nettype wire
