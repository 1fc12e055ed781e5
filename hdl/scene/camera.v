// SPDX-License-Identifier: Apache-2.0
//
// camera: the screen's basis, once a frame (book 8.2.1).
//
//     d = normalise(C - P)    u = normalise((C - P) x up)    v = normalise(d x u)
//     base = d - tan_h * u - tan_v * v
//
// and the spans tan_h * u and tan_v * v, divided by the picture's width and height for the ray
// generator. C - P and its product with up are exact, so that both faults are found exactly. One
// multiplier, one divider and the ray generator's normaliser, which is idle meanwhile, are shared
// by all of it.
//
// Ports
//   start           takes position P, up and center C {x, y, z} (RT_COORD), width and height,
//                   tan_h and tan_v (RT_TAN); they hold still until done, and until then a start is
//                   ignored
//   done, fault     one clock; RT_FAULT_SIZE where width or height is 0, RT_FAULT_CAMERA_POSITION
//                   where C = P, RT_FAULT_CAMERA_UP where up is parallel to C - P (or zero),
//                   RT_FAULT_NONE otherwise
//   base, column_*, row_*   see ray_generator; they hold from done to the next start
//   vector_valid, vector    to the normaliser, WIDE_W bits a component; three vectors, none where
//                   there is a fault
//   unit_valid, unit        from the normaliser, in the order asked
//
// Latency from start to done 2 normalisations (unit_vector), 6 divisions (1 + RT_SPAN_W each), 3 times
// 6 products (9 clocks) and 5 clocks; less where there is a fault.

`default_nettype none
`include "raytracer.vh"

module camera #(
    parameter SIZE_W = 12,
    parameter WIDE_W = 40
) (
    input  wire                      clk,
    input  wire                      rst,
    input  wire                      start,
    input  wire [ 3*`RT_COORD_W-1:0] position,
    input  wire [ 3*`RT_COORD_W-1:0] up,
    input  wire [ 3*`RT_COORD_W-1:0] center,
    input  wire [        SIZE_W-1:0] width,
    input  wire [        SIZE_W-1:0] height,
    input  wire [     `RT_TAN_W-1:0] tan_h,
    input  wire [     `RT_TAN_W-1:0] tan_v,
    output wire                      done,
    output wire [   `RT_FAULT_W-1:0] fault,
    output wire [3*`RT_SCREEN_W-1:0] base,
    output wire [  3*`RT_SPAN_W-1:0] column_quotient,
    output wire [      3*SIZE_W-1:0] column_remainder,
    output wire [               2:0] column_negative,
    output wire [  3*`RT_SPAN_W-1:0] row_quotient,
    output wire [      3*SIZE_W-1:0] row_remainder,
    output wire [               2:0] row_negative,
    output wire                      vector_valid,
    output wire [      3*WIDE_W-1:0] vector,
    input  wire                      unit_valid,
    input  wire [  3*`RT_UNIT_W-1:0] unit
);

    localparam COORD_W = `RT_COORD_W;
    localparam UNIT_W = `RT_UNIT_W;
    localparam VIEW_W = COORD_W + 1;
    localparam TAN_W = `RT_TAN_W + 1;
    // Widest operand of the shared multiplier, signed.
    localparam A_W = VIEW_W > UNIT_W ? VIEW_W : UNIT_W;
    localparam B_W = TAN_W > UNIT_W ? TAN_W : UNIT_W;
    localparam PRODUCT_W = A_W + B_W;
    localparam SPAN_DROP = `RT_TAN_FRAC + `RT_UNIT_FRAC - `RT_SCREEN_FRAC;

    generate
        if (WIDE_W < VIEW_W + COORD_W + 1 || WIDE_W < 2 * UNIT_W + 1) begin : g_bad_wide
            camera_needs_a_WIDE_W_that_holds_its_cross_products error ();
        end
    endgenerate

    localparam [3:0] S_IDLE = 4'd0;
    localparam [3:0] S_VIEW = 4'd1;
    localparam [3:0] S_RIGHT = 4'd2;
    localparam [3:0] S_ASK_D = 4'd3;
    localparam [3:0] S_ASK_U = 4'd4;
    localparam [3:0] S_WAIT_D = 4'd5;
    localparam [3:0] S_WAIT_U = 4'd6;
    localparam [3:0] S_DOWN = 4'd7;
    localparam [3:0] S_ASK_V = 4'd8;
    localparam [3:0] S_WAIT_V = 4'd9;
    localparam [3:0] S_SPANS = 4'd10;
    localparam [3:0] S_DIVIDE = 4'd11;
    localparam [3:0] S_DONE = 4'd12;

    reg [3:0] state_reg;
    reg [3:0] state_next;

    // Operand vectors as lanes 0, 1, 2 for x, y, z.
    reg [3*VIEW_W-1:0] view_reg;
    reg [3*UNIT_W-1:0] d_reg;
    reg [3*UNIT_W-1:0] u_reg;
    reg [3*UNIT_W-1:0] v_reg;
    reg [3*WIDE_W-1:0] product_reg;

    wire [3*VIEW_W-1:0] view_next;

    genvar lane;
    generate
        for (lane = 0; lane < 3; lane = lane + 1) begin : g_view
            wire signed [COORD_W-1:0] c = center[lane*COORD_W+:COORD_W];
            wire signed [COORD_W-1:0] p = position[lane*COORD_W+:COORD_W];
            assign view_next[lane*VIEW_W+:VIEW_W] = {c[COORD_W-1], c} - {p[COORD_W-1], p};
        end
    endgenerate

    always @(posedge clk) if (state_reg == S_VIEW) view_reg <= view_next;

    // Sequence of six products: `issue_reg` counts those sent, `odd` and `collected` tell of one
    // that came back that it is the second of a pair and the last. Those behind it are not used.
    // Product 2 k and 2 k + 1 make component k (x, y, z) of a cross product; product k is
    // component k of the span of the columns, 3 + k that of the rows.
    reg [2:0] issue_reg;
    wire viewing = state_reg == S_RIGHT;
    wire spanning = state_reg == S_SPANS;
    wire multiplying = viewing || state_reg == S_DOWN || spanning;
    wire collect_valid;
    wire upper;
    wire odd;
    wire collected = collect_valid && upper && odd;

    always @(posedge clk) begin
        if (!multiplying) issue_reg <= 3'd0;
        else issue_reg <= issue_reg + 1'b1;
    end

    // a x b: x is a_y b_z - a_z b_y, and so on round.
    reg [1:0] first;
    reg [1:0] second;

    always @* begin
        case (issue_reg[2:1])
            2'd0: {first, second} = {2'd1, 2'd0};
            2'd1: {first, second} = {2'd0, 2'd2};
            default: {first, second} = {2'd2, 2'd1};
        endcase
        if (issue_reg[0]) {first, second} = {second, first};
    end

    // Spans take x, y, z of u, then those of v, which come to lane 2 one after the other.
    wire row = issue_reg >= 3'd3;
    wire [3*A_W-1:0] a_vector;
    wire [3*B_W-1:0] b_vector;

    // Lane 2, 1, 0 of a vector is its x, y, z.
    generate
        for (lane = 0; lane < 3; lane = lane + 1) begin : g_operands
            wire [VIEW_W-1:0] of_view = view_reg[lane*VIEW_W+:VIEW_W];
            wire [UNIT_W-1:0] of_d = d_reg[lane*UNIT_W+:UNIT_W];
            wire [UNIT_W-1:0] of_u = u_reg[lane*UNIT_W+:UNIT_W];
            wire [COORD_W-1:0] of_up = up[lane*COORD_W+:COORD_W];
            assign a_vector[lane*A_W+:A_W] = viewing
                ? {{A_W - VIEW_W + 1{of_view[VIEW_W-1]}}, of_view[VIEW_W-2:0]}
                : {{A_W - UNIT_W + 1{of_d[UNIT_W-1]}}, of_d[UNIT_W-2:0]};
            assign b_vector[lane*B_W+:B_W] = viewing
                ? {{B_W - COORD_W + 1{of_up[COORD_W-1]}}, of_up[COORD_W-2:0]}
                : {{B_W - UNIT_W + 1{of_u[UNIT_W-1]}}, of_u[UNIT_W-2:0]};
        end
    endgenerate

    wire [A_W-1:0] a_component =
        first[1] ? a_vector[2*A_W+:A_W] : first[0] ? a_vector[A_W+:A_W] : a_vector[0+:A_W];
    wire [B_W-1:0] b_component =
        second[1] ? b_vector[2*B_W+:B_W] : second[0] ? b_vector[B_W+:B_W] : b_vector[0+:B_W];
    wire [A_W-1:0] a = spanning
        ? {{A_W - UNIT_W + 1{u_reg[3*UNIT_W-1]}}, u_reg[2*UNIT_W+:UNIT_W-1]} : a_component;
    wire [B_W-1:0] b =
        spanning ? {{B_W - `RT_TAN_W{1'b0}}, row ? tan_v : tan_h} : b_component;

    wire [PRODUCT_W-1:0] product;

    mul #(
        .A_W  (A_W),
        .B_W  (B_W),
        .LANES(1),
        .TAG_W(2)
    ) u_mul (
        .clk      (clk),
        .rst      (rst),
        .in_valid (multiplying),
        .in_tag   ({issue_reg[2], issue_reg[0]}),
        .a        (a),
        .b        (b),
        .out_valid(collect_valid),
        .out_tag  ({upper, odd}),
        .p        (product)
    );

    // Cross products gather by shifting components in from the right, x first; the minuend comes in
    // the clock before. What the spans leave there is not used.
    reg [PRODUCT_W-1:0] minuend_reg;
    wire [PRODUCT_W:0] component =
        {minuend_reg[PRODUCT_W-1], minuend_reg} - {product[PRODUCT_W-1], product};
    wire [WIDE_W-1:0] component_wide;

    generate
        if (WIDE_W > PRODUCT_W + 1) begin : g_extend
            assign component_wide =
                {{WIDE_W - PRODUCT_W - 1{component[PRODUCT_W]}}, component};
        end else begin : g_fit
            assign component_wide = component[WIDE_W-1:0];
        end
        if (WIDE_W < PRODUCT_W + 1) begin : g_spare
            wire unused_component = &{1'b0, component[PRODUCT_W:WIDE_W]};
        end
    endgenerate

    always @(posedge clk) begin
        minuend_reg <= product;
        if (collect_valid && odd)
            product_reg <= {product_reg[2*WIDE_W-1:0], component_wide};
    end

    wire cross_zero = product_reg == {3 * WIDE_W{1'b0}};
    wire no_size = width == {SIZE_W{1'b0}} || height == {SIZE_W{1'b0}};
    wire view_zero = view_reg == {3 * VIEW_W{1'b0}};

    // Spans: magnitudes and signs, columns in the upper three lanes.
    localparam SPAN_W = `RT_SPAN_W;
    reg [6*SPAN_W-1:0] span_reg;
    reg [5:0] negative_reg;
    wire [PRODUCT_W-1:0] magnitude = product[PRODUCT_W-1] ? -product : product;
    wire unused_magnitude =
        &{1'b0, magnitude[PRODUCT_W-1:SPAN_DROP+SPAN_W], magnitude[SPAN_DROP-1:0]};

    // Division turns the lanes round: each is divided and comes in again from the right.
    reg [2:0] divided_reg;
    reg asked_reg;
    wire quotient_valid;
    wire [SPAN_W-1:0] quotient;
    wire [SIZE_W-1:0] remainder;
    reg [6*SIZE_W-1:0] remainder_reg;
    // Its results are taken at once, so the divider is ready whenever it is asked.
    wire unused_ready;
    wire dividing = state_reg == S_DIVIDE;
    // It counts to 5 and no further.
    wire divided_last = divided_reg[2] && divided_reg[0];
    wire divide = dividing && !asked_reg;

    always @(posedge clk) begin
        if (collect_valid && spanning) begin
            span_reg <= {span_reg[5*SPAN_W-1:0], magnitude[SPAN_DROP+:SPAN_W]};
            negative_reg <= {negative_reg[4:0], product[PRODUCT_W-1]};
        end else if (quotient_valid) span_reg <= {span_reg[5*SPAN_W-1:0], quotient};
    end

    always @(posedge clk) begin
        if (quotient_valid) remainder_reg <= {remainder_reg[5*SIZE_W-1:0], remainder};
    end

    always @(posedge clk) begin
        asked_reg <= dividing && !quotient_valid;
        if (!dividing) divided_reg <= 3'd0;
        else if (quotient_valid) divided_reg <= divided_reg + 1'b1;
    end

    div_iter #(
        .NUM_W(SPAN_W),
        .DEN_W(SIZE_W)
    ) u_divide (
        .clk      (clk),
        .rst      (rst),
        .in_valid (divide),
        .in_ready (unused_ready),
        .num      (span_reg[5*SPAN_W+:SPAN_W]),
        .den      (divided_reg < 3'd3 ? width : height),
        .out_valid(quotient_valid),
        .out_ready(1'b1),
        .quotient (quotient),
        .remainder(remainder)
    );

    // base = d - span of the columns - span of the rows, taken before the spans are divided
    localparam SCREEN_W = `RT_SCREEN_W;
    reg [3*SCREEN_W-1:0] base_reg;
    wire [3*SCREEN_W-1:0] base_next;

    generate
        for (lane = 0; lane < 3; lane = lane + 1) begin : g_base
            wire [UNIT_W-1:0] d = d_reg[lane*UNIT_W+:UNIT_W];
            wire [SCREEN_W-1:0] d_screen = {
                {SCREEN_W - UNIT_W - `RT_SCREEN_FRAC + `RT_UNIT_FRAC{d[UNIT_W-1]}},
                d,
                {`RT_SCREEN_FRAC - `RT_UNIT_FRAC{1'b0}}
            };
            wire [SCREEN_W-1:0] column = {
                {SCREEN_W - SPAN_W{1'b0}}, span_reg[(lane+3)*SPAN_W+:SPAN_W]
            };
            wire [SCREEN_W-1:0] row_span = {
                {SCREEN_W - SPAN_W{1'b0}}, span_reg[lane*SPAN_W+:SPAN_W]
            };
            wire [SCREEN_W-1:0] column_off = negative_reg[lane+3] ? column : -column;
            wire [SCREEN_W-1:0] row_off = negative_reg[lane] ? row_span : -row_span;
            assign base_next[lane*SCREEN_W+:SCREEN_W] = d_screen + column_off + row_off;
        end
    endgenerate

    always @(posedge clk) if (divide && divided_reg == 3'd0) base_reg <= base_next;

    // Normaliser: unit vectors come back in the order asked.
    wire [3*WIDE_W-1:0] view_wide;

    generate
        for (lane = 0; lane < 3; lane = lane + 1) begin : g_wide
            wire [VIEW_W-1:0] component_view = view_reg[lane*VIEW_W+:VIEW_W];
            assign view_wide[lane*WIDE_W+:WIDE_W] =
                {{WIDE_W - VIEW_W{component_view[VIEW_W-1]}}, component_view};
        end
    endgenerate

    assign vector_valid = state_reg == S_ASK_D && !cross_zero || state_reg == S_ASK_U
                       || state_reg == S_ASK_V;
    assign vector = state_reg == S_ASK_D ? view_wide : product_reg;

    always @(posedge clk) begin
        // The last unit that is taken is the valid one.
        if (state_reg == S_WAIT_D) d_reg <= unit;
        if (state_reg == S_WAIT_U) u_reg <= unit;
        else if (spanning) u_reg <= {u_reg[0+:2*UNIT_W], v_reg[2*UNIT_W+:UNIT_W]};
        if (state_reg == S_WAIT_V) v_reg <= unit;
        else if (spanning) v_reg <= {v_reg[0+:2*UNIT_W], {UNIT_W{1'b0}}};
    end

    reg [`RT_FAULT_W-1:0] fault_reg;
    reg [`RT_FAULT_W-1:0] fault_next;

    always @* begin
        state_next = state_reg;
        fault_next = fault_reg;
        case (state_reg)
            S_IDLE: begin
                fault_next = `RT_FAULT_NONE;
                if (start) state_next = S_VIEW;
            end
            S_VIEW: begin
                if (no_size) begin
                    fault_next = `RT_FAULT_SIZE;
                    state_next = S_DONE;
                end else state_next = S_RIGHT;
            end
            S_RIGHT: begin
                if (view_zero) begin
                    fault_next = `RT_FAULT_CAMERA_POSITION;
                    if (collected) state_next = S_DONE;
                end else if (collected) state_next = S_ASK_D;
            end
            S_ASK_D: begin
                if (cross_zero) begin
                    fault_next = `RT_FAULT_CAMERA_UP;
                    state_next = S_DONE;
                end else state_next = S_ASK_U;
            end
            S_ASK_U: state_next = S_WAIT_D;
            S_WAIT_D: if (unit_valid) state_next = S_WAIT_U;
            S_WAIT_U: if (unit_valid) state_next = S_DOWN;
            S_DOWN: if (collected) state_next = S_ASK_V;
            S_ASK_V: state_next = S_WAIT_V;
            S_WAIT_V: if (unit_valid) state_next = S_SPANS;
            S_SPANS: if (collected) state_next = S_DIVIDE;
            S_DIVIDE: if (quotient_valid && divided_last) state_next = S_DONE;
            default: state_next = S_IDLE;
        endcase
    end

    always @(posedge clk) begin
        if (rst) begin
            state_reg <= S_IDLE;
            fault_reg <= `RT_FAULT_NONE;
        end else begin
            state_reg <= state_next;
            fault_reg <= fault_next;
        end
    end

    assign done             = state_reg == S_DONE;
    assign fault            = fault_reg;
    assign base             = base_reg;
    assign column_quotient  = span_reg[3*SPAN_W+:3*SPAN_W];
    assign row_quotient     = span_reg[0+:3*SPAN_W];
    assign column_remainder = remainder_reg[3*SIZE_W+:3*SIZE_W];
    assign row_remainder    = remainder_reg[0+:3*SIZE_W];
    assign column_negative  = negative_reg[5:3];
    assign row_negative     = negative_reg[2:0];

endmodule

`default_nettype wire
