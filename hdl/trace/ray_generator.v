// SPDX-License-Identifier: Apache-2.0
//
// ray_generator: one direction a pixel, row by row from the top left (book 8.2.1).
//
//     direction = base + (2 x + 1) / width * tan_h * u + (2 y + 1) / height * tan_v * v
//     base      = d - tan_h * u - tan_v * v
//
// not normalised, each term floored toward zero at RT_SCREEN_FRAC bits.
//
// Ports
//   start           a frame begins; the basis and the size hold still until the next start
//   width, height   of the picture, at least 1
//   base            {x, y, z}, RT_SCREEN
//   column_*        span tan_h * u, a component a lane {x, y, z}: `quotient` (RT_SPAN) and
//                   `remainder` of its magnitude divided by width, `negative` its sign; a magnitude
//                   is below half the range of RT_SPAN, as those of the camera are
//   row_*           the same of tan_v * v and height
//   slot_*          stream of free pixel slots; a ray is cast for each slot taken
//   out_valid       a ray: its `slot` and `direction` {x, y, z}, RT_SCREEN
//
// Latency 1 from slot to ray, rate one ray a clock.

`default_nettype none
`include "raytracer.vh"

module ray_generator #(
    parameter SIZE_W = 12,
    parameter SLOT_W = 8
) (
    input  wire                       clk,
    input  wire                       rst,
    input  wire                       start,
    input  wire [         SIZE_W-1:0] width,
    input  wire [         SIZE_W-1:0] height,
    input  wire [ 3*`RT_SCREEN_W-1:0] base,
    input  wire [   3*`RT_SPAN_W-1:0] column_quotient,
    input  wire [       3*SIZE_W-1:0] column_remainder,
    input  wire [                2:0] column_negative,
    input  wire [   3*`RT_SPAN_W-1:0] row_quotient,
    input  wire [       3*SIZE_W-1:0] row_remainder,
    input  wire [                2:0] row_negative,
    input  wire                       slot_valid,
    output wire                       slot_ready,
    input  wire [         SLOT_W-1:0] slot,
    output wire                       out_valid,
    output wire [         SLOT_W-1:0] out_slot,
    output wire [ 3*`RT_SCREEN_W-1:0] out_direction
);

    // A magnitude as a signed number of the screen's format, negated where asked.
    function [`RT_SCREEN_W-1:0] signed_span;
        input negative;
        input [`RT_SPAN_W-1:0] magnitude;
        reg [`RT_SCREEN_W-1:0] extended;
        begin
            extended = {{`RT_SCREEN_W - `RT_SPAN_W{1'b0}}, magnitude};
            signed_span = negative ? -extended : extended;
        end
    endfunction

    reg busy_reg;
    reg [SIZE_W-1:0] x_reg;
    reg [SIZE_W-1:0] y_reg;

    assign slot_ready = busy_reg;

    wire cast = busy_reg && slot_valid;
    wire line_end = x_reg == width - 1'b1;
    wire frame_end = line_end && y_reg == height - 1'b1;

    always @(posedge clk) begin
        if (rst) busy_reg <= 1'b0;
        else if (start) busy_reg <= 1'b1;
        else if (cast && frame_end) busy_reg <= 1'b0;
    end

    always @(posedge clk) begin
        if (start) begin
            x_reg <= {SIZE_W{1'b0}};
            y_reg <= {SIZE_W{1'b0}};
        end else if (cast) begin
            x_reg <= line_end ? {SIZE_W{1'b0}} : x_reg + 1'b1;
            if (line_end) y_reg <= y_reg + 1'b1;
        end
    end

    reg valid_reg;
    reg [SLOT_W-1:0] slot_reg;

    always @(posedge clk) begin
        if (rst) valid_reg <= 1'b0;
        else valid_reg <= cast;
    end

    always @(posedge clk) slot_reg <= slot;

    assign out_valid = valid_reg;
    assign out_slot  = slot_reg;

    genvar lane;
    generate
        if (`RT_SCREEN_FRAC < `RT_UNIT_FRAC) begin : g_bad_screen
            ray_generator_needs_RT_SCREEN_KNOB_of_at_least_RT_UNIT_KNOB error ();
        end

        for (lane = 0; lane < 3; lane = lane + 1) begin : g_lane
            wire [`RT_SPAN_W-1:0] column;
            wire [`RT_SPAN_W-1:0] row;
            reg [`RT_SCREEN_W-1:0] direction_reg;

            stepper #(
                .SPAN_W (`RT_SPAN_W),
                .COUNT_W(SIZE_W)
            ) u_column (
                .clk      (clk),
                .load     (start || (cast && line_end)),
                .step     (cast),
                .quotient (column_quotient[lane*`RT_SPAN_W+:`RT_SPAN_W]),
                .remainder(column_remainder[lane*SIZE_W+:SIZE_W]),
                .count    (width),
                .value    (column)
            );

            stepper #(
                .SPAN_W (`RT_SPAN_W),
                .COUNT_W(SIZE_W)
            ) u_row (
                .clk      (clk),
                .load     (start),
                .step     (cast && line_end),
                .quotient (row_quotient[lane*`RT_SPAN_W+:`RT_SPAN_W]),
                .remainder(row_remainder[lane*SIZE_W+:SIZE_W]),
                .count    (height),
                .value    (row)
            );

            always @(posedge clk) begin
                direction_reg <= base[lane*`RT_SCREEN_W+:`RT_SCREEN_W]
                               + signed_span(column_negative[lane], column)
                               + signed_span(row_negative[lane], row);
            end

            assign out_direction[lane*`RT_SCREEN_W+:`RT_SCREEN_W] = direction_reg;
        end
    endgenerate

endmodule

`default_nettype wire
