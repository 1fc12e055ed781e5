// SPDX-License-Identifier: Apache-2.0
//
// refract: T, the direction in which a ray goes on behind a surface (book 8.2.5, Snell's law).
//
//     T = (eta c - sqrt(1 - eta^2 (1 - c^2))) N + eta V        with c = -N.V
//
// eta is n_from / n_to: 1 / n where the ray enters, n where it leaves, and n = 1 + index / 8. Where
// the radicand is negative there is no T, total internal reflection, and the ray goes on along R.
//
// Ports
//   direction    V, {x, y, z}, RT_UNIT
//   normal       N, turned toward the viewer, {x, y, z}, RT_UNIT
//   mirrored     R, {x, y, z}, RT_UNIT, and cosine: N.V, RT_UNIT, both as `reflect` gives them
//   index        code of the refractive index, RT_INDEX_W bits
//   leaving      the ray leaves the object
//   transmitted  T, or R where there is none, {x, y, z}, RT_UNIT, floored and saturated
//   total        total internal reflection
//
// Formats of the steps: eta RT_ETA and its square RT_ETA_SQ, floored, from two tables; c held in 0
// to 1, RT_COSINE; 1 - c^2 RT_SINE_SQ, floored; the radicand and eta c with twice and once the
// fraction of RT_GAIN, floored; the factor of N RT_GAIN. The sum of both products is exact and
// floored once.
//
// Latency 3 (c^2) + 1 (1 - c^2) + 3 (times eta^2) + 1 (radicand) + RT_GAIN_FRAC + 2 (root) +
// 1 (factor of N) + 3 (products) + 1 (sum) + 1 (result) = 32, rate one direction a clock.

`default_nettype none
`include "raytracer.vh"

module refract #(
    parameter TAG_W = 1
) (
    input  wire                     clk,
    input  wire                     rst,
    input  wire                     in_valid,
    input  wire [        TAG_W-1:0] in_tag,
    input  wire [3*`RT_UNIT_W-1:0] direction,
    input  wire [3*`RT_UNIT_W-1:0] normal,
    input  wire [3*`RT_UNIT_W-1:0] mirrored,
    input  wire [  `RT_UNIT_W-1:0] cosine,
    input  wire [ `RT_INDEX_W-1:0] index,
    input  wire                     leaving,
    output wire                     out_valid,
    output wire [        TAG_W-1:0] out_tag,
    output wire [3*`RT_UNIT_W-1:0] transmitted,
    output wire                     total
);

    localparam UNIT_W = `RT_UNIT_W;
    localparam COSINE_W = `RT_COSINE_W;
    localparam ETA_W = `RT_ETA_W;
    localparam ETA_SQ_W = `RT_ETA_SQ_W;
    localparam SINE_SQ_W = `RT_SINE_SQ_W;
    localparam GAIN_W = `RT_GAIN_W;
    localparam GAIN_FRAC = `RT_GAIN_FRAC;
    localparam SQUARE_FRAC = 2 * `RT_UNIT_FRAC;
    localparam SQUARE_W = 2 * COSINE_W;
    // eta^2 (1 - c^2), and what of it the radicand drops
    localparam BEND_W = ETA_SQ_W + SINE_SQ_W;
    localparam BEND_DROP = `RT_ETA_SQ_FRAC + `RT_SINE_SQ_FRAC - 2 * GAIN_FRAC;
    // The radicand is at most 1, and the root is 1 where it is.
    localparam RADICAND_W = 2 * GAIN_FRAC + 2;
    localparam ROOT_W = RADICAND_W / 2;

    generate
        if (BEND_DROP < 1 || ETA_W + 1 != GAIN_W || `RT_ETA_FRAC != GAIN_FRAC) begin : g_bad_formats
            refract_needs_RT_ETA_and_RT_GAIN_of_one_fraction_and_RT_GAIN_a_bit_wider error ();
        end
    endgenerate

    // Tables by {leaving, index}, made of the definition of the code; steps of the code in n = 1
    localparam CODES = 1 << `RT_INDEX_W;
    localparam ONE = `RT_INDEX_ONE;
    localparam ETAS_W = 2 * CODES * ETA_W;
    localparam ETA_SQS_W = 2 * CODES * ETA_SQ_W;

    function [ETAS_W-1:0] all_eta;
        input integer one;
        integer code, enter, leave;
        begin
            all_eta = {ETAS_W{1'b0}};
            for (code = 0; code < CODES; code = code + 1) begin
                enter = (one << `RT_ETA_FRAC) / (one + code);
                leave = ((one + code) << `RT_ETA_FRAC) / one;
                all_eta = all_eta | ({{ETAS_W - 32{1'b0}}, enter} << (code * ETA_W))
                        | ({{ETAS_W - 32{1'b0}}, leave} << ((CODES + code) * ETA_W));
            end
        end
    endfunction

    function [ETA_SQS_W-1:0] all_eta_sq;
        input integer one;
        integer code, enter, leave;
        begin
            all_eta_sq = {ETA_SQS_W{1'b0}};
            for (code = 0; code < CODES; code = code + 1) begin
                enter = (one * one << `RT_ETA_SQ_FRAC) / ((one + code) * (one + code));
                leave = ((one + code) * (one + code) << `RT_ETA_SQ_FRAC) / (one * one);
                all_eta_sq = all_eta_sq | ({{ETA_SQS_W - 32{1'b0}}, enter} << (code * ETA_SQ_W))
                           | ({{ETA_SQS_W - 32{1'b0}}, leave} << ((CODES + code) * ETA_SQ_W));
            end
        end
    endfunction

    localparam [ETAS_W-1:0] ETA = all_eta(ONE);
    localparam [ETA_SQS_W-1:0] ETA_SQ = all_eta_sq(ONE);

    wire [ETA_W-1:0] eta = ETA[{leaving, index}*ETA_W+:ETA_W];
    wire [ETA_SQ_W-1:0] eta_sq = ETA_SQ[{leaving, index}*ETA_SQ_W+:ETA_SQ_W];

    // c, held in 0 to 1
    localparam [UNIT_W:0] COSINE_ONE = 1 << `RT_UNIT_FRAC;
    wire [UNIT_W:0] opposite = -{cosine[UNIT_W-1], cosine};
    wire [UNIT_W:0] held = opposite > COSINE_ONE ? COSINE_ONE : opposite;
    wire [COSINE_W-1:0] incidence = opposite[UNIT_W] ? {COSINE_W{1'b0}} : held[COSINE_W-1:0];
    wire unused_held = &{1'b0, held[UNIT_W:COSINE_W]};

    // c^2
    wire square_valid;
    wire [TAG_W-1:0] square_tag;
    wire [9*UNIT_W-1:0] square_vectors;
    wire [ETA_W-1:0] square_eta;
    wire [ETA_SQ_W-1:0] square_eta_sq;
    wire [SQUARE_W-1:0] square;

    mul #(
        .A_W   (COSINE_W),
        .B_W   (COSINE_W),
        .LANES (1),
        .SIGNED(0),
        .TAG_W (9*UNIT_W + ETA_W + ETA_SQ_W + TAG_W)
    ) u_square (
        .clk      (clk),
        .rst      (rst),
        .in_valid (in_valid),
        .in_tag   ({direction, normal, mirrored, eta, eta_sq, in_tag}),
        .a        (incidence),
        .b        (incidence),
        .out_valid(square_valid),
        .out_tag  ({square_vectors, square_eta, square_eta_sq, square_tag}),
        .p        (square)
    );

    // eta c, beside 1 - c^2
    wire [ETA_W-1:0] bent;
    wire unused_bent_valid;
    wire unused_bent_tag;

    vec_mul #(
        .A_INT   (`RT_ETA_INT),
        .A_FRAC  (`RT_ETA_FRAC),
        .B_INT   (`RT_COSINE_INT),
        .B_FRAC  (`RT_COSINE_FRAC),
        .OUT_INT (`RT_ETA_INT),
        .OUT_FRAC(GAIN_FRAC),
        .LANES   (1),
        .SIGNED  (0)
    ) u_bent (
        .clk      (clk),
        .rst      (rst),
        .in_valid (in_valid),
        .in_tag   (1'b0),
        .a        (eta),
        .b        (incidence),
        .out_valid(unused_bent_valid),
        .out_tag  (unused_bent_tag),
        .p        (bent)
    );

    // 1 - c^2, both within 0 to 1
    localparam [SQUARE_FRAC:0] SQUARE_ONE = {1'b1, {SQUARE_FRAC{1'b0}}};
    wire unused_square = square[SQUARE_W-1];
    wire [SINE_SQ_W-1:0] sine_sq_next;
    reg [SINE_SQ_W-1:0] sine_sq_reg;

    resize #(
        .IN_INT    (2),
        .IN_FRAC   (SQUARE_FRAC),
        .OUT_INT   (`RT_SINE_SQ_INT),
        .OUT_FRAC  (`RT_SINE_SQ_FRAC),
        .OUT_SIGNED(0)
    ) u_sine_sq (
        .in ({1'b0, SQUARE_ONE - square[SQUARE_FRAC:0]}),
        .out(sine_sq_next)
    );

    always @(posedge clk) sine_sq_reg <= sine_sq_next;

    wire sine_valid;
    wire [TAG_W-1:0] sine_tag;
    wire [9*UNIT_W-1:0] sine_vectors;
    wire [ETA_W-1:0] sine_eta;
    wire [ETA_SQ_W-1:0] sine_eta_sq;

    valid_pipe #(
        .TAG_W  (9*UNIT_W + ETA_W + ETA_SQ_W + TAG_W),
        .LATENCY(1)
    ) u_sine (
        .clk      (clk),
        .rst      (rst),
        .in_valid (square_valid),
        .in_tag   ({square_vectors, square_eta, square_eta_sq, square_tag}),
        .out_valid(sine_valid),
        .out_tag  ({sine_vectors, sine_eta, sine_eta_sq, sine_tag})
    );

    // eta^2 (1 - c^2)
    wire bend_valid;
    wire [TAG_W-1:0] bend_tag;
    wire [9*UNIT_W-1:0] bend_vectors;
    wire [ETA_W-1:0] bend_eta;
    wire [ETA_W-1:0] bend_bent;
    wire [BEND_W-1:0] bend;

    mul #(
        .A_W   (ETA_SQ_W),
        .B_W   (SINE_SQ_W),
        .LANES (1),
        .SIGNED(0),
        .TAG_W (9*UNIT_W + 2*ETA_W + TAG_W)
    ) u_bend (
        .clk      (clk),
        .rst      (rst),
        .in_valid (sine_valid),
        .in_tag   ({sine_vectors, sine_eta, bent, sine_tag}),
        .a        (sine_eta_sq),
        .b        (sine_sq_reg),
        .out_valid(bend_valid),
        .out_tag  ({bend_vectors, bend_eta, bend_bent, bend_tag}),
        .p        (bend)
    );

    // 1 - eta^2 (1 - c^2)
    localparam DIFFERENCE_W = BEND_W - BEND_DROP + 1;
    localparam [DIFFERENCE_W-1:0] DIFFERENCE_ONE =
        {{DIFFERENCE_W - 1{1'b0}}, 1'b1} << (2 * GAIN_FRAC);
    wire [DIFFERENCE_W-1:0] difference = DIFFERENCE_ONE - {1'b0, bend[BEND_W-1:BEND_DROP]};
    wire unused_bend = &{1'b0, bend[BEND_DROP-1:0]};
    wire unused_difference = &{1'b0, difference[DIFFERENCE_W-2:RADICAND_W]};
    reg [RADICAND_W-1:0] radicand_reg;
    reg total_reg;

    always @(posedge clk) begin
        radicand_reg <= difference[RADICAND_W-1:0];
        total_reg    <= difference[DIFFERENCE_W-1];
    end

    wire radicand_valid;
    wire [TAG_W-1:0] radicand_tag;
    wire [9*UNIT_W-1:0] radicand_vectors;
    wire [ETA_W-1:0] radicand_eta;
    wire [ETA_W-1:0] radicand_bent;

    valid_pipe #(
        .TAG_W  (9*UNIT_W + 2*ETA_W + TAG_W),
        .LATENCY(1)
    ) u_radicand (
        .clk      (clk),
        .rst      (rst),
        .in_valid (bend_valid),
        .in_tag   ({bend_vectors, bend_eta, bend_bent, bend_tag}),
        .out_valid(radicand_valid),
        .out_tag  ({radicand_vectors, radicand_eta, radicand_bent, radicand_tag})
    );

    // Where there is no T, R takes the place of V with eta 1 and factor of N 0: 1 R + 0 N is R, and it
    // need not travel beside the root. The root of a negative radicand is not looked at.
    wire [3*UNIT_W-1:0] radicand_direction;
    wire [3*UNIT_W-1:0] radicand_normal;
    wire [3*UNIT_W-1:0] radicand_mirrored;
    assign {radicand_direction, radicand_normal, radicand_mirrored} = radicand_vectors;
    localparam [ETA_W-1:0] ETA_ONE = 1 << `RT_ETA_FRAC;
    wire [3*UNIT_W-1:0] onward = total_reg ? radicand_mirrored : radicand_direction;
    wire [ETA_W-1:0] onward_eta = total_reg ? ETA_ONE : radicand_eta;

    wire root_valid;
    wire [TAG_W-1:0] root_tag;
    wire root_total;
    wire [3*UNIT_W-1:0] root_onward;
    wire [3*UNIT_W-1:0] root_normal;
    wire [ETA_W-1:0] root_eta;
    wire [ETA_W-1:0] root_bent;
    wire [ROOT_W-1:0] root;
    wire [ROOT_W:0] unused_remainder;

    sqrt #(
        .D_W  (RADICAND_W),
        .TAG_W(1 + 6*UNIT_W + 2*ETA_W + TAG_W)
    ) u_root (
        .clk      (clk),
        .rst      (rst),
        .in_valid (radicand_valid),
        .in_tag   ({total_reg, onward, radicand_normal, onward_eta, radicand_bent, radicand_tag}),
        .radicand (radicand_reg),
        .out_valid(root_valid),
        .out_tag  ({root_total, root_onward, root_normal, root_eta, root_bent, root_tag}),
        .root     (root),
        .remainder(unused_remainder)
    );

    // Factor of N; it is in range: eta c is less than 4, the root at most 1
    wire [GAIN_W-1:0] gain_next = {1'b0, root_bent} - {{GAIN_W - ROOT_W{1'b0}}, root};
    reg [GAIN_W-1:0] gain_reg;

    always @(posedge clk) gain_reg <= root_total ? {GAIN_W{1'b0}} : gain_next;

    wire gain_valid;
    wire [TAG_W-1:0] gain_tag;
    wire gain_total;
    wire [3*UNIT_W-1:0] gain_onward;
    wire [3*UNIT_W-1:0] gain_normal;
    wire [ETA_W-1:0] gain_eta;

    valid_pipe #(
        .TAG_W  (1 + 6*UNIT_W + ETA_W + TAG_W),
        .LATENCY(1)
    ) u_gain (
        .clk      (clk),
        .rst      (rst),
        .in_valid (root_valid),
        .in_tag   ({root_total, root_onward, root_normal, root_eta, root_tag}),
        .out_valid(gain_valid),
        .out_tag  ({gain_total, gain_onward, gain_normal, gain_eta, gain_tag})
    );

    // Factor times N in the upper three lanes, eta V in the lower ones
    localparam PRODUCT_W = GAIN_W + UNIT_W;
    localparam SUM_W = PRODUCT_W + 1;
    wire product_valid;
    wire [TAG_W-1:0] product_tag;
    wire product_total;
    wire [6*PRODUCT_W-1:0] product;

    mul #(
        .A_W  (GAIN_W),
        .B_W  (UNIT_W),
        .LANES(6),
        .TAG_W(1 + TAG_W)
    ) u_product (
        .clk      (clk),
        .rst      (rst),
        .in_valid (gain_valid),
        .in_tag   ({gain_total, gain_tag}),
        .a        ({{3{gain_reg}}, {3{1'b0, gain_eta}}}),
        .b        ({gain_normal, gain_onward}),
        .out_valid(product_valid),
        .out_tag  ({product_total, product_tag}),
        .p        (product)
    );

    reg [3*SUM_W-1:0] sum_reg;
    wire [3*UNIT_W-1:0] transmitted_next;
    reg [3*UNIT_W-1:0] transmitted_reg;

    genvar lane;
    generate
        for (lane = 0; lane < 3; lane = lane + 1) begin : g_lane
            wire [PRODUCT_W-1:0] n = product[(3+lane)*PRODUCT_W+:PRODUCT_W];
            wire [PRODUCT_W-1:0] v = product[lane*PRODUCT_W+:PRODUCT_W];

            always @(posedge clk)
                sum_reg[lane*SUM_W+:SUM_W] <= {n[PRODUCT_W-1], n} + {v[PRODUCT_W-1], v};

            resize #(
                .IN_INT  (`RT_GAIN_INT + `RT_UNIT_INT + 1),
                .IN_FRAC (GAIN_FRAC + `RT_UNIT_FRAC),
                .OUT_INT (`RT_UNIT_INT),
                .OUT_FRAC(`RT_UNIT_FRAC)
            ) u_resize (
                .in (sum_reg[lane*SUM_W+:SUM_W]),
                .out(transmitted_next[lane*UNIT_W+:UNIT_W])
            );
        end
    endgenerate

    always @(posedge clk) transmitted_reg <= transmitted_next;

    valid_pipe #(
        .TAG_W  (1 + TAG_W),
        .LATENCY(2)
    ) u_result (
        .clk      (clk),
        .rst      (rst),
        .in_valid (product_valid),
        .in_tag   ({product_total, product_tag}),
        .out_valid(out_valid),
        .out_tag  ({total, out_tag})
    );

    assign transmitted = transmitted_reg;

endmodule

`default_nettype wire
