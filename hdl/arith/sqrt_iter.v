// SPDX-License-Identifier: Apache-2.0
//
// sqrt_iter: iterative integer square root, one bit a clock (book 10.1.6, figure 19).
//
// radicand = root^2 + remainder with 0 <= remainder <= 2 root, exact for every radicand. One
// adder/subtractor makes the steps (see sqrt_step); the adjustment of a negative remainder,
// remainder + {root, 1}, is made at the output.
//
// Parameters
//   D_W  bits of the radicand, even
//
// Ports     radicand, root, remainder: unsigned
//
// Latency D_W / 2 clocks from acceptance (in_valid and in_ready) to out_valid, rate one root every
// D_W / 2 clocks; a result is held until it is taken, and in that same clock the next radicand is
// accepted (see iterate).

`default_nettype none

module sqrt_iter #(
    parameter D_W = 40
) (
    input  wire             clk,
    input  wire             rst,
    input  wire             in_valid,
    output wire             in_ready,
    input  wire [  D_W-1:0] radicand,
    output wire             out_valid,
    input  wire             out_ready,
    output wire [D_W/2-1:0] root,
    output wire [  D_W/2:0] remainder
);

    localparam STEPS = D_W / 2;

    generate
        if (D_W % 2 != 0 || D_W < 2) begin : g_bad_width
            sqrt_iter_needs_an_even_radicand_width_D_W error ();
        end
    endgenerate

    reg [D_W-1:0] d_reg;
    reg [STEPS+1:0] r_reg;
    reg [STEPS-1:0] q_reg;

    wire start;
    wire step;
    wire [D_W-1:0] d = start ? radicand : d_reg;
    // Before a step the remainder has no more than STEPS + 1 bits.
    wire [STEPS:0] r = start ? {STEPS + 1{1'b0}} : r_reg[STEPS:0];
    wire [STEPS-1:0] q = start ? {STEPS{1'b0}} : q_reg;
    wire [STEPS+1:0] r_next;
    wire [STEPS-1:0] q_next;

    iterate #(
        .STEPS(STEPS)
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

    sqrt_step #(
        .K(STEPS)
    ) u_step (
        .r     (r),
        .q     (q),
        .digits(d[D_W-1:D_W-2]),
        .r_next(r_next),
        .q_next(q_next)
    );

    always @(posedge clk) begin
        if (step) begin
            d_reg <= d << 2;
            r_reg <= r_next;
            q_reg <= q_next;
        end
    end

    assign root = q_reg;
    assign remainder = r_reg[STEPS:0] + (r_reg[STEPS+1] ? {q_reg, 1'b1} : {STEPS + 1{1'b0}});

endmodule

`default_nettype wire
