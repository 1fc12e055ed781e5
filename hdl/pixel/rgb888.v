// SPDX-License-Identifier: Apache-2.0
//
// rgb888: a colour as three bytes (book 8.2.6): times 255, truncated, clamped to 255.
//
// Ports     colour: {r, g, b}, RT_SHADE; pixel: {r, g, b}, RT_CHANNEL
//
// Latency 1, rate one colour a clock.

`default_nettype none
`include "raytracer.vh"

module rgb888 #(
    parameter TAG_W = 1
) (
    input  wire                        clk,
    input  wire                        rst,
    input  wire                        in_valid,
    input  wire [           TAG_W-1:0] in_tag,
    input  wire [  3*`RT_SHADE_W-1:0] colour,
    output wire                        out_valid,
    output wire [           TAG_W-1:0] out_tag,
    output wire [3*`RT_CHANNEL_W-1:0] pixel
);

    localparam W = `RT_SHADE_W;
    localparam CHANNEL_W = `RT_CHANNEL_W;

    reg [3*CHANNEL_W-1:0] pixel_reg;

    genvar lane;
    generate
        for (lane = 0; lane < 3; lane = lane + 1) begin : g_lane
            wire [W-1:0] c = colour[lane*W+:W];
            wire [W+CHANNEL_W-1:0] scaled = {c, {CHANNEL_W{1'b0}}} - {{CHANNEL_W{1'b0}}, c};
            wire [`RT_SHADE_INT+CHANNEL_W-1:0] whole = scaled[W+CHANNEL_W-1:`RT_SHADE_FRAC];
            wire unused_fraction = &{1'b0, scaled[`RT_SHADE_FRAC-1:0]};
            wire over = whole[`RT_SHADE_INT+CHANNEL_W-1:CHANNEL_W] != {`RT_SHADE_INT{1'b0}};

            always @(posedge clk)
                pixel_reg[lane*CHANNEL_W+:CHANNEL_W] <=
                    whole[CHANNEL_W-1:0] | {CHANNEL_W{over}};
        end
    endgenerate

    valid_pipe #(
        .TAG_W  (TAG_W),
        .LATENCY(1)
    ) u_valid (
        .clk      (clk),
        .rst      (rst),
        .in_valid (in_valid),
        .in_tag   (in_tag),
        .out_valid(out_valid),
        .out_tag  (out_tag)
    );

    assign pixel = pixel_reg;

endmodule

`default_nettype wire
