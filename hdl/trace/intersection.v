// SPDX-License-Identifier: Apache-2.0
//
// intersection: where a ray meets an object, sphere or triangle, one test a clock (book 8.2.2).
//
// Both kinds share three banks of 18 x 18 bit multipliers: 6, 12 and 6. With o the ray's origin and
// I its unit direction:
//
// Sphere, c its center seen from o:
//     b = I.c     q = c - b I     discriminant = r^2 - q.q     t = b -+ sqrt(discriminant)
// the smaller t that is >= RT_T_MIN. The discriminant is the book's (I.c)^2 - c.c + r^2 without the
// cancellation of two large squares. A number wider than 18 bits is two operands, a piece of 17
// bits and the rest.
//
// Triangle, A, B, C its corners seen from o, each as a mantissa of RT_UNIT_W bits with an exponent of
// its own, N its unit normal:
//     t = N.A / N.I, both sides are hit
// A corner is moved along the ray onto the plane across the longest component z of I: x' = I_z x - I_x z,
// y' likewise, rounded. The ray passes inside where no two of the areas A' x B', B' x C', C' x A' have
// opposite signs and not all are 0; each is exact for the rounded corners, and the exponents do not
// change its sign.
// A corner's place depends on the ray and the corner alone: triangles that share edges or corners
// leave no gap (after Woop, Benthin, Wald: Watertight Ray/Triangle Intersection, 2013).
//
// (`intersect` alone is a keyword of SystemVerilog.)
//
// Ports
//   origin      {x, y, z}, RT_POINT
//   direction   {x, y, z}, RT_UNIT
//   limit       RT_POINT; a hit at or beyond it is a miss
//   triangle    kind of the object
//   shape       sphere: radius squared (RT_RADIUS_SQ); triangle: normal {x, y, z}, RT_UNIT
//   vertices    {p0, p1, p2}, {x, y, z} each, RT_COORD; a sphere has its center in p0's place
//   hit         the object is hit at RT_T_MIN <= t < limit
//   leaving     sphere: the far end of the chord is the one that counts; triangle: N.I > 0, its back
//   distance    t, RT_POINT
//   offset      q of a sphere, {x, y, z}, RT_OFFSET; 0 for a triangle
//   half_chord  sqrt(discriminant) of a sphere, RT_HALF_CHORD; 0 for a triangle
//
// Latency 3 (corners) + 5 (bank 1) + 5 (bank 2) + 5 (bank 3, discriminant) + square root
// (RT_HALF_CHORD_W + 1) + 2; rate one test a clock.

`default_nettype none
`include "raytracer.vh"

module intersection #(
    parameter TAG_W = 1
) (
    input  wire                          clk,
    input  wire                          rst,
    input  wire                          in_valid,
    input  wire [             TAG_W-1:0] in_tag,
    input  wire [     3*`RT_POINT_W-1:0] origin,
    input  wire [      3*`RT_UNIT_W-1:0] direction,
    input  wire [       `RT_POINT_W-1:0] limit,
    input  wire                          triangle,
    input  wire [      3*`RT_UNIT_W-1:0] shape,
    input  wire [     9*`RT_COORD_W-1:0] vertices,
    output wire                          out_valid,
    output wire [             TAG_W-1:0] out_tag,
    output wire                          hit,
    output wire                          leaving,
    output wire [       `RT_POINT_W-1:0] distance,
    output wire [    3*`RT_OFFSET_W-1:0] offset,
    output wire [  `RT_HALF_CHORD_W-1:0] half_chord
);

    localparam POINT_W = `RT_POINT_W;
    localparam FRAC = `RT_POINT_FRAC;
    localparam UNIT_W = `RT_UNIT_W;
    localparam OFFSET_W = `RT_OFFSET_W;
    localparam SHIFT_W = $clog2(`RT_REACH_W);
    localparam ROOT_W = `RT_HALF_CHORD_W;
    localparam RADIUS_SQ_W = `RT_RADIUS_SQ_W;
    // A number of POINT_W bits as two operands: an unsigned piece and the signed rest above it.
    localparam PIECE_W = 17;
    localparam OPERAND_W = PIECE_W + 1;

    // Clocks at which things are there, counted from the operands.
    localparam T_SEEN = 3;
    localparam T_ALONG = T_SEEN + 5;
    localparam T_FOOT = T_ALONG + 4;
    localparam T_OFFSET = T_FOOT + 1;
    localparam T_DISCRIMINANT = T_OFFSET + 5;
    localparam T_ROOT = T_DISCRIMINANT + ROOT_W + 1;
    localparam T_ENDS = T_ROOT + 1;
    localparam T_HIT = T_ENDS + 1;

    generate
        if (POINT_W <= PIECE_W || POINT_W > PIECE_W + OPERAND_W || UNIT_W > OPERAND_W) begin : g_bad_formats
            intersection_needs_formats_that_two_operands_of_18_bits_hold error ();
        end
    endgenerate

    genvar lane, corner;

    valid_pipe #(
        .TAG_W  (TAG_W),
        .LATENCY(T_HIT)
    ) u_valid (
        .clk      (clk),
        .rst      (rst),
        .in_valid (in_valid),
        .in_tag   (in_tag),
        .out_valid(out_valid),
        .out_tag  (out_tag)
    );

    // The kind of the test at each clock of its way; bit T - 1 at clock T.
    reg [T_ENDS-1:0] kind_reg;

    always @(posedge clk) kind_reg <= {kind_reg[T_ENDS-2:0], triangle};

    wire kind_at_seen = kind_reg[T_SEEN-1];
    wire kind_at_along = kind_reg[T_ALONG-1];
    wire kind_at_offset = kind_reg[T_OFFSET-1];
    wire kind_at_ends = kind_reg[T_ENDS-1];

    // ------------------------------------------------ corners, or a center, seen from the origin
    // p0 is in the most significant bits: A is corner 2, B corner 1, C corner 0.
    wire [9*UNIT_W-1:0] seen;
    wire [SHIFT_W-1:0] seen_shift;
    wire [3*POINT_W-1:0] center_seen;

    corners u_corners (
        .clk     (clk),
        .rst     (rst),
        .origin  (origin),
        .vertices(vertices),
        .seen    (seen),
        .shift   (seen_shift),
        .center  (center_seen)
    );

    wire [3*UNIT_W-1:0] direction_at_seen;
    wire [3*UNIT_W-1:0] shape_at_seen;

    delay #(
        .WIDTH(6*UNIT_W),
        .DEPTH(T_SEEN)
    ) u_to_seen (
        .clk(clk),
        .rst(rst),
        .in ({direction, shape}),
        .out({direction_at_seen, shape_at_seen})
    );

    // ------------------------------------------------ bank 1: I.c, or N.A and N.I
    wire [6*UNIT_W-1:0] bank1_a = kind_at_seen ? {2{shape_at_seen}} : {2{direction_at_seen}};
    wire [6*OPERAND_W-1:0] bank1_b;

    generate
        for (lane = 0; lane < 3; lane = lane + 1) begin : g_bank1
            wire [POINT_W-1:0] c = center_seen[lane*POINT_W+:POINT_W];
            wire [UNIT_W-1:0] a = seen[(6+lane)*UNIT_W+:UNIT_W];
            wire [UNIT_W-1:0] i = direction_at_seen[lane*UNIT_W+:UNIT_W];
            wire [OPERAND_W-1:0] rest =
                {{PIECE_W + OPERAND_W - POINT_W{c[POINT_W-1]}}, c[POINT_W-1:PIECE_W]};
            assign bank1_b[(3+lane)*OPERAND_W+:OPERAND_W] =
                kind_at_seen ? {{OPERAND_W - UNIT_W + 1{a[UNIT_W-1]}}, a[UNIT_W-2:0]} : rest;
            assign bank1_b[lane*OPERAND_W+:OPERAND_W] =
                kind_at_seen ? {{OPERAND_W - UNIT_W + 1{i[UNIT_W-1]}}, i[UNIT_W-2:0]}
                             : {1'b0, c[PIECE_W-1:0]};
        end
    endgenerate

    localparam PRODUCT_W = UNIT_W + OPERAND_W;
    localparam SUM_W = PRODUCT_W + 2;
    wire unused_bank1_valid;
    wire unused_bank1_tag;
    wire [6*PRODUCT_W-1:0] bank1;

    mul #(
        .A_W  (UNIT_W),
        .B_W  (OPERAND_W),
        .LANES(6)
    ) u_bank1 (
        .clk      (clk),
        .rst      (rst),
        .in_valid (1'b0),
        .in_tag   (1'b0),
        .a        (bank1_a),
        .b        (bank1_b),
        .out_valid(unused_bank1_valid),
        .out_tag  (unused_bank1_tag),
        .p        (bank1)
    );

    // Sums of three: the upper one weighs 2^PIECE_W of the lower one in a sphere's test.
    reg signed [SUM_W-1:0] upper_sum_reg;
    reg signed [SUM_W-1:0] lower_sum_reg;

    function [SUM_W-1:0] sum_of_three;
        input [3*PRODUCT_W-1:0] terms;
        integer k;
        begin
            sum_of_three = {SUM_W{1'b0}};
            for (k = 0; k < 3; k = k + 1)
                sum_of_three = sum_of_three
                    + {{2{terms[(k+1)*PRODUCT_W-1]}}, terms[k*PRODUCT_W+:PRODUCT_W]};
        end
    endfunction

    always @(posedge clk) begin
        upper_sum_reg <= sum_of_three(bank1[3*PRODUCT_W+:3*PRODUCT_W]);
        lower_sum_reg <= sum_of_three(bank1[0+:3*PRODUCT_W]);
    end

    // b = I.c, truncated and saturated once
    localparam ALONG_W = PIECE_W + SUM_W + 1;
    wire signed [ALONG_W-1:0] along_wide =
        {upper_sum_reg[SUM_W-1], upper_sum_reg, {PIECE_W{1'b0}}}
        + {{ALONG_W - SUM_W{lower_sum_reg[SUM_W-1]}}, lower_sum_reg};
    wire [POINT_W-1:0] along_next;
    reg [POINT_W-1:0] along_reg;

    resize #(
        .IN_INT  (ALONG_W - `RT_UNIT_FRAC - FRAC),
        .IN_FRAC (`RT_UNIT_FRAC + FRAC),
        .OUT_INT (`RT_POINT_INT),
        .OUT_FRAC(FRAC)
    ) u_along (
        .in (along_wide),
        .out(along_next)
    );

    always @(posedge clk) along_reg <= along_next;

    // ------------------------------------------------ a triangle's distance: |N.A| / |N.I|
    localparam QUOTIENT_W = 8 + FRAC;
    localparam T_QUOTIENT = T_ALONG - 1 + 2 + QUOTIENT_W;
    wire [SHIFT_W-1:0] shift_at_sums;
    wire [QUOTIENT_W-1:0] quotient;
    wire quotient_away;
    wire quotient_possible;
    wire [QUOTIENT_W-1:0] flat_distance;
    wire flat_away;
    wire flat_possible;

    generate
        if (T_QUOTIENT > T_ENDS) begin : g_bad_distance
            intersection_needs_a_square_root_longer_than_its_division error ();
        end
    endgenerate

    delay #(
        .WIDTH(SHIFT_W),
        .DEPTH(T_ALONG - 1 - T_SEEN)
    ) u_shift (
        .clk(clk),
        .rst(rst),
        .in (seen_shift),
        .out(shift_at_sums)
    );

    plane_distance #(
        .QUOTIENT_W(QUOTIENT_W)
    ) u_plane (
        .clk     (clk),
        .rst     (rst),
        .behind  (upper_sum_reg[2*UNIT_W:0]),
        .facing  (lower_sum_reg[2*UNIT_W:0]),
        .shift   (shift_at_sums),
        .distance(quotient),
        .away    (quotient_away),
        .possible(quotient_possible)
    );

    delay #(
        .WIDTH(QUOTIENT_W + 2),
        .DEPTH(T_ENDS - T_QUOTIENT)
    ) u_flat (
        .clk(clk),
        .rst(rst),
        .in ({quotient, quotient_away, quotient_possible}),
        .out({flat_distance, flat_away, flat_possible})
    );

    // ------------------------------------------------ bank 2: b I, or corners moved along the ray
    wire [9*UNIT_W-1:0] seen_at_along;
    wire [3*UNIT_W-1:0] direction_at_along;

    delay #(
        .WIDTH(12*UNIT_W),
        .DEPTH(T_ALONG - T_SEEN)
    ) u_to_along (
        .clk(clk),
        .rst(rst),
        .in ({seen, direction_at_seen}),
        .out({seen_at_along, direction_at_along})
    );

    // The longest component of the direction, of equal ones the first: 2, 1, 0 for x, y, z
    function [UNIT_W-1:0] magnitude;
        input [UNIT_W-1:0] component;
        magnitude = component[UNIT_W-1] ? -component : component;
    endfunction

    wire [UNIT_W-1:0] x_size = magnitude(direction[2*UNIT_W+:UNIT_W]);
    wire [UNIT_W-1:0] y_size = magnitude(direction[UNIT_W+:UNIT_W]);
    wire [UNIT_W-1:0] z_size = magnitude(direction[0+:UNIT_W]);
    reg [1:0] axis_reg;
    wire [1:0] axis;

    always @(posedge clk) begin
        if (x_size >= y_size && x_size >= z_size) axis_reg <= 2'd2;
        else axis_reg <= y_size >= z_size ? 2'd1 : 2'd0;
    end

    delay #(
        .WIDTH(2),
        .DEPTH(T_ALONG - 1)
    ) u_axis (
        .clk(clk),
        .rst(rst),
        .in (axis_reg),
        .out(axis)
    );

    // {x, y, z} turned so that the longest component of the direction comes last
    function [3*UNIT_W-1:0] turned;
        input [3*UNIT_W-1:0] vector;
        input [1:0] longest;
        if (longest[1]) turned = {vector[0+:2*UNIT_W], vector[2*UNIT_W+:UNIT_W]};
        else if (longest[0]) turned = {vector[0+:UNIT_W], vector[UNIT_W+:2*UNIT_W]};
        else turned = vector;
    endfunction

    wire [3*UNIT_W-1:0] ray = turned(direction_at_along, axis);
    wire [12*UNIT_W-1:0] bank2_a;
    wire [12*OPERAND_W-1:0] bank2_b;

    // A corner takes four products: I_z x, I_x z, I_z y, I_y z. A sphere takes two of each of the
    // first two corners' and of the third's: the same component of I times both pieces of b.
    generate
        for (corner = 0; corner < 3; corner = corner + 1) begin : g_bank2
            wire [3*UNIT_W-1:0] v = turned(seen_at_along[3*corner*UNIT_W+:3*UNIT_W], axis);
            wire [4*UNIT_W-1:0] flat_a = {
                ray[0+:UNIT_W], ray[2*UNIT_W+:UNIT_W], ray[0+:UNIT_W], ray[UNIT_W+:UNIT_W]
            };
            wire [4*UNIT_W-1:0] flat_b = {
                v[2*UNIT_W+:UNIT_W], v[0+:UNIT_W], v[UNIT_W+:UNIT_W], v[0+:UNIT_W]
            };
            wire [UNIT_W-1:0] i = direction_at_along[corner*UNIT_W+:UNIT_W];
            wire [OPERAND_W-1:0] rest = {
                {PIECE_W + OPERAND_W - POINT_W{along_reg[POINT_W-1]}}, along_reg[POINT_W-1:PIECE_W]
            };
            wire [4*OPERAND_W-1:0] round_b =
                {rest, 1'b0, along_reg[PIECE_W-1:0], {2*OPERAND_W{1'b0}}};

            assign bank2_a[4*corner*UNIT_W+:4*UNIT_W] =
                kind_at_along ? flat_a : {i, i, {2*UNIT_W{1'b0}}};

            for (lane = 0; lane < 4; lane = lane + 1) begin : g_operand
                wire [UNIT_W-1:0] narrow = flat_b[lane*UNIT_W+:UNIT_W];
                assign bank2_b[(4*corner+lane)*OPERAND_W+:OPERAND_W] =
                    kind_at_along ? {{OPERAND_W - UNIT_W + 1{narrow[UNIT_W-1]}}, narrow[UNIT_W-2:0]}
                                  : round_b[lane*OPERAND_W+:OPERAND_W];
            end
        end
    endgenerate

    wire unused_bank2_valid;
    wire unused_bank2_tag;
    wire [12*PRODUCT_W-1:0] bank2;

    mul #(
        .A_W  (UNIT_W),
        .B_W  (OPERAND_W),
        .LANES(12)
    ) u_bank2 (
        .clk      (clk),
        .rst      (rst),
        .in_valid (1'b0),
        .in_tag   (1'b0),
        .a        (bank2_a),
        .b        (bank2_b),
        .out_valid(unused_bank2_valid),
        .out_tag  (unused_bank2_tag),
        .p        (bank2)
    );

    wire [3*POINT_W-1:0] foot_next;
    reg [3*POINT_W-1:0] foot_reg;
    wire [6*UNIT_W-1:0] moved_next;
    reg [6*UNIT_W-1:0] moved_reg;
    reg [6*UNIT_W-1:0] moved_late_reg;

    generate
        for (corner = 0; corner < 3; corner = corner + 1) begin : g_foot
            wire [PRODUCT_W-1:0] upper = bank2[(4*corner+3)*PRODUCT_W+:PRODUCT_W];
            wire [PRODUCT_W-1:0] lower = bank2[(4*corner+2)*PRODUCT_W+:PRODUCT_W];
            wire [PIECE_W+PRODUCT_W:0] whole =
                {upper[PRODUCT_W-1], upper, {PIECE_W{1'b0}}}
                + {{PIECE_W + 1{lower[PRODUCT_W-1]}}, lower};

            resize #(
                .IN_INT  (PIECE_W + PRODUCT_W + 1 - `RT_UNIT_FRAC - FRAC),
                .IN_FRAC (`RT_UNIT_FRAC + FRAC),
                .OUT_INT (`RT_POINT_INT),
                .OUT_FRAC(FRAC)
            ) u_resize (
                .in (whole),
                .out(foot_next[corner*POINT_W+:POINT_W])
            );

            for (lane = 0; lane < 2; lane = lane + 1) begin : g_moved
                wire [PRODUCT_W-1:0] plus = bank2[(4*corner+2*lane+1)*PRODUCT_W+:PRODUCT_W];
                wire [PRODUCT_W-1:0] minus = bank2[(4*corner+2*lane)*PRODUCT_W+:PRODUCT_W];

                resize #(
                    .IN_INT  (PRODUCT_W + 1 - `RT_UNIT_FRAC - UNIT_W + 1),
                    .IN_FRAC (`RT_UNIT_FRAC + UNIT_W - 1),
                    .OUT_INT (`RT_UNIT_INT),
                    .OUT_FRAC(`RT_UNIT_FRAC)
                ) u_resize (
                    .in ({plus[PRODUCT_W-1], plus} - {minus[PRODUCT_W-1], minus}),
                    .out(moved_next[(2*corner+lane)*UNIT_W+:UNIT_W])
                );
            end
        end
    endgenerate

    always @(posedge clk) begin
        foot_reg       <= foot_next;
        moved_reg      <= moved_next;
        moved_late_reg <= moved_reg;
    end

    // q = c - b I, saturated: a component that does not fit is longer than any radius
    wire [3*POINT_W-1:0] center_at_foot;
    wire [3*OFFSET_W-1:0] offset_next;
    reg [3*OFFSET_W-1:0] offset_reg;

    delay #(
        .WIDTH(3*POINT_W),
        .DEPTH(T_FOOT - T_SEEN)
    ) u_center (
        .clk(clk),
        .rst(rst),
        .in (center_seen),
        .out(center_at_foot)
    );

    generate
        for (lane = 0; lane < 3; lane = lane + 1) begin : g_offset
            wire [POINT_W-1:0] c = center_at_foot[lane*POINT_W+:POINT_W];
            wire [POINT_W-1:0] f = foot_reg[lane*POINT_W+:POINT_W];

            resize #(
                .IN_INT  (`RT_POINT_INT + 1),
                .IN_FRAC (FRAC),
                .OUT_INT (`RT_OFFSET_INT),
                .OUT_FRAC(FRAC)
            ) u_resize (
                .in ({c[POINT_W-1], c} - {f[POINT_W-1], f}),
                .out(offset_next[lane*OFFSET_W+:OFFSET_W])
            );
        end
    endgenerate

    always @(posedge clk) offset_reg <= offset_next;

    // ------------------------------------------------ bank 3: q.q, or the areas of the edges
    localparam WIDE_W = OFFSET_W > UNIT_W ? OFFSET_W : UNIT_W;
    localparam AREA_W = 2 * WIDE_W;
    wire [6*WIDE_W-1:0] bank3_a;
    wire [6*WIDE_W-1:0] bank3_b;
    wire [6*AREA_W-1:0] bank3;
    wire unused_bank3_valid;
    wire unused_bank3_tag;

    // Corner 2 is A: edge 2 is AB, edge 1 BC, edge 0 CA. A sphere's squares are in lane 0 of each.
    generate
        for (corner = 0; corner < 3; corner = corner + 1) begin : g_bank3
            localparam NEXT = (corner + 2) % 3;
            wire [2*UNIT_W-1:0] here = moved_late_reg[2*corner*UNIT_W+:2*UNIT_W];
            wire [2*UNIT_W-1:0] there = moved_late_reg[2*NEXT*UNIT_W+:2*UNIT_W];
            wire [OFFSET_W-1:0] q = offset_reg[corner*OFFSET_W+:OFFSET_W];

            for (lane = 0; lane < 2; lane = lane + 1) begin : g_operand
                wire [UNIT_W-1:0] left = here[lane*UNIT_W+:UNIT_W];
                wire [UNIT_W-1:0] right = there[(1-lane)*UNIT_W+:UNIT_W];
                wire is_area = lane == 1 || kind_at_offset;
                wire [WIDE_W-1:0] q_wide = {{WIDE_W - OFFSET_W + 1{q[OFFSET_W-1]}}, q[OFFSET_W-2:0]};
                assign bank3_a[(2*corner+lane)*WIDE_W+:WIDE_W] =
                    is_area ? {{WIDE_W - UNIT_W + 1{left[UNIT_W-1]}}, left[UNIT_W-2:0]} : q_wide;
                assign bank3_b[(2*corner+lane)*WIDE_W+:WIDE_W] =
                    is_area ? {{WIDE_W - UNIT_W + 1{right[UNIT_W-1]}}, right[UNIT_W-2:0]} : q_wide;
            end
        end
    endgenerate

    mul #(
        .A_W  (WIDE_W),
        .B_W  (WIDE_W),
        .LANES(6)
    ) u_bank3 (
        .clk      (clk),
        .rst      (rst),
        .in_valid (1'b0),
        .in_tag   (1'b0),
        .a        (bank3_a),
        .b        (bank3_b),
        .out_valid(unused_bank3_valid),
        .out_tag  (unused_bank3_tag),
        .p        (bank3)
    );

    // Signs of the areas
    reg [2:0] positive_reg;
    reg [2:0] negative_reg;
    reg inside_reg;

    generate
        for (corner = 0; corner < 3; corner = corner + 1) begin : g_area
            wire signed [AREA_W-1:0] plus = bank3[(2*corner+1)*AREA_W+:AREA_W];
            wire signed [AREA_W-1:0] minus = bank3[2*corner*AREA_W+:AREA_W];

            always @(posedge clk) begin
                positive_reg[corner] <= plus > minus;
                negative_reg[corner] <= plus < minus;
            end
        end
    endgenerate

    // Exactly one of the two: with all areas 0 the triangle is seen as a line or a point.
    always @(posedge clk) inside_reg <= (positive_reg == 3'd0) ^ (negative_reg == 3'd0);

    wire is_inside;

    delay #(
        .WIDTH(1),
        .DEPTH(T_ENDS - T_DISCRIMINANT)
    ) u_inside (
        .clk(clk),
        .rst(rst),
        .in (inside_reg),
        .out(is_inside)
    );

    // ------------------------------------------------ discriminant = r^2 - q.q
    // A component of q is at most 2^(OFFSET_W - 1) in size: three squares need no third bit more.
    localparam SQUARES_W = 2 * OFFSET_W;
    localparam DISCRIMINANT_W = SQUARES_W + 1;
    localparam RADICAND_W = 2 * ROOT_W;
    reg [SQUARES_W-1:0] sum_reg;
    reg [DISCRIMINANT_W-1:0] discriminant_reg;
    wire [RADIUS_SQ_W-1:0] radius_sq;

    delay #(
        .WIDTH(RADIUS_SQ_W),
        .DEPTH(T_DISCRIMINANT - 1 - T_SEEN)
    ) u_radius (
        .clk(clk),
        .rst(rst),
        .in (shape_at_seen[RADIUS_SQ_W-1:0]),
        .out(radius_sq)
    );

    always @(posedge clk) begin
        sum_reg <= bank3[4*AREA_W+:SQUARES_W] + bank3[2*AREA_W+:SQUARES_W]
                 + bank3[0+:SQUARES_W];
        discriminant_reg <= {
            {DISCRIMINANT_W - RADIUS_SQ_W - 2 * FRAC + `RT_RADIUS_SQ_FRAC{1'b0}},
            radius_sq,
            {2 * FRAC - `RT_RADIUS_SQ_FRAC{1'b0}}
        } - {1'b0, sum_reg};
    end

    wire unused_discriminant = &{1'b0, discriminant_reg[DISCRIMINANT_W-2:RADICAND_W]};
    wire unused_root_valid;
    wire root_negative;
    wire [ROOT_W-1:0] root;
    wire [ROOT_W:0] unused_remainder;

    sqrt #(
        .D_W  (RADICAND_W),
        .TAG_W(1)
    ) u_root (
        .clk      (clk),
        .rst      (rst),
        .in_valid (1'b0),
        .in_tag   (discriminant_reg[DISCRIMINANT_W-1]),
        .radicand (discriminant_reg[RADICAND_W-1:0]),
        .out_valid(unused_root_valid),
        .out_tag  (root_negative),
        .root     (root),
        .remainder(unused_remainder)
    );

    // ------------------------------------------------ t = b -+ root, one bit wider than RT_POINT
    localparam [POINT_W:0] T_MIN = `RT_T_MIN;
    wire [POINT_W-1:0] along_at_root;
    wire [3*OFFSET_W-1:0] offset_at_ends;
    wire [POINT_W-1:0] limit_at_ends;
    reg signed [POINT_W:0] near_reg;
    reg signed [POINT_W:0] far_reg;
    reg negative_root_reg;
    reg [ROOT_W-1:0] root_reg;

    delay #(
        .WIDTH(POINT_W),
        .DEPTH(T_ROOT - T_ALONG)
    ) u_along_root (
        .clk(clk),
        .rst(rst),
        .in (along_reg),
        .out(along_at_root)
    );

    delay #(
        .WIDTH(3*OFFSET_W),
        .DEPTH(T_ENDS - T_OFFSET)
    ) u_offset (
        .clk(clk),
        .rst(rst),
        .in (offset_reg),
        .out(offset_at_ends)
    );

    delay #(
        .WIDTH(POINT_W),
        .DEPTH(T_ENDS)
    ) u_limit (
        .clk(clk),
        .rst(rst),
        .in (limit),
        .out(limit_at_ends)
    );

    wire [POINT_W:0] b_wide = {along_at_root[POINT_W-1], along_at_root};
    wire [POINT_W:0] root_wide = {{POINT_W + 1 - ROOT_W{1'b0}}, root};

    always @(posedge clk) begin
        near_reg          <= b_wide - root_wide;
        far_reg           <= b_wide + root_wide;
        negative_root_reg <= root_negative;
        root_reg          <= root;
    end

    wire far_end = near_reg < $signed(T_MIN);
    wire signed [POINT_W:0] round_distance = far_end ? far_reg : near_reg;
    wire signed [POINT_W:0] t =
        kind_at_ends ? {{POINT_W + 1 - QUOTIENT_W{1'b0}}, flat_distance} : round_distance;
    wire possible = kind_at_ends ? is_inside && flat_possible : !negative_root_reg;
    wire signed [POINT_W:0] limit_wide = {limit_at_ends[POINT_W-1], limit_at_ends};
    wire [POINT_W-1:0] t_point;
    reg hit_reg;
    reg leaving_reg;
    reg [POINT_W-1:0] distance_reg;
    reg [3*OFFSET_W-1:0] hit_offset_reg;
    reg [ROOT_W-1:0] half_chord_reg;

    resize #(
        .IN_INT  (`RT_POINT_INT + 1),
        .IN_FRAC (FRAC),
        .OUT_INT (`RT_POINT_INT),
        .OUT_FRAC(FRAC)
    ) u_distance (
        .in (t),
        .out(t_point)
    );

    always @(posedge clk) begin
        hit_reg        <= possible && t >= $signed(T_MIN) && t < limit_wide;
        leaving_reg    <= kind_at_ends ? flat_away : far_end;
        distance_reg   <= t_point;
        hit_offset_reg <= offset_at_ends & {3 * OFFSET_W{!kind_at_ends}};
        half_chord_reg <= root_reg & {ROOT_W{!kind_at_ends}};
    end

    assign hit        = hit_reg;
    assign leaving    = leaving_reg;
    assign distance   = distance_reg;
    assign offset     = hit_offset_reg;
    assign half_chord = half_chord_reg;

endmodule

`default_nettype wire
