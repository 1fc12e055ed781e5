// SPDX-License-Identifier: Apache-2.0
//
// video: a stream of pictures on a screen.
//
// stream -> frame_buffer -> colours -> r, g, b        on the pixel clock, which is any clock:
// vga_timing -> scan -----^       \-> hsync, vsync    see frame_buffer for the crossing
//
// The picture is in the middle of the screen, each pixel of it repeated FACTOR times in either
// direction, the largest factor with which a stored picture of WIDTH x HEIGHT fits; a smaller one is
// drawn with the same factor. All around is black, and so is the screen before the first picture.
// Pictures change in vertical blank, so none tears.
//
// Parameters
//   WIDTH, HEIGHT, DEPTH_BITS, SIZE_W   of the stored pictures, see frame_buffer
//   H_*, V_*                            mode of the screen, see vga_timing
//
// Ports
//   clk, rst        the core's clock; rst drops the picture that is written, nothing else
//   width, height, s_axis_video_*       the stream, see frame_buffer
//   pixel_clk, pixel_rst                of the screen; pixel_rst is at least four clocks of the
//                   slower clock long, and a register of pixel_clk
//   r, g, b         a byte each, expanded by repeating the stored bits; 0 where de is low
//   hsync, vsync    as vga_timing makes them, 2 clocks later; at rest in reset
//   de              data enable: the pixel is seen

`default_nettype none
`include "raytracer.vh"

module video #(
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
    input  wire                        clk,
    input  wire                        rst,
    input  wire [          SIZE_W-1:0] width,
    input  wire [          SIZE_W-1:0] height,
    input  wire                        s_axis_video_tvalid,
    output wire                        s_axis_video_tready,
    input  wire [3*`RT_CHANNEL_W-1:0] s_axis_video_tdata,
    input  wire                        s_axis_video_tuser,
    input  wire                        s_axis_video_tlast,
    input  wire                        pixel_clk,
    input  wire                        pixel_rst,
    output wire [  `RT_CHANNEL_W-1:0] r,
    output wire [  `RT_CHANNEL_W-1:0] g,
    output wire [  `RT_CHANNEL_W-1:0] b,
    output wire                        hsync,
    output wire                        vsync,
    output wire                        de
);

    localparam CHANNEL_W = `RT_CHANNEL_W;
    localparam RED_W = (DEPTH_BITS + 1) / 3;
    localparam GREEN_W = (DEPTH_BITS + 2) / 3;
    localparam BLUE_W = DEPTH_BITS / 3;
    localparam ADDRESS_W = $clog2(WIDTH * HEIGHT);
    localparam X_W = $clog2(H_ACTIVE + H_FRONT + H_SYNC + H_BACK);
    localparam Y_W = $clog2(V_ACTIVE + V_FRONT + V_SYNC + V_BACK);
    localparam H_FACTOR = H_ACTIVE / WIDTH;
    localparam V_FACTOR = V_ACTIVE / HEIGHT;
    localparam FACTOR = H_FACTOR < V_FACTOR ? H_FACTOR : V_FACTOR;
    localparam IDLE_H = H_POSITIVE == 0;
    localparam IDLE_V = V_POSITIVE == 0;

    generate
        if (FACTOR < 1) begin : g_bad_size
            video_needs_a_screen_that_holds_a_picture_of_WIDTH_and_HEIGHT error ();
        end
    endgenerate

    wire [X_W-1:0] x;
    wire [Y_W-1:0] y;
    wire active;
    wire timing_hsync;
    wire timing_vsync;
    wire blank_start;

    vga_timing #(
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
    ) u_timing (
        .clk        (pixel_clk),
        .rst        (pixel_rst),
        .x          (x),
        .y          (y),
        .active     (active),
        .hsync      (timing_hsync),
        .vsync      (timing_vsync),
        .blank_start(blank_start)
    );

    wire [SIZE_W-1:0] shown_width;
    wire [SIZE_W-1:0] shown_height;
    wire on_picture;
    wire [ADDRESS_W-1:0] address;
    wire [DEPTH_BITS-1:0] colour;

    scan #(
        .H_ACTIVE (H_ACTIVE),
        .V_ACTIVE (V_ACTIVE),
        .X_W      (X_W),
        .Y_W      (Y_W),
        .FACTOR   (FACTOR),
        .WIDTH    (WIDTH),
        .SIZE_W   (SIZE_W),
        .ADDRESS_W(ADDRESS_W)
    ) u_scan (
        .clk       (pixel_clk),
        .x         (x),
        .y         (y),
        .width     (shown_width),
        .height    (shown_height),
        .on_picture(on_picture),
        .address   (address)
    );

    frame_buffer #(
        .WIDTH     (WIDTH),
        .HEIGHT    (HEIGHT),
        .DEPTH_BITS(DEPTH_BITS),
        .SIZE_W    (SIZE_W)
    ) u_buffer (
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
        .swap               (blank_start),
        .shown_width        (shown_width),
        .shown_height       (shown_height),
        .address            (address),
        .colour             (colour)
    );

    // Beside the memory's clock, and then the output registers.
    reg picture_reg;
    reg active_reg;
    reg [1:0] hsync_reg;
    reg [1:0] vsync_reg;
    reg de_reg;
    reg [3*CHANNEL_W-1:0] rgb_reg;

    // The bits of a channel, repeated from the top, until there are eight.
    wire [CHANNEL_W*RED_W-1:0] red = {CHANNEL_W{colour[DEPTH_BITS-1-:RED_W]}};
    wire [CHANNEL_W*GREEN_W-1:0] green = {CHANNEL_W{colour[BLUE_W+:GREEN_W]}};
    wire [CHANNEL_W*BLUE_W-1:0] blue = {CHANNEL_W{colour[0+:BLUE_W]}};
    wire unused_repeats = &{1'b0, red, green, blue};

    always @(posedge pixel_clk) begin
        picture_reg <= on_picture && active;
        rgb_reg    <= !picture_reg || pixel_rst ? {3 * CHANNEL_W{1'b0}} :
                      {red[CHANNEL_W*RED_W-1-:CHANNEL_W], green[CHANNEL_W*GREEN_W-1-:CHANNEL_W],
                       blue[CHANNEL_W*BLUE_W-1-:CHANNEL_W]};
    end

    always @(posedge pixel_clk) begin
        if (pixel_rst) begin
            active_reg <= 1'b0;
            de_reg     <= 1'b0;
            hsync_reg  <= {2{IDLE_H}};
            vsync_reg  <= {2{IDLE_V}};
        end else begin
            active_reg <= active;
            de_reg     <= active_reg;
            hsync_reg  <= {hsync_reg[0], timing_hsync};
            vsync_reg  <= {vsync_reg[0], timing_vsync};
        end
    end

    assign r     = rgb_reg[3*CHANNEL_W-1-:CHANNEL_W];
    assign g     = rgb_reg[2*CHANNEL_W-1-:CHANNEL_W];
    assign b     = rgb_reg[CHANNEL_W-1-:CHANNEL_W];
    assign hsync = hsync_reg[1];
    assign vsync = vsync_reg[1];
    assign de    = de_reg;

endmodule

`default_nettype wire
