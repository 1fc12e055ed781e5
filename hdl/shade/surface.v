// SPDX-License-Identifier: Apache-2.0
//
// surface: point and normal where a ray hits an object (book 8.2.3).
//
// A ray o + t I meets a triangle at X = o + t I; its normal is that of the triangle, turned toward
// the viewer. For a sphere, with q from the ray's nearest point to the center and h half of the
// chord, the center seen from the hit point is m = q + h I at the near end of the chord and
// m = q - h I at the far one, so
//
//     X = center - m        N = -m / r (near), m / r (far), turned toward the viewer
//
// Taking both from the center keeps X on the sphere and N a unit vector however far the viewer is.
//
// Ports
//   origin      o, {x, y, z}, RT_POINT; not looked at for a sphere
//   direction   I, {x, y, z}, RT_UNIT
//   triangle    1: the object is a triangle; 0: a sphere
//   leaving     the ray leaves the sphere; it comes from behind the triangle
//   distance    t, RT_POINT; not looked at for a sphere
//   offset      q, {x, y, z}, RT_OFFSET; half_chord: h, RT_HALF_CHORD; not looked at for a triangle
//   center      {x, y, z}, RT_COORD; not looked at for a triangle
//   shape       normal of the triangle, {x, y, z}, RT_UNIT; 1 / r of the sphere in the low bits,
//               RT_INV_RADIUS
//   point       X, {x, y, z}, RT_POINT, floored and saturated
//   normal      N, {x, y, z}, RT_UNIT, floored and saturated
//
// Latency 4 (h I or t I) + 1 (m) + 4 (N) = 9, rate one hit a clock.

`default_nettype none
`include "raytracer.vh"

module surface #(
    parameter TAG_W = 1
) (
    input  wire                         clk,
    input  wire                         rst,
    input  wire                         in_valid,
    input  wire [            TAG_W-1:0] in_tag,
    input  wire [   3*`RT_POINT_W-1:0] origin,
    input  wire [    3*`RT_UNIT_W-1:0] direction,
    input  wire                         triangle,
    input  wire                         leaving,
    input  wire [     `RT_POINT_W-1:0] distance,
    input  wire [  3*`RT_OFFSET_W-1:0] offset,
    input  wire [`RT_HALF_CHORD_W-1:0] half_chord,
    input  wire [   3*`RT_COORD_W-1:0] center,
    input  wire [    3*`RT_UNIT_W-1:0] shape,
    output wire                         out_valid,
    output wire [            TAG_W-1:0] out_tag,
    output wire [   3*`RT_POINT_W-1:0] point,
    output wire [    3*`RT_UNIT_W-1:0] normal
);

    localparam OFFSET_W = `RT_OFFSET_W;
    localparam POINT_W = `RT_POINT_W;
    localparam COORD_W = `RT_COORD_W;
    localparam UNIT_W = `RT_UNIT_W;
    localparam INV_RADIUS_W = `RT_INV_RADIUS_W;
    localparam FRAC = `RT_POINT_FRAC;
    // m has a bit more than a point, and so has what is subtracted from a point.
    localparam M_W = POINT_W + 1;
    localparam WIDE_W = POINT_W + 2;

    // Both kinds are one sum: a triangle's point lies t I beyond the origin of the ray, as that of a
    // sphere that is left lies h I - q beyond its center. So a triangle has q = 0 and the far end.
    wire [3*POINT_W-1:0] base;
    wire [3*OFFSET_W-1:0] aside = triangle ? {3 * OFFSET_W{1'b0}} : offset;
    wire [POINT_W-1:0] length =
        triangle ? distance : {{POINT_W - `RT_HALF_CHORD_W{1'b0}}, half_chord};

    // h I, t I
    wire along_valid;
    wire [TAG_W-1:0] along_tag;
    wire along_triangle;
    wire along_leaving;
    wire [3*POINT_W-1:0] along_base;
    wire [3*OFFSET_W-1:0] along_aside;
    wire [3*UNIT_W-1:0] along_shape;
    wire [3*POINT_W-1:0] along;

    vec_scale #(
        .A_INT   (`RT_UNIT_INT),
        .A_FRAC  (`RT_UNIT_FRAC),
        .B_INT   (`RT_POINT_INT),
        .B_FRAC  (FRAC),
        .OUT_INT (`RT_POINT_INT),
        .OUT_FRAC(FRAC),
        .TAG_W   (2 + 3*POINT_W + 3*OFFSET_W + 3*UNIT_W + TAG_W)
    ) u_along (
        .clk      (clk),
        .rst      (rst),
        .in_valid (in_valid),
        .in_tag   ({triangle, leaving, base, aside, shape, in_tag}),
        .a        (direction),
        .s        (length),
        .out_valid(along_valid),
        .out_tag  ({along_triangle, along_leaving, along_base, along_aside, along_shape, along_tag}),
        .p        (along)
    );

    // m, and m turned toward the viewer; X; normal of the triangle turned toward the viewer
    wire far_end = along_triangle || along_leaving;
    wire [3*OFFSET_W-1:0] turned_next;
    wire [3*POINT_W-1:0] point_next;
    wire [3*UNIT_W-1:0] flat_next;
    reg [3*OFFSET_W-1:0] turned_reg;
    reg [3*POINT_W-1:0] point_reg;
    reg [3*UNIT_W-1:0] flat_reg;

    genvar lane;
    generate
        for (lane = 0; lane < 3; lane = lane + 1) begin : g_lane
            wire [COORD_W-1:0] c = center[lane*COORD_W+:COORD_W];
            wire [POINT_W-1:0] c_wide = {
                {POINT_W - COORD_W - FRAC + `RT_COORD_FRAC{c[COORD_W-1]}},
                c,
                {FRAC - `RT_COORD_FRAC{1'b0}}
            };
            assign base[lane*POINT_W+:POINT_W] =
                triangle ? origin[lane*POINT_W+:POINT_W] : c_wide;

            wire [OFFSET_W-1:0] q = along_aside[lane*OFFSET_W+:OFFSET_W];
            wire [POINT_W-1:0] h = along[lane*POINT_W+:POINT_W];
            wire [M_W-1:0] q_wide = {{M_W - OFFSET_W{q[OFFSET_W-1]}}, q};
            wire [M_W-1:0] h_wide = {h[POINT_W-1], h};
            wire [M_W-1:0] m = far_end ? q_wide - h_wide : q_wide + h_wide;
            wire [WIDE_W-1:0] m_wide = {m[M_W-1], m};
            wire [POINT_W-1:0] b = along_base[lane*POINT_W+:POINT_W];
            wire [UNIT_W-1:0] n = along_shape[lane*UNIT_W+:UNIT_W];
            wire [UNIT_W:0] n_wide = {n[UNIT_W-1], n};

            resize #(
                .IN_INT  (`RT_POINT_INT + 2),
                .IN_FRAC (FRAC),
                .OUT_INT (`RT_OFFSET_INT),
                .OUT_FRAC(FRAC)
            ) u_turned (
                .in (along_leaving ? m_wide : -m_wide),
                .out(turned_next[lane*OFFSET_W+:OFFSET_W])
            );

            resize #(
                .IN_INT  (`RT_POINT_INT + 2),
                .IN_FRAC (FRAC),
                .OUT_INT (`RT_POINT_INT),
                .OUT_FRAC(FRAC)
            ) u_point (
                .in ({{2{b[POINT_W-1]}}, b} - m_wide),
                .out(point_next[lane*POINT_W+:POINT_W])
            );

            resize #(
                .IN_INT  (`RT_UNIT_INT + 1),
                .IN_FRAC (`RT_UNIT_FRAC),
                .OUT_INT (`RT_UNIT_INT),
                .OUT_FRAC(`RT_UNIT_FRAC)
            ) u_flat (
                .in (along_leaving ? -n_wide : n_wide),
                .out(flat_next[lane*UNIT_W+:UNIT_W])
            );
        end
    endgenerate

    always @(posedge clk) begin
        turned_reg <= turned_next;
        point_reg  <= point_next;
        flat_reg   <= flat_next;
    end

    wire turned_valid;
    wire [TAG_W-1:0] turned_tag;
    wire turned_triangle;
    wire [INV_RADIUS_W-1:0] turned_inv_radius;

    valid_pipe #(
        .TAG_W  (1 + INV_RADIUS_W + TAG_W),
        .LATENCY(1)
    ) u_turned_valid (
        .clk      (clk),
        .rst      (rst),
        .in_valid (along_valid),
        .in_tag   ({along_triangle, along_shape[INV_RADIUS_W-1:0], along_tag}),
        .out_valid(turned_valid),
        .out_tag  ({turned_triangle, turned_inv_radius, turned_tag})
    );

    // N of the sphere; a triangle has it already
    wire round_triangle;
    wire [3*UNIT_W-1:0] round_flat;
    wire [3*UNIT_W-1:0] round;

    vec_scale #(
        .A_INT   (`RT_OFFSET_INT),
        .A_FRAC  (FRAC),
        .B_INT   (`RT_INV_RADIUS_INT + 1),
        .B_FRAC  (`RT_INV_RADIUS_FRAC),
        .OUT_INT (`RT_UNIT_INT),
        .OUT_FRAC(`RT_UNIT_FRAC),
        .TAG_W   (1 + 3*UNIT_W + 3*POINT_W + TAG_W)
    ) u_round (
        .clk      (clk),
        .rst      (rst),
        .in_valid (turned_valid),
        .in_tag   ({turned_triangle, flat_reg, point_reg, turned_tag}),
        .a        (turned_reg),
        .s        ({1'b0, turned_inv_radius}),
        .out_valid(out_valid),
        .out_tag  ({round_triangle, round_flat, point, out_tag}),
        .p        (round)
    );

    assign normal = round_triangle ? round_flat : round;

endmodule

`default_nettype wire
