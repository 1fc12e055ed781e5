// SPDX-License-Identifier: Apache-2.0
//
// core_vga_tb: the core behind registers with its screen, which is recorded.
//
// Parameters and ports are those of raytracer_vga. Beside them
//   told, samples, unknown   see screen_recorder
//   taken                    pixels that the frame buffer has taken since rst
//   held                     clocks since rst in which it left a pixel waiting
//
// Those two only say where a run is: what is right is told by the screen and the registers.

`default_nettype none
`include "raytracer.vh"

module core_vga_tb #(
    parameter UNITS            = `RT_UNITS,
    parameter PIXELS_IN_FLIGHT = 512,
    parameter LEVEL_ROOM       = 256,
    parameter LIGHT_COUNT_W    = 2,
    parameter SPHERE_COUNT_W   = 2,
    parameter TRIANGLE_COUNT_W = 4,
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
    input  wire        clk,
    input  wire        rst,
    input  wire [ 7:0] s_axil_awaddr,
    input  wire [ 2:0] s_axil_awprot,
    input  wire        s_axil_awvalid,
    output wire        s_axil_awready,
    input  wire [31:0] s_axil_wdata,
    input  wire [ 3:0] s_axil_wstrb,
    input  wire        s_axil_wvalid,
    output wire        s_axil_wready,
    output wire [ 1:0] s_axil_bresp,
    output wire        s_axil_bvalid,
    input  wire        s_axil_bready,
    input  wire [ 7:0] s_axil_araddr,
    input  wire [ 2:0] s_axil_arprot,
    input  wire        s_axil_arvalid,
    output wire        s_axil_arready,
    output wire [31:0] s_axil_rdata,
    output wire [ 1:0] s_axil_rresp,
    output wire        s_axil_rvalid,
    input  wire        s_axil_rready,
    input  wire        s_axis_frame_tvalid,
    output wire        s_axis_frame_tready,
    input  wire [31:0] s_axis_frame_tdata,
    input  wire        s_axis_frame_tlast,
    output wire        irq,
    input  wire        pixel_clk,
    input  wire        pixel_rst,
    output wire        told,
    output wire [31:0] samples,
    output wire        unknown,
    output reg  [31:0] taken,
    output reg  [31:0] held
);

    wire [7:0] r;
    wire [7:0] g;
    wire [7:0] b;
    wire hsync;
    wire vsync;
    wire de;

    raytracer_vga #(
        .UNITS           (UNITS),
        .PIXELS_IN_FLIGHT(PIXELS_IN_FLIGHT),
        .LEVEL_ROOM      (LEVEL_ROOM),
        .LIGHT_COUNT_W   (LIGHT_COUNT_W),
        .SPHERE_COUNT_W  (SPHERE_COUNT_W),
        .TRIANGLE_COUNT_W(TRIANGLE_COUNT_W),
        .WIDTH           (WIDTH),
        .HEIGHT          (HEIGHT),
        .DEPTH_BITS      (DEPTH_BITS),
        .H_ACTIVE        (H_ACTIVE),
        .H_FRONT         (H_FRONT),
        .H_SYNC          (H_SYNC),
        .H_BACK          (H_BACK),
        .H_POSITIVE      (H_POSITIVE),
        .V_ACTIVE        (V_ACTIVE),
        .V_FRONT         (V_FRONT),
        .V_SYNC          (V_SYNC),
        .V_BACK          (V_BACK),
        .V_POSITIVE      (V_POSITIVE)
    ) dut (
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
        .irq                (irq),
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

    always @(posedge clk) begin
        if (rst) taken <= 32'd0;
        else if (dut.video_valid && dut.video_ready) taken <= taken + 32'd1;
    end

    always @(posedge clk) begin
        if (rst) held <= 32'd0;
        else if (dut.video_valid && !dut.video_ready) held <= held + 32'd1;
    end

endmodule

`default_nettype wire
