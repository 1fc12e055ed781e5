// SPDX-License-Identifier: Apache-2.0
//
// lighting_harness: the light of a step, with the step in one port and all that comes in another.
//
// Ports
//   in   {valid, slot, hit, first, lit, own, weight, point, normal, mirrored, position, intensity}
//   out  {shadow_valid, shadow, direct_valid, direct, light_at_point}; what no valid goes with is 0

`default_nettype none
`include "raytracer.vh"

module lighting_harness #(
    parameter OBJECTS  = 18,
    parameter OBJECT_W = 5,
    parameter SLOT_W   = 9
) (
    input  wire                      clk,
    input  wire                      rst,
    input  wire                      table_valid,
    input  wire [      OBJECT_W-1:0] table_index,
    input  wire [`RT_MATERIAL_W-1:0] table_material,
    input  wire [ 3*`RT_COEFF_W-1:0] background,
    input  wire [5+SLOT_W+OBJECT_W+3*`RT_SHADE_W+3*`RT_POINT_W+6*`RT_UNIT_W+3*`RT_COORD_W+3*`RT_COEFF_W
                 -1:0] in,
    output wire [2+SLOT_W+OBJECT_W+1+6*`RT_SHADE_W+4*`RT_POINT_W+3*`RT_UNIT_W+SLOT_W+3*`RT_SHADE_W:0] out
);

    localparam SHADOW_W = SLOT_W + OBJECT_W + 1 + 6 * `RT_SHADE_W + 4 * `RT_POINT_W + 3 * `RT_UNIT_W;
    localparam DIRECT_W = SLOT_W + 3 * `RT_SHADE_W;

    wire in_valid;
    wire [SLOT_W-1:0] in_slot;
    wire in_hit;
    wire in_first;
    wire in_lit;
    wire [OBJECT_W:0] in_own;
    wire [3*`RT_SHADE_W-1:0] in_weight;
    wire [3*`RT_POINT_W-1:0] in_point;
    wire [3*`RT_UNIT_W-1:0] in_normal;
    wire [3*`RT_UNIT_W-1:0] in_mirrored;
    wire [3*`RT_COORD_W-1:0] in_position;
    wire [3*`RT_COEFF_W-1:0] in_intensity;
    assign {in_valid, in_slot, in_hit, in_first, in_lit, in_own, in_weight, in_point, in_normal, in_mirrored,
            in_position, in_intensity} = in;

    wire shadow_valid;
    wire [SHADOW_W-1:0] shadow;
    wire direct_valid;
    wire [DIRECT_W-1:0] direct;
    wire light_at_point;
    assign out = {
        shadow_valid, shadow & {SHADOW_W{shadow_valid}},
        direct_valid, direct & {DIRECT_W{direct_valid}},
        light_at_point
    };

    lighting #(
        .OBJECTS (OBJECTS),
        .OBJECT_W(OBJECT_W),
        .SLOT_W  (SLOT_W)
    ) dut (
        .clk           (clk),
        .rst           (rst),
        .table_valid   (table_valid),
        .table_index   (table_index),
        .table_material(table_material),
        .background    (background),
        .in_valid      (in_valid),
        .in_slot       (in_slot),
        .in_hit        (in_hit),
        .in_first      (in_first),
        .in_lit        (in_lit),
        .in_own        (in_own),
        .in_weight     (in_weight),
        .in_point      (in_point),
        .in_normal     (in_normal),
        .in_mirrored   (in_mirrored),
        .in_position   (in_position),
        .in_intensity  (in_intensity),
        .shadow_valid  (shadow_valid),
        .shadow        (shadow),
        .direct_valid  (direct_valid),
        .direct        (direct),
        .light_at_point(light_at_point)
    );

endmodule

`default_nettype wire
