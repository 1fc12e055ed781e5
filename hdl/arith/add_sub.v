// SPDX-License-Identifier: Apache-2.0
//
// add_sub: sum or difference of two vectors (book 10.1.1, 10.1.2).
//
// Each component is one bit wider than its operands, then saturated.
//
// Parameters
//   INT, FRAC  format of operands and result, signed
//   LANES      components
//   SUBTRACT   0: a + b; 1: a - b
//   TAG_W      bits of the caller's sideband data
//
// Ports     a, b: operands; sum: result
//
// Latency 1, rate one vector a clock.

`default_nettype none

module add_sub #(
    parameter INT      = 9,
    parameter FRAC     = 10,
    parameter LANES    = 3,
    parameter SUBTRACT = 0,
    parameter TAG_W    = 1
) (
    input  wire                        clk,
    input  wire                        rst,
    input  wire                        in_valid,
    input  wire [           TAG_W-1:0] in_tag,
    input  wire [LANES*(INT+FRAC)-1:0] a,
    input  wire [LANES*(INT+FRAC)-1:0] b,
    output wire                        out_valid,
    output wire [           TAG_W-1:0] out_tag,
    output wire [LANES*(INT+FRAC)-1:0] sum
);

    localparam W = INT + FRAC;

    wire [LANES*W-1:0] sum_next;
    reg [LANES*W-1:0] sum_reg;

    genvar lane;
    generate
        for (lane = 0; lane < LANES; lane = lane + 1) begin : g_lane
            wire [W:0] a_wide = {a[lane*W+W-1], a[lane*W+:W]};
            wire [W:0] b_wide = {b[lane*W+W-1], b[lane*W+:W]};
            wire [W:0] wide;

            if (SUBTRACT != 0) begin : g_subtract
                assign wide = a_wide - b_wide;
            end else begin : g_add
                assign wide = a_wide + b_wide;
            end

            resize #(
                .IN_INT  (INT + 1),
                .IN_FRAC (FRAC),
                .OUT_INT (INT),
                .OUT_FRAC(FRAC)
            ) u_resize (
                .in (wide),
                .out(sum_next[lane*W+:W])
            );
        end
    endgenerate

    always @(posedge clk) sum_reg <= sum_next;

    assign sum = sum_reg;

    valid_pipe #(
        .TAG_W  (TAG_W),
        .LATENCY(1)
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
