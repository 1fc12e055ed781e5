// SPDX-License-Identifier: Apache-2.0
//
// screen_tb: the video block as it is by default, between a player of a file and a recorder.
//
// Both clocks run here, so that seconds of video are simulated in seconds. The pixel clock is that
// of 640 x 480 at 60 Hz, to a part in 100,000.
//
// Parameters
//   CORE_PS, PIXEL_PS  clocks of the stream and of the screen, in picoseconds
//
// Ports
//   rst             of both sides, at least four clocks of each
//   width, height   of the pictures in the file
//   due, sent       see stream_player
//   told, samples, unknown  see screen_recorder

`default_nettype none

module screen_tb #(
    parameter CORE_PS  = 100000,
    parameter PIXEL_PS = 39722
) (
    input  wire        rst,
    input  wire [11:0] width,
    input  wire [11:0] height,
    input  wire [15:0] due,
    output wire [15:0] sent,
    output wire        told,
    output wire [31:0] samples,
    output wire        unknown
);

    reg clk;
    reg pixel_clk;
    reg pixel_rst;

    initial clk = 1'b0;
    always #(CORE_PS / 2000.0) clk = !clk;

    initial pixel_clk = 1'b0;
    always #(PIXEL_PS / 2000.0) pixel_clk = !pixel_clk;

    always @(posedge pixel_clk) pixel_rst <= rst;

    wire tvalid;
    wire tready;
    wire [23:0] tdata;
    wire tuser;
    wire tlast;
    wire [7:0] r;
    wire [7:0] g;
    wire [7:0] b;
    wire hsync;
    wire vsync;
    wire de;
    wire unused_screen = &{1'b0, r, g, b, hsync, vsync, de};

    stream_player u_player (
        .clk                (clk),
        .rst                (rst),
        .due                (due),
        .sent               (sent),
        .m_axis_video_tvalid(tvalid),
        .m_axis_video_tready(tready),
        .m_axis_video_tdata (tdata),
        .m_axis_video_tuser (tuser),
        .m_axis_video_tlast (tlast)
    );

    video_tb u_video (
        .clk                (clk),
        .rst                (rst),
        .width              (width),
        .height             (height),
        .s_axis_video_tvalid(tvalid),
        .s_axis_video_tready(tready),
        .s_axis_video_tdata (tdata),
        .s_axis_video_tuser (tuser),
        .s_axis_video_tlast (tlast),
        .pixel_clk          (pixel_clk),
        .pixel_rst          (pixel_rst),
        .r                  (r),
        .g                  (g),
        .b                  (b),
        .hsync              (hsync),
        .vsync              (vsync),
        .de                 (de),
        .told               (told),
        .samples            (samples),
        .unknown            (unknown)
    );

endmodule

`default_nettype wire
