// SPDX-License-Identifier: Apache-2.0
//
// children_harness: the secondary rays of a hit with a step in one port and all that comes in another.
//
// Ports
//   in   {valid, slot, depth, hit, branching, step, more, own, weight, point, direction, normal, mirrored,
//        cosine, index, leaving}
//   out  {more_valid, slot, count, child_valid, depth, child, settle_valid, depth, count}; what no valid
//        goes with is 0

`default_nettype none
`include "raytracer.vh"

module children_harness #(
    parameter OBJECTS    = 18,
    parameter OBJECT_W   = 5,
    parameter SLOT_W     = 9,
    parameter DEPTH_W    = 3,
    parameter LIGHT_W    = 2,
    parameter COUNT_W    = 8,
    parameter MIN_WEIGHT = `RT_MIN_WEIGHT
) (
    input  wire                      clk,
    input  wire                      rst,
    input  wire                      table_valid,
    input  wire [      OBJECT_W-1:0] table_index,
    input  wire [`RT_MATERIAL_W-1:0] table_material,
    input  wire [       DEPTH_W-1:0] max_depth,
    input  wire                      reflects,
    input  wire                      transmits,
    input  wire [5+SLOT_W+DEPTH_W+2*LIGHT_W+OBJECT_W+3*`RT_SHADE_W+3*`RT_POINT_W+10*`RT_UNIT_W
                 +`RT_INDEX_W-1:0] in,
    output wire [3+SLOT_W+COUNT_W+2*DEPTH_W+SLOT_W+OBJECT_W+1+3*`RT_SHADE_W+3*`RT_POINT_W+3*`RT_UNIT_W
                 +1:0] out
);

    localparam CHILD_W = SLOT_W + OBJECT_W + 1 + 3 * `RT_SHADE_W + 3 * `RT_POINT_W + 3 * `RT_UNIT_W;

    wire in_valid;
    wire [SLOT_W-1:0] in_slot;
    wire [DEPTH_W-1:0] in_depth;
    wire in_hit;
    wire in_branching;
    wire [LIGHT_W-1:0] in_step;
    wire [LIGHT_W-1:0] in_more;
    wire [OBJECT_W:0] in_own;
    wire [3*`RT_SHADE_W-1:0] in_weight;
    wire [3*`RT_POINT_W-1:0] in_point;
    wire [3*`RT_UNIT_W-1:0] in_direction;
    wire [3*`RT_UNIT_W-1:0] in_normal;
    wire [3*`RT_UNIT_W-1:0] in_mirrored;
    wire [`RT_UNIT_W-1:0] in_cosine;
    wire [`RT_INDEX_W-1:0] in_index;
    wire in_leaving;
    assign {in_valid, in_slot, in_depth, in_hit, in_branching, in_step, in_more, in_own, in_weight, in_point,
            in_direction, in_normal, in_mirrored, in_cosine, in_index, in_leaving} = in;

    wire more_valid;
    wire [SLOT_W-1:0] more_slot;
    wire [COUNT_W-1:0] more_count;
    wire child_valid;
    wire [DEPTH_W-1:0] child_depth;
    wire [CHILD_W-1:0] child;
    wire settle_valid;
    wire [DEPTH_W-1:0] settle_depth;
    wire [1:0] settle_count;
    assign out = {
        more_valid, {more_slot, more_count} & {SLOT_W + COUNT_W{more_valid}},
        child_valid, {child_depth, child} & {DEPTH_W + CHILD_W{child_valid}},
        settle_valid, {settle_depth, settle_count} & {DEPTH_W + 2{settle_valid}}
    };

    children #(
        .OBJECTS   (OBJECTS),
        .OBJECT_W  (OBJECT_W),
        .SLOT_W    (SLOT_W),
        .DEPTH_W   (DEPTH_W),
        .LIGHT_W   (LIGHT_W),
        .COUNT_W   (COUNT_W),
        .MIN_WEIGHT(MIN_WEIGHT)
    ) dut (
        .clk           (clk),
        .rst           (rst),
        .table_valid   (table_valid),
        .table_index   (table_index),
        .table_material(table_material),
        .max_depth     (max_depth),
        .reflects      (reflects),
        .transmits     (transmits),
        .in_valid      (in_valid),
        .in_slot       (in_slot),
        .in_depth      (in_depth),
        .in_hit        (in_hit),
        .in_branching  (in_branching),
        .in_step       (in_step),
        .in_more       (in_more),
        .in_own        (in_own),
        .in_weight     (in_weight),
        .in_point      (in_point),
        .in_direction  (in_direction),
        .in_normal     (in_normal),
        .in_mirrored   (in_mirrored),
        .in_cosine     (in_cosine),
        .in_index      (in_index),
        .in_leaving    (in_leaving),
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

endmodule

`default_nettype wire
