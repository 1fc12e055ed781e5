// SPDX-License-Identifier: Apache-2.0
//
// screen_recorder: what leaves for the screen, clock by clock, in the file screen.bin.
//
// A sample is 32 bits, little-endian: {5 zeros, de, vsync, hsync, r, g, b}. It stands beside any
// design that has these signals; `verif.video.monitor` makes pictures of the file. `told` flips where
// vsync changes, and the file is then up to date: so Python is called twice a frame and not in every
// clock.
//
// Ports
//   clk, rst  the pixel clock and its reset
//   samples   in the file, since the simulation began
//   unknown   a sample since reset had an X or a Z in it

`default_nettype none

module screen_recorder (
    input  wire        clk,
    input  wire        rst,
    input  wire [ 7:0] r,
    input  wire [ 7:0] g,
    input  wire [ 7:0] b,
    input  wire        hsync,
    input  wire        vsync,
    input  wire        de,
    output reg         told,
    output reg  [31:0] samples,
    output reg         unknown
);

    integer file;
    reg opened;
    reg vsync_before;
    wire [31:0] sample = {5'd0, de, vsync, hsync, r, g, b};

    initial begin
        opened  = 1'b0;
        told    = 1'b0;
        samples = 32'd0;
        unknown = 1'b0;
    end

    // Opened with the first clock: a simulation that forks before it leaves a file to each child.
    /* verilator lint_off BLKSEQ */
    always @(posedge clk) begin
        if (!opened) begin
            file = $fopen("screen.bin", "wb");
            opened <= 1'b1;
        end
        $fwrite(file, "%u", sample);
        samples <= samples + 32'd1;
        unknown <= !rst && (unknown || ^sample === 1'bx);
        vsync_before <= vsync;
        if (!rst && vsync !== vsync_before) begin
            $fflush(file);
            told <= !told;
        end
    end
    /* verilator lint_on BLKSEQ */

endmodule

`default_nettype wire
