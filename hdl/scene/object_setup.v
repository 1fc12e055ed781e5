// SPDX-License-Identifier: Apache-2.0
//
// object_setup: what tests and shading need of the objects and a frame does not hold, once a frame.
//
//     ambient    = ambient light * k_ambient, point-wise, floored and saturated
//     radius_sq  = radius^2, exact                                               of a sphere
//     inv_radius = 1 / radius, floored                                           of a sphere
//     normal     = normalise((p1 - p0) x (p2 - p0)), the product exact           of a triangle
//
// All spheres, then all triangles of the frame, one after the other; each ends in one row of the
// tables. One multiplier, one divider and the ray generator's normaliser, which is idle meanwhile,
// are shared by all of it.
//
// Parameters
//   SPHERE_INDEX_W, TRIANGLE_INDEX_W  bits of an index among its kind, at most 8
//   OBJECT_W                          bits of an object's number
//   WIDE_W                            bits of a component that the normaliser takes
//
// Ports
//   start           a new frame, ignored until the last one is done; `spheres`, `triangles` (counts),
//                   `ambient_light` {r, g, b} (RT_COEFF) and the records hold still until done
//   sphere_index, sphere, triangle_index, triangle    read ports of scene_memory
//   vector_valid, vector    to the normaliser {x, y, z}
//   unit_valid, unit        from the normaliser, RT_UNIT; 0 for the vector 0
//   table_valid     one row is written: number of the object `table_index`, spheres first, and
//     table_geometry  {triangle, dead, glass, shape 3 x RT_UNIT_W, vertices p0 p1 p2 9 x RT_COORD_W,
//                     k_transparency 3 x RT_COEFF_W}; shape is the normal, or radius_sq in the low
//                     bits; a sphere has its center in p0 and 0 in p1 and p2. dead: a triangle
//                     without area, which no ray hits. glass: some k_transparency is not 0
//     table_surface   {triangle, index 4, shape 3 x RT_UNIT_W, center 3 x RT_COORD_W}; shape is the
//                     normal, or inv_radius in the low bits; center is 0 for a triangle
//     table_material  {ambient 3 x RT_SHADE_W, k_diffuse, k_specular, k_reflection, k_transparency
//                     3 x RT_COEFF_W each}
//   reflects, transmits     some object of the frame has a k_reflection, a k_transparency that is
//                   not 0; from done to the next start
//   degenerate      one clock for each triangle without area
//   done            one clock behind the last row
//
// Latency from start to done 3 clocks, RT_INV_RADIUS_W + 4 for a sphere, and 17 and the latency of
// the normaliser for a triangle.

`default_nettype none
`include "raytracer.vh"

module object_setup #(
    parameter SPHERE_INDEX_W   = 2,
    parameter TRIANGLE_INDEX_W = 4,
    parameter OBJECT_W         = 5,
    parameter WIDE_W           = 41
) (
    input  wire                                    clk,
    input  wire                                    rst,
    input  wire                                    start,
    input  wire [                             7:0] spheres,
    input  wire [                             7:0] triangles,
    input  wire [               3*`RT_COEFF_W-1:0] ambient_light,
    output wire [              SPHERE_INDEX_W-1:0] sphere_index,
    input  wire [`RT_SPHERE_SLOTS*`RT_COORD_W-1:0] sphere,
    output wire [            TRIANGLE_INDEX_W-1:0] triangle_index,
    input  wire [`RT_RECORD_SLOTS*`RT_COORD_W-1:0] triangle,
    output wire                                    vector_valid,
    output wire [                    3*WIDE_W-1:0] vector,
    input  wire                                    unit_valid,
    input  wire [                3*`RT_UNIT_W-1:0] unit,
    output wire                                    table_valid,
    output wire [                    OBJECT_W-1:0] table_index,
    output wire [               `RT_GEOMETRY_W-1:0] table_geometry,
    output wire [                `RT_SURFACE_W-1:0] table_surface,
    output wire [               `RT_MATERIAL_W-1:0] table_material,
    output wire                                    reflects,
    output wire                                    transmits,
    output wire                                    degenerate,
    output wire                                    done
);

    localparam W = `RT_COORD_W;
    localparam COEFF_W = `RT_COEFF_W;
    localparam UNIT_W = `RT_UNIT_W;
    localparam INDEX_W = 8;
    // Operands of the multiplier: differences of coordinates, coefficients with a sign on top.
    localparam FACTOR_W = W + 1;
    localparam PRODUCT_W = 2 * FACTOR_W;
    // 1.0 at the fraction of the quotient and of the divisor.
    localparam [`RT_INV_RADIUS_W-1:0] ONE = 1 << (`RT_INV_RADIUS_FRAC + `RT_RADIUS_FRAC);

    generate
        if (WIDE_W < PRODUCT_W + 1) begin : g_bad_wide
            object_setup_needs_a_WIDE_W_that_holds_its_cross_products error ();
        end
        if (SPHERE_INDEX_W > INDEX_W || TRIANGLE_INDEX_W > INDEX_W) begin : g_bad_index
            object_setup_needs_indices_of_at_most_8_bits error ();
        end
    endgenerate

    localparam [2:0] S_IDLE = 3'd0;
    localparam [2:0] S_NEXT = 3'd1;
    localparam [2:0] S_READ = 3'd2;
    localparam [2:0] S_START = 3'd3;
    localparam [2:0] S_PRODUCTS = 3'd4;
    localparam [2:0] S_ASK = 3'd5;
    localparam [2:0] S_WAIT = 3'd6;
    localparam [2:0] S_WRITE = 3'd7;

    reg [2:0] state_reg;
    reg [2:0] state_next;

    // The object at hand: whether it is a triangle, its index among its kind, its number.
    reg is_triangle_reg;
    reg [INDEX_W-1:0] index_reg;
    reg [OBJECT_W-1:0] object_reg;
    reg done_reg;

    wire kind_ends = index_reg == (is_triangle_reg ? triangles : spheres);
    wire frame_ends = state_reg == S_NEXT && kind_ends && is_triangle_reg;
    wire take = state_reg == S_IDLE && start;

    always @(posedge clk) begin
        if (take) begin
            is_triangle_reg <= 1'b0;
            index_reg <= {INDEX_W{1'b0}};
            object_reg <= {OBJECT_W{1'b0}};
        end else if (state_reg == S_NEXT && kind_ends) begin
            is_triangle_reg <= 1'b1;
            index_reg <= {INDEX_W{1'b0}};
        end else if (state_reg == S_WRITE) begin
            index_reg <= index_reg + 1'b1;
            object_reg <= object_reg + 1'b1;
        end
    end

    assign sphere_index = index_reg[SPHERE_INDEX_W-1:0];
    assign triangle_index = index_reg[TRIANGLE_INDEX_W-1:0];

    // Its record; the index holds still, so it does too.
    localparam MATERIAL_SLOTS = 16;
    wire [MATERIAL_SLOTS*W-1:0] sphere_material = sphere[4*W+:MATERIAL_SLOTS*W];
    wire [MATERIAL_SLOTS*W-1:0] triangle_material = triangle[9*W+:MATERIAL_SLOTS*W];
    wire [3*W-1:0] center = sphere[W+:3*W];
    wire [`RT_RADIUS_W-1:0] radius = sphere[0+:`RT_RADIUS_W];
    wire [9*W-1:0] vertices = triangle[0+:9*W];
    wire [3*COEFF_W-1:0] k_ambient;
    wire [3*COEFF_W-1:0] k_diffuse;
    wire [3*COEFF_W-1:0] k_specular;
    wire [3*COEFF_W-1:0] k_reflection;
    wire [3*COEFF_W-1:0] k_transparency;
    wire [W-1:0] index;
    assign {k_ambient, k_diffuse, k_specular, k_reflection, k_transparency, index} =
        is_triangle_reg ? triangle_material : sphere_material;
    wire unused_record = &{
        1'b0, sphere[20*W+:W], sphere[W-1:`RT_RADIUS_W], triangle[25*W+:W], index[W-1:`RT_INDEX_W]
    };

    // Sequence of products: `issue_reg` counts those sent, `collect` those that came back. Products
    // 0 to 5 are those of the cross product: 2 k and 2 k + 1 make its component k (x, y, z). A sphere
    // has no use for them, but waits longer for its quotient. Products 6 to 8 are the ambient term
    // {r, g, b}; the last one alone has bit 3.
    localparam [3:0] AMBIENT = 4'd6;
    localparam [3:0] LAST = 4'd8;
    reg [3:0] issue_reg;
    wire issue = state_reg == S_PRODUCTS && issue_reg <= LAST;
    wire collect_valid;
    wire [3:0] collect;
    wire collected = collect_valid && collect[3];

    always @(posedge clk) begin
        if (state_reg == S_START) issue_reg <= 4'd0;
        else if (issue) issue_reg <= issue_reg + 1'b1;
    end

    // Lane 2, 1, 0 of a vector is its x, y, z. a x b: x is a_y b_z - a_z b_y, and so on round.
    reg [1:0] first;
    reg [1:0] second;

    always @* begin
        case (issue_reg)
            4'd0: {first, second} = {2'd1, 2'd0};
            4'd1: {first, second} = {2'd0, 2'd1};
            4'd2: {first, second} = {2'd0, 2'd2};
            4'd3: {first, second} = {2'd2, 2'd0};
            4'd4: {first, second} = {2'd2, 2'd1};
            4'd5: {first, second} = {2'd1, 2'd2};
            4'd6: {first, second} = {2'd2, 2'd2};
            4'd7: {first, second} = {2'd1, 2'd1};
            default: {first, second} = {2'd0, 2'd0};
        endcase
    end

    function [FACTOR_W-1:0] difference;
        input [3*W-1:0] to;
        input [3*W-1:0] from;
        input [1:0] lane;
        reg [W-1:0] minuend;
        reg [W-1:0] subtrahend;
        begin
            minuend = to[lane*W+:W];
            subtrahend = from[lane*W+:W];
            difference = {minuend[W-1], minuend} - {subtrahend[W-1], subtrahend};
        end
    endfunction

    wire [3*W-1:0] p0 = vertices[6*W+:3*W];
    wire [3*W-1:0] p1 = vertices[3*W+:3*W];
    wire [3*W-1:0] p2 = vertices[0+:3*W];
    wire ambient_now = issue_reg >= AMBIENT;
    wire [FACTOR_W-1:0] a =
        ambient_now ? {1'b0, ambient_light[first*COEFF_W+:COEFF_W]} : difference(p1, p0, first);
    wire [FACTOR_W-1:0] b =
        ambient_now ? {1'b0, k_ambient[second*COEFF_W+:COEFF_W]} : difference(p2, p0, second);
    wire [PRODUCT_W-1:0] product;

    mul #(
        .A_W  (FACTOR_W),
        .B_W  (FACTOR_W),
        .LANES(1),
        .TAG_W(4)
    ) u_mul (
        .clk      (clk),
        .rst      (rst),
        .in_valid (issue),
        .in_tag   (issue_reg),
        .a        (a),
        .b        (b),
        .out_valid(collect_valid),
        .out_tag  (collect),
        .p        (product)
    );

    // Results gather by shifting components in from the right, x or r first.
    reg [PRODUCT_W-1:0] minuend_reg;
    reg [3*WIDE_W-1:0] cross_reg;
    wire [PRODUCT_W:0] component =
        {minuend_reg[PRODUCT_W-1], minuend_reg} - {product[PRODUCT_W-1], product};
    wire [WIDE_W-1:0] component_wide = {
        {WIDE_W - PRODUCT_W{component[PRODUCT_W]}}, component[PRODUCT_W-1:0]
    };

    always @(posedge clk) begin
        if (collect_valid) minuend_reg <= product;
        if (collect_valid && collect < AMBIENT && collect[0])
            cross_reg <= {cross_reg[2*WIDE_W-1:0], component_wide};
    end

    localparam SHADE_W = `RT_SHADE_W;
    reg [3*SHADE_W-1:0] ambient_reg;
    wire [SHADE_W-1:0] shade;

    resize #(
        .IN_INT    (PRODUCT_W - 2 * `RT_COEFF_FRAC),
        .IN_FRAC   (2 * `RT_COEFF_FRAC),
        .OUT_INT   (`RT_SHADE_INT),
        .OUT_FRAC  (`RT_SHADE_FRAC),
        .OUT_SIGNED(0)
    ) u_shade (
        .in (product),
        .out(shade)
    );

    // The last three products stay.
    always @(posedge clk) if (collect_valid) ambient_reg <= {ambient_reg[2*SHADE_W-1:0], shade};

    // 1 / radius waits in the divider until its row is written.
    wire write = state_reg == S_WRITE;
    wire quotient_valid;
    wire [`RT_INV_RADIUS_W-1:0] inv_radius;
    wire [`RT_RADIUS_W-1:0] unused_remainder;
    wire unused_ready;
    reg [`RT_RADIUS_SQ_W-1:0] radius_sq_reg;

    div_iter #(
        .NUM_W(`RT_INV_RADIUS_W),
        .DEN_W(`RT_RADIUS_W)
    ) u_inverse (
        .clk      (clk),
        .rst      (rst),
        .in_valid (state_reg == S_START && !is_triangle_reg),
        .in_ready (unused_ready),
        .num      (ONE),
        .den      (radius),
        .out_valid(quotient_valid),
        .out_ready(write),
        .quotient (inv_radius),
        .remainder(unused_remainder)
    );

    always @(posedge clk) if (state_reg == S_START) radius_sq_reg <= radius * radius;

    assign vector_valid = state_reg == S_ASK;
    assign vector = cross_reg;

    reg [3*UNIT_W-1:0] normal_reg;
    always @(posedge clk) if (unit_valid) normal_reg <= unit;

    // Rows.
    wire dead = is_triangle_reg && cross_reg == {3 * WIDE_W{1'b0}};
    wire glass = k_transparency != {3 * COEFF_W{1'b0}};
    wire mirror = k_reflection != {3 * COEFF_W{1'b0}};
    wire [3*UNIT_W-1:0] tested = {{3 * UNIT_W - `RT_RADIUS_SQ_W{1'b0}}, radius_sq_reg};
    wire [3*UNIT_W-1:0] shaded = {{3 * UNIT_W - `RT_INV_RADIUS_W{1'b0}}, inv_radius};

    assign table_valid = write;
    assign table_index = object_reg;
    assign table_geometry = {
        is_triangle_reg,
        dead,
        glass,
        is_triangle_reg ? normal_reg : tested,
        is_triangle_reg ? vertices : {center, {6 * W{1'b0}}},
        k_transparency
    };
    assign table_surface = {
        is_triangle_reg,
        index[`RT_INDEX_W-1:0],
        is_triangle_reg ? normal_reg : shaded,
        is_triangle_reg ? {3 * W{1'b0}} : center
    };
    assign table_material = {ambient_reg, k_diffuse, k_specular, k_reflection, k_transparency};
    assign degenerate = write && dead;

    reg reflects_reg;
    reg transmits_reg;

    always @(posedge clk) begin
        if (take) begin
            reflects_reg  <= 1'b0;
            transmits_reg <= 1'b0;
        end else if (write) begin
            reflects_reg  <= reflects_reg || mirror;
            transmits_reg <= transmits_reg || glass;
        end
    end

    assign reflects  = reflects_reg;
    assign transmits = transmits_reg;

    always @* begin
        state_next = state_reg;
        case (state_reg)
            S_IDLE: if (start) state_next = S_NEXT;
            S_NEXT: begin
                if (frame_ends) state_next = S_IDLE;
                else if (!kind_ends) state_next = S_READ;
            end
            S_READ: state_next = S_START;
            S_START: state_next = S_PRODUCTS;
            S_PRODUCTS: if (collected) state_next = is_triangle_reg ? S_ASK : S_WAIT;
            S_ASK: state_next = S_WAIT;
            S_WAIT: if (is_triangle_reg ? unit_valid : quotient_valid) state_next = S_WRITE;
            default: state_next = S_NEXT;
        endcase
    end

    always @(posedge clk) begin
        if (rst) state_reg <= S_IDLE;
        else state_reg <= state_next;
    end

    always @(posedge clk) begin
        if (rst) done_reg <= 1'b0;
        else done_reg <= frame_ends;
    end

    assign done = done_reg;

endmodule

`default_nettype wire
