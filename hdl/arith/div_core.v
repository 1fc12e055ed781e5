// SPDX-License-Identifier: Apache-2.0
//
// div_core: pipelined unsigned long division of {upper, lower} by den.
//
//     {upper, lower} = quotient * den + remainder with 0 <= remainder < den, where upper < den
//
// Non-restoring: every stage finds one bit of the quotient with one adder/subtractor. With the
// signed partial remainder R (at first `upper`) and the next bit D of `lower`,
//     R >= 0:  {R, D} - den        R < 0:  {R, D} + den
// and the bit is 1 where the result is not negative. A negative last R takes den once more to be
// the remainder, behind the last register.
//
// Where upper >= den the quotient does not fit. The result is then that of the same steps, each
// modulo 2^(DEN_W + 1), and means nothing: the caller checks first.
//
// Parameters
//   DEN_W   bits of the denominator, the remainder and `upper`
//   QUOT_W  bits of the quotient and of `lower`
//   LANES   dividends side by side that share one denominator; lane 0 is in the low bits
//   TAG_W   bits of the caller's sideband data
//
// Latency QUOT_W, rate one division (of each lane) a clock.

`default_nettype none

module div_core #(
    parameter DEN_W  = 20,
    parameter QUOT_W = 18,
    parameter LANES  = 1,
    parameter TAG_W  = 1
) (
    input  wire                    clk,
    input  wire                    rst,
    input  wire                    in_valid,
    input  wire [       TAG_W-1:0] in_tag,
    input  wire [ LANES*DEN_W-1:0] upper,
    input  wire [LANES*QUOT_W-1:0] lower,
    input  wire [       DEN_W-1:0] den,
    output wire                    out_valid,
    output wire [       TAG_W-1:0] out_tag,
    output wire [LANES*QUOT_W-1:0] quotient,
    output wire [ LANES*DEN_W-1:0] remainder
);

    genvar k, lane;
    generate
        if (QUOT_W < 1 || DEN_W < 1) begin : g_bad_width
            div_core_needs_DEN_W_and_QUOT_W_of_1_or_more error ();
        end

        // Stage k makes bit k of the quotient, counted from the top, the first being 1.
        for (k = 1; k <= QUOT_W; k = k + 1) begin : g_stage
            wire [DEN_W-1:0] den_in;
            reg [DEN_W-1:0] den_reg;

            if (k == 1) begin : g_first
                assign den_in = den;
            end else begin : g_next
                assign den_in = g_stage[k-1].den_reg;
            end

            always @(posedge clk) den_reg <= den_in;

            for (lane = 0; lane < LANES; lane = lane + 1) begin : g_lane
                // What is left of `lower`, then what is known of the quotient.
                wire [QUOT_W-1:0] work;
                wire [DEN_W:0] r;
                reg [QUOT_W-1:0] work_reg;
                reg [DEN_W:0] r_reg;

                if (k == 1) begin : g_first
                    assign work = lower[lane*QUOT_W+:QUOT_W];
                    assign r = {1'b0, upper[lane*DEN_W+:DEN_W]};
                end else begin : g_next
                    assign work = g_stage[k-1].g_lane[lane].work_reg;
                    assign r = g_stage[k-1].g_lane[lane].r_reg;
                end

                wire add = r[DEN_W];
                wire [DEN_W:0] operand = {1'b0, den_in} ^ {DEN_W + 1{!add}};
                wire [DEN_W:0] r_next = {r[DEN_W-1:0], work[QUOT_W-1]} + operand
                                      + {{DEN_W{1'b0}}, !add};
                wire [QUOT_W:0] work_next = {work, !r_next[DEN_W]};
                wire unused_digit = work_next[QUOT_W];

                always @(posedge clk) begin
                    r_reg <= r_next;
                    work_reg <= work_next[QUOT_W-1:0];
                end
            end
        end

        for (lane = 0; lane < LANES; lane = lane + 1) begin : g_out
            wire [DEN_W:0] r = g_stage[QUOT_W].g_lane[lane].r_reg;
            assign quotient[lane*QUOT_W+:QUOT_W] = g_stage[QUOT_W].g_lane[lane].work_reg;
            assign remainder[lane*DEN_W+:DEN_W] =
                r[DEN_W-1:0] + (g_stage[QUOT_W].den_reg & {DEN_W{r[DEN_W]}});
        end
    endgenerate

    valid_pipe #(
        .TAG_W  (TAG_W),
        .LATENCY(QUOT_W)
    ) u_valid (
        .clk      (clk),
        .rst      (rst),
        .in_valid (in_valid),
        .in_tag   (in_tag),
        .out_valid(out_valid),
        .out_tag  (out_tag)
    );

endmodule

`default_nettype wire
