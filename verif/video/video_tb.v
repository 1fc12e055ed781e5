// SPDX-License-Identifier: Apache-2.0
//
// video_tb: the video block, its screen recorded.
//
// Parameters and ports are the block's; told, samples and unknown are the recorder's.

`default_nettype none
`include "raytracer.vh"

module video_tb #(
    parameter WIDTH      = `RT_VIDEO_WIDTH,
    parameter HEIGHT     = `RT_VIDEO_HEIGHT,
    parameter DEPTH_BITS = `RT_VIDEO_DEPTH,
    parameter SIZE_W     = 12,
    parameter H_ACTIVE   = `RT_VGA_H_ACTIVE,
    parameter H_FRONT    = `RT_VGA_H_FRONT,
    parameter H_SYNC     = `RT_VGA_H_SYNC,
    parameter H_BACK     = `RT_VGA_H_BACK,
    parameter H_POSITIVE = `RT_VGA_H_POSITIVE,
    parameter V_ACTIVE   = `RT_VGA_V_ACTIVE,
    parameter V_FRONT    = `RT_VGA_V_FRONT,
    parameter V_SYNC     = `RT_VGA_V_SYNC,
    parameter V_BACK     = `RT_VGA_V_BACK,
    parameter V_POSITIVE = `RT_VGA_V_POSITIVE
) (
    input  wire              clk,
    input  wire              rst,
    input  wire [SIZE_W-1:0] width,
    input  wire [SIZE_W-1:0] height,
    input  wire              s_axis_video_tvalid,
    output wire              s_axis_video_tready,
    input  wire [      23:0] s_axis_video_tdata,
    input  wire              s_axis_video_tuser,
    input  wire              s_axis_video_tlast,
    input  wire              pixel_clk,
    input  wire              pixel_rst,
    output wire [       7:0] r,
    output wire [       7:0] g,
    output wire [       7:0] b,
    output wire              hsync,
    output wire              vsync,
    output wire              de,
    output wire              told,
    output wire [      31:0] samples,
    output wire              unknown
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
    ) dut (
        .clk                (clk),
        .rst                (rst),
        .width              (width),
        .height             (height),
        .s_axis_video_tvalid(s_axis_video_tvalid),
        .s_axis_video_tready(s_axis_video_tready),
        .s_axis_video_tdata (s_axis_video_tdata),
        .s_axis_video_tuser (s_axis_video_tuser),
        .s_axis_video_tlast (s_axis_video_tlast),
        .pixel_clk          (pixel_clk),
        .pixel_rst          (pixel_rst),
        .r                  (r),
        .g                  (g),
        .b                  (b),
        .hsync              (hsync),
        .vsync              (vsync),
        .de                 (de)
    );

    screen_recorder u_recorder (
        .clk    (pixel_clk),
        .rst    (pixel_rst),
        .r      (r),
        .g      (g),
        .b      (b),
        .hsync  (hsync),
        .vsync  (vsync),
        .de     (de),
        .told   (told),
        .samples(samples),
        .unknown(unknown)
    );

endmodule

`default_nettype wire
