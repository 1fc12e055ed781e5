// SPDX-License-Identifier: Apache-2.0
//
// sphere_intersect: where a ray enters or leaves a sphere (book 8.2.2), one test a clock.
//
// With c the center seen from the ray's origin, I the unit direction and b = I.c, the book's
// discriminant (I.c)^2 - c.c + r^2 is taken as
//
//     q = c - b I             from the ray's nearest point to the center, short where it hits
//     discriminant = r^2 - q.q
//     t = b -+ sqrt(discriminant)      the smaller one that is >= RT_T_MIN
//
// which is the same number without the cancellation of two large squares.
//
// Ports
//   origin      {x, y, z}, RT_POINT
//   direction   {x, y, z}, RT_UNIT
//   center      {x, y, z}, RT_COORD
//   radius_sq   RT_RADIUS_SQ
//   limit       RT_POINT; a hit at or beyond it is a miss
//   hit         the sphere is hit at RT_T_MIN <= t < limit; the rest is meaningful if so
//   leaving      the ray starts inside: the far end of the chord is hit
//   distance    t, RT_POINT
//   offset      q, {x, y, z}, RT_OFFSET
//   half_chord  sqrt(discriminant), RT_HALF_CHORD
//
// Latency: 1 (center) + 5 (b) + 4 (b I) + 1 (q) + 5 (q.q, discriminant) + square root + 2; rate
// one test a clock.

`default_nettype none
`include "raytracer.vh"

module sphere_intersect #(
    parameter TAG_W = 1
) (
    input  wire                        clk,
    input  wire                        rst,
    input  wire                        in_valid,
    input  wire [           TAG_W-1:0] in_tag,
    input  wire [  3*`RT_POINT_W-1:0] origin,
    input  wire [   3*`RT_UNIT_W-1:0] direction,
    input  wire [  3*`RT_COORD_W-1:0] center,
    input  wire [`RT_RADIUS_SQ_W-1:0] radius_sq,
    input  wire [    `RT_POINT_W-1:0] limit,
    output wire                        out_valid,
    output wire [           TAG_W-1:0] out_tag,
    output wire                        hit,
    output wire                        leaving,
    output wire [    `RT_POINT_W-1:0] distance,
    output wire [ 3*`RT_OFFSET_W-1:0] offset,
    output wire [`RT_HALF_CHORD_W-1:0] half_chord
);

    localparam POINT_W = `RT_POINT_W;
    localparam UNIT_W = `RT_UNIT_W;
    localparam OFFSET_W = `RT_OFFSET_W;
    localparam FRAC = `RT_POINT_FRAC;
    localparam ROOT_W = `RT_HALF_CHORD_W;
    // Side data that waits for the discriminant.
    localparam SIDE_W = TAG_W + POINT_W + `RT_RADIUS_SQ_W;

    genvar lane;

    // c = center - origin
    wire [3*POINT_W-1:0] relative_next;
    reg [3*POINT_W-1:0] relative_reg;
    reg [3*UNIT_W-1:0] direction_reg;

    generate
        for (lane = 0; lane < 3; lane = lane + 1) begin : g_relative
            wire [POINT_W:0] center_point = {
                {POINT_W + 1 - `RT_COORD_W - FRAC + `RT_COORD_FRAC{center[(lane+1)*`RT_COORD_W-1]}},
                center[lane*`RT_COORD_W+:`RT_COORD_W],
                {FRAC - `RT_COORD_FRAC{1'b0}}
            };
            wire [POINT_W:0] origin_point = {
                origin[(lane+1)*POINT_W-1], origin[lane*POINT_W+:POINT_W]
            };

            resize #(
                .IN_INT  (`RT_POINT_INT + 1),
                .IN_FRAC (FRAC),
                .OUT_INT (`RT_POINT_INT),
                .OUT_FRAC(FRAC)
            ) u_resize (
                .in (center_point - origin_point),
                .out(relative_next[lane*POINT_W+:POINT_W])
            );
        end
    endgenerate

    always @(posedge clk) begin
        relative_reg  <= relative_next;
        direction_reg <= direction;
    end

    wire relative_valid;
    wire [SIDE_W-1:0] relative_side;

    valid_pipe #(
        .TAG_W  (SIDE_W),
        .LATENCY(1)
    ) u_relative (
        .clk      (clk),
        .rst      (rst),
        .in_valid (in_valid),
        .in_tag   ({limit, radius_sq, in_tag}),
        .out_valid(relative_valid),
        .out_tag  (relative_side)
    );

    // b = I.c
    wire along_valid;
    wire [SIDE_W-1:0] along_side;
    wire [3*POINT_W-1:0] along_relative;
    wire [3*UNIT_W-1:0] along_direction;
    wire [POINT_W-1:0] along;

    dot #(
        .A_INT   (`RT_UNIT_INT),
        .A_FRAC  (`RT_UNIT_FRAC),
        .B_INT   (`RT_POINT_INT),
        .B_FRAC  (FRAC),
        .OUT_INT (`RT_POINT_INT),
        .OUT_FRAC(FRAC),
        .TAG_W   (3*POINT_W + 3*UNIT_W + SIDE_W)
    ) u_along (
        .clk      (clk),
        .rst      (rst),
        .in_valid (relative_valid),
        .in_tag   ({relative_reg, direction_reg, relative_side}),
        .a        (direction_reg),
        .b        (relative_reg),
        .out_valid(along_valid),
        .out_tag  ({along_relative, along_direction, along_side}),
        .p        (along)
    );

    // b I
    wire foot_valid;
    wire [SIDE_W-1:0] foot_side;
    wire [POINT_W-1:0] foot_along;
    wire [3*POINT_W-1:0] foot_relative;
    wire [3*POINT_W-1:0] foot;

    vec_scale #(
        .A_INT   (`RT_UNIT_INT),
        .A_FRAC  (`RT_UNIT_FRAC),
        .B_INT   (`RT_POINT_INT),
        .B_FRAC  (FRAC),
        .OUT_INT (`RT_POINT_INT),
        .OUT_FRAC(FRAC),
        .TAG_W   (3*POINT_W + POINT_W + SIDE_W)
    ) u_foot (
        .clk      (clk),
        .rst      (rst),
        .in_valid (along_valid),
        .in_tag   ({along_relative, along, along_side}),
        .a        (along_direction),
        .s        (along),
        .out_valid(foot_valid),
        .out_tag  ({foot_relative, foot_along, foot_side}),
        .p        (foot)
    );

    // q = c - b I, saturated: a component that does not fit is longer than any radius
    wire [3*OFFSET_W-1:0] offset_next;
    reg [3*OFFSET_W-1:0] offset_reg;

    generate
        for (lane = 0; lane < 3; lane = lane + 1) begin : g_offset
            wire [POINT_W:0] relative_point = {
                foot_relative[(lane+1)*POINT_W-1], foot_relative[lane*POINT_W+:POINT_W]
            };
            wire [POINT_W:0] foot_point = {
                foot[(lane+1)*POINT_W-1], foot[lane*POINT_W+:POINT_W]
            };

            resize #(
                .IN_INT  (`RT_POINT_INT + 1),
                .IN_FRAC (FRAC),
                .OUT_INT (`RT_OFFSET_INT),
                .OUT_FRAC(FRAC)
            ) u_resize (
                .in (relative_point - foot_point),
                .out(offset_next[lane*OFFSET_W+:OFFSET_W])
            );
        end
    endgenerate

    always @(posedge clk) offset_reg <= offset_next;

    wire offset_valid;
    wire [SIDE_W+POINT_W-1:0] offset_side;

    valid_pipe #(
        .TAG_W  (SIDE_W + POINT_W),
        .LATENCY(1)
    ) u_offset (
        .clk      (clk),
        .rst      (rst),
        .in_valid (foot_valid),
        .in_tag   ({foot_along, foot_side}),
        .out_valid(offset_valid),
        .out_tag  (offset_side)
    );

    // q.q, exact
    localparam SQUARE_W = 2 * OFFSET_W;
    wire square_valid;
    wire [SIDE_W+POINT_W+3*OFFSET_W-1:0] square_side;
    wire [3*SQUARE_W-1:0] square;

    mul #(
        .A_W  (OFFSET_W),
        .B_W  (OFFSET_W),
        .LANES(3),
        .TAG_W(SIDE_W + POINT_W + 3*OFFSET_W)
    ) u_square (
        .clk      (clk),
        .rst      (rst),
        .in_valid (offset_valid),
        .in_tag   ({offset_reg, offset_side}),
        .a        (offset_reg),
        .b        (offset_reg),
        .out_valid(square_valid),
        .out_tag  (square_side),
        .p        (square)
    );

    // discriminant = r^2 - q.q
    localparam SUM_W = SQUARE_W + 2;
    localparam RADICAND_W = 2 * ROOT_W;
    reg [SUM_W-1:0] sum_reg;
    reg [SUM_W-1:0] discriminant_reg;
    wire discriminant_valid;
    wire [3*OFFSET_W-1:0] discriminant_offset;
    wire [POINT_W-1:0] discriminant_along;
    wire [POINT_W-1:0] discriminant_limit;
    wire [`RT_RADIUS_SQ_W-1:0] discriminant_radius_sq;
    wire [TAG_W-1:0] discriminant_tag;
    wire sum_valid;
    wire [SIDE_W+POINT_W+3*OFFSET_W-1:0] sum_side;
    wire [`RT_RADIUS_SQ_W-1:0] sum_radius_sq = sum_side[TAG_W+:`RT_RADIUS_SQ_W];

    always @(posedge clk) begin
        // A square is not negative: two zero bits on top.
        sum_reg <= {2'b0, square[2*SQUARE_W+:SQUARE_W]} + {2'b0, square[SQUARE_W+:SQUARE_W]}
                 + {2'b0, square[0+:SQUARE_W]};
        discriminant_reg <= {
            {SUM_W - `RT_RADIUS_SQ_W - 2 * FRAC + `RT_RADIUS_SQ_FRAC{1'b0}},
            sum_radius_sq,
            {2 * FRAC - `RT_RADIUS_SQ_FRAC{1'b0}}
        } - sum_reg;
    end

    valid_pipe #(
        .TAG_W  (SIDE_W + POINT_W + 3*OFFSET_W),
        .LATENCY(1)
    ) u_sum (
        .clk      (clk),
        .rst      (rst),
        .in_valid (square_valid),
        .in_tag   (square_side),
        .out_valid(sum_valid),
        .out_tag  (sum_side)
    );

    valid_pipe #(
        .TAG_W  (SIDE_W + POINT_W + 3*OFFSET_W),
        .LATENCY(1)
    ) u_discriminant (
        .clk      (clk),
        .rst      (rst),
        .in_valid (sum_valid),
        .in_tag   (sum_side),
        .out_valid(discriminant_valid),
        .out_tag  ({discriminant_offset, discriminant_along, discriminant_limit,
                    discriminant_radius_sq, discriminant_tag})
    );

    wire discriminant_negative = discriminant_reg[SUM_W-1];
    wire unused_discriminant =
        &{1'b0, discriminant_radius_sq, discriminant_reg[SUM_W-2:RADICAND_W]};

    // sqrt(discriminant)
    wire root_valid;
    wire root_negative;
    wire [3*OFFSET_W-1:0] root_offset;
    wire [POINT_W-1:0] root_along;
    wire [POINT_W-1:0] root_limit;
    wire [TAG_W-1:0] root_tag;
    wire [ROOT_W-1:0] root;
    wire [ROOT_W:0] unused_remainder;

    sqrt #(
        .D_W  (RADICAND_W),
        .TAG_W(1 + 3*OFFSET_W + 2*POINT_W + TAG_W)
    ) u_root (
        .clk      (clk),
        .rst      (rst),
        .in_valid (discriminant_valid),
        .in_tag   ({discriminant_negative, discriminant_offset, discriminant_along,
                    discriminant_limit, discriminant_tag}),
        .radicand (discriminant_reg[RADICAND_W-1:0]),
        .out_valid(root_valid),
        .out_tag  ({root_negative, root_offset, root_along, root_limit, root_tag}),
        .root     (root),
        .remainder(unused_remainder)
    );

    // t = b -+ root, one bit wider than RT_POINT
    localparam [POINT_W:0] T_MIN = `RT_T_MIN;
    reg signed [POINT_W:0] near_reg;
    reg signed [POINT_W:0] far_reg;
    reg negative_reg;
    reg signed [POINT_W:0] limit_reg;
    reg [ROOT_W-1:0] half_chord_reg;
    reg [3*OFFSET_W-1:0] end_offset_reg;
    wire [POINT_W:0] along_wide = {root_along[POINT_W-1], root_along};
    wire [POINT_W:0] root_wide = {{POINT_W + 1 - ROOT_W{1'b0}}, root};

    always @(posedge clk) begin
        near_reg       <= along_wide - root_wide;
        far_reg        <= along_wide + root_wide;
        negative_reg   <= root_negative;
        limit_reg      <= {root_limit[POINT_W-1], root_limit};
        half_chord_reg <= root;
        end_offset_reg <= root_offset;
    end

    wire leaving_next = near_reg < $signed(T_MIN);
    wire signed [POINT_W:0] distance_next = leaving_next ? far_reg : near_reg;
    wire [POINT_W-1:0] distance_point;
    reg hit_reg;
    reg leaving_reg;
    reg [POINT_W-1:0] distance_reg;
    reg [3*OFFSET_W-1:0] hit_offset_reg;
    reg [ROOT_W-1:0] hit_half_chord_reg;

    resize #(
        .IN_INT  (`RT_POINT_INT + 1),
        .IN_FRAC (FRAC),
        .OUT_INT (`RT_POINT_INT),
        .OUT_FRAC(FRAC)
    ) u_distance (
        .in (distance_next),
        .out(distance_point)
    );

    always @(posedge clk) begin
        hit_reg <= !negative_reg && distance_next >= $signed(T_MIN) && distance_next < limit_reg;
        leaving_reg         <= leaving_next;
        distance_reg       <= distance_point;
        hit_offset_reg     <= end_offset_reg;
        hit_half_chord_reg <= half_chord_reg;
    end

    valid_pipe #(
        .TAG_W  (TAG_W),
        .LATENCY(2)
    ) u_hit (
        .clk      (clk),
        .rst      (rst),
        .in_valid (root_valid),
        .in_tag   (root_tag),
        .out_valid(out_valid),
        .out_tag  (out_tag)
    );

    assign hit        = hit_reg;
    assign leaving     = leaving_reg;
    assign distance   = distance_reg;
    assign offset     = hit_offset_reg;
    assign half_chord = hit_half_chord_reg;

endmodule

`default_nettype wire
