// SPDX-License-Identifier: Apache-2.0
//
// cross_product: a x b (book 10.1.5.2). (`cross` alone is a keyword of SystemVerilog.)
//
//     p = (a_y b_z - a_z b_y,  a_z b_x - a_x b_z,  a_x b_y - a_y b_x)
//
// Each component is an exact difference of two full products, truncated (floor) and saturated once.
//
// Parameters
//   A_INT, A_FRAC, B_INT, B_FRAC  formats of the operands' components, signed
//   OUT_INT, OUT_FRAC             format of the result's components, signed
//   TAG_W                         bits of the caller's sideband data
//
// Ports     a, b, p: vectors {x, y, z}
//
// Latency 5 (multiplier 3, difference 1, result register 1), rate one product a clock.

`default_nettype none

module cross_product #(
    parameter A_INT    = 9,
    parameter A_FRAC   = 10,
    parameter B_INT    = 9,
    parameter B_FRAC   = 10,
    parameter OUT_INT  = 9,
    parameter OUT_FRAC = 10,
    parameter TAG_W    = 1
) (
    input  wire                            clk,
    input  wire                            rst,
    input  wire                            in_valid,
    input  wire [               TAG_W-1:0] in_tag,
    input  wire [    3*(A_INT+A_FRAC)-1:0] a,
    input  wire [    3*(B_INT+B_FRAC)-1:0] b,
    output wire                            out_valid,
    output wire [               TAG_W-1:0] out_tag,
    output wire [3*(OUT_INT+OUT_FRAC)-1:0] p
);

    localparam A_W = A_INT + A_FRAC;
    localparam B_W = B_INT + B_FRAC;
    localparam PRODUCT_W = A_W + B_W;
    localparam OUT_W = OUT_INT + OUT_FRAC;

    // The vectors turned by one and by two components.
    wire [3*A_W-1:0] a_yzx = {a[2*A_W-1:0], a[3*A_W-1:2*A_W]};
    wire [3*A_W-1:0] a_zxy = {a[A_W-1:0], a[3*A_W-1:A_W]};
    wire [3*B_W-1:0] b_yzx = {b[2*B_W-1:0], b[3*B_W-1:2*B_W]};
    wire [3*B_W-1:0] b_zxy = {b[B_W-1:0], b[3*B_W-1:B_W]};

    wire product_valid;
    wire [TAG_W-1:0] product_tag;
    wire [3*PRODUCT_W-1:0] plus;
    wire [3*PRODUCT_W-1:0] minus;
    wire [3*OUT_W-1:0] p_next;
    reg [3*OUT_W-1:0] p_reg;

    mul #(
        .A_W   (A_W),
        .B_W   (B_W),
        .LANES (6),
        .SIGNED(1),
        .TAG_W (TAG_W)
    ) u_mul (
        .clk      (clk),
        .rst      (rst),
        .in_valid (in_valid),
        .in_tag   (in_tag),
        .a        ({a_yzx, a_zxy}),
        .b        ({b_zxy, b_yzx}),
        .out_valid(product_valid),
        .out_tag  (product_tag),
        .p        ({plus, minus})
    );

    genvar lane;
    generate
        for (lane = 0; lane < 3; lane = lane + 1) begin : g_lane
            reg [PRODUCT_W:0] difference_reg;

            always @(posedge clk)
                difference_reg <= {plus[(lane+1)*PRODUCT_W-1], plus[lane*PRODUCT_W+:PRODUCT_W]}
                                - {minus[(lane+1)*PRODUCT_W-1], minus[lane*PRODUCT_W+:PRODUCT_W]};

            resize #(
                .IN_INT  (A_INT + B_INT + 1),
                .IN_FRAC (A_FRAC + B_FRAC),
                .OUT_INT (OUT_INT),
                .OUT_FRAC(OUT_FRAC)
            ) u_resize (
                .in (difference_reg),
                .out(p_next[lane*OUT_W+:OUT_W])
            );
        end
    endgenerate

    always @(posedge clk) p_reg <= p_next;

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
