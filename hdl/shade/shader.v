// SPDX-License-Identifier: Apache-2.0
//
// shader: from hits to terms, shadow rays and secondary rays (book 8.2.3 to 8.2.5).
//
//     steps -> surface -> reflect -> lighting -> shadow rays, direct terms
//                            \-> children -> secondary rays
//
// Parameters
//   OBJECTS, OBJECT_W  objects of the tables, bits of an object's number
//   LIGHT_W            bits of the number of lights
//   SLOT_W, DEPTH_W    bits of a pixel slot, of a depth
//   COUNT_W            bits of an amount of a pixel's work
//   ROOM               shadow rays, and direct terms, in the shader or waiting behind it, a power of
//                      two; at full rate more than its latency
//   MIN_WEIGHT         smallest weight of a secondary ray, RT_SHADE raw
//
// Ports
//   table_*, reflects, transmits   of the frame's objects, see object_setup
//   lights, background, max_depth  of the frame
//   light_index, light             read port of scene_memory
//   hit_*          stream of {slot, depth, weight, origin, direction}, {hit, number, glass, leaving,
//                  distance, offset, half_chord}
//   child_*, settle_*   to the ray store; more_*: to the accumulator, see children
//   shadow_*       stream of shadow rays; direct_*: stream of terms, see lighting
//   light_at_point one clock for each light that was at a hit point and was left out
//
// Latency from a hit to its children 1 (step) + 1 (tables) + surface + reflect + children, and to
// its shadow rays lighting instead; rate one step a clock.

`default_nettype none
`include "raytracer.vh"

module shader #(
    parameter OBJECTS    = 18,
    parameter OBJECT_W   = 5,
    parameter LIGHT_W    = 2,
    parameter SLOT_W     = 9,
    parameter DEPTH_W    = 3,
    parameter COUNT_W    = 8,
    parameter ROOM       = 256,
    parameter MIN_WEIGHT = `RT_MIN_WEIGHT
) (
    input  wire                      clk,
    input  wire                      rst,
    input  wire                      table_valid,
    input  wire [      OBJECT_W-1:0] table_index,
    input  wire [ `RT_SURFACE_W-1:0] table_surface,
    input  wire [`RT_MATERIAL_W-1:0] table_material,
    input  wire                      reflects,
    input  wire                      transmits,
    input  wire [       LIGHT_W-1:0] lights,
    input  wire [ 3*`RT_COEFF_W-1:0] background,
    input  wire [       DEPTH_W-1:0] max_depth,
    output wire [       LIGHT_W-1:0] light_index,
    input  wire [ 6*`RT_COORD_W-1:0] light,
    input  wire                      hit_valid,
    output wire                      hit_ready,
    input  wire [SLOT_W+DEPTH_W+3*`RT_SHADE_W+3*`RT_POINT_W+3*`RT_UNIT_W+OBJECT_W+3+`RT_POINT_W
                 +3*`RT_OFFSET_W+`RT_HALF_CHORD_W-1:0] hit,
    output wire                      child_valid,
    output wire [       DEPTH_W-1:0] child_depth,
    output wire [SLOT_W+OBJECT_W+1+3*`RT_SHADE_W+3*`RT_POINT_W+3*`RT_UNIT_W-1:0] child,
    output wire                      settle_valid,
    output wire [       DEPTH_W-1:0] settle_depth,
    output wire [               1:0] settle_count,
    output wire                      more_valid,
    output wire [        SLOT_W-1:0] more_slot,
    output wire [       COUNT_W-1:0] more_count,
    output wire                      shadow_valid,
    input  wire                      shadow_ready,
    output wire [SLOT_W+OBJECT_W+1+6*`RT_SHADE_W+4*`RT_POINT_W+3*`RT_UNIT_W-1:0] shadow,
    output wire                      direct_valid,
    input  wire                      direct_ready,
    output wire [SLOT_W+3*`RT_SHADE_W-1:0] direct,
    output wire                      light_at_point
);

    localparam SHADE_W = `RT_SHADE_W;
    localparam UNIT_W = `RT_UNIT_W;
    localparam POINT_W = `RT_POINT_W;
    localparam COORD_W = `RT_COORD_W;
    localparam COEFF_W = `RT_COEFF_W;
    localparam FOUND_W = OBJECT_W + 2 + POINT_W + 3 * `RT_OFFSET_W + `RT_HALF_CHORD_W;
    localparam LINE_W = 3 * POINT_W + 3 * UNIT_W;
    localparam RAY_W = SLOT_W + DEPTH_W + 3 * SHADE_W;
    localparam HIT_W = RAY_W + LINE_W + 1 + FOUND_W;

    // ------------------------------------------------ steps
    wire [DEPTH_W-1:0] hit_depth = hit[HIT_W-SLOT_W-1-:DEPTH_W];
    wire hit_hit = hit[FOUND_W];
    wire hit_glass = hit[FOUND_W-OBJECT_W-1];
    wire hit_branching = hit_hit && hit_glass && hit_depth < max_depth;
    wire [1:0] direct_back;
    wire [1:0] shadow_back;
    wire step_valid;
    wire step_branching;
    wire [RAY_W-1:0] step_ray;
    wire [LINE_W-1:0] step_line;
    wire step_hit;
    wire [FOUND_W-1:0] step_found;
    wire [LIGHT_W-1:0] step;
    wire [LIGHT_W-1:0] step_more;

    steps #(
        .ITEM_W (HIT_W + 1),
        .LIGHT_W(LIGHT_W),
        .ROOM   (ROOM)
    ) u_steps (
        .clk         (clk),
        .rst         (rst),
        .lights      (lights),
        .in_valid    (hit_valid),
        .in_ready    (hit_ready),
        .in_item     ({hit_branching, hit}),
        .in_hit      (hit_hit),
        .in_branching(hit_branching),
        .direct_back (direct_back),
        .shadow_back (shadow_back),
        .out_valid   (step_valid),
        .out_item    ({step_branching, step_ray, step_line, step_hit, step_found}),
        .out_step    (step),
        .out_more    (step_more)
    );

    // ------------------------------------------------ rows of the tables, and the light
    reg [`RT_SURFACE_W-1:0] rows[0:OBJECTS-1];
    reg [`RT_SURFACE_W-1:0] row_reg;
    wire [OBJECT_W-1:0] step_number = step_found[FOUND_W-1-:OBJECT_W];

    always @(posedge clk) begin
        if (table_valid) rows[table_index] <= table_surface;
        row_reg <= rows[step_number];
    end

    assign light_index = step;

    // What a step carries on: ray, hit, branching, lit, number of the step and of its last one.
    localparam STEP_W = RAY_W + 3 + 2 * LIGHT_W;
    wire row_valid;
    wire [STEP_W-1:0] row_step;
    wire [3*POINT_W-1:0] row_origin;
    wire [3*UNIT_W-1:0] row_direction;
    wire [OBJECT_W-1:0] row_number;
    wire unused_row_glass;
    wire row_leaving;
    wire [POINT_W-1:0] row_distance;
    wire [3*`RT_OFFSET_W-1:0] row_offset;
    wire [`RT_HALF_CHORD_W-1:0] row_half_chord;

    valid_pipe #(
        .TAG_W  (STEP_W + LINE_W + FOUND_W),
        .LATENCY(1)
    ) u_row (
        .clk      (clk),
        .rst      (rst),
        .in_valid (step_valid),
        .in_tag   ({step_ray, step_hit, step_branching, step_hit && step < lights, step, step_more,
                    step_line, step_found}),
        .out_valid(row_valid),
        .out_tag  ({row_step, row_origin, row_direction, row_number, unused_row_glass, row_leaving,
                    row_distance, row_offset, row_half_chord})
    );

    wire row_triangle;
    wire [`RT_INDEX_W-1:0] row_index;
    wire [3*UNIT_W-1:0] row_shape;
    wire [3*COORD_W-1:0] row_center;
    assign {row_triangle, row_index, row_shape, row_center} = row_reg;

    // ------------------------------------------------ point, normal, mirrored direction
    localparam KEPT_W = STEP_W + 3 * UNIT_W + 1 + OBJECT_W + `RT_INDEX_W + 1 + 6 * COORD_W;
    wire surface_valid;
    wire [KEPT_W-1:0] surface_kept;
    wire [3*POINT_W-1:0] surface_point;
    wire [3*UNIT_W-1:0] surface_normal;

    surface #(
        .TAG_W(KEPT_W)
    ) u_surface (
        .clk       (clk),
        .rst       (rst),
        .in_valid  (row_valid),
        .in_tag    ({row_direction, row_step, row_triangle, row_number, row_index, row_leaving, light}),
        .origin    (row_origin),
        .direction (row_direction),
        .triangle  (row_triangle),
        .leaving   (row_leaving),
        .distance  (row_distance),
        .offset    (row_offset),
        .half_chord(row_half_chord),
        .center    (row_center),
        .shape     (row_shape),
        .out_valid (surface_valid),
        .out_tag   (surface_kept),
        .point     (surface_point),
        .normal    (surface_normal)
    );

    wire [3*UNIT_W-1:0] surface_direction = surface_kept[KEPT_W-1-:3*UNIT_W];
    wire at_valid;
    wire [3*UNIT_W-1:0] at_direction;
    wire [SLOT_W-1:0] at_slot;
    wire [DEPTH_W-1:0] at_depth;
    wire [3*SHADE_W-1:0] at_weight;
    wire at_hit;
    wire at_branching;
    wire at_lit;
    wire [LIGHT_W-1:0] at_step;
    wire [LIGHT_W-1:0] at_more;
    wire [OBJECT_W:0] at_own;
    wire [`RT_INDEX_W-1:0] at_index;
    wire at_leaving;
    wire [3*COORD_W-1:0] at_position;
    wire [3*COEFF_W-1:0] at_intensity;
    wire [3*POINT_W-1:0] at_point;
    wire [3*UNIT_W-1:0] at_normal;
    wire [3*UNIT_W-1:0] at_mirrored;
    wire [UNIT_W-1:0] at_cosine;

    reflect #(
        .TAG_W(KEPT_W + 3*POINT_W + 3*UNIT_W)
    ) u_reflect (
        .clk      (clk),
        .rst      (rst),
        .in_valid (surface_valid),
        .in_tag   ({surface_kept, surface_point, surface_normal}),
        .direction(surface_direction),
        .normal   (surface_normal),
        .out_valid(at_valid),
        .out_tag  ({at_direction, at_slot, at_depth, at_weight, at_hit, at_branching, at_lit, at_step,
                    at_more, at_own, at_index, at_leaving, at_position, at_intensity, at_point, at_normal}),
        .mirrored (at_mirrored),
        .cosine   (at_cosine)
    );

    // ------------------------------------------------ secondary rays
    children #(
        .OBJECTS   (OBJECTS),
        .OBJECT_W  (OBJECT_W),
        .SLOT_W    (SLOT_W),
        .DEPTH_W   (DEPTH_W),
        .LIGHT_W   (LIGHT_W),
        .COUNT_W   (COUNT_W),
        .MIN_WEIGHT(MIN_WEIGHT)
    ) u_children (
        .clk           (clk),
        .rst           (rst),
        .table_valid   (table_valid),
        .table_index   (table_index),
        .table_material(table_material),
        .max_depth     (max_depth),
        .reflects      (reflects),
        .transmits     (transmits),
        .in_valid      (at_valid),
        .in_slot       (at_slot),
        .in_depth      (at_depth),
        .in_hit        (at_hit),
        .in_branching  (at_branching),
        .in_step       (at_step),
        .in_more       (at_more),
        .in_own        (at_own),
        .in_weight     (at_weight),
        .in_point      (at_point),
        .in_direction  (at_direction),
        .in_normal     (at_normal),
        .in_mirrored   (at_mirrored),
        .in_cosine     (at_cosine),
        .in_index      (at_index),
        .in_leaving    (at_leaving),
        .child_valid   (child_valid),
        .child_depth   (child_depth),
        .child         (child),
        .settle_valid  (settle_valid),
        .settle_depth  (settle_depth),
        .settle_count  (settle_count),
        .more_valid    (more_valid),
        .more_slot     (more_slot),
        .more_count    (more_count)
    );

    // ------------------------------------------------ light
    localparam SHADOW_W = SLOT_W + OBJECT_W + 1 + 6 * SHADE_W + LINE_W + POINT_W;
    localparam DIRECT_W = SLOT_W + 3 * SHADE_W;
    wire lit_valid;
    wire [SHADOW_W-1:0] lit;
    wire plain_valid;
    wire [DIRECT_W-1:0] plain;

    lighting #(
        .OBJECTS (OBJECTS),
        .OBJECT_W(OBJECT_W),
        .SLOT_W  (SLOT_W)
    ) u_lighting (
        .clk           (clk),
        .rst           (rst),
        .table_valid   (table_valid),
        .table_index   (table_index),
        .table_material(table_material),
        .background    (background),
        .in_valid      (at_valid),
        .in_slot       (at_slot),
        .in_hit        (at_hit),
        .in_first      (at_step == {LIGHT_W{1'b0}}),
        .in_lit        (at_lit),
        .in_own        (at_own),
        .in_weight     (at_weight),
        .in_point      (at_point),
        .in_normal     (at_normal),
        .in_mirrored   (at_mirrored),
        .in_position   (at_position),
        .in_intensity  (at_intensity),
        .shadow_valid  (lit_valid),
        .shadow        (lit),
        .direct_valid  (plain_valid),
        .direct        (plain),
        .light_at_point(light_at_point)
    );

    // Each step took a place in both queues; it gives back the one that it does not use at once.
    wire unused_shadow_room_ready;
    wire unused_direct_room_ready;
    wire [$clog2(ROOM):0] unused_shadow_room;
    wire [$clog2(ROOM):0] unused_direct_room;

    fifo #(
        .WIDTH(SHADOW_W),
        .DEPTH(ROOM)
    ) u_shadows (
        .clk      (clk),
        .rst      (rst),
        .in_valid (lit_valid),
        .in_ready (unused_shadow_room_ready),
        .in_data  (lit),
        .out_valid(shadow_valid),
        .out_ready(shadow_ready),
        .out_data (shadow),
        .room     (unused_shadow_room)
    );

    fifo #(
        .WIDTH(DIRECT_W),
        .DEPTH(ROOM)
    ) u_direct (
        .clk      (clk),
        .rst      (rst),
        .in_valid (plain_valid),
        .in_ready (unused_direct_room_ready),
        .in_data  (plain),
        .out_valid(direct_valid),
        .out_ready(direct_ready),
        .out_data (direct),
        .room     (unused_direct_room)
    );

    assign direct_back = {1'b0, lit_valid} + {1'b0, direct_valid && direct_ready};
    assign shadow_back = {1'b0, plain_valid} + {1'b0, shadow_valid && shadow_ready};

endmodule

`default_nettype wire
