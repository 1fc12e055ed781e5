// SPDX-License-Identifier: Apache-2.0
//
// phong: what one light adds to the colour of a hit point (book 8.2.3, equation 1).
//
//     intensity * (k_diffuse max(0, N.L) + k_specular max(0, R.L)^16)   where N.L > 0
//
// Ports
//   normal, mirrored, direction    N, R, L, {x, y, z}, RT_UNIT
//   dark                           the light adds nothing (there is none)
//   k_diffuse, k_specular          of the surface, {r, g, b}, RT_COEFF
//   intensity                      of the light, {r, g, b}, RT_COEFF
//   colour                         {r, g, b}, RT_SHADE; each product floored, all saturated
//
// The colour is that of a light which nothing stops: what its shadow ray meets is multiplied later.
//
// Latency 5 (cosines) + 16 (power) + 4 (coefficients) + 1 (sum) + 4 (light) + 1 = 31; rate one
// light a clock.

`default_nettype none
`include "raytracer.vh"

module phong #(
    parameter TAG_W = 1
) (
    input  wire                      clk,
    input  wire                      rst,
    input  wire                      in_valid,
    input  wire [         TAG_W-1:0] in_tag,
    input  wire [ 3*`RT_UNIT_W-1:0] normal,
    input  wire [ 3*`RT_UNIT_W-1:0] mirrored,
    input  wire [ 3*`RT_UNIT_W-1:0] direction,
    input  wire                      dark,
    input  wire [3*`RT_COEFF_W-1:0] k_diffuse,
    input  wire [3*`RT_COEFF_W-1:0] k_specular,
    input  wire [3*`RT_COEFF_W-1:0] intensity,
    output wire                      out_valid,
    output wire [         TAG_W-1:0] out_tag,
    output wire [3*`RT_SHADE_W-1:0] colour
);

    localparam UNIT_W = `RT_UNIT_W;
    localparam COSINE_W = `RT_COSINE_W;
    localparam RGB_W = 3 * `RT_COEFF_W;
    localparam SHADE_W = `RT_SHADE_W;

    // N.L and R.L side by side; lane 1 is N.L
    wire [1:0] cosine_valid;
    wire [2*UNIT_W-1:0] cosine;
    wire [TAG_W-1:0] cosine_tag;
    wire cosine_dark;
    wire [RGB_W-1:0] cosine_diffuse;
    wire [RGB_W-1:0] cosine_specular;
    wire [RGB_W-1:0] cosine_intensity;

    dot #(
        .A_INT   (`RT_UNIT_INT),
        .A_FRAC  (`RT_UNIT_FRAC),
        .B_INT   (`RT_UNIT_INT),
        .B_FRAC  (`RT_UNIT_FRAC),
        .OUT_INT (`RT_UNIT_INT),
        .OUT_FRAC(`RT_UNIT_FRAC),
        .TAG_W   (1 + 3*RGB_W + TAG_W)
    ) u_diffuse_cosine (
        .clk      (clk),
        .rst      (rst),
        .in_valid (in_valid),
        .in_tag   ({dark, k_diffuse, k_specular, intensity, in_tag}),
        .a        (normal),
        .b        (direction),
        .out_valid(cosine_valid[1]),
        .out_tag  ({cosine_dark, cosine_diffuse, cosine_specular, cosine_intensity,
                    cosine_tag}),
        .p        (cosine[UNIT_W+:UNIT_W])
    );

    wire unused_tag;
    wire unused_valid = cosine_valid[0];

    dot #(
        .A_INT   (`RT_UNIT_INT),
        .A_FRAC  (`RT_UNIT_FRAC),
        .B_INT   (`RT_UNIT_INT),
        .B_FRAC  (`RT_UNIT_FRAC),
        .OUT_INT (`RT_UNIT_INT),
        .OUT_FRAC(`RT_UNIT_FRAC),
        .TAG_W   (1)
    ) u_specular_cosine (
        .clk      (clk),
        .rst      (rst),
        .in_valid (in_valid),
        .in_tag   (1'b0),
        .a        (mirrored),
        .b        (direction),
        .out_valid(cosine_valid[0]),
        .out_tag  (unused_tag),
        .p        (cosine[0+:UNIT_W])
    );

    wire [2*COSINE_W-1:0] clamped;

    genvar lane;
    generate
        for (lane = 0; lane < 2; lane = lane + 1) begin : g_clamp
            resize #(
                .IN_INT    (`RT_UNIT_INT),
                .IN_FRAC   (`RT_UNIT_FRAC),
                .OUT_INT   (`RT_COSINE_INT),
                .OUT_FRAC  (`RT_COSINE_FRAC),
                .OUT_SIGNED(0)
            ) u_resize (
                .in (cosine[lane*UNIT_W+:UNIT_W]),
                .out(clamped[lane*COSINE_W+:COSINE_W])
            );
        end
    endgenerate

    wire cosine_lit = !cosine_dark && clamped[COSINE_W+:COSINE_W] != {COSINE_W{1'b0}};

    // max(0, R.L)^16
    wire power_valid;
    wire [TAG_W-1:0] power_tag;
    wire power_lit;
    wire [COSINE_W-1:0] power_cosine;
    wire [RGB_W-1:0] power_diffuse;
    wire [RGB_W-1:0] power_specular;
    wire [RGB_W-1:0] power_intensity;
    wire [COSINE_W-1:0] power;

    highlight #(
        .TAG_W(1 + COSINE_W + 3*RGB_W + TAG_W)
    ) u_highlight (
        .clk      (clk),
        .rst      (rst),
        .in_valid (cosine_valid[1]),
        .in_tag   ({cosine_lit, clamped[COSINE_W+:COSINE_W], cosine_diffuse, cosine_specular,
                    cosine_intensity, cosine_tag}),
        .cosine   (clamped[0+:COSINE_W]),
        .out_valid(power_valid),
        .out_tag  ({power_lit, power_cosine, power_diffuse, power_specular, power_intensity,
                    power_tag}),
        .power    (power)
    );

    // Coefficient times cosine, diffuse in the upper three lanes
    wire part_valid;
    wire [TAG_W-1:0] part_tag;
    wire part_lit;
    wire [RGB_W-1:0] part_intensity;
    wire [6*SHADE_W-1:0] part;

    vec_mul #(
        .A_INT   (`RT_COEFF_INT),
        .A_FRAC  (`RT_COEFF_FRAC),
        .B_INT   (`RT_COSINE_INT),
        .B_FRAC  (`RT_COSINE_FRAC),
        .OUT_INT (`RT_SHADE_INT),
        .OUT_FRAC(`RT_SHADE_FRAC),
        .LANES   (6),
        .SIGNED  (0),
        .TAG_W   (1 + RGB_W + TAG_W)
    ) u_part (
        .clk      (clk),
        .rst      (rst),
        .in_valid (power_valid),
        .in_tag   ({power_lit, power_intensity, power_tag}),
        .a        ({power_diffuse, power_specular}),
        .b        ({{3{power_cosine}}, {3{power}}}),
        .out_valid(part_valid),
        .out_tag  ({part_lit, part_intensity, part_tag}),
        .p        (part)
    );

    // Sum of both parts
    wire sum_valid;
    wire [TAG_W-1:0] sum_tag;
    wire sum_lit;
    wire [RGB_W-1:0] sum_intensity;
    wire [3*SHADE_W-1:0] sum;

    colour_add #(
        .TAG_W(1 + RGB_W + TAG_W)
    ) u_sum (
        .clk      (clk),
        .rst      (rst),
        .in_valid (part_valid),
        .in_tag   ({part_lit, part_intensity, part_tag}),
        .a        (part[3*SHADE_W+:3*SHADE_W]),
        .b        (part[0+:3*SHADE_W]),
        .out_valid(sum_valid),
        .out_tag  ({sum_lit, sum_intensity, sum_tag}),
        .sum      (sum)
    );

    // times the intensity
    wire product_valid;
    wire [TAG_W-1:0] product_tag;
    wire product_lit;
    wire [3*SHADE_W-1:0] product;
    reg [3*SHADE_W-1:0] colour_reg;

    vec_mul #(
        .A_INT   (`RT_SHADE_INT),
        .A_FRAC  (`RT_SHADE_FRAC),
        .B_INT   (`RT_COEFF_INT),
        .B_FRAC  (`RT_COEFF_FRAC),
        .OUT_INT (`RT_SHADE_INT),
        .OUT_FRAC(`RT_SHADE_FRAC),
        .SIGNED  (0),
        .TAG_W   (1 + TAG_W)
    ) u_product (
        .clk      (clk),
        .rst      (rst),
        .in_valid (sum_valid),
        .in_tag   ({sum_lit, sum_tag}),
        .a        (sum),
        .b        (sum_intensity),
        .out_valid(product_valid),
        .out_tag  ({product_lit, product_tag}),
        .p        (product)
    );

    always @(posedge clk) colour_reg <= product_lit ? product : {3 * SHADE_W{1'b0}};

    valid_pipe #(
        .TAG_W  (TAG_W),
        .LATENCY(1)
    ) u_colour (
        .clk      (clk),
        .rst      (rst),
        .in_valid (product_valid),
        .in_tag   (product_tag),
        .out_valid(out_valid),
        .out_tag  (out_tag)
    );

    assign colour = colour_reg;

endmodule

`default_nettype wire
