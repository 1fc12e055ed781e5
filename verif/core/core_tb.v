// SPDX-License-Identifier: Apache-2.0
//
// core_tb: the core with what its benches watch it through.
//
// The clock runs here and the pixels go into the file pixels.bin, 32 bits each {object, r, g, b}, so
// that the simulator calls Python where something happens and not in every clock. `event_flip`
// flips when a frame is done or refused, or the probe is complete; the other outputs then say
// which, and the file is up to date.
//
// Ports beside the core's
//   clk               the clock, 10 ns; an input where RT_CLOCK_FROM_OUTSIDE is defined, for benches
//                     that look at every clock: Verilator shows a clock of its own too late, when
//                     the registers have changed already
//   object            (in the file) number of the object that the pixel's primary ray hit, 255 for
//                     none; seen at the intersection, kept by pixel slot
//   pixels            pixels in the file
//   unknown           a pixel since reset had an X or a Z in it
//   cycles            clocks from the first word of the frame to its last pixel
//   probe_x, probe_y  a pixel whose values are kept at each stage, while probe_on is high
//   probe             the values; see probe.py for the fields. probe_done: all of them are there

`default_nettype none
`include "raytracer.vh"

module core_tb #(
    parameter PIXELS_IN_FLIGHT = 256,
    parameter SIZE_W           = 12
) (
`ifdef RT_CLOCK_FROM_OUTSIDE
    input  wire                    clk,
`else
    output reg                     clk,
`endif
    input  wire                    rst,
    input  wire [      SIZE_W-1:0] width,
    input  wire [      SIZE_W-1:0] height,
    input  wire [   `RT_TAN_W-1:0] tan_h,
    input  wire [   `RT_TAN_W-1:0] tan_v,
    input  wire                    s_axis_frame_tvalid,
    output wire                    s_axis_frame_tready,
    input  wire [            31:0] s_axis_frame_tdata,
    input  wire                    s_axis_frame_tlast,
    output wire                    m_axis_video_tvalid,
    input  wire                    m_axis_video_tready,
    output wire [            23:0] m_axis_video_tdata,
    output wire                    m_axis_video_tuser,
    output wire                    m_axis_video_tlast,
    output wire                    frame_done,
    output wire                    frame_error,
    output wire [ `RT_FAULT_W-1:0] error_code,
    output wire                    busy,
    output wire [            31:0] lights_at_point,
    output reg                     event_flip,
    output reg                     event_done,
    output reg                     event_error,
    output reg  [ `RT_FAULT_W-1:0] event_code,
    output reg  [            31:0] pixels,
    output reg                     unknown,
    output reg  [            31:0] cycles,
    input  wire                    probe_on,
    input  wire [      SIZE_W-1:0] probe_x,
    input  wire [      SIZE_W-1:0] probe_y,
    output wire                    probe_done,
    output wire [  3*`RT_SCREEN_W + 12*`RT_UNIT_W + 5*`RT_POINT_W + 3*`RT_OFFSET_W
                  + `RT_HALF_CHORD_W + 6*`RT_SHADE_W + 3*`RT_CHANNEL_W + 3 - 1:0] probe
);

`ifndef RT_CLOCK_FROM_OUTSIDE
    initial clk = 1'b0;
    always #5 clk = !clk;
`endif

    localparam SLOT_W = $clog2(PIXELS_IN_FLIGHT);
    localparam [7:0] NO_OBJECT = 8'hff;

    raytracer #(
        .PIXELS_IN_FLIGHT(PIXELS_IN_FLIGHT),
        .SIZE_W          (SIZE_W)
    ) dut (
        .clk                (clk),
        .rst                (rst),
        .width              (width),
        .height             (height),
        .tan_h              (tan_h),
        .tan_v              (tan_v),
        .s_axis_frame_tvalid(s_axis_frame_tvalid),
        .s_axis_frame_tready(s_axis_frame_tready),
        .s_axis_frame_tdata (s_axis_frame_tdata),
        .s_axis_frame_tlast (s_axis_frame_tlast),
        .m_axis_video_tvalid(m_axis_video_tvalid),
        .m_axis_video_tready(m_axis_video_tready),
        .m_axis_video_tdata (m_axis_video_tdata),
        .m_axis_video_tuser (m_axis_video_tuser),
        .m_axis_video_tlast (m_axis_video_tlast),
        .frame_done         (frame_done),
        .frame_error        (frame_error),
        .error_code         (error_code),
        .busy               (busy),
        .lights_at_point    (lights_at_point)
    );

    // Objects by slot; slots leave in the order 0, 1, 2, ... of each frame.
    reg [7:0] objects[0:PIXELS_IN_FLIGHT-1];
    reg [SLOT_W-1:0] out_slot;
    wire taken = m_axis_video_tvalid && m_axis_video_tready;

    always @(posedge clk) begin
        if (dut.test_valid)
            objects[dut.test_slot] <= dut.test_hit && dut.has_sphere_reg ? 8'd0 : NO_OBJECT;
        if (dut.draw_start) out_slot <= {SLOT_W{1'b0}};
        else if (taken) out_slot <= out_slot + 1'b1;
    end

    integer file;
    reg probe_told;

    initial begin
        file       = $fopen("pixels.bin", "wb");
        event_flip = 1'b0;
        pixels     = 32'd0;
        unknown    = 1'b0;
    end

    wire [31:0] entry = {objects[out_slot], m_axis_video_tdata};
    wire told = frame_done || frame_error || probe_done && !probe_told;

    always @(posedge clk) begin
        if (!rst && taken) begin
            $fwrite(file, "%u", entry);
            pixels <= pixels + 32'd1;
            if (^entry === 1'bx) unknown <= 1'b1;
        end
        if (!rst && told) $fflush(file);
        if (rst) unknown <= 1'b0;
    end

    always @(posedge clk) begin
        probe_told <= probe_done && !rst;
        if (!rst && told) begin
            event_flip  <= !event_flip;
            event_done  <= frame_done;
            event_error <= frame_error;
            event_code  <= error_code;
        end
    end

    reg loading;
    reg drawing;

    always @(posedge clk) begin
        if (rst) begin
            loading <= 1'b0;
            drawing <= 1'b0;
        end else begin
            if (s_axis_frame_tvalid && s_axis_frame_tready) loading <= !s_axis_frame_tlast;
            if (s_axis_frame_tvalid && s_axis_frame_tready && !loading) drawing <= 1'b1;
            if (frame_done || frame_error) drawing <= 1'b0;
        end
    end

    always @(posedge clk) cycles <= drawing ? cycles + 32'd1 : 32'd1;

    // ------------------------------------------------------------- one pixel, stage by stage
    reg armed;
    reg [SLOT_W-1:0] slot;
    reg seen;
    wire here = dut.u_rays.cast && dut.u_rays.x_reg == probe_x && dut.u_rays.y_reg == probe_y;

    reg [3*`RT_SCREEN_W-1:0] screen;
    reg [3*`RT_UNIT_W-1:0] direction;
    reg hit;
    reg leaving;
    reg [`RT_POINT_W-1:0] distance;
    reg [3*`RT_OFFSET_W-1:0] offset;
    reg [`RT_HALF_CHORD_W-1:0] half_chord;
    reg [3*`RT_POINT_W-1:0] point;
    reg [3*`RT_UNIT_W-1:0] normal;
    reg [3*`RT_UNIT_W-1:0] mirrored;
    reg [3*`RT_UNIT_W-1:0] light;
    reg [`RT_POINT_W-1:0] limit;
    reg shadowed;
    reg [3*`RT_SHADE_W-1:0] direct;
    reg [3*`RT_SHADE_W-1:0] colour;
    reg [3*`RT_CHANNEL_W-1:0] pixel;

    wire at_screen = dut.cast_valid && dut.cast_slot == slot;
    wire at_ray = dut.ray_valid && dut.ray_slot == slot;
    wire at_test = dut.test_valid && dut.test_slot == slot;
    wire at_surface = dut.u_shader.surface_valid && dut.u_shader.surface_ray[SLOT_W-1:0] == slot;
    wire at_mirror = dut.u_shader.mirror_valid && dut.u_shader.mirror_ray[SLOT_W-1:0] == slot;
    wire at_light = dut.u_shader.light_valid && dut.u_shader.light_ray[SLOT_W-1:0] == slot;
    wire at_shadow = dut.u_shader.shadow_valid && dut.u_shader.shadow_ray[SLOT_W-1:0] == slot;
    wire at_phong = dut.u_shader.phong_valid && dut.u_shader.phong_ray[SLOT_W-1:0] == slot;
    wire at_lit = dut.u_shader.lit_valid && dut.u_shader.lit_tag == slot;
    wire at_pixel = dut.pixel_valid && dut.pixel_slot == slot;

    always @(posedge clk) begin
        if (rst || !probe_on) begin
            armed <= 1'b0;
            seen  <= 1'b0;
        end else begin
            if (here && !armed) begin
                armed <= 1'b1;
                slot  <= dut.slot;
            end
            if (armed && at_pixel) seen <= 1'b1;
        end
    end

    // Stages are in order, so the first value that passes after arming is the pixel's.
    always @(posedge clk) begin
        if (armed && !seen) begin
            if (at_screen) screen <= dut.cast_direction;
            if (at_ray) direction <= dut.ray_direction;
            if (at_test) begin
                hit        <= dut.test_hit && dut.has_sphere_reg;
                leaving    <= dut.test_leaving;
                distance   <= dut.unused_distance;
                offset     <= dut.test_offset;
                half_chord <= dut.test_half_chord;
            end
            if (at_surface) begin
                point  <= dut.u_shader.surface_point;
                normal <= dut.u_shader.surface_normal;
            end
            if (at_mirror) mirrored <= dut.u_shader.mirrored;
            if (at_light) begin
                light <= dut.u_shader.light_direction;
                limit <= dut.u_shader.light_limit;
            end
            if (at_shadow) shadowed <= dut.u_shader.shadowed;
            if (at_phong) direct <= dut.u_shader.direct;
            if (at_lit) colour <= dut.u_shader.lit;
            if (at_pixel) pixel <= dut.pixel;
        end
    end

    assign probe_done = seen;
    assign probe = {screen, direction, hit, leaving, distance, offset, half_chord, point, normal,
                    mirrored, light, limit, shadowed, direct, colour, pixel};

endmodule

`default_nettype wire
