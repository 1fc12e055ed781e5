// SPDX-License-Identifier: Apache-2.0
//
// vga_timing: where the screen is, and its sync pulses.
//
// A line begins with its pulse, then come back porch, active part and front porch; so do the lines
// of a frame. The vertical pulse begins and ends with the pulse of a line.
//
// Parameters, in pixel clocks (H_) and lines (V_), each at least 1; the defaults are the mode of
// models/video.py, 640 x 480 at 60 Hz
//   *_ACTIVE    what is seen
//   *_FRONT     porch before the pulse
//   *_SYNC      the pulse
//   *_BACK      porch behind the pulse
//   *_POSITIVE  1: the pulse is high
//
// Ports
//   clk          the pixel clock
//   x, y         place on the screen, from the upper left corner; outside of the active part they
//                count on, x from the end of a line's active part to the end of the next one's back
//                porch, y likewise; y steps with the pulse
//   active       x, y is a place that is seen
//   hsync, vsync
//   blank_start  one clock, the first of the first line behind the active ones
//
// Reset begins a vertical blank. All outputs speak of the same clock; rate one pixel a clock.

`default_nettype none
`include "raytracer.vh"

module vga_timing #(
    parameter H_ACTIVE   = `RT_VGA_H_ACTIVE,
    parameter H_FRONT    = `RT_VGA_H_FRONT,
    parameter H_SYNC     = `RT_VGA_H_SYNC,
    parameter H_BACK     = `RT_VGA_H_BACK,
    parameter H_POSITIVE = `RT_VGA_H_POSITIVE,
    parameter V_ACTIVE   = `RT_VGA_V_ACTIVE,
    parameter V_FRONT    = `RT_VGA_V_FRONT,
    parameter V_SYNC     = `RT_VGA_V_SYNC,
    parameter V_BACK     = `RT_VGA_V_BACK,
    parameter V_POSITIVE = `RT_VGA_V_POSITIVE,
    parameter X_W        = $clog2(H_ACTIVE + H_FRONT + H_SYNC + H_BACK),
    parameter Y_W        = $clog2(V_ACTIVE + V_FRONT + V_SYNC + V_BACK)
) (
    input  wire           clk,
    input  wire           rst,
    output wire [X_W-1:0] x,
    output wire [Y_W-1:0] y,
    output wire           active,
    output wire           hsync,
    output wire           vsync,
    output wire           blank_start
);

    localparam H_TOTAL = H_ACTIVE + H_FRONT + H_SYNC + H_BACK;
    localparam V_TOTAL = V_ACTIVE + V_FRONT + V_SYNC + V_BACK;
    localparam [X_W-1:0] H_LAST = H_TOTAL[X_W-1:0] - 1'b1;
    localparam [Y_W-1:0] V_LAST = V_TOTAL[Y_W-1:0] - 1'b1;
    localparam [X_W-1:0] H_END = H_ACTIVE[X_W-1:0];
    localparam [Y_W-1:0] V_END = V_ACTIVE[Y_W-1:0];
    localparam [X_W-1:0] H_PULSE = H_END + H_FRONT[X_W-1:0];
    localparam [Y_W-1:0] V_PULSE = V_END + V_FRONT[Y_W-1:0];
    localparam [X_W-1:0] H_PULSE_END = H_PULSE + H_SYNC[X_W-1:0];
    localparam [Y_W-1:0] V_PULSE_END = V_PULSE + V_SYNC[Y_W-1:0];
    localparam H_HIGH = H_POSITIVE != 0;
    localparam V_HIGH = V_POSITIVE != 0;

    generate
        if (H_ACTIVE < 1 || H_FRONT < 1 || H_SYNC < 1 || H_BACK < 1) begin : g_bad_line
            vga_timing_needs_every_part_of_a_line_to_be_at_least_1 error ();
        end
        if (V_ACTIVE < 1 || V_FRONT < 1 || V_SYNC < 1 || V_BACK < 1) begin : g_bad_frame
            vga_timing_needs_every_part_of_a_frame_to_be_at_least_1 error ();
        end
    endgenerate

    reg [X_W-1:0] x_reg;
    reg [Y_W-1:0] y_reg;
    wire [X_W-1:0] x_next = x_reg == H_LAST ? {X_W{1'b0}} : x_reg + 1'b1;
    wire line_start = x_next == H_PULSE;
    wire [Y_W-1:0] y_next =
        !line_start ? y_reg : y_reg == V_LAST ? {Y_W{1'b0}} : y_reg + 1'b1;

    always @(posedge clk) begin
        if (rst) begin
            x_reg <= {X_W{1'b0}};
            y_reg <= V_END;
        end else begin
            x_reg <= x_next;
            y_reg <= y_next;
        end
    end

    // Of the next place, so that they are registers and yet of the same clock as x and y.
    reg active_reg;
    reg hsync_reg;
    reg vsync_reg;
    reg blank_start_reg;

    always @(posedge clk) begin
        if (rst) begin
            active_reg      <= 1'b0;
            hsync_reg       <= !H_HIGH;
            vsync_reg       <= !V_HIGH;
            blank_start_reg <= 1'b0;
        end else begin
            active_reg      <= x_next < H_END && y_next < V_END;
            hsync_reg       <= (x_next >= H_PULSE && x_next < H_PULSE_END) == H_HIGH;
            vsync_reg       <= (y_next >= V_PULSE && y_next < V_PULSE_END) == V_HIGH;
            blank_start_reg <= line_start && y_next == V_END;
        end
    end

    assign x           = x_reg;
    assign y           = y_reg;
    assign active      = active_reg;
    assign hsync       = hsync_reg;
    assign vsync       = vsync_reg;
    assign blank_start = blank_start_reg;

endmodule

`default_nettype wire
