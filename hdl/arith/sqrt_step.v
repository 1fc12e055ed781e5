// SPDX-License-Identifier: Apache-2.0
//
// sqrt_step: one step of the non-restoring square root (book 10.1.6, figure 19).
//
// With the partial root Q, the signed partial remainder R and the next two bits D of the radicand,
//     R >= 0:  r_next = {R, D} - {Q, 01}        R < 0:  r_next = {R, D} + {Q, 11}
// in one adder/subtractor; the new bit of the root is 1 where r_next is not negative.
// r_next lies between -(2 q_next + 1) and 2 q_next, so K + 2 bits always hold it.
//
// Parameters
//   K  bits of the root after this step, the first step being 1
//
// Ports     r, q: before the step (q < 2^(K-1), both 0 in the first step); r_next, q_next: after it
//
// Combinational.

`default_nettype none

module sqrt_step #(
    parameter K = 20
) (
    input  wire [  K:0] r,
    input  wire [K-1:0] q,
    input  wire [  1:0] digits,
    output wire [K+1:0] r_next,
    output wire [K-1:0] q_next
);

    wire add = r[K];
    wire [K+2:0] shifted = {r, digits};
    wire [K+1:0] operand = {q, add, 1'b1};
    wire [K:0] q_wide = {q, !r_next[K+1]};
    wire unused_top = &{1'b0, shifted[K+2], q_wide[K]};

    assign r_next = shifted[K+1:0] + (operand ^ {K + 2{!add}}) + {{K + 1{1'b0}}, !add};
    assign q_next = q_wide[K-1:0];

endmodule

`default_nettype wire
