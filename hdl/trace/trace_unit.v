// SPDX-License-Identifier: Apache-2.0
//
// trace_unit: one ray after the other against all objects, one test a clock (book 8.2.2, 8.2.3).
//
// Of a ray it finds the nearest hit, of equal distances the lowest object number's. Of a shadow
// ray it finds the light that is left behind all objects before its limit, each of which filters
// it once, in the order of the object numbers. A ray that starts on a triangle is not tested
// against it: a plane cannot be met twice, whatever rounding says.
//
// Parameters
//   OBJECTS   objects that the tables hold
//   OBJECT_W  bits of an object's number
//   SLOT_W    bits of a pixel slot
//   SIDE_W    bits of a ray that only its hit needs, beside origin and direction
//   ROOM      rays of each kind in the unit or behind it, a power of two
//
// Ports
//   table_*   rows of the objects, see object_setup; objects: how many the frame has. Both change
//             only while no ray is in the unit
//   ray_*     a ray: {side, own, origin, direction}
//   shadow_*  a shadow ray: {slot, own, base, colour, origin, direction, limit}. own: {1, number} of
//             the triangle that it starts on, else {0, any}; colour: light that sets out, base: what
//             else belongs to the term, {r, g, b}, RT_SHADE
//             ray_free, shadow_free: a ray of this kind may come; only one of the kinds in a clock
//   hit_*     stream: {side, origin, direction} of the ray, and {hit, number, glass, leaving, distance,
//             offset, half_chord}; glass: the object lets light through
//   term_*    stream: {slot, base + light that is left}, saturated
//   tested    a test of this clock counts: it is neither of a triangle that the ray starts on, nor
//             of a degenerate one
//
// Rate one test a clock, without a gap between rays. Latency from a ray's last test to its result 1
// (tables) + intersection + 1 + fifo. Results of each kind are in the order of the rays. Nothing
// stalls between the start of a ray and its result: there is room for it when it starts.

`default_nettype none
`include "raytracer.vh"

module trace_unit #(
    parameter OBJECTS  = 18,
    parameter OBJECT_W = 5,
    parameter SLOT_W   = 9,
    parameter SIDE_W   = 75,
    parameter ROOM     = 64
) (
    input  wire                        clk,
    input  wire                        rst,
    input  wire                        table_valid,
    input  wire [        OBJECT_W-1:0] table_index,
    input  wire [  `RT_GEOMETRY_W-1:0] table_geometry,
    input  wire [          OBJECT_W:0] objects,
    output wire                        ray_free,
    input  wire                        ray_valid,
    input  wire [SIDE_W+OBJECT_W+1+3*`RT_POINT_W+3*`RT_UNIT_W-1:0] ray,
    output wire                        shadow_free,
    input  wire                        shadow_valid,
    input  wire [SLOT_W+OBJECT_W+1+6*`RT_SHADE_W+4*`RT_POINT_W+3*`RT_UNIT_W-1:0] shadow,
    output wire                        hit_valid,
    input  wire                        hit_ready,
    output wire [SIDE_W+3*`RT_POINT_W+3*`RT_UNIT_W+OBJECT_W+3+`RT_POINT_W
                 +3*`RT_OFFSET_W+`RT_HALF_CHORD_W-1:0] hit,
    output wire                        term_valid,
    input  wire                        term_ready,
    output wire [SLOT_W+3*`RT_SHADE_W-1:0] term,
    output wire                        tested
);

    localparam UNIT_W = `RT_UNIT_W;
    localparam POINT_W = `RT_POINT_W;
    localparam SHADE_W = `RT_SHADE_W;
    localparam LINE_W = 3 * POINT_W + 3 * UNIT_W;
    localparam [POINT_W-1:0] INFINITY = `RT_INFINITY;
    // A ray is hit before infinity, so that its distance has no other bits.
    localparam DISTANCE_W = $clog2(`RT_INFINITY);
    localparam DISTANCE_LOW = 3 * `RT_OFFSET_W + `RT_HALF_CHORD_W;
    localparam FOUND_W = OBJECT_W + 2 + DISTANCE_W + DISTANCE_LOW;

    generate
        if (OBJECTS > 1 << OBJECT_W) begin : g_bad_objects
            trace_unit_needs_an_OBJECT_W_that_counts_its_OBJECTS error ();
        end
    endgenerate

    // ------------------------------------------------ the ray at hand, and its next object
    wire [SIDE_W-1:0] ray_side;
    wire [OBJECT_W:0] ray_own;
    wire [LINE_W-1:0] ray_line;
    assign {ray_side, ray_own, ray_line} = ray;

    wire [SLOT_W-1:0] shadow_slot;
    wire [OBJECT_W:0] shadow_own;
    wire [3*SHADE_W-1:0] shadow_base;
    wire [3*SHADE_W-1:0] shadow_colour;
    wire [LINE_W-1:0] shadow_line;
    wire [POINT_W-1:0] shadow_limit;
    assign {shadow_slot, shadow_own, shadow_base, shadow_colour, shadow_line, shadow_limit} = shadow;

    reg busy_reg;
    reg is_shadow_reg;
    reg first_reg;
    reg [OBJECT_W-1:0] index_reg;
    reg [OBJECT_W:0] own_reg;
    reg [LINE_W-1:0] line_reg;
    reg [POINT_W-1:0] limit_reg;
    reg [3*SHADE_W-1:0] colour_reg;

    wire [OBJECT_W:0] own_at_start = shadow_valid ? shadow_own : ray_own;
    wire skip_first = own_at_start == {1'b1, {OBJECT_W{1'b0}}};
    wire [OBJECT_W:0] following = {1'b0, index_reg} + 1'b1;
    wire skip_next = own_reg == {1'b1, following[OBJECT_W-1:0]};
    wire [OBJECT_W:0] next_index = skip_next ? following + 1'b1 : following;
    wire last = next_index >= objects;
    wire start = ray_valid || shadow_valid;
    wire loadable = !busy_reg || last;

    always @(posedge clk) begin
        if (rst) busy_reg <= 1'b0;
        else if (start) busy_reg <= 1'b1;
        else if (last) busy_reg <= 1'b0;
    end

    always @(posedge clk) begin
        index_reg <= start ? {{OBJECT_W - 1{1'b0}}, skip_first} : next_index[OBJECT_W-1:0];
        first_reg <= start;
    end

    always @(posedge clk) begin
        if (start) begin
            is_shadow_reg <= shadow_valid;
            own_reg       <= own_at_start;
            line_reg      <= shadow_valid ? shadow_line : ray_line;
            limit_reg     <= shadow_valid ? shadow_limit : INFINITY;
            colour_reg    <= shadow_colour;
        end
    end

    // ------------------------------------------------ the object's row
    reg [`RT_GEOMETRY_W-1:0] rows[0:OBJECTS-1];
    reg [`RT_GEOMETRY_W-1:0] row_reg;

    always @(posedge clk) begin
        if (table_valid) rows[table_index] <= table_geometry;
        row_reg <= rows[index_reg];
    end

    wire row_triangle;
    wire row_dead;
    wire row_glass;
    wire [3*UNIT_W-1:0] row_shape;
    wire [9*`RT_COORD_W-1:0] row_vertices;
    wire [3*`RT_COEFF_W-1:0] row_transparency;
    assign {row_triangle, row_dead, row_glass, row_shape, row_vertices, row_transparency} = row_reg;

    reg test_valid_reg;
    reg test_shadow_reg;
    reg test_first_reg;
    reg test_last_reg;
    reg test_void_reg;
    reg [OBJECT_W-1:0] test_index_reg;
    reg [LINE_W-1:0] test_line_reg;
    reg [POINT_W-1:0] test_limit_reg;
    reg [3*SHADE_W-1:0] test_colour_reg;

    always @(posedge clk) begin
        if (rst) test_valid_reg <= 1'b0;
        else test_valid_reg <= busy_reg;
    end

    always @(posedge clk) begin
        test_shadow_reg <= is_shadow_reg;
        test_first_reg  <= first_reg;
        test_last_reg   <= last;
        // Where there is no object to test, one test of none ends the ray.
        test_void_reg   <= {1'b0, index_reg} >= objects;
        test_index_reg  <= index_reg;
        test_line_reg   <= line_reg;
        test_limit_reg  <= limit_reg;
        test_colour_reg <= colour_reg;
    end

    wire blank = test_void_reg || row_dead;
    assign tested = test_valid_reg && !blank;

    // ------------------------------------------------ the test
    localparam TEST_TAG_W = 5 + OBJECT_W + 3 * `RT_COEFF_W + 3 * SHADE_W;
    wire found_valid;
    wire found_shadow;
    wire found_first;
    wire found_last;
    wire found_blank;
    wire found_glass;
    wire [OBJECT_W-1:0] found_index;
    wire [3*`RT_COEFF_W-1:0] found_transparency;
    wire [3*SHADE_W-1:0] found_colour;
    wire found_hit;
    wire found_leaving;
    wire [POINT_W-DISTANCE_W-1:0] unused_distance;
    wire [DISTANCE_W-1:0] found_distance;
    wire [3*`RT_OFFSET_W-1:0] found_offset;
    wire [`RT_HALF_CHORD_W-1:0] found_half_chord;

    intersection #(
        .TAG_W(TEST_TAG_W)
    ) u_intersection (
        .clk       (clk),
        .rst       (rst),
        .in_valid  (test_valid_reg),
        .in_tag    ({test_shadow_reg, test_first_reg, test_last_reg, blank, row_glass, test_index_reg,
                     row_transparency, test_colour_reg}),
        .origin    (test_line_reg[3*UNIT_W+:3*POINT_W]),
        .direction (test_line_reg[0+:3*UNIT_W]),
        .limit     (test_limit_reg),
        .triangle  (row_triangle),
        .shape     (row_shape),
        .vertices  (row_vertices),
        .out_valid (found_valid),
        .out_tag   ({found_shadow, found_first, found_last, found_blank, found_glass, found_index,
                     found_transparency, found_colour}),
        .hit       (found_hit),
        .leaving   (found_leaving),
        .distance  ({unused_distance, found_distance}),
        .offset    (found_offset),
        .half_chord(found_half_chord)
    );

    // ------------------------------------------------ the nearest hit, or the light that is left
    wire meets = found_hit && !found_blank;
    reg any_hit_reg;
    reg [FOUND_W-1:0] nearest_reg;
    reg [3*SHADE_W-1:0] light_reg;
    reg nearest_done_reg;
    reg light_done_reg;

    wire [DISTANCE_W-1:0] nearest_distance = nearest_reg[DISTANCE_LOW+:DISTANCE_W];
    wire so_far = any_hit_reg && !found_first;
    wire nearer = meets && (!so_far || found_distance < nearest_distance);
    wire [3*SHADE_W-1:0] light = found_first ? found_colour : light_reg;
    wire [3*SHADE_W-1:0] dimmed;

    dim u_dim (
        .colour(light),
        .share (found_transparency),
        .dimmed(dimmed)
    );

    // Between rays these are anything: the first test of a ray begins anew.
    always @(posedge clk) begin
        if (!found_shadow) begin
            any_hit_reg <= meets || so_far;
            if (nearer || found_first)
                nearest_reg <= {found_index, found_glass, found_leaving, found_distance,
                                found_offset, found_half_chord};
        end
    end

    always @(posedge clk) if (found_shadow) light_reg <= meets ? dimmed : light;

    always @(posedge clk) begin
        if (rst) begin
            nearest_done_reg <= 1'b0;
            light_done_reg   <= 1'b0;
        end else begin
            nearest_done_reg <= found_valid && found_last && !found_shadow;
            light_done_reg   <= found_valid && found_last && found_shadow;
        end
    end

    // ------------------------------------------------ what waits for its result, and the results
    // Places are taken when a ray starts, and free again when its result has left, so that the
    // queue of results, as long, has room for each. What waits is there before its result, which
    // alone says that both are.
    wire hit_side_ready;
    wire unused_hit_side_valid;
    wire [SIDE_W+LINE_W-1:0] hit_side;
    wire hit_found_valid;
    wire [FOUND_W:0] hit_found;
    wire [$clog2(ROOM):0] unused_hit_side_room;
    wire [$clog2(ROOM):0] unused_hit_room;
    wire unused_hit_found_ready;
    wire hit_taken = hit_valid && hit_ready;

    fifo #(
        .WIDTH(SIDE_W + LINE_W),
        .DEPTH(ROOM)
    ) u_hit_side (
        .clk      (clk),
        .rst      (rst),
        .in_valid (ray_valid),
        .in_ready (hit_side_ready),
        .in_data  ({ray_side, ray_line}),
        .out_valid(unused_hit_side_valid),
        .out_ready(hit_taken),
        .out_data (hit_side),
        .room     (unused_hit_side_room)
    );

    fifo #(
        .WIDTH(1 + FOUND_W),
        .DEPTH(ROOM)
    ) u_hit_found (
        .clk      (clk),
        .rst      (rst),
        .in_valid (nearest_done_reg),
        .in_ready (unused_hit_found_ready),
        .in_data  ({any_hit_reg, nearest_reg}),
        .out_valid(hit_found_valid),
        .out_ready(hit_taken),
        .out_data (hit_found),
        .room     (unused_hit_room)
    );

    assign hit_valid = hit_found_valid;
    assign hit       = {hit_side, hit_found[FOUND_W:DISTANCE_LOW+DISTANCE_W],
                        {POINT_W - DISTANCE_W{1'b0}}, hit_found[DISTANCE_LOW+DISTANCE_W-1:0]};

    wire term_side_ready;
    wire unused_term_side_valid;
    wire [SLOT_W-1:0] term_slot;
    wire [3*SHADE_W-1:0] term_base;
    wire term_light_valid;
    wire [3*SHADE_W-1:0] term_light;
    wire [$clog2(ROOM):0] unused_term_side_room;
    wire [$clog2(ROOM):0] unused_term_room;
    wire unused_term_light_ready;
    wire term_taken = term_valid && term_ready;

    fifo #(
        .WIDTH(SLOT_W + 3 * SHADE_W),
        .DEPTH(ROOM)
    ) u_term_side (
        .clk      (clk),
        .rst      (rst),
        .in_valid (shadow_valid),
        .in_ready (term_side_ready),
        .in_data  ({shadow_slot, shadow_base}),
        .out_valid(unused_term_side_valid),
        .out_ready(term_taken),
        .out_data ({term_slot, term_base}),
        .room     (unused_term_side_room)
    );

    fifo #(
        .WIDTH(3 * SHADE_W),
        .DEPTH(ROOM)
    ) u_term_light (
        .clk      (clk),
        .rst      (rst),
        .in_valid (light_done_reg),
        .in_ready (unused_term_light_ready),
        .in_data  (light_reg),
        .out_valid(term_light_valid),
        .out_ready(term_taken),
        .out_data (term_light),
        .room     (unused_term_room)
    );

    genvar lane;
    wire [3*SHADE_W-1:0] sum;
    generate
        for (lane = 0; lane < 3; lane = lane + 1) begin : g_sum
            wire [SHADE_W:0] wide = {1'b0, term_base[lane*SHADE_W+:SHADE_W]}
                                  + {1'b0, term_light[lane*SHADE_W+:SHADE_W]};
            assign sum[lane*SHADE_W+:SHADE_W] = wide[SHADE_W-1:0] | {SHADE_W{wide[SHADE_W]}};
        end
    endgenerate

    assign term_valid  = term_light_valid;
    assign term        = {term_slot, sum};
    assign ray_free    = loadable && hit_side_ready;
    assign shadow_free = loadable && term_side_ready;

endmodule

`default_nettype wire
