// SPDX-License-Identifier: Apache-2.0
//
// camera_harness: the camera and a normaliser of its own, as the core wires them.
//
// asked: vectors that the normaliser has been given since reset or the last done; 15 stands for more too.

`default_nettype none
`include "raytracer.vh"

module camera_harness #(
    parameter SIZE_W = 12,
    parameter WIDE_W = 40
) (
    input  wire                      clk,
    input  wire                      rst,
    input  wire                      start,
    input  wire [ 3*`RT_COORD_W-1:0] position,
    input  wire [ 3*`RT_COORD_W-1:0] up,
    input  wire [ 3*`RT_COORD_W-1:0] center,
    input  wire [        SIZE_W-1:0] width,
    input  wire [        SIZE_W-1:0] height,
    input  wire [     `RT_TAN_W-1:0] tan_h,
    input  wire [     `RT_TAN_W-1:0] tan_v,
    output wire                      done,
    output wire [   `RT_FAULT_W-1:0] fault,
    output wire [3*`RT_SCREEN_W-1:0] base,
    output wire [  3*`RT_SPAN_W-1:0] column_quotient,
    output wire [      3*SIZE_W-1:0] column_remainder,
    output wire [               2:0] column_negative,
    output wire [  3*`RT_SPAN_W-1:0] row_quotient,
    output wire [      3*SIZE_W-1:0] row_remainder,
    output wire [               2:0] row_negative,
    output wire [               3:0] asked
);

    wire vector_valid;
    wire [3*WIDE_W-1:0] vector;
    wire unit_valid;
    wire [3*`RT_UNIT_W-1:0] result;
    // Between results there is something else.
    wire [3*`RT_UNIT_W-1:0] unit = unit_valid ? result : ~result;
    wire unused_tag;
    wire [`RT_UNIT_W:0] unused_norm;
    wire [$clog2(WIDE_W)-1:0] unused_shift;
    wire unused_degenerate;

    camera #(
        .SIZE_W(SIZE_W),
        .WIDE_W(WIDE_W)
    ) u_camera (
        .clk             (clk),
        .rst             (rst),
        .start           (start),
        .position        (position),
        .up              (up),
        .center          (center),
        .width           (width),
        .height          (height),
        .tan_h           (tan_h),
        .tan_v           (tan_v),
        .done            (done),
        .fault           (fault),
        .base            (base),
        .column_quotient (column_quotient),
        .column_remainder(column_remainder),
        .column_negative (column_negative),
        .row_quotient    (row_quotient),
        .row_remainder   (row_remainder),
        .row_negative    (row_negative),
        .vector_valid    (vector_valid),
        .vector          (vector),
        .unit_valid      (unit_valid),
        .unit            (unit)
    );

    unit_vector #(
        .IN_W(WIDE_W)
    ) u_unit (
        .clk       (clk),
        .rst       (rst),
        .in_valid  (vector_valid),
        .in_tag    (1'b0),
        .vector    (vector),
        .out_valid (unit_valid),
        .out_tag   (unused_tag),
        .unit      (result),
        .norm      (unused_norm),
        .shift     (unused_shift),
        .degenerate(unused_degenerate)
    );

    reg [3:0] asked_reg;

    always @(posedge clk) begin
        if (rst || done) asked_reg <= 4'd0;
        else if (vector_valid && asked_reg != 4'd15) asked_reg <= asked_reg + 1'b1;
    end

    assign asked = asked_reg;

endmodule

`default_nettype wire
