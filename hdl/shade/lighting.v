// SPDX-License-Identifier: Apache-2.0
//
// lighting: what one light adds to a hit, before anything stands in its way (book 8.2.3).
//
//     base  = weight * ambient          in the first step of a hit, 0 in the others
//           = weight * background       of a ray that missed
//     light = weight * intensity * (k_diffuse max(0, N.L) + k_specular max(0, R.L)^16)
//
// A step whose light is not 0 becomes a shadow ray that carries both; any other is a direct term, its
// base alone.
//
// Parameters
//   OBJECTS, OBJECT_W  objects of the tables, bits of an object's number
//   SLOT_W             bits of a pixel slot
//
// Ports
//   table_*    rows of materials, see object_setup; background {r, g, b}, RT_COEFF
//   in_*       a step: of a hit or not; first: of its hit; lit: there is a light for it, at
//              `in_position` (RT_COORD) with `in_intensity` (RT_COEFF); own: {1, number} of the triangle
//              that was hit, else {0, number}
//   shadow_valid, shadow   {slot, own, base, light, point, direction, limit}
//   direct_valid, direct   {slot, base}
//   light_at_point         beside either: the light is at the hit point and was left out
//
// Latency that of light_vector + 1 (table) + that of phong + 4 (weight) + 1; rate one step a clock.

`default_nettype none
`include "raytracer.vh"

module lighting #(
    parameter OBJECTS  = 18,
    parameter OBJECT_W = 5,
    parameter SLOT_W   = 9
) (
    input  wire                      clk,
    input  wire                      rst,
    input  wire                      table_valid,
    input  wire [      OBJECT_W-1:0] table_index,
    input  wire [`RT_MATERIAL_W-1:0] table_material,
    input  wire [  3*`RT_COEFF_W-1:0] background,
    input  wire                      in_valid,
    input  wire [        SLOT_W-1:0] in_slot,
    input  wire                      in_hit,
    input  wire                      in_first,
    input  wire                      in_lit,
    input  wire [        OBJECT_W:0] in_own,
    input  wire [  3*`RT_SHADE_W-1:0] in_weight,
    input  wire [  3*`RT_POINT_W-1:0] in_point,
    input  wire [   3*`RT_UNIT_W-1:0] in_normal,
    input  wire [   3*`RT_UNIT_W-1:0] in_mirrored,
    input  wire [  3*`RT_COORD_W-1:0] in_position,
    input  wire [  3*`RT_COEFF_W-1:0] in_intensity,
    output wire                      shadow_valid,
    output wire [SLOT_W+OBJECT_W+1+6*`RT_SHADE_W+4*`RT_POINT_W+3*`RT_UNIT_W-1:0] shadow,
    output wire                      direct_valid,
    output wire [SLOT_W+3*`RT_SHADE_W-1:0] direct,
    output wire                      light_at_point
);

    localparam SHADE_W = `RT_SHADE_W;
    localparam UNIT_W = `RT_UNIT_W;
    localparam POINT_W = `RT_POINT_W;
    localparam COEFF_W = `RT_COEFF_W;
    // What a step carries to its end: slot, hit, first, lit, own, weight, point.
    localparam STEP_W = SLOT_W + 3 + OBJECT_W + 1 + 3 * SHADE_W + 3 * POINT_W;
    localparam SURFACE_W = 6 * UNIT_W + 3 * COEFF_W;
    localparam WAY_W = 3 * UNIT_W + POINT_W + 1;

    // ------------------------------------------------ the way to the light
    wire way_valid;
    wire [STEP_W-1:0] way_step;
    wire [SURFACE_W-1:0] way_surface;
    wire [3*UNIT_W-1:0] way_direction;
    wire [POINT_W-1:0] way_limit;
    wire way_degenerate;

    light_vector #(
        .TAG_W(STEP_W + SURFACE_W)
    ) u_way (
        .clk       (clk),
        .rst       (rst),
        .in_valid  (in_valid),
        .in_tag    ({in_slot, in_hit, in_first, in_lit, in_own, in_weight, in_point,
                     in_normal, in_mirrored, in_intensity}),
        .point     (in_point),
        .light     (in_position),
        .out_valid (way_valid),
        .out_tag   ({way_step, way_surface}),
        .direction (way_direction),
        .limit     (way_limit),
        .degenerate(way_degenerate)
    );

    // ------------------------------------------------ ambient, k_diffuse, k_specular
    localparam ROW_W = 3 * SHADE_W + 6 * COEFF_W;
    reg [ROW_W-1:0] rows[0:OBJECTS-1];
    reg [ROW_W-1:0] row_reg;
    wire [OBJECT_W-1:0] way_number = way_step[3*POINT_W+3*SHADE_W+:OBJECT_W];
    wire unused_material = &{1'b0, table_material[6*COEFF_W-1:0]};

    always @(posedge clk) begin
        if (table_valid) rows[table_index] <= table_material[6*COEFF_W+:ROW_W];
        row_reg <= rows[way_number];
    end

    wire row_valid;
    wire [STEP_W-1:0] row_step;
    wire [3*UNIT_W-1:0] row_normal;
    wire [3*UNIT_W-1:0] row_mirrored;
    wire [3*COEFF_W-1:0] row_intensity;
    wire [WAY_W-1:0] row_way;
    wire row_lit = row_step[OBJECT_W+1+3*SHADE_W+3*POINT_W];

    valid_pipe #(
        .TAG_W  (STEP_W + SURFACE_W + WAY_W),
        .LATENCY(1)
    ) u_row (
        .clk      (clk),
        .rst      (rst),
        .in_valid (way_valid),
        .in_tag   ({way_step, way_surface, way_direction, way_limit, way_degenerate}),
        .out_valid(row_valid),
        .out_tag  ({row_step, row_normal, row_mirrored, row_intensity, row_way})
    );

    wire [3*SHADE_W-1:0] row_ambient = row_reg[6*COEFF_W+:3*SHADE_W];

    // ------------------------------------------------ light
    // A light at the hit point has no direction, thus no cosine: it is dark by itself.
    wire phong_valid;
    wire [STEP_W-1:0] phong_step;
    wire [WAY_W-1:0] phong_way;
    wire [3*SHADE_W-1:0] phong_ambient;
    wire [3*SHADE_W-1:0] phong_colour;

    phong #(
        .TAG_W(STEP_W + WAY_W + 3*SHADE_W)
    ) u_phong (
        .clk       (clk),
        .rst       (rst),
        .in_valid  (row_valid),
        .in_tag    ({row_step, row_way, row_ambient}),
        .normal    (row_normal),
        .mirrored  (row_mirrored),
        .direction (row_way[POINT_W+1+:3*UNIT_W]),
        .dark      (!row_lit),
        .k_diffuse (row_reg[3*COEFF_W+:3*COEFF_W]),
        .k_specular(row_reg[0+:3*COEFF_W]),
        .intensity (row_intensity),
        .out_valid (phong_valid),
        .out_tag   ({phong_step, phong_way, phong_ambient}),
        .colour    (phong_colour)
    );

    wire [3*SHADE_W-1:0] phong_weight = phong_step[3*POINT_W+:3*SHADE_W];
    wire phong_hit = phong_step[STEP_W-SLOT_W-1];
    wire [3*SHADE_W-1:0] background_shade;

    genvar lane;
    generate
        for (lane = 0; lane < 3; lane = lane + 1) begin : g_background
            assign background_shade[lane*SHADE_W+:SHADE_W] = {
                background[lane*COEFF_W+:COEFF_W], {`RT_SHADE_FRAC - `RT_COEFF_FRAC{1'b0}}
            };
        end
    endgenerate

    // ------------------------------------------------ times the ray's weight
    wire end_valid;
    wire [SLOT_W-1:0] end_slot;
    wire end_hit;
    wire end_first;
    wire end_lit;
    wire [OBJECT_W:0] end_own;
    wire [3*SHADE_W-1:0] unused_weight;
    wire [3*POINT_W-1:0] end_point;
    wire [3*UNIT_W-1:0] end_direction;
    wire [POINT_W-1:0] end_limit;
    wire end_degenerate;
    wire [3*SHADE_W-1:0] end_light;
    wire [3*SHADE_W-1:0] end_local;

    vec_mul #(
        .A_INT   (`RT_SHADE_INT),
        .A_FRAC  (`RT_SHADE_FRAC),
        .B_INT   (`RT_SHADE_INT),
        .B_FRAC  (`RT_SHADE_FRAC),
        .OUT_INT (`RT_SHADE_INT),
        .OUT_FRAC(`RT_SHADE_FRAC),
        .LANES   (6),
        .SIGNED  (0),
        .TAG_W   (STEP_W + WAY_W)
    ) u_weight (
        .clk      (clk),
        .rst      (rst),
        .in_valid (phong_valid),
        .in_tag   ({phong_step, phong_way}),
        .a        ({phong_colour, phong_hit ? phong_ambient : background_shade}),
        .b        ({2{phong_weight}}),
        .out_valid(end_valid),
        .out_tag  ({end_slot, end_hit, end_first, end_lit, end_own, unused_weight, end_point,
                    end_direction, end_limit, end_degenerate}),
        .p        ({end_light, end_local})
    );

    wire bright = end_hit && end_light != {3 * SHADE_W{1'b0}};
    wire [3*SHADE_W-1:0] base = end_first ? end_local : {3 * SHADE_W{1'b0}};
    reg shadow_valid_reg;
    reg direct_valid_reg;
    reg at_point_reg;
    reg [SLOT_W-1:0] slot_reg;
    reg [3*SHADE_W-1:0] base_reg;
    reg [OBJECT_W:0] own_reg;
    reg [3*SHADE_W-1:0] light_reg;
    reg [3*POINT_W+3*UNIT_W+POINT_W-1:0] line_reg;

    always @(posedge clk) begin
        if (rst) begin
            shadow_valid_reg <= 1'b0;
            direct_valid_reg <= 1'b0;
            at_point_reg     <= 1'b0;
        end else begin
            shadow_valid_reg <= end_valid && bright;
            direct_valid_reg <= end_valid && !bright;
            at_point_reg     <= end_valid && end_hit && end_lit && end_degenerate;
        end
    end

    always @(posedge clk) begin
        slot_reg  <= end_slot;
        base_reg  <= base;
        own_reg   <= end_own;
        light_reg <= end_light;
        line_reg  <= {end_point, end_direction, end_limit};
    end

    assign shadow_valid   = shadow_valid_reg;
    assign shadow         = {slot_reg, own_reg, base_reg, light_reg, line_reg};
    assign direct_valid   = direct_valid_reg;
    assign direct         = {slot_reg, base_reg};
    assign light_at_point = at_point_reg;

endmodule

`default_nettype wire
