// SPDX-License-Identifier: Apache-2.0
//
// dot: dot product of two vectors (book 10.1.5.1).
//
// The three full products are summed exactly; the sum is truncated (floor) and saturated once.
//
// Parameters
//   A_INT, A_FRAC, B_INT, B_FRAC  formats of the operands' components, signed
//   OUT_INT, OUT_FRAC             format of the result, signed
//   TAG_W                         bits of the caller's sideband data
//
// Ports     a, b: vectors {x, y, z}; p: scalar
//
// Latency 5 (multiplier 3, sum 1, result register 1), rate one product a clock.

`default_nettype none

module dot #(
    parameter A_INT    = 9,
    parameter A_FRAC   = 10,
    parameter B_INT    = 9,
    parameter B_FRAC   = 10,
    parameter OUT_INT  = 9,
    parameter OUT_FRAC = 10,
    parameter TAG_W    = 1
) (
    input  wire                        clk,
    input  wire                        rst,
    input  wire                        in_valid,
    input  wire [           TAG_W-1:0] in_tag,
    input  wire [3*(A_INT+A_FRAC)-1:0] a,
    input  wire [3*(B_INT+B_FRAC)-1:0] b,
    output wire                        out_valid,
    output wire [           TAG_W-1:0] out_tag,
    output wire [OUT_INT+OUT_FRAC-1:0] p
);

    localparam PRODUCT_W = A_INT + A_FRAC + B_INT + B_FRAC;
    // Three products need two bits more than one.
    localparam SUM_W = PRODUCT_W + 2;
    localparam OUT_W = OUT_INT + OUT_FRAC;

    wire product_valid;
    wire [TAG_W-1:0] product_tag;
    wire [3*PRODUCT_W-1:0] product;
    wire [3*SUM_W-1:0] term;
    wire [OUT_W-1:0] p_next;
    reg [SUM_W-1:0] sum_reg;
    reg [OUT_W-1:0] p_reg;

    mul #(
        .A_W   (A_INT + A_FRAC),
        .B_W   (B_INT + B_FRAC),
        .LANES (3),
        .SIGNED(1),
        .TAG_W (TAG_W)
    ) u_mul (
        .clk      (clk),
        .rst      (rst),
        .in_valid (in_valid),
        .in_tag   (in_tag),
        .a        (a),
        .b        (b),
        .out_valid(product_valid),
        .out_tag  (product_tag),
        .p        (product)
    );

    genvar lane;
    generate
        for (lane = 0; lane < 3; lane = lane + 1) begin : g_term
            assign term[lane*SUM_W+:SUM_W] =
                {{2{product[(lane+1)*PRODUCT_W-1]}}, product[lane*PRODUCT_W+:PRODUCT_W]};
        end
    endgenerate

    resize #(
        .IN_INT  (A_INT + B_INT + 2),
        .IN_FRAC (A_FRAC + B_FRAC),
        .OUT_INT (OUT_INT),
        .OUT_FRAC(OUT_FRAC)
    ) u_resize (
        .in (sum_reg),
        .out(p_next)
    );

    always @(posedge clk) begin
        sum_reg <= term[2*SUM_W+:SUM_W] + term[SUM_W+:SUM_W] + term[0+:SUM_W];
        p_reg   <= p_next;
    end

    assign p = p_reg;

    valid_pipe #(
        .TAG_W  (TAG_W),
        .LATENCY(2)
    ) u_valid (
        .clk      (clk),
        .rst      (rst),
        .in_valid (product_valid),
        .in_tag   (product_tag),
        .out_valid(out_valid),
        .out_tag  (out_tag)
    );

endmodule

`default_nettype wire
