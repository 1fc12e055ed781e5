// SPDX-License-Identifier: Apache-2.0
//
// unit_vector: direction and length of a vector of any length (book 10.1.5.3, 11.1).
//
// Block floating point in front of the normaliser: the vector is shifted left until its longest
// component fills RT_UNIT_W bits, so that short and long vectors give equally precise directions.
//
// Parameters
//   IN_W   bits of a component, signed; its binary point does not matter
//   TAG_W  bits of the caller's sideband data
//
// Ports
//   vector      {x, y, z}
//   unit        {x, y, z}, RT_UNIT; each component truncated toward zero
//   norm        length of the shifted vector, unsigned [2 . RT_UNIT_FRAC + 1]
//   shift       places the vector was shifted; with E the weight of the vector's top bit,
//               length = norm * 2**(E - shift)
//   degenerate  the vector was zero; unit is zero
//
// Latency 2 for block_shift + that of normalise; rate one vector a clock.

`default_nettype none
`include "raytracer.vh"

module unit_vector #(
    parameter IN_W    = 40,
    parameter SHIFT_W = $clog2(IN_W),
    parameter TAG_W   = 1
) (
    input  wire                   clk,
    input  wire                   rst,
    input  wire                   in_valid,
    input  wire [      TAG_W-1:0] in_tag,
    input  wire [     3*IN_W-1:0] vector,
    output wire                   out_valid,
    output wire [      TAG_W-1:0] out_tag,
    output wire [3*`RT_UNIT_W-1:0] unit,
    output wire [  `RT_UNIT_W:0] norm,
    output wire [    SHIFT_W-1:0] shift,
    output wire                   degenerate
);

    wire shifted_valid;
    wire [TAG_W-1:0] shifted_tag;
    wire [3*`RT_UNIT_W-1:0] shifted;
    wire [SHIFT_W-1:0] shifted_by;

    block_shift #(
        .IN_W (IN_W),
        .OUT_W(`RT_UNIT_W),
        .LANES(3),
        .TAG_W(TAG_W)
    ) u_block_shift (
        .clk      (clk),
        .rst      (rst),
        .in_valid (in_valid),
        .in_tag   (in_tag),
        .a        (vector),
        .out_valid(shifted_valid),
        .out_tag  (shifted_tag),
        .p        (shifted),
        .shift    (shifted_by)
    );

    normalise #(
        .INT     (1),
        .FRAC    (`RT_UNIT_W - 1),
        .OUT_FRAC(`RT_UNIT_FRAC),
        .GUARD   (0),
        .TAG_W   (SHIFT_W + TAG_W)
    ) u_normalise (
        .clk       (clk),
        .rst       (rst),
        .in_valid  (shifted_valid),
        .in_tag    ({shifted_by, shifted_tag}),
        .a         (shifted),
        .out_valid (out_valid),
        .out_tag   ({shift, out_tag}),
        .unit      (unit),
        .norm      (norm),
        .degenerate(degenerate)
    );

endmodule

`default_nettype wire
