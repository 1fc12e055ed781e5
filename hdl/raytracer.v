// SPDX-License-Identifier: Apache-2.0
//
// raytracer: the core. A packed frame in, a picture out; see README.md beside this file.
//
//     frame -> loader -> scene memory -> camera, object set-up -> tables
//
//     pixel slots -> ray generator -> unit vector -> ray store -> trace units -> shader
//                                                       ^------- children --------/ |
//     pixel queue <- RGB888 <- accumulator <- terms <- trace units <- shadow rays --+
//
// Parameters
//   UNITS              trace units: tests of a ray against an object in one clock
//   PIXELS_IN_FLIGHT   slots of the pixel queue, a power of two; 512 sustain one pixel a clock
//   LEVEL_ROOM         rays of each depth in the ray store, a power of two
//   SIZE_W             bits of width and height
//   *_COUNT_W          bits of the frame's counters: they set what a frame may hold
//   MAX_DEPTH          deepest ray, 1 to 7; the primary ray has depth 1
//   MIN_WEIGHT         smallest weight of a secondary ray, RT_SHADE raw
//
// Ports
//   width, height      of the picture; tan_h, tan_v: RT_TAN, tangents of the half field of view.
//                      Taken with the first frame after reset, fixed until the next reset
//   depth              of the deepest ray, 1 to MAX_DEPTH; taken with each frame
//   go                 a frame that has been read is drawn while this is high
//   s_axis_frame_*     AXI4-Stream: the packed frame, 32 bits a word, most significant bit first,
//                      padded to whole words; `tlast` with the last word
//   m_axis_video_*     AXI4-Stream: the pixels, {r, g, b}; `tuser` start of frame, `tlast` end of line
//   picture_*          size of the pictures, from the first frame on
//   frame_start        one clock: a frame that has been read begins
//   frame_done         one clock: the last pixel of a frame has been taken
//   frame_error        one clock: a frame has been refused; `error_code` (RT_FAULT) beside it
//   busy               a frame is set up or drawn
//   cycles, *_rays, tests, lights_at_point, degenerate   see counters
//
// Rate up to one pixel a clock; a frame's set-up takes about 400 clocks and 25 to 70 for each object.
// The next frame is loaded while this one is drawn.

`default_nettype none
`include "raytracer.vh"

module raytracer #(
    parameter UNITS            = `RT_UNITS,
    parameter PIXELS_IN_FLIGHT = 512,
    parameter LEVEL_ROOM       = 256,
    parameter SIZE_W           = 12,
    parameter LIGHT_COUNT_W    = 2,
    parameter SPHERE_COUNT_W   = 2,
    parameter TRIANGLE_COUNT_W = 4,
    parameter MAX_DEPTH        = `RT_MAX_DEPTH,
    parameter MIN_WEIGHT       = `RT_MIN_WEIGHT
) (
    input  wire                        clk,
    input  wire                        rst,
    input  wire [          SIZE_W-1:0] width,
    input  wire [          SIZE_W-1:0] height,
    input  wire [       `RT_TAN_W-1:0] tan_h,
    input  wire [       `RT_TAN_W-1:0] tan_v,
    input  wire [                 2:0] depth,
    input  wire                        go,
    input  wire                        s_axis_frame_tvalid,
    output wire                        s_axis_frame_tready,
    input  wire [                31:0] s_axis_frame_tdata,
    input  wire                        s_axis_frame_tlast,
    output wire                        m_axis_video_tvalid,
    input  wire                        m_axis_video_tready,
    output wire [3*`RT_CHANNEL_W-1:0] m_axis_video_tdata,
    output wire                        m_axis_video_tuser,
    output wire                        m_axis_video_tlast,
    output wire [          SIZE_W-1:0] picture_width,
    output wire [          SIZE_W-1:0] picture_height,
    output wire                        frame_start,
    output wire                        frame_done,
    output wire                        frame_error,
    output wire [     `RT_FAULT_W-1:0] error_code,
    output wire                        busy,
    output wire [                31:0] cycles,
    output wire [                31:0] primary_rays,
    output wire [                31:0] secondary_rays,
    output wire [                31:0] shadow_rays,
    output wire [                31:0] tests,
    output wire [                31:0] lights_at_point,
    output wire [                31:0] degenerate
);

    localparam LIGHTS = (1 << LIGHT_COUNT_W) - 1;
    localparam SPHERES = (1 << SPHERE_COUNT_W) - 1;
    localparam TRIANGLES = (1 << TRIANGLE_COUNT_W) - 1;
    localparam OBJECTS = SPHERES + TRIANGLES;
    localparam OBJECT_W = $clog2(OBJECTS);
    localparam SLOT_W = $clog2(PIXELS_IN_FLIGHT);
    localparam DEPTH_W = 3;
    // More than all steps and children of a tree of MAX_DEPTH levels.
    localparam COUNT_W = MAX_DEPTH + LIGHT_COUNT_W + 2;
    localparam COORD_W = `RT_COORD_W;
    localparam COEFF_W = `RT_COEFF_W;
    localparam UNIT_W = `RT_UNIT_W;
    localparam POINT_W = `RT_POINT_W;
    localparam SHADE_W = `RT_SHADE_W;
    localparam SCREEN_W = `RT_SCREEN_W;
    // What is normalised: cross products of differences of coordinates, of unit vectors, directions.
    localparam EDGES_W = 2 * (COORD_W + 1) + 1;
    localparam WIDE_W = EDGES_W > 2 * UNIT_W + 1 ? EDGES_W : 2 * UNIT_W + 1;

    generate
        if (MAX_DEPTH < 1 || MAX_DEPTH > 7) begin : g_bad_depth
            raytracer_needs_a_MAX_DEPTH_of_1_to_7 error ();
        end
        if (LIGHT_COUNT_W < 2 || SPHERE_COUNT_W < 1 || TRIANGLE_COUNT_W < 1) begin : g_bad_counters
            raytracer_needs_a_LIGHT_COUNT_W_of_2_or_more_and_other_counters_of_1_or_more error ();
        end
        if (MIN_WEIGHT < 1) begin : g_bad_weight
            raytracer_needs_a_MIN_WEIGHT_of_1_or_more_lest_rays_without_weight_are_cast error ();
        end
    endgenerate

    // ---------------------------------------------------------------- frame
    wire load_ready;
    wire load_done;
    wire [`RT_FAULT_W-1:0] load_fault;
    wire record_valid;
    wire [2:0] record_kind;
    wire [7:0] record_index;
    wire [`RT_RECORD_SLOTS*COORD_W-1:0] record;
    wire [7:0] load_lights;
    wire [7:0] load_spheres;
    wire [7:0] load_triangles;

    loader #(
        .LIGHT_COUNT_W   (LIGHT_COUNT_W),
        .SPHERE_COUNT_W  (SPHERE_COUNT_W),
        .TRIANGLE_COUNT_W(TRIANGLE_COUNT_W),
        .MAX_LIGHTS      (LIGHTS),
        .MAX_SPHERES     (SPHERES),
        .MAX_TRIANGLES   (TRIANGLES)
    ) u_loader (
        .clk         (clk),
        .rst         (rst),
        .in_valid    (s_axis_frame_tvalid),
        .in_ready    (s_axis_frame_tready),
        .in_data     (s_axis_frame_tdata),
        .in_last     (s_axis_frame_tlast),
        .next_ready  (load_ready),
        .record_valid(record_valid),
        .record_kind (record_kind),
        .record_index(record_index),
        .record      (record),
        .done        (load_done),
        .fault       (load_fault),
        .lights      (load_lights),
        .spheres     (load_spheres),
        .triangles   (load_triangles)
    );

    wire swap;
    wire [LIGHT_COUNT_W-1:0] light_index;
    wire [6*COORD_W-1:0] light;
    wire [SPHERE_COUNT_W-1:0] sphere_index;
    wire [`RT_SPHERE_SLOTS*COORD_W-1:0] sphere;
    wire [TRIANGLE_COUNT_W-1:0] triangle_index;
    wire [`RT_RECORD_SLOTS*COORD_W-1:0] triangle;
    wire [3*COORD_W-1:0] camera_position;
    wire [3*COORD_W-1:0] camera_up;
    wire [3*COORD_W-1:0] camera_center;
    wire [3*COEFF_W-1:0] ambient_light;
    wire [3*COEFF_W-1:0] background;

    scene_memory #(
        .LIGHTS          (LIGHTS),
        .SPHERES         (SPHERES),
        .TRIANGLES       (TRIANGLES),
        .LIGHT_INDEX_W   (LIGHT_COUNT_W),
        .SPHERE_INDEX_W  (SPHERE_COUNT_W),
        .TRIANGLE_INDEX_W(TRIANGLE_COUNT_W)
    ) u_scene (
        .clk           (clk),
        .rst           (rst),
        .write_valid   (record_valid),
        .write_kind    (record_kind),
        .write_index   (record_index),
        .write_record  (record),
        .swap          (swap),
        .light_index   (light_index),
        .light         (light),
        .sphere_index  (sphere_index),
        .sphere        (sphere),
        .triangle_index(triangle_index),
        .triangle      (triangle),
        .camera        ({camera_position, camera_up, camera_center}),
        .tail          ({ambient_light, background})
    );

    // What the frame that is drawn has, and the size that holds from the first frame on.
    wire size_lock;
    reg [LIGHT_COUNT_W-1:0] lights_reg;
    reg [7:0] spheres_reg;
    reg [7:0] triangles_reg;
    reg [OBJECT_W:0] objects_reg;
    reg [DEPTH_W-1:0] depth_reg;
    reg [SIZE_W-1:0] width_reg;
    reg [SIZE_W-1:0] height_reg;
    reg [`RT_TAN_W-1:0] tan_h_reg;
    reg [`RT_TAN_W-1:0] tan_v_reg;
    // Wider than their number may be, whatever OBJECT_W is.
    wire [OBJECT_W+9:0] load_objects = {{OBJECT_W + 2{1'b0}}, load_spheres}
                                     + {{OBJECT_W + 2{1'b0}}, load_triangles};
    wire unused_load = &{1'b0, load_lights[7:LIGHT_COUNT_W], load_objects[OBJECT_W+9:OBJECT_W+1]};

    always @(posedge clk) begin
        if (swap) begin
            lights_reg    <= load_lights[LIGHT_COUNT_W-1:0];
            spheres_reg   <= load_spheres;
            triangles_reg <= load_triangles;
            objects_reg   <= load_objects[OBJECT_W:0];
            depth_reg     <= depth;
        end
    end

    always @(posedge clk) begin
        if (size_lock) begin
            width_reg  <= width;
            height_reg <= height;
            tan_h_reg  <= tan_h;
            tan_v_reg  <= tan_v;
        end
    end

    assign picture_width  = width_reg;
    assign picture_height = height_reg;

    // ---------------------------------------------------------------- set-up
    wire camera_start;
    wire camera_done;
    wire [`RT_FAULT_W-1:0] camera_fault;
    wire object_start;
    wire object_done;
    wire draw_ready;
    wire draw_start;
    wire draw_done;

    control u_control (
        .clk         (clk),
        .rst         (rst),
        .load_done   (load_done),
        .load_fault  (load_fault),
        .load_ready  (load_ready),
        .go          (go),
        .swap        (swap),
        .frame_start (frame_start),
        .camera_start(camera_start),
        .camera_done (camera_done),
        .camera_fault(camera_fault),
        .object_start(object_start),
        .object_done (object_done),
        .draw_ready  (draw_ready),
        .draw_start  (draw_start),
        .draw_done   (draw_done),
        .size_lock   (size_lock),
        .frame_done  (frame_done),
        .frame_error (frame_error),
        .error_code  (error_code),
        .busy        (busy)
    );

    wire [3*SCREEN_W-1:0] base;
    wire [3*`RT_SPAN_W-1:0] column_quotient;
    wire [3*SIZE_W-1:0] column_remainder;
    wire [2:0] column_negative;
    wire [3*`RT_SPAN_W-1:0] row_quotient;
    wire [3*SIZE_W-1:0] row_remainder;
    wire [2:0] row_negative;
    wire basis_valid;
    wire [3*WIDE_W-1:0] basis_vector;
    wire edges_valid;
    wire [3*WIDE_W-1:0] edges_vector;
    wire unit_valid;
    wire unit_is_basis;
    wire unit_is_edges;
    wire [3*UNIT_W-1:0] unit;

    camera #(
        .SIZE_W(SIZE_W),
        .WIDE_W(WIDE_W)
    ) u_camera (
        .clk             (clk),
        .rst             (rst),
        .start           (camera_start),
        .position        (camera_position),
        .up              (camera_up),
        .center          (camera_center),
        .width           (width_reg),
        .height          (height_reg),
        .tan_h           (tan_h_reg),
        .tan_v           (tan_v_reg),
        .done            (camera_done),
        .fault           (camera_fault),
        .base            (base),
        .column_quotient (column_quotient),
        .column_remainder(column_remainder),
        .column_negative (column_negative),
        .row_quotient    (row_quotient),
        .row_remainder   (row_remainder),
        .row_negative    (row_negative),
        .vector_valid    (basis_valid),
        .vector          (basis_vector),
        .unit_valid      (unit_valid && unit_is_basis),
        .unit            (unit)
    );

    wire table_valid;
    wire [OBJECT_W-1:0] table_index;
    wire [`RT_GEOMETRY_W-1:0] table_geometry;
    wire [`RT_SURFACE_W-1:0] table_surface;
    wire [`RT_MATERIAL_W-1:0] table_material;
    wire reflects;
    wire transmits;
    wire flat;

    object_setup #(
        .SPHERE_INDEX_W  (SPHERE_COUNT_W),
        .TRIANGLE_INDEX_W(TRIANGLE_COUNT_W),
        .OBJECT_W        (OBJECT_W),
        .WIDE_W          (WIDE_W)
    ) u_objects (
        .clk           (clk),
        .rst           (rst),
        .start         (object_start),
        .spheres       (spheres_reg),
        .triangles     (triangles_reg),
        .ambient_light (ambient_light),
        .sphere_index  (sphere_index),
        .sphere        (sphere),
        .triangle_index(triangle_index),
        .triangle      (triangle),
        .vector_valid  (edges_valid),
        .vector        (edges_vector),
        .unit_valid    (unit_valid && unit_is_edges),
        .unit          (unit),
        .table_valid   (table_valid),
        .table_index   (table_index),
        .table_geometry(table_geometry),
        .table_surface (table_surface),
        .table_material(table_material),
        .reflects      (reflects),
        .transmits     (transmits),
        .degenerate    (flat),
        .done          (object_done)
    );

    // ---------------------------------------------------------------- primary rays
    // A slot is taken only where its ray has a place in the queue behind the normaliser.
    localparam ROOM = 64;
    localparam ROOM_W = $clog2(ROOM) + 1;
    localparam [ROOM_W-1:0] ALL_ROOM = ROOM;
    reg [ROOM_W-1:0] room_reg;
    wire room = room_reg != {ROOM_W{1'b0}};
    wire slot_valid;
    wire slot_ready;
    wire [SLOT_W-1:0] slot;
    wire cast_valid;
    wire [SLOT_W-1:0] cast_slot;
    wire [3*SCREEN_W-1:0] cast_direction;
    wire primary_valid;
    wire primary_ready;

    always @(posedge clk) begin
        if (rst) room_reg <= ALL_ROOM;
        else
            room_reg <= room_reg - {{ROOM_W - 1{1'b0}}, slot_valid && room && slot_ready}
                      + {{ROOM_W - 1{1'b0}}, primary_valid && primary_ready};
    end

    ray_generator #(
        .SIZE_W(SIZE_W),
        .SLOT_W(SLOT_W)
    ) u_rays (
        .clk             (clk),
        .rst             (rst),
        .start           (draw_start),
        .width           (width_reg),
        .height          (height_reg),
        .base            (base),
        .column_quotient (column_quotient),
        .column_remainder(column_remainder),
        .column_negative (column_negative),
        .row_quotient    (row_quotient),
        .row_remainder   (row_remainder),
        .row_negative    (row_negative),
        .slot_valid      (slot_valid && room),
        .slot_ready      (slot_ready),
        .slot            (slot),
        .out_valid       (cast_valid),
        .out_slot        (cast_slot),
        .out_direction   (cast_direction)
    );

    // One normaliser for the basis, for the normals of triangles, and for the rays.
    wire [3*WIDE_W-1:0] cast_wide;
    wire [3*POINT_W-1:0] camera_point;

    genvar lane;
    generate
        for (lane = 0; lane < 3; lane = lane + 1) begin : g_lane
            wire [SCREEN_W-1:0] component = cast_direction[lane*SCREEN_W+:SCREEN_W];
            wire [COORD_W-1:0] place = camera_position[lane*COORD_W+:COORD_W];
            assign cast_wide[lane*WIDE_W+:WIDE_W] =
                {{WIDE_W - SCREEN_W{component[SCREEN_W-1]}}, component};
            assign camera_point[lane*POINT_W+:POINT_W] = {
                {`RT_POINT_INT - `RT_COORD_INT{place[COORD_W-1]}},
                place,
                {`RT_POINT_FRAC - `RT_COORD_FRAC{1'b0}}
            };
        end
    endgenerate

    wire [SLOT_W-1:0] unit_slot;
    wire [UNIT_W:0] unused_norm;
    wire [$clog2(WIDE_W)-1:0] unused_shift;
    wire unused_degenerate;

    unit_vector #(
        .IN_W (WIDE_W),
        .TAG_W(2 + SLOT_W)
    ) u_unit (
        .clk       (clk),
        .rst       (rst),
        .in_valid  (basis_valid || edges_valid || cast_valid),
        .in_tag    ({basis_valid, edges_valid, cast_slot}),
        .vector    (basis_valid ? basis_vector : edges_valid ? edges_vector : cast_wide),
        .out_valid (unit_valid),
        .out_tag   ({unit_is_basis, unit_is_edges, unit_slot}),
        .unit      (unit),
        .norm      (unused_norm),
        .shift     (unused_shift),
        .degenerate(unused_degenerate)
    );

    wire [SLOT_W-1:0] primary_slot;
    wire [3*UNIT_W-1:0] primary_direction;
    wire unused_primary_ready;
    wire [ROOM_W-1:0] unused_primary_room;

    fifo #(
        .WIDTH(SLOT_W + 3*UNIT_W),
        .DEPTH(ROOM)
    ) u_primary (
        .clk      (clk),
        .rst      (rst),
        .in_valid (unit_valid && !unit_is_basis && !unit_is_edges),
        .in_ready (unused_primary_ready),
        .in_data  ({unit_slot, unit}),
        .out_valid(primary_valid),
        .out_ready(primary_ready),
        .out_data ({primary_slot, primary_direction}),
        .room     (unused_primary_room)
    );

    // ---------------------------------------------------------------- rays
    // A ray: slot, the triangle that it starts on, weight, origin, direction.
    localparam LINE_W = 3 * POINT_W + 3 * UNIT_W;
    localparam RAY_W = SLOT_W + OBJECT_W + 1 + 3 * SHADE_W + LINE_W;
    localparam [SHADE_W-1:0] ONE = 1 << `RT_SHADE_FRAC;
    wire child_valid;
    wire [DEPTH_W-1:0] child_depth;
    wire [RAY_W-1:0] child;
    wire settle_valid;
    wire [DEPTH_W-1:0] settle_depth;
    wire [1:0] settle_count;
    wire ray_valid;
    wire ray_ready;
    wire [DEPTH_W-1:0] ray_depth;
    wire [SLOT_W-1:0] ray_slot;
    wire [OBJECT_W:0] ray_own;
    wire [3*SHADE_W-1:0] ray_weight;
    wire [LINE_W-1:0] ray_line;
    wire unused_idle;

    ray_store #(
        .RAY_W     (RAY_W),
        .MAX_DEPTH (MAX_DEPTH),
        .LEVEL_ROOM(LEVEL_ROOM),
        .DEPTH_W   (DEPTH_W)
    ) u_store (
        .clk          (clk),
        .rst          (rst),
        .max_depth    (depth_reg),
        .branches     ({1'b0, reflects} + {1'b0, transmits}),
        .primary_valid(primary_valid),
        .primary_ready(primary_ready),
        .primary      ({primary_slot, {OBJECT_W + 1{1'b0}}, {3{ONE}}, camera_point, primary_direction}),
        .child_valid  (child_valid),
        .child_depth  (child_depth),
        .child        (child),
        .settle_valid (settle_valid),
        .settle_depth (settle_depth),
        .settle_count (settle_count),
        .ray_valid    (ray_valid),
        .ray_ready    (ray_ready),
        .ray_depth    (ray_depth),
        .ray          ({ray_slot, ray_own, ray_weight, ray_line}),
        .idle         (unused_idle)
    );

    // ---------------------------------------------------------------- tests
    localparam SIDE_W = SLOT_W + DEPTH_W + 3 * SHADE_W;
    localparam SHADOW_W = SLOT_W + OBJECT_W + 1 + 6 * SHADE_W + LINE_W + POINT_W;
    localparam HIT_W = SIDE_W + LINE_W + OBJECT_W + 3 + POINT_W + 3 * `RT_OFFSET_W
                     + `RT_HALF_CHORD_W;
    localparam TERM_W = SLOT_W + 3 * SHADE_W;
    wire shadow_valid;
    wire shadow_ready;
    wire [SHADOW_W-1:0] shadow;
    wire [UNITS-1:0] ray_free;
    wire [UNITS-1:0] ray_start;
    wire [UNITS-1:0] shadow_free;
    wire [UNITS-1:0] shadow_start;
    wire [UNITS-1:0] unit_hit_valid;
    wire [UNITS-1:0] unit_hit_ready;
    wire [UNITS*HIT_W-1:0] unit_hit;
    // The direct terms come last.
    wire [UNITS:0] source_valid;
    wire [UNITS:0] source_ready;
    wire [(UNITS+1)*TERM_W-1:0] source;
    wire [UNITS-1:0] tested;

    dispatch #(
        .UNITS(UNITS)
    ) u_dispatch (
        .ray_valid   (ray_valid),
        .ray_ready   (ray_ready),
        .shadow_valid(shadow_valid),
        .shadow_ready(shadow_ready),
        .ray_free    (ray_free),
        .shadow_free (shadow_free),
        .ray_start   (ray_start),
        .shadow_start(shadow_start)
    );

    genvar k;
    generate
        for (k = 0; k < UNITS; k = k + 1) begin : g_unit
            trace_unit #(
                .OBJECTS (OBJECTS),
                .OBJECT_W(OBJECT_W),
                .SLOT_W  (SLOT_W),
                .SIDE_W  (SIDE_W),
                .ROOM    (ROOM)
            ) u_trace (
                .clk           (clk),
                .rst           (rst),
                .table_valid   (table_valid),
                .table_index   (table_index),
                .table_geometry(table_geometry),
                .objects       (objects_reg),
                .ray_free      (ray_free[k]),
                .ray_valid     (ray_start[k]),
                .ray           ({ray_slot, ray_depth, ray_weight, ray_own, ray_line}),
                .shadow_free   (shadow_free[k]),
                .shadow_valid  (shadow_start[k]),
                .shadow        (shadow),
                .hit_valid     (unit_hit_valid[k]),
                .hit_ready     (unit_hit_ready[k]),
                .hit           (unit_hit[k*HIT_W+:HIT_W]),
                .term_valid    (source_valid[k]),
                .term_ready    (source_ready[k]),
                .term          (source[k*TERM_W+:TERM_W]),
                .tested        (tested[k])
            );
        end
    endgenerate

    wire hit_valid;
    wire hit_ready;
    wire [HIT_W-1:0] hit;

    merge #(
        .PORTS(UNITS),
        .WIDTH(HIT_W)
    ) u_hits (
        .clk      (clk),
        .rst      (rst),
        .in_valid (unit_hit_valid),
        .in_ready (unit_hit_ready),
        .in_data  (unit_hit),
        .out_valid(hit_valid),
        .out_ready(hit_ready),
        .out_data (hit)
    );

    // ---------------------------------------------------------------- colours
    wire more_valid;
    wire [SLOT_W-1:0] more_slot;
    wire [COUNT_W-1:0] more_count;
    wire light_at_point;

    shader #(
        .OBJECTS   (OBJECTS),
        .OBJECT_W  (OBJECT_W),
        .LIGHT_W   (LIGHT_COUNT_W),
        .SLOT_W    (SLOT_W),
        .DEPTH_W   (DEPTH_W),
        .COUNT_W   (COUNT_W),
        .MIN_WEIGHT(MIN_WEIGHT)
    ) u_shader (
        .clk           (clk),
        .rst           (rst),
        .table_valid   (table_valid),
        .table_index   (table_index),
        .table_surface (table_surface),
        .table_material(table_material),
        .reflects      (reflects),
        .transmits     (transmits),
        .lights        (lights_reg),
        .background    (background),
        .max_depth     (depth_reg),
        .light_index   (light_index),
        .light         (light),
        .hit_valid     (hit_valid),
        .hit_ready     (hit_ready),
        .hit           (hit),
        .child_valid   (child_valid),
        .child_depth   (child_depth),
        .child         (child),
        .settle_valid  (settle_valid),
        .settle_depth  (settle_depth),
        .settle_count  (settle_count),
        .more_valid    (more_valid),
        .more_slot     (more_slot),
        .more_count    (more_count),
        .shadow_valid  (shadow_valid),
        .shadow_ready  (shadow_ready),
        .shadow        (shadow),
        .direct_valid  (source_valid[UNITS]),
        .direct_ready  (source_ready[UNITS]),
        .direct        (source[UNITS*TERM_W+:TERM_W]),
        .light_at_point(light_at_point)
    );

    // ---------------------------------------------------------------- pixels
    wire term_valid;
    wire [SLOT_W-1:0] term_slot;
    wire [3*SHADE_W-1:0] term_colour;
    wire sum_valid;
    wire [SLOT_W-1:0] sum_slot;
    wire [3*SHADE_W-1:0] sum;
    wire pixel_valid;
    wire [SLOT_W-1:0] pixel_slot;
    wire [3*`RT_CHANNEL_W-1:0] pixel;

    merge #(
        .PORTS(UNITS + 1),
        .WIDTH(TERM_W)
    ) u_terms (
        .clk      (clk),
        .rst      (rst),
        .in_valid (source_valid),
        .in_ready (source_ready),
        .in_data  (source),
        .out_valid(term_valid),
        .out_ready(1'b1),
        .out_data ({term_slot, term_colour})
    );

    accumulator #(
        .SLOTS  (PIXELS_IN_FLIGHT),
        .COUNT_W(COUNT_W)
    ) u_sums (
        .clk        (clk),
        .rst        (rst),
        .ready      (draw_ready),
        .more_valid (more_valid),
        .more_slot  (more_slot),
        .more_count (more_count),
        .term_valid (term_valid),
        .term_slot  (term_slot),
        .term_colour(term_colour),
        .out_valid  (sum_valid),
        .out_slot   (sum_slot),
        .out_colour (sum)
    );

    rgb888 #(
        .TAG_W(SLOT_W)
    ) u_rgb (
        .clk      (clk),
        .rst      (rst),
        .in_valid (sum_valid),
        .in_tag   (sum_slot),
        .colour   (sum),
        .out_valid(pixel_valid),
        .out_tag  (pixel_slot),
        .pixel    (pixel)
    );

    pixel_queue #(
        .SLOTS (PIXELS_IN_FLIGHT),
        .SIZE_W(SIZE_W)
    ) u_pixels (
        .clk       (clk),
        .rst       (rst),
        .start     (draw_start),
        .width     (width_reg),
        .height    (height_reg),
        .slot_valid(slot_valid),
        .slot_ready(slot_ready && room),
        .slot      (slot),
        .in_valid  (pixel_valid),
        .in_slot   (pixel_slot),
        .in_pixel  (pixel),
        .out_valid (m_axis_video_tvalid),
        .out_ready (m_axis_video_tready),
        .out_data  (m_axis_video_tdata),
        .out_user  (m_axis_video_tuser),
        .out_last  (m_axis_video_tlast),
        .done      (draw_done)
    );

    counters #(
        .UNITS(UNITS)
    ) u_counters (
        .clk            (clk),
        .rst            (rst),
        .frame_start    (frame_start),
        .busy           (busy),
        .primary        (cast_valid),
        .secondary      (child_valid),
        .shadow         (shadow_valid && shadow_ready),
        .tested         (tested),
        .at_point       (light_at_point),
        .flat           (flat),
        .cycles         (cycles),
        .primary_rays   (primary_rays),
        .secondary_rays (secondary_rays),
        .shadow_rays    (shadow_rays),
        .tests          (tests),
        .lights_at_point(lights_at_point),
        .degenerate     (degenerate)
    );

endmodule

`default_nettype wire
