// SPDX-License-Identifier: Apache-2.0
//
// pixel_queue: the pixels in flight. Hands out slots in picture order, takes pixels in any order,
// sends them in picture order.
//
// A ray is cast only where there is a slot for its pixel, so that nothing behind the ray generator
// ever has to wait: a consumer that stalls stops the slots, and the queue holds what is in flight.
//
// Parameters
//   SLOTS   pixels in flight, a power of two; at full rate at least the latency of the core
//   SIZE_W  bits of width and height
//
// Ports
//   start         a frame begins; the queue is empty
//   width, height of the picture; they hold still until `done`
//   slot_*        stream of free slots
//   in_valid      the pixel of `in_slot` is `in_pixel`; once for each slot handed out
//   out_*         AXI4-Stream of pixels; `out_user` marks the first of a frame, `out_last` the last
//                 of a line
//   done          one clock: the last pixel of the frame has been taken
//
// Latency 2 from the pixel of the oldest slot to out_valid; rate one pixel a clock.

`default_nettype none
`include "raytracer.vh"

module pixel_queue #(
    parameter SLOTS  = 256,
    parameter SIZE_W = 12,
    parameter SLOT_W = $clog2(SLOTS)
) (
    input  wire                        clk,
    input  wire                        rst,
    input  wire                        start,
    input  wire [          SIZE_W-1:0] width,
    input  wire [          SIZE_W-1:0] height,
    output wire                        slot_valid,
    input  wire                        slot_ready,
    output wire [          SLOT_W-1:0] slot,
    input  wire                        in_valid,
    input  wire [          SLOT_W-1:0] in_slot,
    input  wire [3*`RT_CHANNEL_W-1:0] in_pixel,
    output wire                        out_valid,
    input  wire                        out_ready,
    output wire [3*`RT_CHANNEL_W-1:0] out_data,
    output wire                        out_user,
    output wire                        out_last,
    output wire                        done
);

    localparam PIXEL_W = 3 * `RT_CHANNEL_W;

    generate
        if (SLOTS < 2 || SLOTS != 1 << SLOT_W) begin : g_bad_slots
            pixel_queue_needs_SLOTS_that_are_a_power_of_two error ();
        end
    endgenerate

    // Slots between head and tail are handed out; the top bit tells full from empty.
    reg [SLOT_W:0] head_reg;
    reg [SLOT_W:0] tail_reg;
    reg [SLOTS-1:0] present_reg;
    reg valid_reg;

    wire [SLOT_W-1:0] head = head_reg[SLOT_W-1:0];
    wire full = head_reg == {!tail_reg[SLOT_W], tail_reg[SLOT_W-1:0]};
    wire fetch = present_reg[head] && (!valid_reg || out_ready);

    assign slot_valid = !full;
    assign slot       = tail_reg[SLOT_W-1:0];

    always @(posedge clk) begin
        if (rst || start) begin
            head_reg <= {SLOT_W + 1{1'b0}};
            tail_reg <= {SLOT_W + 1{1'b0}};
        end else begin
            if (fetch) head_reg <= head_reg + 1'b1;
            if (slot_valid && slot_ready) tail_reg <= tail_reg + 1'b1;
        end
    end

    always @(posedge clk) begin
        if (rst) present_reg <= {SLOTS{1'b0}};
        else begin
            if (fetch) present_reg[head] <= 1'b0;
            if (in_valid) present_reg[in_slot] <= 1'b1;
        end
    end

    // The pixels: one memory, one write, one registered read.
    reg [PIXEL_W-1:0] pixels[0:SLOTS-1];
    reg [PIXEL_W-1:0] data_reg;

    always @(posedge clk) begin
        if (in_valid) pixels[in_slot] <= in_pixel;
        if (fetch) data_reg <= pixels[head];
    end

    always @(posedge clk) begin
        if (rst) valid_reg <= 1'b0;
        else if (fetch) valid_reg <= 1'b1;
        else if (out_ready) valid_reg <= 1'b0;
    end

    // Where the pixel that waits at the output is in the picture.
    reg [SIZE_W-1:0] x_reg;
    reg [SIZE_W-1:0] y_reg;
    wire taken = valid_reg && out_ready;
    wire line_end = x_reg == width - 1'b1;

    always @(posedge clk) begin
        if (start) begin
            x_reg <= {SIZE_W{1'b0}};
            y_reg <= {SIZE_W{1'b0}};
        end else if (taken) begin
            x_reg <= line_end ? {SIZE_W{1'b0}} : x_reg + 1'b1;
            if (line_end) y_reg <= y_reg + 1'b1;
        end
    end

    assign out_valid = valid_reg;
    assign out_data  = data_reg;
    assign out_user  = x_reg == {SIZE_W{1'b0}} && y_reg == {SIZE_W{1'b0}};
    assign out_last  = line_end;
    assign done      = taken && line_end && y_reg == height - 1'b1;

endmodule

`default_nettype wire
