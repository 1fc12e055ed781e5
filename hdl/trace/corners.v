// SPDX-License-Identifier: Apache-2.0
//
// corners: an object's places seen from a ray's origin, exact, then as the intersection needs them.
//
// Ports
//   origin    {x, y, z}, RT_POINT
//   vertices  {p0, p1, p2}, {x, y, z} each, RT_COORD
//   seen      the same places seen from the origin, each as a mantissa with an exponent of its own:
//             shifted left as far as its longest component allows, then cut to RT_UNIT_W bits (floor)
//   shift     of p0: its mantissa is (p0 - origin) * 2^shift, cut
//   center    p0 seen from the origin, RT_POINT, saturated
//
// Latency 1 (difference) + 2 (block_shift), rate one object a clock.

`default_nettype none
`include "raytracer.vh"

module corners #(
    parameter SHIFT_W = $clog2(`RT_REACH_W)
) (
    input  wire                      clk,
    input  wire                      rst,
    input  wire [3*`RT_POINT_W-1:0] origin,
    input  wire [9*`RT_COORD_W-1:0] vertices,
    output wire [ 9*`RT_UNIT_W-1:0] seen,
    output wire [       SHIFT_W-1:0] shift,
    output wire [3*`RT_POINT_W-1:0] center
);

    localparam POINT_W = `RT_POINT_W;
    localparam FRAC = `RT_POINT_FRAC;
    localparam UNIT_W = `RT_UNIT_W;
    localparam REACH_W = `RT_REACH_W;

    reg [9*REACH_W-1:0] reach_reg;
    wire [3*SHIFT_W-1:0] shifts;
    wire [3*POINT_W-1:0] center_next;
    reg [3*POINT_W-1:0] center_reg;
    reg [3*POINT_W-1:0] center_late_reg;

    genvar lane, corner;
    generate
        if (REACH_W != POINT_W + 1) begin : g_bad_reach
            corners_needs_an_RT_REACH_one_bit_wider_than_RT_POINT error ();
        end

        for (corner = 0; corner < 3; corner = corner + 1) begin : g_corner
            wire unused_valid;
            wire unused_tag;

            for (lane = 0; lane < 3; lane = lane + 1) begin : g_lane
                wire [`RT_COORD_W-1:0] place = vertices[(3*corner+lane)*`RT_COORD_W+:`RT_COORD_W];
                wire [POINT_W-1:0] start = origin[lane*POINT_W+:POINT_W];
                wire [REACH_W-1:0] place_wide = {
                    {REACH_W - `RT_COORD_W - FRAC + `RT_COORD_FRAC{place[`RT_COORD_W-1]}},
                    place,
                    {FRAC - `RT_COORD_FRAC{1'b0}}
                };

                always @(posedge clk)
                    reach_reg[(3*corner+lane)*REACH_W+:REACH_W] <=
                        place_wide - {start[POINT_W-1], start};
            end

            block_shift #(
                .IN_W (REACH_W),
                .OUT_W(UNIT_W),
                .LANES(3)
            ) u_block_shift (
                .clk      (clk),
                .rst      (rst),
                .in_valid (1'b0),
                .in_tag   (1'b0),
                .a        (reach_reg[3*corner*REACH_W+:3*REACH_W]),
                .out_valid(unused_valid),
                .out_tag  (unused_tag),
                .p        (seen[3*corner*UNIT_W+:3*UNIT_W]),
                .shift    (shifts[corner*SHIFT_W+:SHIFT_W])
            );
        end

        for (lane = 0; lane < 3; lane = lane + 1) begin : g_center
            resize #(
                .IN_INT  (`RT_REACH_INT),
                .IN_FRAC (FRAC),
                .OUT_INT (`RT_POINT_INT),
                .OUT_FRAC(FRAC)
            ) u_resize (
                .in (reach_reg[(6+lane)*REACH_W+:REACH_W]),
                .out(center_next[lane*POINT_W+:POINT_W])
            );
        end
    endgenerate

    always @(posedge clk) begin
        center_reg      <= center_next;
        center_late_reg <= center_reg;
    end

    wire unused_shifts = &{1'b0, shifts[2*SHIFT_W-1:0]};
    assign shift  = shifts[2*SHIFT_W+:SHIFT_W];
    assign center = center_late_reg;

endmodule

`default_nettype wire
