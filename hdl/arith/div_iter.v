// SPDX-License-Identifier: Apache-2.0
//
// div_iter: iterative unsigned division, one bit of the quotient a clock, with one subtractor.
//
//     num = quotient * den + remainder with 0 <= remainder < den
//
// den = 0 gives a quotient of all ones and the low bits of num as the remainder.
//
// Parameters
//   NUM_W  bits of the numerator and the quotient
//   DEN_W  bits of the denominator and the remainder
//
// Latency NUM_W clocks from acceptance (in_valid and in_ready) to out_valid, rate one division
// every NUM_W clocks; a result is held until it is taken, and in that same clock the next operands
// are accepted (see iterate).

`default_nettype none

module div_iter #(
    parameter NUM_W = 24,
    parameter DEN_W = 12
) (
    input  wire             clk,
    input  wire             rst,
    input  wire             in_valid,
    output wire             in_ready,
    input  wire [NUM_W-1:0] num,
    input  wire [DEN_W-1:0] den,
    output wire             out_valid,
    input  wire             out_ready,
    output wire [NUM_W-1:0] quotient,
    output wire [DEN_W-1:0] remainder
);

    // What is left of the numerator, then what is known of the quotient.
    reg [NUM_W-1:0] work_reg;
    reg [DEN_W-1:0] den_reg;
    reg [DEN_W-1:0] r_reg;

    wire start;
    wire step;
    wire [NUM_W-1:0] work = start ? num : work_reg;
    wire [DEN_W-1:0] den_in = start ? den : den_reg;
    wire [DEN_W-1:0] r = start ? {DEN_W{1'b0}} : r_reg;
    wire [DEN_W:0] shifted = {r, work[NUM_W-1]};
    wire [DEN_W+1:0] difference = {1'b0, shifted} - {2'b00, den_in};
    wire fits = !difference[DEN_W+1];
    wire [NUM_W:0] work_next = {work, fits};
    wire unused_top = &{1'b0, difference[DEN_W], work_next[NUM_W]};

    iterate #(
        .STEPS(NUM_W)
    ) u_iterate (
        .clk      (clk),
        .rst      (rst),
        .in_valid (in_valid),
        .in_ready (in_ready),
        .out_valid(out_valid),
        .out_ready(out_ready),
        .start    (start),
        .step     (step)
    );

    always @(posedge clk) begin
        if (step) begin
            work_reg <= work_next[NUM_W-1:0];
            den_reg <= den_in;
            r_reg <= fits ? difference[DEN_W-1:0] : shifted[DEN_W-1:0];
        end
    end

    assign quotient = work_reg;
    assign remainder = r_reg;

endmodule

`default_nettype wire
