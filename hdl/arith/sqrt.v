// SPDX-License-Identifier: Apache-2.0
//
// sqrt: pipelined integer square root (book 10.1.6, figure 19; Li and Chu's non-restoring algorithm).
//
// radicand = root^2 + remainder with 0 <= remainder <= 2 root, exact for every radicand. Every
// stage finds one bit of the root with one adder/subtractor and no multiplier (see sqrt_step). The
// last stage adds {root, 1} to a negative partial remainder, which makes it the remainder.
//
// Parameters
//   D_W    bits of the radicand, even
//   TAG_W  bits of the caller's sideband data
//
// Ports     radicand, root, remainder: unsigned
//
// Latency D_W / 2 + 1, rate one root a clock. After stage k the registers hold k bits of root,
// k + 2 bits of signed remainder and the D_W - 2 k bits of the radicand that are left.

`default_nettype none

module sqrt #(
    parameter D_W   = 40,
    parameter TAG_W = 1
) (
    input  wire             clk,
    input  wire             rst,
    input  wire             in_valid,
    input  wire [TAG_W-1:0] in_tag,
    input  wire [  D_W-1:0] radicand,
    output wire             out_valid,
    output wire [TAG_W-1:0] out_tag,
    output wire [D_W/2-1:0] root,
    output wire [  D_W/2:0] remainder
);

    localparam STEPS = D_W / 2;

    reg [STEPS-1:0] root_reg;
    reg [STEPS:0] remainder_reg;

    genvar k;
    generate
        if (D_W % 2 != 0 || D_W < 2) begin : g_bad_width
            sqrt_needs_an_even_radicand_width_D_W error ();
        end

        // Stage k makes bit k of the root, counted from the top, the first being 1.
        for (k = 1; k <= STEPS; k = k + 1) begin : g_stage
            // Bits of the radicand that are left behind this stage.
            localparam LEFT = D_W - 2 * k;
            wire [k:0] r;
            wire [k-1:0] q;
            wire [LEFT+1:0] d;
            wire [k+1:0] r_next;
            wire [k-1:0] q_next;
            reg [k+1+LEFT:0] state_reg;
            reg [k-1:0] q_reg;

            if (k == 1) begin : g_first
                assign {r, d} = {2'b00, radicand};
                assign q = 1'b0;
            end else begin : g_next
                assign {r, d} = g_stage[k-1].state_reg;
                assign q = {1'b0, g_stage[k-1].q_reg};
            end

            sqrt_step #(
                .K(k)
            ) u_step (
                .r     (r),
                .q     (q),
                .digits(d[LEFT+1:LEFT]),
                .r_next(r_next),
                .q_next(q_next)
            );

            always @(posedge clk) q_reg <= q_next;

            if (LEFT == 0) begin : g_state_last
                always @(posedge clk) state_reg <= r_next;
            end else begin : g_state
                always @(posedge clk) state_reg <= {r_next, d[LEFT-1:0]};
            end
        end
    endgenerate

    wire [STEPS+1:0] r_last = g_stage[STEPS].state_reg;
    wire [STEPS-1:0] q_last = g_stage[STEPS].q_reg;

    always @(posedge clk) begin
        root_reg <= q_last;
        remainder_reg <= r_last[STEPS:0] + (r_last[STEPS+1] ? {q_last, 1'b1} : {STEPS + 1{1'b0}});
    end

    assign root = root_reg;
    assign remainder = remainder_reg;

    valid_pipe #(
        .TAG_W  (TAG_W),
        .LATENCY(STEPS + 1)
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
