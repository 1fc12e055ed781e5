// SPDX-License-Identifier: Apache-2.0
//
// stepper: floor((2 i + 1) span / count) for i = 0, 1, 2, ... without a multiplier or a divider.
//
// A digital differential analyser that carries the remainder, so that no error accumulates: the
// place of a pixel's center on the screen (book 8.2.1) is exact in every column and row.
//
// Parameters
//   SPAN_W   bits of the span, unsigned
//   COUNT_W  bits of the count, unsigned
//
// Ports
//   quotient, remainder  span = quotient * count + remainder, remainder < count
//   count                pixels in the line
//   load                 value becomes that of i = 0; otherwise
//   step                 value becomes that of the next i
//   value                floor((2 i + 1) span / count), a register; it wraps past SPAN_W bits

`default_nettype none

module stepper #(
    parameter SPAN_W  = 22,
    parameter COUNT_W = 12
) (
    input  wire               clk,
    input  wire               load,
    input  wire               step,
    input  wire [ SPAN_W-1:0] quotient,
    input  wire [COUNT_W-1:0] remainder,
    input  wire [COUNT_W-1:0] count,
    output wire [ SPAN_W-1:0] value
);

    reg [SPAN_W-1:0] value_reg;
    reg [COUNT_W-1:0] rest_reg;

    // The increment is twice the span: its remainder carries at most once.
    wire [COUNT_W:0] double_rest = {remainder, 1'b0};
    wire double_carry = double_rest >= {1'b0, count};
    wire [COUNT_W:0] increment_rest = double_carry ? double_rest - {1'b0, count} : double_rest;
    wire [SPAN_W-1:0] increment = {quotient[SPAN_W-2:0], double_carry};

    wire [COUNT_W:0] sum = {1'b0, rest_reg} + increment_rest;
    wire carry = sum >= {1'b0, count};
    wire [COUNT_W:0] sum_rest = carry ? sum - {1'b0, count} : sum;
    wire unused_top = &{1'b0, quotient[SPAN_W-1], sum_rest[COUNT_W]};

    always @(posedge clk) begin
        if (load) begin
            value_reg <= quotient;
            rest_reg  <= remainder;
        end else if (step) begin
            value_reg <= value_reg + increment + {{SPAN_W - 1{1'b0}}, carry};
            rest_reg  <= sum_rest[COUNT_W-1:0];
        end
    end

    assign value = value_reg;

endmodule

`default_nettype wire
