// SPDX-License-Identifier: Apache-2.0
//
// iterate: control of a unit that works on one operand for STEPS clocks (sqrt_iter, div_iter).
//
// `start` accepts an operand, `step` is high in each of the STEPS clocks of work, the first of
// which is the one of acceptance. The result stands from then on until it is taken.
//
// Parameters
//   STEPS  clocks of work, 1 or more
//
// Latency STEPS clocks from acceptance to out_valid. An operand is accepted where the unit is
// empty or in the very clock in which its result is taken (in_ready depends on out_ready in the
// same clock), so the rate is one result every STEPS clocks.

`default_nettype none

module iterate #(
    parameter STEPS = 20
) (
    input  wire clk,
    input  wire rst,
    input  wire in_valid,
    output wire in_ready,
    output wire out_valid,
    input  wire out_ready,
    output wire start,
    output wire step
);

    localparam COUNT_W = STEPS > 1 ? $clog2(STEPS) : 1;

    // Steps still to do; the last one is under way at 1.
    reg [COUNT_W-1:0] count_reg;
    reg out_valid_reg;

    wire busy = count_reg != {COUNT_W{1'b0}};
    wire finish;

    assign in_ready = !busy && (!out_valid_reg || out_ready);
    assign out_valid = out_valid_reg;
    assign start = in_valid && in_ready;
    assign step = start || busy;

    generate
        if (STEPS < 1) begin : g_bad_steps
            iterate_needs_at_least_one_of_STEPS error ();
        end

        if (STEPS == 1) begin : g_single
            assign finish = start;
            always @(posedge clk) count_reg <= {COUNT_W{1'b0}};
        end else begin : g_count
            localparam [31:0] FIRST = STEPS - 1;
            assign finish = count_reg == {{COUNT_W - 1{1'b0}}, 1'b1};
            always @(posedge clk) begin
                if (rst) count_reg <= {COUNT_W{1'b0}};
                else if (start) count_reg <= FIRST[COUNT_W-1:0];
                else if (busy) count_reg <= count_reg - 1'b1;
            end
        end
    endgenerate

    always @(posedge clk) begin
        if (rst) out_valid_reg <= 1'b0;
        else out_valid_reg <= finish || (out_valid_reg && !out_ready);
    end

endmodule

`default_nettype wire
