// SPDX-License-Identifier: Apache-2.0
//
// children: the secondary rays of a hit (book 8.2.4, 8.2.5), and how much work a pixel has.
//
// Step 0 of a hit casts the reflected ray with the weight w * k_reflection, step 1 the transmitted
// one with w * k_transparency, each where a channel of its weight reaches MIN_WEIGHT and the depth
// allows it.
//
// Parameters
//   OBJECTS, OBJECT_W  objects of the tables, bits of an object's number
//   SLOT_W, DEPTH_W    bits of a pixel slot, of a depth
//   LIGHT_W            bits of the number of a step
//   COUNT_W            bits of an amount of work
//   MIN_WEIGHT         smallest weight, RT_SHADE raw, at least 1: where the frame has no mirror there is
//                      no place for a mirrored ray of weight 0
//
// Ports
//   table_*     rows of materials, see object_setup
//   max_depth   of the deepest ray; reflects, transmits: what the frame's objects do. A ray of less
//               depth has as many places reserved in the ray store as these two are set
//   in_*        a step: of a hit (`in_hit`) or of a ray that missed; branching: step 1 is the transmitted
//               ray's; own: {1, number} of the triangle that was hit, else {0, number};
//               direction, normal, mirrored, cosine as reflect gives them; index, leaving: see refract
//   child_*     a child: its depth and {slot, own, weight, point, direction}
//   settle_*    places of the ray store that stay empty
//   more_*      work of the pixel beyond the one piece that its ray was: the hit's other steps, a child
//
// Latency 1 (table) + 4 (weight) + that of refract + 1; rate one step a clock. All of it comes before
// the step's term.

`default_nettype none
`include "raytracer.vh"

module children #(
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
    input  wire                      in_valid,
    input  wire [        SLOT_W-1:0] in_slot,
    input  wire [       DEPTH_W-1:0] in_depth,
    input  wire                      in_hit,
    input  wire                      in_branching,
    input  wire [       LIGHT_W-1:0] in_step,
    input  wire [       LIGHT_W-1:0] in_more,
    input  wire [        OBJECT_W:0] in_own,
    input  wire [  3*`RT_SHADE_W-1:0] in_weight,
    input  wire [  3*`RT_POINT_W-1:0] in_point,
    input  wire [   3*`RT_UNIT_W-1:0] in_direction,
    input  wire [   3*`RT_UNIT_W-1:0] in_normal,
    input  wire [   3*`RT_UNIT_W-1:0] in_mirrored,
    input  wire [     `RT_UNIT_W-1:0] in_cosine,
    input  wire [    `RT_INDEX_W-1:0] in_index,
    input  wire                      in_leaving,
    output wire                      child_valid,
    output wire [       DEPTH_W-1:0] child_depth,
    output wire [SLOT_W+OBJECT_W+1+3*`RT_SHADE_W+3*`RT_POINT_W+3*`RT_UNIT_W-1:0] child,
    output wire                      settle_valid,
    output wire [       DEPTH_W-1:0] settle_depth,
    output wire [               1:0] settle_count,
    output wire                      more_valid,
    output wire [        SLOT_W-1:0] more_slot,
    output wire [       COUNT_W-1:0] more_count
);

    localparam SHADE_W = `RT_SHADE_W;
    localparam UNIT_W = `RT_UNIT_W;
    localparam POINT_W = `RT_POINT_W;
    localparam COEFF_W = `RT_COEFF_W;
    localparam SHARES_W = 6 * COEFF_W;
    localparam [SHADE_W-1:0] LEAST = MIN_WEIGHT[SHADE_W-1:0];
    localparam [LIGHT_W-1:0] REFLECTED = 0;
    localparam [LIGHT_W-1:0] TRANSMITTED = 1;
    localparam [DEPTH_W-1:0] ONE_DEEPER = 1;

    generate
        if (MIN_WEIGHT < 1 || MIN_WEIGHT >> SHADE_W != 0) begin : g_bad_weight
            children_needs_a_MIN_WEIGHT_of_1_or_more_that_RT_SHADE_holds error ();
        end
    endgenerate

    // ------------------------------------------------ k_reflection, k_transparency
    reg [SHARES_W-1:0] shares[0:OBJECTS-1];
    reg [SHARES_W-1:0] shares_reg;
    wire unused_material = &{1'b0, table_material[`RT_MATERIAL_W-1:SHARES_W]};

    always @(posedge clk) begin
        if (table_valid) shares[table_index] <= table_material[SHARES_W-1:0];
        shares_reg <= shares[in_own[OBJECT_W-1:0]];
    end

    // What a step is, beside its geometry
    localparam STEP_W = SLOT_W + DEPTH_W + 2 + 2 * LIGHT_W + OBJECT_W + 1;
    localparam GEOMETRY_W = 3 * POINT_W + 10 * UNIT_W + `RT_INDEX_W + 1;
    wire share_valid;
    wire [STEP_W-1:0] share_what;
    wire [GEOMETRY_W-1:0] share_geometry;
    wire [3*SHADE_W-1:0] share_weight;
    // Step 0 reflects, step 1 transmits, and later ones send nothing: one bit tells.
    wire share_transmits = share_what[OBJECT_W+1+LIGHT_W];

    valid_pipe #(
        .TAG_W  (STEP_W + GEOMETRY_W + 3*SHADE_W),
        .LATENCY(1)
    ) u_share (
        .clk      (clk),
        .rst      (rst),
        .in_valid (in_valid),
        .in_tag   ({in_slot, in_depth, in_hit, in_branching, in_step, in_more, in_own, in_point,
                    in_direction, in_normal, in_mirrored, in_cosine, in_index, in_leaving, in_weight}),
        .out_valid(share_valid),
        .out_tag  ({share_what, share_geometry, share_weight})
    );

    // ------------------------------------------------ weight
    wire weight_valid;
    wire [STEP_W-1:0] weight_what;
    wire [3*POINT_W-1:0] weight_point;
    wire [3*UNIT_W-1:0] weight_direction;
    wire [3*UNIT_W-1:0] weight_normal;
    wire [3*UNIT_W-1:0] weight_mirrored;
    wire [UNIT_W-1:0] weight_cosine;
    wire [`RT_INDEX_W-1:0] weight_index;
    wire weight_leaving;
    wire [3*SHADE_W-1:0] weight;

    vec_mul #(
        .A_INT   (`RT_SHADE_INT),
        .A_FRAC  (`RT_SHADE_FRAC),
        .B_INT   (`RT_COEFF_INT),
        .B_FRAC  (`RT_COEFF_FRAC),
        .OUT_INT (`RT_SHADE_INT),
        .OUT_FRAC(`RT_SHADE_FRAC),
        .SIGNED  (0),
        .TAG_W   (STEP_W + GEOMETRY_W)
    ) u_weight (
        .clk      (clk),
        .rst      (rst),
        .in_valid (share_valid),
        .in_tag   ({share_what, share_geometry}),
        .a        (share_weight),
        .b        (share_transmits ? shares_reg[0+:3*COEFF_W] : shares_reg[3*COEFF_W+:3*COEFF_W]),
        .out_valid(weight_valid),
        .out_tag  ({weight_what, weight_point, weight_direction, weight_normal, weight_mirrored,
                    weight_cosine, weight_index, weight_leaving}),
        .p        (weight)
    );

    // ------------------------------------------------ direction
    wire turned_valid;
    wire [SLOT_W-1:0] turned_slot;
    wire [DEPTH_W-1:0] turned_depth;
    wire turned_hit;
    wire turned_branching;
    wire [LIGHT_W-1:0] turned_step;
    wire [LIGHT_W-1:0] turned_more;
    wire [OBJECT_W:0] turned_own;
    wire [3*SHADE_W-1:0] turned_weight;
    wire [3*POINT_W-1:0] turned_point;
    wire [3*UNIT_W-1:0] turned_mirrored;
    wire [3*UNIT_W-1:0] transmitted;
    wire unused_total;

    refract #(
        .TAG_W(STEP_W + 3*SHADE_W + 3*POINT_W + 3*UNIT_W)
    ) u_refract (
        .clk        (clk),
        .rst        (rst),
        .in_valid   (weight_valid),
        .in_tag     ({weight_what, weight, weight_point, weight_mirrored}),
        .direction  (weight_direction),
        .normal     (weight_normal),
        .mirrored   (weight_mirrored),
        .cosine     (weight_cosine),
        .index      (weight_index),
        .leaving    (weight_leaving),
        .out_valid  (turned_valid),
        .out_tag    ({turned_slot, turned_depth, turned_hit, turned_branching, turned_step, turned_more,
                      turned_own, turned_weight, turned_point, turned_mirrored}),
        .transmitted(transmitted),
        .total      (unused_total)
    );

    // ------------------------------------------------ which of it comes to be
    wire deeper = turned_depth < max_depth;
    wire reflected_step = turned_step == REFLECTED;
    wire transmitted_step = turned_step == TRANSMITTED && turned_branching;
    wire heavy = turned_weight[0+:SHADE_W] >= LEAST || turned_weight[SHADE_W+:SHADE_W] >= LEAST
              || turned_weight[2*SHADE_W+:SHADE_W] >= LEAST;
    wire cast = turned_hit && deeper && heavy && (reflected_step || transmitted_step);
    // Step 0 answers for the reflected ray, and for the transmitted one where no step of it comes.
    wire [1:0] due = reflected_step ? {1'b0, reflects} + {1'b0, transmits && !turned_branching}
                                    : {1'b0, transmitted_step};
    wire [1:0] idle_places = deeper ? due - {1'b0, cast} : 2'd0;

    reg child_valid_reg;
    reg settle_valid_reg;
    reg more_valid_reg;
    reg [DEPTH_W-1:0] depth_reg;
    reg [1:0] settle_count_reg;
    reg [SLOT_W-1:0] slot_reg;
    reg [COUNT_W-1:0] more_count_reg;
    reg [OBJECT_W:0] own_reg;
    reg [3*SHADE_W-1:0] weight_reg;
    reg [3*POINT_W-1:0] point_reg;
    reg [3*UNIT_W-1:0] direction_reg;

    always @(posedge clk) begin
        if (rst) begin
            child_valid_reg  <= 1'b0;
            settle_valid_reg <= 1'b0;
            more_valid_reg   <= 1'b0;
        end else begin
            child_valid_reg  <= turned_valid && cast;
            settle_valid_reg <= turned_valid && idle_places != 2'd0;
            more_valid_reg   <= turned_valid;
        end
    end

    always @(posedge clk) begin
        depth_reg        <= turned_depth + ONE_DEEPER;
        settle_count_reg <= idle_places;
        slot_reg         <= turned_slot;
        own_reg          <= turned_own;
        weight_reg       <= turned_weight;
        point_reg        <= turned_point;
        direction_reg    <= transmitted_step ? transmitted : turned_mirrored;
        more_count_reg   <= {{COUNT_W - 1{1'b0}}, cast}
                          + (reflected_step ? {{COUNT_W - LIGHT_W{1'b0}}, turned_more} : {COUNT_W{1'b0}});
    end

    assign child_valid  = child_valid_reg;
    assign child_depth  = depth_reg;
    assign child        = {slot_reg, own_reg, weight_reg, point_reg, direction_reg};
    assign settle_valid = settle_valid_reg;
    assign settle_depth = depth_reg;
    assign settle_count = settle_count_reg;
    assign more_valid   = more_valid_reg;
    assign more_slot    = slot_reg;
    assign more_count   = more_count_reg;

endmodule

`default_nettype wire
