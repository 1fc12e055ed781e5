// SPDX-License-Identifier: Apache-2.0
//
// resize: a signed number of one fixed-point format in another format.
//
// The rule of the book's multiplier (10.1.3): fraction bits that do not fit are dropped (floor,
// toward minus infinity), integer bits that do not fit are checked, and a value out of range
// becomes the largest or the smallest value of the format. Missing fraction bits are zeros.
//
// Parameters
//   IN_INT, IN_FRAC    signed input, the sign counts as an integer bit; IN_INT >= 1
//   OUT_INT, OUT_FRAC  output
//   OUT_SIGNED         1: output is signed; 0: unsigned, negative inputs become 0
//
// Combinational.

`default_nettype none

module resize #(
    parameter IN_INT     = 18,
    parameter IN_FRAC    = 20,
    parameter OUT_INT    = 9,
    parameter OUT_FRAC   = 10,
    parameter OUT_SIGNED = 1
) (
    input  wire [  IN_INT+IN_FRAC-1:0] in,
    output wire [OUT_INT+OUT_FRAC-1:0] out
);

    localparam OUT_W = OUT_INT + OUT_FRAC;
    // Input bits that are left when the fraction is that of the output.
    localparam MID_W = IN_INT + OUT_FRAC;
    // Bits of the output below its sign, if it has one.
    localparam MAGNITUDE_W = OUT_SIGNED != 0 ? OUT_W - 1 : OUT_W;

    wire negative = in[IN_INT+IN_FRAC-1];
    wire [MID_W-1:0] mid;

    generate
        if (IN_INT < 1 || MAGNITUDE_W < 1) begin : g_bad_format
            resize_needs_IN_INT_of_1_or_more_and_an_output_bit_beside_the_sign error ();
        end

        if (IN_FRAC > OUT_FRAC) begin : g_drop
            wire unused_fraction = &{1'b0, in[IN_FRAC-OUT_FRAC-1:0]};
            assign mid = in[IN_INT+IN_FRAC-1:IN_FRAC-OUT_FRAC];
        end else if (IN_FRAC < OUT_FRAC) begin : g_append
            assign mid = {in, {OUT_FRAC - IN_FRAC{1'b0}}};
        end else begin : g_same
            assign mid = in;
        end

        if (MID_W - 1 > MAGNITUDE_W) begin : g_narrow
            // Significant where a bit above the output's magnitude differs from the sign.
            wire overflow = mid[MID_W-1:MAGNITUDE_W] != {MID_W - MAGNITUDE_W{negative}};
            if (OUT_SIGNED != 0) begin : g_signed
                assign out = overflow ? {negative, {OUT_W - 1{!negative}}}
                                      : {negative, mid[OUT_W-2:0]};
            end else begin : g_unsigned
                assign out = negative ? {OUT_W{1'b0}} : mid[OUT_W-1:0] | {OUT_W{overflow}};
            end
        end else if (OUT_SIGNED != 0) begin : g_signed
            if (MID_W == OUT_W) begin : g_same
                wire unused_negative = negative;
                assign out = mid;
            end else begin : g_extend
                assign out = {{OUT_W - MID_W{negative}}, mid};
            end
        end else begin : g_unsigned
            wire [OUT_W:0] extended = {{OUT_W + 1 - MID_W{negative}}, mid};
            wire unused_sign = extended[OUT_W];
            assign out = extended[OUT_W-1:0] & {OUT_W{!negative}};
        end
    endgenerate

endmodule

`default_nettype wire
