// SPDX-License-Identifier: Apache-2.0
//
// raytracer_vga: the core behind AXI4-Lite registers, and its pictures on a screen. Frames in, VGA out.
//
//     frames -> raytracer_axi -> video -> r, g, b, hsync, vsync
//
// While a picture waits for the screen's vertical blank the core waits, so that each picture is
// seen at least once; see video/frame_buffer.v for what becomes of one larger than the memory.
//
// Parameters are those of `raytracer` and of `video`.
//
// Ports
//   clk, rst           of the core, the registers and the frames
//   s_axil_*, irq      see raytracer_axi
//   s_axis_frame_*     AXI4-Stream: the packed frame, see raytracer.v
//   pixel_clk, pixel_rst, r, g, b, hsync, vsync, de    of the screen, see video/video.v

`default_nettype none
`include "raytracer.vh"

module raytracer_vga #(
    parameter UNITS            = `RT_UNITS,
    parameter PIXELS_IN_FLIGHT = 512,
    parameter LEVEL_ROOM       = 256,
    parameter SIZE_W           = 12,
    parameter LIGHT_COUNT_W    = 2,
    parameter SPHERE_COUNT_W   = 2,
    parameter TRIANGLE_COUNT_W = 4,
    parameter MAX_DEPTH        = `RT_MAX_DEPTH,
    parameter MIN_WEIGHT       = `RT_MIN_WEIGHT,
    parameter WIDTH            = `RT_VIDEO_WIDTH,
    parameter HEIGHT           = `RT_VIDEO_HEIGHT,
    parameter DEPTH_BITS       = `RT_VIDEO_DEPTH,
    parameter H_ACTIVE         = `RT_VGA_H_ACTIVE,
    parameter H_FRONT          = `RT_VGA_H_FRONT,
    parameter H_SYNC           = `RT_VGA_H_SYNC,
    parameter H_BACK           = `RT_VGA_H_BACK,
    parameter H_POSITIVE       = `RT_VGA_H_POSITIVE,
    parameter V_ACTIVE         = `RT_VGA_V_ACTIVE,
    parameter V_FRONT          = `RT_VGA_V_FRONT,
    parameter V_SYNC           = `RT_VGA_V_SYNC,
    parameter V_BACK           = `RT_VGA_V_BACK,
    parameter V_POSITIVE       = `RT_VGA_V_POSITIVE
) (
    input  wire                     clk,
    input  wire                     rst,
    input  wire [              7:0] s_axil_awaddr,
    input  wire [              2:0] s_axil_awprot,
    input  wire                     s_axil_awvalid,
    output wire                     s_axil_awready,
    input  wire [             31:0] s_axil_wdata,
    input  wire [              3:0] s_axil_wstrb,
    input  wire                     s_axil_wvalid,
    output wire                     s_axil_wready,
    output wire [              1:0] s_axil_bresp,
    output wire                     s_axil_bvalid,
    input  wire                     s_axil_bready,
    input  wire [              7:0] s_axil_araddr,
    input  wire [              2:0] s_axil_arprot,
    input  wire                     s_axil_arvalid,
    output wire                     s_axil_arready,
    output wire [             31:0] s_axil_rdata,
    output wire [              1:0] s_axil_rresp,
    output wire                     s_axil_rvalid,
    input  wire                     s_axil_rready,
    input  wire                     s_axis_frame_tvalid,
    output wire                     s_axis_frame_tready,
    input  wire [             31:0] s_axis_frame_tdata,
    input  wire                     s_axis_frame_tlast,
    output wire                     irq,
    input  wire                     pixel_clk,
    input  wire                     pixel_rst,
    output wire [`RT_CHANNEL_W-1:0] r,
    output wire [`RT_CHANNEL_W-1:0] g,
    output wire [`RT_CHANNEL_W-1:0] b,
    output wire                     hsync,
    output wire                     vsync,
    output wire                     de
);

    wire video_valid;
    wire video_ready;
    wire [3*`RT_CHANNEL_W-1:0] video_data;
    wire video_user;
    wire video_last;
    wire [SIZE_W-1:0] picture_width;
    wire [SIZE_W-1:0] picture_height;

    raytracer_axi #(
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
        .rst                (rst),
        .s_axil_awaddr      (s_axil_awaddr),
        .s_axil_awprot      (s_axil_awprot),
        .s_axil_awvalid     (s_axil_awvalid),
        .s_axil_awready     (s_axil_awready),
        .s_axil_wdata       (s_axil_wdata),
        .s_axil_wstrb       (s_axil_wstrb),
        .s_axil_wvalid      (s_axil_wvalid),
        .s_axil_wready      (s_axil_wready),
        .s_axil_bresp       (s_axil_bresp),
        .s_axil_bvalid      (s_axil_bvalid),
        .s_axil_bready      (s_axil_bready),
        .s_axil_araddr      (s_axil_araddr),
        .s_axil_arprot      (s_axil_arprot),
        .s_axil_arvalid     (s_axil_arvalid),
        .s_axil_arready     (s_axil_arready),
        .s_axil_rdata       (s_axil_rdata),
        .s_axil_rresp       (s_axil_rresp),
        .s_axil_rvalid      (s_axil_rvalid),
        .s_axil_rready      (s_axil_rready),
        .s_axis_frame_tvalid(s_axis_frame_tvalid),
        .s_axis_frame_tready(s_axis_frame_tready),
        .s_axis_frame_tdata (s_axis_frame_tdata),
        .s_axis_frame_tlast (s_axis_frame_tlast),
        .m_axis_video_tvalid(video_valid),
        .m_axis_video_tready(video_ready),
        .m_axis_video_tdata (video_data),
        .m_axis_video_tuser (video_user),
        .m_axis_video_tlast (video_last),
        .picture_width      (picture_width),
        .picture_height     (picture_height),
        .irq                (irq)
    );

    video #(
        .WIDTH     (WIDTH),
        .HEIGHT    (HEIGHT),
        .DEPTH_BITS(DEPTH_BITS),
        .SIZE_W    (SIZE_W),
        .H_ACTIVE  (H_ACTIVE),
        .H_FRONT   (H_FRONT),
        .H_SYNC    (H_SYNC),
        .H_BACK    (H_BACK),
        .H_POSITIVE(H_POSITIVE),
        .V_ACTIVE  (V_ACTIVE),
        .V_FRONT   (V_FRONT),
        .V_SYNC    (V_SYNC),
        .V_BACK    (V_BACK),
        .V_POSITIVE(V_POSITIVE)
    ) u_video (
        .clk                (clk),
        .rst                (rst),
        .width              (picture_width),
        .height             (picture_height),
        .s_axis_video_tvalid(video_valid),
        .s_axis_video_tready(video_ready),
        .s_axis_video_tdata (video_data),
        .s_axis_video_tuser (video_user),
        .s_axis_video_tlast (video_last),
        .pixel_clk          (pixel_clk),
        .pixel_rst          (pixel_rst),
        .r                  (r),
        .g                  (g),
        .b                  (b),
        .hsync              (hsync),
        .vsync              (vsync),
        .de                 (de)
    );

endmodule

`default_nettype wire
