// SPDX-License-Identifier: Apache-2.0
//
// raytracer_axi: the core behind AXI4-Lite registers. A packed frame in, a picture out, as in raytracer.v;
// all else is read and written. ../models/registers.py is the map, README.md beside this file has it.
//
// Parameters are those of `raytracer`; SIZE_W here 10 to 16.
//
// Ports
//   s_axil_*           AXI4-Lite: the registers, see bus/axil_registers.v
//   s_axis_frame_*     AXI4-Stream: the packed frame, see raytracer.v
//   m_axis_video_*     AXI4-Stream: the pixels, see raytracer.v
//   picture_*          size of the pictures, see raytracer.v
//   irq                level: an event that is enabled has not been cleared
//
// CONTROL.reset stops the video stream within a picture. No word of a frame is taken meanwhile; what comes
// behind it is the first word of a frame.

`default_nettype none
`include "raytracer.vh"

module raytracer_axi #(
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
    input  wire                       clk,
    input  wire                       rst,
    input  wire [                7:0] s_axil_awaddr,
    input  wire [                2:0] s_axil_awprot,
    input  wire                       s_axil_awvalid,
    output wire                       s_axil_awready,
    input  wire [               31:0] s_axil_wdata,
    input  wire [                3:0] s_axil_wstrb,
    input  wire                       s_axil_wvalid,
    output wire                       s_axil_wready,
    output wire [                1:0] s_axil_bresp,
    output wire                       s_axil_bvalid,
    input  wire                       s_axil_bready,
    input  wire [                7:0] s_axil_araddr,
    input  wire [                2:0] s_axil_arprot,
    input  wire                       s_axil_arvalid,
    output wire                       s_axil_arready,
    output wire [               31:0] s_axil_rdata,
    output wire [                1:0] s_axil_rresp,
    output wire                       s_axil_rvalid,
    input  wire                       s_axil_rready,
    input  wire                       s_axis_frame_tvalid,
    output wire                       s_axis_frame_tready,
    input  wire [               31:0] s_axis_frame_tdata,
    input  wire                       s_axis_frame_tlast,
    output wire                       m_axis_video_tvalid,
    input  wire                       m_axis_video_tready,
    output wire [3*`RT_CHANNEL_W-1:0] m_axis_video_tdata,
    output wire                       m_axis_video_tuser,
    output wire                       m_axis_video_tlast,
    output wire [         SIZE_W-1:0] picture_width,
    output wire [         SIZE_W-1:0] picture_height,
    output wire                       irq
);

    wire [SIZE_W-1:0] width;
    wire [SIZE_W-1:0] height;
    wire [`RT_TAN_W-1:0] tan_h;
    wire [`RT_TAN_W-1:0] tan_v;
    wire [2:0] depth;
    wire go;
    wire core_rst;
    wire busy;
    wire frame_start;
    wire frame_done;
    wire frame_error;
    wire [`RT_FAULT_W-1:0] error_code;
    wire [31:0] lights_at_point;
    wire [31:0] degenerate;
    wire [31:0] cycles;
    wire [31:0] primary_rays;
    wire [31:0] shadow_rays;
    wire [31:0] secondary_rays;
    wire [31:0] tests;

    axil_registers #(
        .UNITS    (UNITS),
        .SIZE_W   (SIZE_W),
        .MAX_DEPTH(MAX_DEPTH),
        .LIGHTS   ((1 << LIGHT_COUNT_W) - 1),
        .SPHERES  ((1 << SPHERE_COUNT_W) - 1),
        .TRIANGLES((1 << TRIANGLE_COUNT_W) - 1)
    ) u_registers (
        .clk            (clk),
        .rst            (rst),
        .s_axil_awaddr  (s_axil_awaddr),
        .s_axil_awprot  (s_axil_awprot),
        .s_axil_awvalid (s_axil_awvalid),
        .s_axil_awready (s_axil_awready),
        .s_axil_wdata   (s_axil_wdata),
        .s_axil_wstrb   (s_axil_wstrb),
        .s_axil_wvalid  (s_axil_wvalid),
        .s_axil_wready  (s_axil_wready),
        .s_axil_bresp   (s_axil_bresp),
        .s_axil_bvalid  (s_axil_bvalid),
        .s_axil_bready  (s_axil_bready),
        .s_axil_araddr  (s_axil_araddr),
        .s_axil_arprot  (s_axil_arprot),
        .s_axil_arvalid (s_axil_arvalid),
        .s_axil_arready (s_axil_arready),
        .s_axil_rdata   (s_axil_rdata),
        .s_axil_rresp   (s_axil_rresp),
        .s_axil_rvalid  (s_axil_rvalid),
        .s_axil_rready  (s_axil_rready),
        .width          (width),
        .height         (height),
        .tan_h          (tan_h),
        .tan_v          (tan_v),
        .depth          (depth),
        .go             (go),
        .core_rst       (core_rst),
        .irq            (irq),
        .busy           (busy),
        .frame_start    (frame_start),
        .frame_done     (frame_done),
        .frame_error    (frame_error),
        .error_code     (error_code),
        .lights_at_point(lights_at_point),
        .degenerate     (degenerate),
        .cycles         (cycles),
        .primary_rays   (primary_rays),
        .shadow_rays    (shadow_rays),
        .secondary_rays (secondary_rays),
        .tests          (tests)
    );

    // A core in reset drops what it takes, and the source of a frame does not see core_rst.
    wire frame_ready;
    assign s_axis_frame_tready = frame_ready && !core_rst;

    raytracer #(
        .UNITS           (UNITS),
        .PIXELS_IN_FLIGHT(PIXELS_IN_FLIGHT),
        .LEVEL_ROOM      (LEVEL_ROOM),
        .SIZE_W          (SIZE_W),
        .LIGHT_COUNT_W   (LIGHT_COUNT_W),
        .SPHERE_COUNT_W  (SPHERE_COUNT_W),
        .TRIANGLE_COUNT_W(TRIANGLE_COUNT_W),
        .MAX_DEPTH       (MAX_DEPTH),
        .MIN_WEIGHT      (MIN_WEIGHT)
    ) u_core (
        .clk                (clk),
        .rst                (rst || core_rst),
        .width              (width),
        .height             (height),
        .tan_h              (tan_h),
        .tan_v              (tan_v),
        .depth              (depth),
        .go                 (go),
        .s_axis_frame_tvalid(s_axis_frame_tvalid && !core_rst),
        .s_axis_frame_tready(frame_ready),
        .s_axis_frame_tdata (s_axis_frame_tdata),
        .s_axis_frame_tlast (s_axis_frame_tlast),
        .m_axis_video_tvalid(m_axis_video_tvalid),
        .m_axis_video_tready(m_axis_video_tready),
        .m_axis_video_tdata (m_axis_video_tdata),
        .m_axis_video_tuser (m_axis_video_tuser),
        .m_axis_video_tlast (m_axis_video_tlast),
        .picture_width      (picture_width),
        .picture_height     (picture_height),
        .frame_start        (frame_start),
        .frame_done         (frame_done),
        .frame_error        (frame_error),
        .error_code         (error_code),
        .busy               (busy),
        .cycles             (cycles),
        .primary_rays       (primary_rays),
        .secondary_rays     (secondary_rays),
        .shadow_rays        (shadow_rays),
        .tests              (tests),
        .lights_at_point    (lights_at_point),
        .degenerate         (degenerate)
    );

endmodule

`default_nettype wire
