// SPDX-License-Identifier: Apache-2.0
//
// frame_buffer: two pictures, one that is shown and one that is written meanwhile, and the crossing
// from the core's clock to the pixel clock.
//
// A picture is complete when its last pixel has been taken: it then waits, with tready low, until
// the screen has shown the one before it to the end. So every complete picture is shown at least
// once, none is overwritten while it is shown, and the core is held at one picture a frame of the
// screen.
// A picture that is not whole is never shown: tuser in the middle of it begins the next one, and
// behind a tlast that comes too early or too late everything is dropped up to the next tuser.
// Of a picture larger than WIDTH x HEIGHT the upper left part is kept and the rest is dropped.
//
// Parameters
//   WIDTH, HEIGHT  size of a stored picture
//   DEPTH_BITS     bits of a stored pixel, 3 to 24: the top bits of each channel, a third of them
//                  each; one that is left over is green's, a second red's. 16 is 565
//   SIZE_W         bits of width and height
//
// Ports, on clk
//   rst            drops the picture that is written; what is complete will be shown
//   width, height  of the picture in the stream, taken with its first pixel
//   s_axis_video_* AXI4-Stream of pixels {r, g, b}; tuser: first of a picture, tlast: last of a line
// Ports, on pixel_clk
//   pixel_rst      empties both buffers; at least four clocks of the slower clock long, and a
//                  register of this clock
//   swap           one clock: of the picture that is shown nothing more is read; the one that waits,
//                  if any, is shown from the next clock on
//   shown_width, shown_height  what is stored of the picture shown; 0 before the first one
//   address        pixel of the picture shown, y * WIDTH + x
//   colour         {r, g, b} of it, 1 clock later
//
// Between the clocks one bit goes either way, through a synchroniser: which buffer was completed
// last, and which one is shown. Where they differ, a picture waits. Its size is a register that
// holds still all that time, so it is read without one.

`default_nettype none
`include "raytracer.vh"

module frame_buffer #(
    parameter WIDTH      = `RT_VIDEO_WIDTH,
    parameter HEIGHT     = `RT_VIDEO_HEIGHT,
    parameter DEPTH_BITS = `RT_VIDEO_DEPTH,
    parameter SIZE_W     = 12,
    parameter ADDRESS_W  = $clog2(WIDTH * HEIGHT)
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
    input  wire                        swap,
    output wire [          SIZE_W-1:0] shown_width,
    output wire [          SIZE_W-1:0] shown_height,
    input  wire [       ADDRESS_W-1:0] address,
    output wire [      DEPTH_BITS-1:0] colour
);

    localparam CHANNEL_W = `RT_CHANNEL_W;
    localparam RED_W = (DEPTH_BITS + 1) / 3;
    localparam GREEN_W = (DEPTH_BITS + 2) / 3;
    localparam BLUE_W = DEPTH_BITS / 3;
    localparam [SIZE_W-1:0] MOST_X = WIDTH[SIZE_W-1:0];
    localparam [SIZE_W-1:0] MOST_Y = HEIGHT[SIZE_W-1:0];
    localparam STORED_X_W = $clog2(WIDTH + 1);
    localparam STORED_Y_W = $clog2(HEIGHT + 1);
    localparam [ADDRESS_W-1:0] ROW = WIDTH[ADDRESS_W-1:0];

    generate
        if (WIDTH < 2 || HEIGHT < 2) begin : g_bad_size
            frame_buffer_needs_WIDTH_and_HEIGHT_of_at_least_2 error ();
        end
        if (WIDTH >= 1 << SIZE_W || HEIGHT >= 1 << SIZE_W) begin : g_bad_size_w
            frame_buffer_needs_WIDTH_and_HEIGHT_that_fit_SIZE_W error ();
        end
        if (DEPTH_BITS < 3 || DEPTH_BITS > 3 * CHANNEL_W) begin : g_bad_depth
            frame_buffer_needs_DEPTH_BITS_of_3_to_24 error ();
        end
    endgenerate

    // ------------------------------------------------------------------- the core's clock
    reg  full_reg;   // the buffer that was completed last; the other one is written
    reg  shown_reg;  // the buffer that is shown; of the pixel clock
    wire shown;
    wire restart;

    synchroniser u_shown (
        .clk(clk),
        .in (shown_reg),
        .out(shown)
    );

    synchroniser u_restart (
        .clk(clk),
        .in (pixel_rst),
        .out(restart)
    );

    reg ended_reg;      // the last pixel of a picture was taken in the clock before
    reg receiving_reg;  // the next pixel belongs to a picture that is whole so far
    reg [SIZE_W-1:0] width_reg;
    reg [SIZE_W-1:0] height_reg;
    reg [SIZE_W-1:0] x_reg;
    reg [SIZE_W-1:0] y_reg;
    reg [ADDRESS_W-1:0] row_reg;
    reg [ADDRESS_W-1:0] address_reg;

    wire waiting = full_reg != shown;
    assign s_axis_video_tready = !rst && !restart && !ended_reg && !waiting;

    // What the pixel that is offered is: a first one is at the upper left, whatever came before.
    wire first = s_axis_video_tuser;
    wire take = s_axis_video_tvalid && s_axis_video_tready && (first || receiving_reg);
    wire [SIZE_W-1:0] w = first ? width : width_reg;
    wire [SIZE_W-1:0] h = first ? height : height_reg;
    wire [SIZE_W-1:0] x = first ? {SIZE_W{1'b0}} : x_reg;
    wire [SIZE_W-1:0] y = first ? {SIZE_W{1'b0}} : y_reg;
    wire [ADDRESS_W-1:0] row = first ? {ADDRESS_W{1'b0}} : row_reg;
    wire [ADDRESS_W-1:0] row_next = row + ROW;
    wire [ADDRESS_W-1:0] place = first ? {ADDRESS_W{1'b0}} : address_reg;
    wire line_end = x == w - 1'b1;
    wire frame_end = line_end && y == h - 1'b1;
    wire whole = s_axis_video_tlast == line_end;

    always @(posedge clk) begin
        if (rst || restart) receiving_reg <= 1'b0;
        else if (take) receiving_reg <= whole && !frame_end;
    end

    always @(posedge clk) ended_reg <= take && whole && frame_end;

    always @(posedge clk) begin
        if (take) begin
            width_reg   <= w;
            height_reg  <= h;
            x_reg       <= line_end ? {SIZE_W{1'b0}} : x + 1'b1;
            y_reg       <= line_end ? y + 1'b1 : y;
            row_reg     <= line_end ? row_next : row;
            address_reg <= line_end ? row_next : place + 1'b1;
        end
    end

    // The write is a clock later, and the picture is complete in the clock of its last write.
    reg write_reg;
    reg [ADDRESS_W-1:0] write_address_reg;
    reg [DEPTH_BITS-1:0] write_colour_reg;
    wire unused_low = &{1'b0, s_axis_video_tdata};

    always @(posedge clk) begin
        write_reg         <= take && x < MOST_X && y < MOST_Y;
        write_address_reg <= place;
        write_colour_reg  <= {
            s_axis_video_tdata[3*CHANNEL_W-1-:RED_W],
            s_axis_video_tdata[2*CHANNEL_W-1-:GREEN_W],
            s_axis_video_tdata[CHANNEL_W-1-:BLUE_W]
        };
    end

    // What is stored needs no more bits than the largest of it.
    reg [STORED_X_W-1:0] full_width_reg;
    reg [STORED_Y_W-1:0] full_height_reg;

    always @(posedge clk) begin
        if (restart) full_reg <= 1'b0;
        else if (ended_reg) full_reg <= !full_reg;
    end

    always @(posedge clk) begin
        if (ended_reg) begin
            full_width_reg  <= width_reg < MOST_X ? width_reg[STORED_X_W-1:0] : MOST_X[STORED_X_W-1:0];
            full_height_reg <= height_reg < MOST_Y ? height_reg[STORED_Y_W-1:0] : MOST_Y[STORED_Y_W-1:0];
        end
    end

    // -------------------------------------------------------------------- the pixel clock
    wire full;

    synchroniser u_full (
        .clk(pixel_clk),
        .in (full_reg),
        .out(full)
    );

    reg [STORED_X_W-1:0] shown_width_reg;
    reg [STORED_Y_W-1:0] shown_height_reg;

    always @(posedge pixel_clk) begin
        if (pixel_rst) begin
            shown_reg        <= 1'b0;
            shown_width_reg  <= {STORED_X_W{1'b0}};
            shown_height_reg <= {STORED_Y_W{1'b0}};
        end else if (swap && full != shown_reg) begin
            shown_reg        <= full;
            shown_width_reg  <= full_width_reg;
            shown_height_reg <= full_height_reg;
        end
    end

    assign shown_width  = {{SIZE_W - STORED_X_W{1'b0}}, shown_width_reg};
    assign shown_height = {{SIZE_W - STORED_Y_W{1'b0}}, shown_height_reg};

    // ------------------------------------------------------------------------ the buffers
    wire [2*DEPTH_BITS-1:0] colours;

    genvar buffer;
    generate
        for (buffer = 0; buffer < 2; buffer = buffer + 1) begin : g_buffer
            localparam SECOND = buffer != 0;

            dual_clock_memory #(
                .WIDTH(DEPTH_BITS),
                .WORDS(WIDTH * HEIGHT)
            ) u_memory (
                .write_clk    (clk),
                .write_enable (write_reg && full_reg != SECOND),
                .write_address(write_address_reg),
                .write_data   (write_colour_reg),
                .read_clk     (pixel_clk),
                .read_address (address),
                .read_data    (colours[buffer*DEPTH_BITS+:DEPTH_BITS])
            );
        end
    endgenerate

    assign colour = shown_reg ? colours[DEPTH_BITS+:DEPTH_BITS] : colours[0+:DEPTH_BITS];

endmodule

`default_nettype wire
