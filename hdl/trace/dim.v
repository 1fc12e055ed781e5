// SPDX-License-Identifier: Apache-2.0
//
// dim: light behind a transparent object (book 8.2.3): colour * k_transparency, lane by lane,
// floored and saturated.
//
// Ports     colour, dimmed: {r, g, b}, RT_SHADE; share: {r, g, b}, RT_COEFF
//
// Combinational: a shadow ray may meet an object in every clock, and each changes what the one
// before it has left.

`default_nettype none
`include "raytracer.vh"

module dim (
    input  wire [3*`RT_SHADE_W-1:0] colour,
    input  wire [3*`RT_COEFF_W-1:0] share,
    output wire [3*`RT_SHADE_W-1:0] dimmed
);

    localparam W = `RT_SHADE_W;
    localparam SHARE_W = `RT_COEFF_W;
    localparam PRODUCT_W = W + SHARE_W;

    genvar lane;
    generate
        for (lane = 0; lane < 3; lane = lane + 1) begin : g_lane
            wire [PRODUCT_W-1:0] product = colour[lane*W+:W] * share[lane*SHARE_W+:SHARE_W];

            // A zero on top: resize takes signed numbers.
            resize #(
                .IN_INT    (`RT_SHADE_INT + `RT_COEFF_INT + 1),
                .IN_FRAC   (`RT_SHADE_FRAC + `RT_COEFF_FRAC),
                .OUT_INT   (`RT_SHADE_INT),
                .OUT_FRAC  (`RT_SHADE_FRAC),
                .OUT_SIGNED(0)
            ) u_resize (
                .in ({1'b0, product}),
                .out(dimmed[lane*W+:W])
            );
        end
    endgenerate

endmodule

`default_nettype wire
