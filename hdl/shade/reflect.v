// SPDX-License-Identifier: Apache-2.0
//
// reflect: R = V - 2 (N.V) N, the mirror of a direction at a surface (book 8.2.4).
//
// Ports
//   direction  V, {x, y, z}, RT_UNIT
//   normal     N, {x, y, z}, RT_UNIT
//   mirrored   R, {x, y, z}, RT_UNIT, each component floored and saturated
//   cosine     N.V, RT_UNIT, floored and saturated, beside its R: what refraction goes on from
//
// Latency 5 (N.V) + 4 (times N) + 1 (difference) = 10, rate one direction a clock.

`default_nettype none
`include "raytracer.vh"

module reflect #(
    parameter TAG_W = 1
) (
    input  wire                     clk,
    input  wire                     rst,
    input  wire                     in_valid,
    input  wire [        TAG_W-1:0] in_tag,
    input  wire [3*`RT_UNIT_W-1:0] direction,
    input  wire [3*`RT_UNIT_W-1:0] normal,
    output wire                     out_valid,
    output wire [        TAG_W-1:0] out_tag,
    output wire [3*`RT_UNIT_W-1:0] mirrored,
    output wire [  `RT_UNIT_W-1:0] cosine
);

    localparam W = `RT_UNIT_W;

    wire cosine_valid;
    wire [TAG_W-1:0] cosine_tag;
    wire [3*W-1:0] cosine_direction;
    wire [3*W-1:0] cosine_normal;
    wire [W-1:0] cosine_value;

    dot #(
        .A_INT   (`RT_UNIT_INT),
        .A_FRAC  (`RT_UNIT_FRAC),
        .B_INT   (`RT_UNIT_INT),
        .B_FRAC  (`RT_UNIT_FRAC),
        .OUT_INT (`RT_UNIT_INT),
        .OUT_FRAC(`RT_UNIT_FRAC),
        .TAG_W   (6*W + TAG_W)
    ) u_cosine (
        .clk      (clk),
        .rst      (rst),
        .in_valid (in_valid),
        .in_tag   ({direction, normal, in_tag}),
        .a        (normal),
        .b        (direction),
        .out_valid(cosine_valid),
        .out_tag  ({cosine_direction, cosine_normal, cosine_tag}),
        .p        (cosine_value)
    );

    wire along_valid;
    wire [TAG_W-1:0] along_tag;
    wire [3*W-1:0] along_direction;
    wire [W-1:0] along_cosine;
    wire [3*W-1:0] along;

    vec_scale #(
        .A_INT   (`RT_UNIT_INT),
        .A_FRAC  (`RT_UNIT_FRAC),
        .B_INT   (`RT_UNIT_INT),
        .B_FRAC  (`RT_UNIT_FRAC),
        .OUT_INT (`RT_UNIT_INT),
        .OUT_FRAC(`RT_UNIT_FRAC),
        .TAG_W   (4*W + TAG_W)
    ) u_along (
        .clk      (clk),
        .rst      (rst),
        .in_valid (cosine_valid),
        .in_tag   ({cosine_direction, cosine_value, cosine_tag}),
        .a        (cosine_normal),
        .s        (cosine_value),
        .out_valid(along_valid),
        .out_tag  ({along_direction, along_cosine, along_tag}),
        .p        (along)
    );

    wire [3*W-1:0] mirrored_next;
    reg [3*W-1:0] mirrored_reg;

    genvar lane;
    generate
        for (lane = 0; lane < 3; lane = lane + 1) begin : g_lane
            wire [W-1:0] v = along_direction[lane*W+:W];
            wire [W-1:0] n = along[lane*W+:W];

            resize #(
                .IN_INT  (`RT_UNIT_INT + 2),
                .IN_FRAC (`RT_UNIT_FRAC),
                .OUT_INT (`RT_UNIT_INT),
                .OUT_FRAC(`RT_UNIT_FRAC)
            ) u_resize (
                .in ({{2{v[W-1]}}, v} - {n[W-1], n, 1'b0}),
                .out(mirrored_next[lane*W+:W])
            );
        end
    endgenerate

    always @(posedge clk) mirrored_reg <= mirrored_next;

    valid_pipe #(
        .TAG_W  (W + TAG_W),
        .LATENCY(1)
    ) u_valid (
        .clk      (clk),
        .rst      (rst),
        .in_valid (along_valid),
        .in_tag   ({along_cosine, along_tag}),
        .out_valid(out_valid),
        .out_tag  ({cosine, out_tag})
    );

    assign mirrored = mirrored_reg;

endmodule

`default_nettype wire
