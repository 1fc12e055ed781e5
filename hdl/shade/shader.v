// SPDX-License-Identifier: Apache-2.0
//
// shader: the share of one ray in the colour of its pixel (book 8.2.3), weight times
//
//     background                                           where the ray misses
//     ambient + attenuation * light of phong               where it hits
//
// The light's attenuation is the transparency of the sphere where the shadow ray hits it, else 1.
//
// Ports
//   weight          of the ray, {r, g, b}, RT_SHADE
//   direction       of the ray, {x, y, z}, RT_UNIT
//   hit, leaving, offset, half_chord    from sphere_intersect
//   center, radius_sq, inv_radius, ambient, k_*    of the sphere; light_*: of the light, `light_on`
//                   where the frame has one; background: {r, g, b}, RT_COEFF; all of these hold
//                   still while a frame is drawn
//   colour          {r, g, b}, RT_SHADE
//   light_at_point  beside a result: the light is at the hit point and was left out
//
// Latency: surface, reflect, light_vector, sphere_intersect (the shadow ray), phong, 1 (ambient),
// 1 (background), 4 (weight), one after the other; rate one ray a clock.

`default_nettype none
`include "raytracer.vh"

module shader #(
    parameter TAG_W = 1
) (
    input  wire                         clk,
    input  wire                         rst,
    input  wire                         in_valid,
    input  wire [            TAG_W-1:0] in_tag,
    input  wire [   3*`RT_SHADE_W-1:0] weight,
    input  wire [    3*`RT_UNIT_W-1:0] direction,
    input  wire                         hit,
    input  wire                         leaving,
    input  wire [  3*`RT_OFFSET_W-1:0] offset,
    input  wire [`RT_HALF_CHORD_W-1:0] half_chord,
    input  wire [   3*`RT_COORD_W-1:0] center,
    input  wire [ `RT_RADIUS_SQ_W-1:0] radius_sq,
    input  wire [`RT_INV_RADIUS_W-1:0] inv_radius,
    input  wire [   3*`RT_SHADE_W-1:0] ambient,
    input  wire [   3*`RT_COEFF_W-1:0] k_diffuse,
    input  wire [   3*`RT_COEFF_W-1:0] k_specular,
    input  wire [   3*`RT_COEFF_W-1:0] k_transparency,
    input  wire                         light_on,
    input  wire [   3*`RT_COORD_W-1:0] light_position,
    input  wire [   3*`RT_COEFF_W-1:0] light_intensity,
    input  wire [   3*`RT_COEFF_W-1:0] background,
    output wire                         out_valid,
    output wire [            TAG_W-1:0] out_tag,
    output wire [   3*`RT_SHADE_W-1:0] colour,
    output wire                         light_at_point
);

    localparam UNIT_W = `RT_UNIT_W;
    localparam POINT_W = `RT_POINT_W;
    localparam COEFF_W = `RT_COEFF_W;
    localparam SHADE_W = `RT_SHADE_W;
    // What a ray carries to the end: its tag, its weight, whether it hit.
    localparam RAY_W = TAG_W + 3*SHADE_W + 1;

    wire surface_valid;
    wire [RAY_W-1:0] surface_ray;
    wire [3*UNIT_W-1:0] surface_direction;
    wire [3*POINT_W-1:0] surface_point;
    wire [3*UNIT_W-1:0] surface_normal;

    surface #(
        .TAG_W(3*UNIT_W + RAY_W)
    ) u_surface (
        .clk       (clk),
        .rst       (rst),
        .in_valid  (in_valid),
        .in_tag    ({direction, hit, weight, in_tag}),
        .direction (direction),
        .offset    (offset),
        .half_chord(half_chord),
        .leaving    (leaving),
        .center    (center),
        .inv_radius(inv_radius),
        .out_valid (surface_valid),
        .out_tag   ({surface_direction, surface_ray}),
        .point     (surface_point),
        .normal    (surface_normal)
    );

    wire mirror_valid;
    wire [RAY_W-1:0] mirror_ray;
    wire [3*POINT_W-1:0] mirror_point;
    wire [3*UNIT_W-1:0] mirror_normal;
    wire [3*UNIT_W-1:0] mirrored;

    reflect #(
        .TAG_W(3*POINT_W + 3*UNIT_W + RAY_W)
    ) u_reflect (
        .clk      (clk),
        .rst      (rst),
        .in_valid (surface_valid),
        .in_tag   ({surface_point, surface_normal, surface_ray}),
        .direction(surface_direction),
        .normal   (surface_normal),
        .out_valid(mirror_valid),
        .out_tag  ({mirror_point, mirror_normal, mirror_ray}),
        .mirrored (mirrored)
    );

    wire light_valid;
    wire [RAY_W-1:0] light_ray;
    wire [3*POINT_W-1:0] light_point;
    wire [3*UNIT_W-1:0] light_normal;
    wire [3*UNIT_W-1:0] light_mirrored;
    wire [3*UNIT_W-1:0] light_direction;
    wire [POINT_W-1:0] light_limit;
    wire light_degenerate;

    light_vector #(
        .TAG_W(3*POINT_W + 6*UNIT_W + RAY_W)
    ) u_light (
        .clk       (clk),
        .rst       (rst),
        .in_valid  (mirror_valid),
        .in_tag    ({mirror_point, mirror_normal, mirrored, mirror_ray}),
        .point     (mirror_point),
        .light     (light_position),
        .out_valid (light_valid),
        .out_tag   ({light_point, light_normal, light_mirrored, light_ray}),
        .direction (light_direction),
        .limit     (light_limit),
        .degenerate(light_degenerate)
    );

    // The shadow ray
    wire shadow_valid;
    wire [RAY_W-1:0] shadow_ray;
    wire [3*UNIT_W-1:0] shadow_normal;
    wire [3*UNIT_W-1:0] shadow_mirrored;
    wire [3*UNIT_W-1:0] shadow_direction;
    wire shadow_degenerate;
    wire shadowed;
    wire unused_leaving;
    wire [POINT_W-1:0] unused_distance;
    wire [3*`RT_OFFSET_W-1:0] unused_offset;
    wire [`RT_HALF_CHORD_W-1:0] unused_half_chord;

    sphere_intersect #(
        .TAG_W(1 + 9*UNIT_W + RAY_W)
    ) u_shadow (
        .clk       (clk),
        .rst       (rst),
        .in_valid  (light_valid),
        .in_tag    ({light_degenerate, light_normal, light_mirrored, light_direction, light_ray}),
        .origin    (light_point),
        .direction (light_direction),
        .center    (center),
        .radius_sq (radius_sq),
        .limit     (light_limit),
        .out_valid (shadow_valid),
        .out_tag   ({shadow_degenerate, shadow_normal, shadow_mirrored, shadow_direction,
                     shadow_ray}),
        .hit       (shadowed),
        .leaving    (unused_leaving),
        .distance  (unused_distance),
        .offset    (unused_offset),
        .half_chord(unused_half_chord)
    );

    localparam [COEFF_W-1:0] ONE = 1 << `RT_COEFF_FRAC;
    wire phong_valid;
    wire [RAY_W-1:0] phong_ray;
    wire phong_degenerate;
    wire [3*SHADE_W-1:0] direct;

    phong #(
        .TAG_W(1 + RAY_W)
    ) u_phong (
        .clk        (clk),
        .rst        (rst),
        .in_valid   (shadow_valid),
        .in_tag     ({shadow_degenerate, shadow_ray}),
        .normal     (shadow_normal),
        .mirrored   (shadow_mirrored),
        .direction  (shadow_direction),
        .dark       (shadow_degenerate || !light_on),
        .k_diffuse  (k_diffuse),
        .k_specular (k_specular),
        .intensity  (light_intensity),
        .attenuation(shadowed ? k_transparency : {3{ONE}}),
        .out_valid  (phong_valid),
        .out_tag    ({phong_degenerate, phong_ray}),
        .colour     (direct)
    );

    wire lit_valid;
    wire lit_degenerate;
    wire lit_hit;
    wire [3*SHADE_W-1:0] lit_weight;
    wire [TAG_W-1:0] lit_tag;
    wire [3*SHADE_W-1:0] lit;

    colour_add #(
        .TAG_W(1 + RAY_W)
    ) u_lit (
        .clk      (clk),
        .rst      (rst),
        .in_valid (phong_valid),
        .in_tag   ({phong_degenerate, phong_ray}),
        .a        (ambient),
        .b        (direct),
        .out_valid(lit_valid),
        .out_tag  ({lit_degenerate, lit_hit, lit_weight, lit_tag}),
        .sum      (lit)
    );

    // Background where the ray missed
    wire [3*SHADE_W-1:0] background_shade;
    reg [3*SHADE_W-1:0] local_reg;

    genvar lane;
    generate
        for (lane = 0; lane < 3; lane = lane + 1) begin : g_background
            assign background_shade[lane*SHADE_W+:SHADE_W] = {
                background[lane*COEFF_W+:COEFF_W], {`RT_SHADE_FRAC - `RT_COEFF_FRAC{1'b0}}
            };
        end
    endgenerate

    always @(posedge clk) local_reg <= lit_hit ? lit : background_shade;

    wire local_valid;
    wire local_at_point;
    wire [3*SHADE_W-1:0] local_weight;
    wire [TAG_W-1:0] local_tag;

    valid_pipe #(
        .TAG_W  (1 + 3*SHADE_W + TAG_W),
        .LATENCY(1)
    ) u_local (
        .clk      (clk),
        .rst      (rst),
        .in_valid (lit_valid),
        .in_tag   ({lit_hit && lit_degenerate && light_on, lit_weight, lit_tag}),
        .out_valid(local_valid),
        .out_tag  ({local_at_point, local_weight, local_tag})
    );

    vec_mul #(
        .A_INT   (`RT_SHADE_INT),
        .A_FRAC  (`RT_SHADE_FRAC),
        .B_INT   (`RT_SHADE_INT),
        .B_FRAC  (`RT_SHADE_FRAC),
        .OUT_INT (`RT_SHADE_INT),
        .OUT_FRAC(`RT_SHADE_FRAC),
        .SIGNED  (0),
        .TAG_W   (1 + TAG_W)
    ) u_weight (
        .clk      (clk),
        .rst      (rst),
        .in_valid (local_valid),
        .in_tag   ({local_at_point, local_tag}),
        .a        (local_reg),
        .b        (local_weight),
        .out_valid(out_valid),
        .out_tag  ({light_at_point, out_tag}),
        .p        (colour)
    );

endmodule

`default_nettype wire
