// SPDX-License-Identifier: Apache-2.0
//
// raytracer: the core. A packed frame in, a picture out; see README.md beside this file.
//
//     frame -> loader -> scene memory -> camera, object set-up
//                                           |
//     pixel slots -> ray generator -> unit vector -> sphere -> shader -> RGB888 -> pixel queue
//
// This slice draws what the book's hardware drew (chapter 11): one sphere, one light, no secondary
// rays, which is the whole specification at depth 1; any camera, inside the sphere too.
//
// Parameters
//   PIXELS_IN_FLIGHT   slots of the pixel queue, a power of two; 256 sustain one pixel a clock
//   SIZE_W             bits of width and height
//   *_COUNT_W          bits of the frame's counters
//
// Ports
//   width, height      of the picture; tan_h, tan_v: RT_TAN, tangents of the half field of view.
//                      Taken with the first frame after reset, fixed until the next reset
//   s_axis_frame_*     AXI4-Stream: the packed frame, 32 bits a word, most significant bit first,
//                      padded to whole words; `tlast` with the last word
//   m_axis_video_*     AXI4-Stream: the pixels, {r, g, b}; `tuser` start of frame, `tlast` end of line
//   frame_done         one clock: the last pixel of a frame has been taken
//   frame_error        one clock: a frame has been refused; `error_code` (RT_FAULT) beside it
//   busy               a frame is set up or drawn
//   lights_at_point    hits since reset at which the light was left out: it was at the hit point
//
// Rate one pixel a clock; a frame's set-up takes about 500 clocks. The next frame is loaded while
// this one is drawn.

`default_nettype none
`include "raytracer.vh"

module raytracer #(
    parameter PIXELS_IN_FLIGHT = 256,
    parameter SIZE_W           = 12,
    parameter LIGHT_COUNT_W    = 2,
    parameter SPHERE_COUNT_W   = 2,
    parameter TRIANGLE_COUNT_W = 4
) (
    input  wire                        clk,
    input  wire                        rst,
    input  wire [          SIZE_W-1:0] width,
    input  wire [          SIZE_W-1:0] height,
    input  wire [       `RT_TAN_W-1:0] tan_h,
    input  wire [       `RT_TAN_W-1:0] tan_v,
    input  wire                        s_axis_frame_tvalid,
    output wire                        s_axis_frame_tready,
    input  wire [                31:0] s_axis_frame_tdata,
    input  wire                        s_axis_frame_tlast,
    output wire                        m_axis_video_tvalid,
    input  wire                        m_axis_video_tready,
    output wire [3*`RT_CHANNEL_W-1:0] m_axis_video_tdata,
    output wire                        m_axis_video_tuser,
    output wire                        m_axis_video_tlast,
    output wire                        frame_done,
    output wire                        frame_error,
    output wire [     `RT_FAULT_W-1:0] error_code,
    output wire                        busy,
    output wire [                31:0] lights_at_point
);

    localparam SLOT_W = $clog2(PIXELS_IN_FLIGHT);
    localparam DEPTH_W = 3;
    localparam COORD_W = `RT_COORD_W;
    localparam COEFF_W = `RT_COEFF_W;
    localparam UNIT_W = `RT_UNIT_W;
    localparam POINT_W = `RT_POINT_W;
    localparam SHADE_W = `RT_SHADE_W;
    // Cross products of the camera: (C - P) x up, d x u.
    localparam WIDE_W = 2 * UNIT_W + 1 > 2 * COORD_W + 2 ? 2 * UNIT_W + 1 : 2 * COORD_W + 2;

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
    wire [7:0] unused_triangles;

    loader #(
        .LIGHT_COUNT_W   (LIGHT_COUNT_W),
        .SPHERE_COUNT_W  (SPHERE_COUNT_W),
        .TRIANGLE_COUNT_W(TRIANGLE_COUNT_W),
        .MAX_LIGHTS      (`RT_MAX_LIGHTS),
        .MAX_SPHERES     (`RT_MAX_SPHERES),
        .MAX_TRIANGLES   (`RT_MAX_TRIANGLES)
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
        .triangles   (unused_triangles)
    );

    wire swap;
    wire [3*COORD_W-1:0] light_position;
    wire [3*COEFF_W-1:0] light_intensity;
    wire [3*COEFF_W-1:0] k_ambient;
    wire [3*COEFF_W-1:0] k_diffuse;
    wire [3*COEFF_W-1:0] k_specular;
    wire [3*COEFF_W-1:0] unused_k_reflection;
    wire [3*COEFF_W-1:0] k_transparency;
    wire [COORD_W-1:0] unused_kind;
    wire [COORD_W-1:0] unused_refraction;
    wire [3*COORD_W-1:0] center;
    wire [COORD_W-1:0] radius_slot;
    wire [3*COORD_W-1:0] camera_position;
    wire [3*COORD_W-1:0] camera_up;
    wire [3*COORD_W-1:0] camera_center;
    wire [3*COEFF_W-1:0] ambient_light;
    wire [3*COEFF_W-1:0] background;
    wire unused_radius = &{1'b0, radius_slot[COORD_W-1:`RT_RADIUS_W]};

    scene_memory #(
        .LIGHTS (`RT_MAX_LIGHTS),
        .SPHERES(`RT_MAX_SPHERES)
    ) u_scene (
        .clk         (clk),
        .rst         (rst),
        .write_valid (record_valid),
        .write_kind  (record_kind),
        .write_index (record_index),
        .write_record(record),
        .swap        (swap),
        .light_index (1'b0),
        .light       ({light_position, light_intensity}),
        .sphere_index(1'b0),
        .sphere      ({unused_kind, k_ambient, k_diffuse, k_specular, unused_k_reflection,
                       k_transparency, unused_refraction, center, radius_slot}),
        .camera      ({camera_position, camera_up, camera_center}),
        .tail        ({ambient_light, background})
    );

    // What the frame that is drawn has, and the size that holds from the first frame on.
    wire size_lock;
    reg has_light_reg;
    reg has_sphere_reg;
    reg [SIZE_W-1:0] width_reg;
    reg [SIZE_W-1:0] height_reg;
    reg [`RT_TAN_W-1:0] tan_h_reg;
    reg [`RT_TAN_W-1:0] tan_v_reg;

    always @(posedge clk) begin
        if (swap) begin
            has_light_reg  <= load_lights != 8'd0;
            has_sphere_reg <= load_spheres != 8'd0;
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

    // ---------------------------------------------------------------- set-up
    wire camera_start;
    wire camera_done;
    wire [`RT_FAULT_W-1:0] camera_fault;
    wire object_start;
    wire object_done;
    wire draw_start;
    wire draw_done;

    control u_control (
        .clk         (clk),
        .rst         (rst),
        .load_done   (load_done),
        .load_fault  (load_fault),
        .load_ready  (load_ready),
        .swap        (swap),
        .camera_start(camera_start),
        .camera_done (camera_done),
        .camera_fault(camera_fault),
        .has_object  (has_sphere_reg),
        .object_start(object_start),
        .object_done (object_done),
        .draw_start  (draw_start),
        .draw_done   (draw_done),
        .size_lock   (size_lock),
        .frame_done  (frame_done),
        .frame_error (frame_error),
        .error_code  (error_code),
        .busy        (busy)
    );

    wire [3*`RT_SCREEN_W-1:0] base;
    wire [3*`RT_SPAN_W-1:0] column_quotient;
    wire [3*SIZE_W-1:0] column_remainder;
    wire [2:0] column_negative;
    wire [3*`RT_SPAN_W-1:0] row_quotient;
    wire [3*SIZE_W-1:0] row_remainder;
    wire [2:0] row_negative;
    wire basis_valid;
    wire [3*WIDE_W-1:0] basis_vector;
    wire unit_valid;
    wire unit_is_basis;
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

    wire [`RT_RADIUS_SQ_W-1:0] radius_sq;
    wire [`RT_INV_RADIUS_W-1:0] inv_radius;
    wire [3*SHADE_W-1:0] ambient;

    object_setup u_object (
        .clk          (clk),
        .rst          (rst),
        .start        (object_start),
        .radius       (radius_slot[`RT_RADIUS_W-1:0]),
        .ambient_light(ambient_light),
        .k_ambient    (k_ambient),
        .done         (object_done),
        .radius_sq    (radius_sq),
        .inv_radius   (inv_radius),
        .ambient      (ambient)
    );

    // ---------------------------------------------------------------- rays
    wire slot_valid;
    wire slot_ready;
    wire [SLOT_W-1:0] slot;
    wire cast_valid;
    wire [SLOT_W-1:0] cast_slot;
    wire [3*`RT_SCREEN_W-1:0] cast_direction;

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
        .slot_valid      (slot_valid),
        .slot_ready      (slot_ready),
        .slot            (slot),
        .out_valid       (cast_valid),
        .out_slot        (cast_slot),
        .out_direction   (cast_direction)
    );

    // One normaliser for the basis, once a frame, and for the rays.
    wire [3*WIDE_W-1:0] cast_wide;
    wire [3*POINT_W-1:0] camera_point;

    genvar lane;
    generate
        for (lane = 0; lane < 3; lane = lane + 1) begin : g_lane
            wire [`RT_SCREEN_W-1:0] component =
                cast_direction[lane*`RT_SCREEN_W+:`RT_SCREEN_W];
            wire [COORD_W-1:0] place = camera_position[lane*COORD_W+:COORD_W];
            assign cast_wide[lane*WIDE_W+:WIDE_W] =
                {{WIDE_W - `RT_SCREEN_W{component[`RT_SCREEN_W-1]}}, component};
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
        .TAG_W(1 + SLOT_W)
    ) u_unit (
        .clk       (clk),
        .rst       (rst),
        .in_valid  (basis_valid || cast_valid),
        .in_tag    ({basis_valid, cast_slot}),
        .vector    (basis_valid ? basis_vector : cast_wide),
        .out_valid (unit_valid),
        .out_tag   ({unit_is_basis, unit_slot}),
        .unit      (unit),
        .norm      (unused_norm),
        .shift     (unused_shift),
        .degenerate(unused_degenerate)
    );

    // A ray: slot, depth, weight, origin, direction.
    localparam RAY_W = SLOT_W + DEPTH_W + 3 * SHADE_W + 3 * POINT_W + 3 * UNIT_W;
    localparam [SHADE_W-1:0] ONE = 1 << `RT_SHADE_FRAC;
    localparam [POINT_W-1:0] INFINITY = `RT_INFINITY;
    localparam [DEPTH_W-1:0] PRIMARY = 1;
    wire ray_valid = unit_valid && !unit_is_basis;
    wire [RAY_W-1:0] ray = {unit_slot, PRIMARY, {3{ONE}}, camera_point, unit};
    wire [SLOT_W-1:0] ray_slot;
    wire [DEPTH_W-1:0] ray_depth;
    wire [3*SHADE_W-1:0] ray_weight;
    wire [3*POINT_W-1:0] ray_origin;
    wire [3*UNIT_W-1:0] ray_direction;
    assign {ray_slot, ray_depth, ray_weight, ray_origin, ray_direction} = ray;

    // ---------------------------------------------------------------- hits
    localparam KEPT_W = SLOT_W + DEPTH_W + 3 * SHADE_W + 3 * UNIT_W;
    wire test_valid;
    wire [SLOT_W-1:0] test_slot;
    wire [DEPTH_W-1:0] unused_depth;
    wire [3*SHADE_W-1:0] test_weight;
    wire [3*UNIT_W-1:0] test_direction;
    wire test_hit;
    wire test_leaving;
    wire [POINT_W-1:0] unused_distance;
    wire [3*`RT_OFFSET_W-1:0] test_offset;
    wire [`RT_HALF_CHORD_W-1:0] test_half_chord;

    sphere_intersect #(
        .TAG_W(KEPT_W)
    ) u_sphere (
        .clk       (clk),
        .rst       (rst),
        .in_valid  (ray_valid),
        .in_tag    ({ray_slot, ray_depth, ray_weight, ray_direction}),
        .origin    (ray_origin),
        .direction (ray_direction),
        .center    (center),
        .radius_sq (radius_sq),
        .limit     (INFINITY),
        .out_valid (test_valid),
        .out_tag   ({test_slot, unused_depth, test_weight, test_direction}),
        .hit       (test_hit),
        .leaving    (test_leaving),
        .distance  (unused_distance),
        .offset    (test_offset),
        .half_chord(test_half_chord)
    );

    // ---------------------------------------------------------------- colours
    wire shade_valid;
    wire [SLOT_W-1:0] shade_slot;
    wire [3*SHADE_W-1:0] shade;
    wire shade_at_point;

    shader #(
        .TAG_W(SLOT_W)
    ) u_shader (
        .clk            (clk),
        .rst            (rst),
        .in_valid       (test_valid),
        .in_tag         (test_slot),
        .weight         (test_weight),
        .direction      (test_direction),
        .hit            (test_hit && has_sphere_reg),
        .leaving         (test_leaving),
        .offset         (test_offset),
        .half_chord     (test_half_chord),
        .center         (center),
        .radius_sq      (radius_sq),
        .inv_radius     (inv_radius),
        .ambient        (ambient),
        .k_diffuse      (k_diffuse),
        .k_specular     (k_specular),
        .k_transparency (k_transparency),
        .light_on       (has_light_reg),
        .light_position (light_position),
        .light_intensity(light_intensity),
        .background     (background),
        .out_valid      (shade_valid),
        .out_tag        (shade_slot),
        .colour         (shade),
        .light_at_point (shade_at_point)
    );

    reg [31:0] lights_at_point_reg;

    always @(posedge clk) begin
        if (rst) lights_at_point_reg <= 32'd0;
        else if (shade_valid && shade_at_point) lights_at_point_reg <= lights_at_point_reg + 1'b1;
    end

    assign lights_at_point = lights_at_point_reg;

    // ---------------------------------------------------------------- pixels
    wire pixel_valid;
    wire [SLOT_W-1:0] pixel_slot;
    wire [3*`RT_CHANNEL_W-1:0] pixel;

    rgb888 #(
        .TAG_W(SLOT_W)
    ) u_rgb (
        .clk      (clk),
        .rst      (rst),
        .in_valid (shade_valid),
        .in_tag   (shade_slot),
        .colour   (shade),
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
        .slot_ready(slot_ready),
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

endmodule

`default_nettype wire
