// SPDX-License-Identifier: Apache-2.0
//
// object_setup: what a sphere's tests and shading need and a frame does not hold, once a frame.
//
//     radius_sq  = radius^2, exact
//     inv_radius = 1 / radius, floored
//     ambient    = ambient light * k_ambient, point-wise, floored and saturated
//
// Ports
//   start          takes `radius` (RT_RADIUS, not 0), `ambient_light` and `k_ambient` {r, g, b}
//                  (RT_COEFF); they hold still until done
//   done           one clock; the results (RT_RADIUS_SQ, RT_INV_RADIUS, RT_SHADE) hold from it on
//                  until the next start
//
// Latency RT_INV_RADIUS_W + 1 clocks from start to done.

`default_nettype none
`include "raytracer.vh"

module object_setup (
    input  wire                        clk,
    input  wire                        rst,
    input  wire                        start,
    input  wire [    `RT_RADIUS_W-1:0] radius,
    input  wire [   3*`RT_COEFF_W-1:0] ambient_light,
    input  wire [   3*`RT_COEFF_W-1:0] k_ambient,
    output wire                        done,
    output wire [`RT_RADIUS_SQ_W-1:0] radius_sq,
    output wire [`RT_INV_RADIUS_W-1:0] inv_radius,
    output wire [   3*`RT_SHADE_W-1:0] ambient
);

    // 1.0 at the fraction of the quotient and of the divisor.
    localparam [`RT_INV_RADIUS_W-1:0] ONE = 1 << (`RT_INV_RADIUS_FRAC + `RT_RADIUS_FRAC);

    reg [`RT_RADIUS_SQ_W-1:0] radius_sq_reg;
    reg [`RT_INV_RADIUS_W-1:0] inv_radius_reg;
    reg [3*`RT_SHADE_W-1:0] ambient_reg;
    reg done_reg;

    wire quotient_valid;
    wire [`RT_INV_RADIUS_W-1:0] quotient;
    wire [`RT_RADIUS_W-1:0] unused_remainder;
    wire unused_ready;

    div_iter #(
        .NUM_W(`RT_INV_RADIUS_W),
        .DEN_W(`RT_RADIUS_W)
    ) u_inverse (
        .clk      (clk),
        .rst      (rst),
        .in_valid (start),
        .in_ready (unused_ready),
        .num      (ONE),
        .den      (radius),
        .out_valid(quotient_valid),
        .out_ready(1'b1),
        .quotient (quotient),
        .remainder(unused_remainder)
    );

    wire ambient_valid;
    wire unused_tag;
    wire [3*`RT_SHADE_W-1:0] ambient_next;

    vec_mul #(
        .A_INT   (`RT_COEFF_INT),
        .A_FRAC  (`RT_COEFF_FRAC),
        .B_INT   (`RT_COEFF_INT),
        .B_FRAC  (`RT_COEFF_FRAC),
        .OUT_INT (`RT_SHADE_INT),
        .OUT_FRAC(`RT_SHADE_FRAC),
        .SIGNED  (0)
    ) u_ambient (
        .clk      (clk),
        .rst      (rst),
        .in_valid (start),
        .in_tag   (1'b0),
        .a        (ambient_light),
        .b        (k_ambient),
        .out_valid(ambient_valid),
        .out_tag  (unused_tag),
        .p        (ambient_next)
    );

    always @(posedge clk) begin
        if (start) radius_sq_reg <= radius * radius;
        if (quotient_valid) inv_radius_reg <= quotient;
        if (ambient_valid) ambient_reg <= ambient_next;
    end

    always @(posedge clk) begin
        if (rst) done_reg <= 1'b0;
        else done_reg <= quotient_valid;
    end

    assign done       = done_reg;
    assign radius_sq  = radius_sq_reg;
    assign inv_radius = inv_radius_reg;
    assign ambient    = ambient_reg;

endmodule

`default_nettype wire
