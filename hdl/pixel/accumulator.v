// SPDX-License-Identifier: Apache-2.0
//
// accumulator: sums the terms of each pixel in flight and tells when it is complete.
//
// A pixel begins with one piece of work, which nobody announces. `more` adds pieces, each term
// ends one and adds its colour, lane by lane, saturated as in colour_add; no term is negative, so
// the order of the terms is no matter. The term that ends the last piece completes the pixel, and
// its slot stands at zero and one piece of work for the next one.
//
// Two counts of each slot never go back: what was announced, and the terms less the pixels. The
// work of a pixel is 1 + announced - terms. So each count has one writer, and a pixel that is
// complete is the one whose counts are equal before the term, which then does not count.
//
// Parameters
//   SLOTS    pixels in flight, a power of two, at least 2
//   COUNT_W  bits of a pixel's work: at most 2^COUNT_W pieces are outstanding
//
// Ports
//   ready    the memories have been cleared, SLOTS clocks after reset; nothing comes before it
//   more_*   so much more work, may be 0; never waits. It comes at an earlier clock than the term
//            that would complete the pixel without it. With any other term of the pixel it may
//            come in the same clock. In the clock of the completing term it counts for the next
//            pixel of the slot
//   term_*   one term, {r, g, b} in RT_SHADE; never waits, any slot in any clock
//   out_*    one clock: the pixel of the slot is complete, its colour
//
// Latency 2 from a term to out_valid, rate one term and one `more` a clock.

`default_nettype none
`include "raytracer.vh"

module accumulator #(
    parameter SLOTS   = 256,
    parameter SLOT_W  = $clog2(SLOTS),
    parameter COUNT_W = 8
) (
    input  wire                      clk,
    input  wire                      rst,
    output wire                      ready,
    input  wire                      more_valid,
    input  wire [        SLOT_W-1:0] more_slot,
    input  wire [       COUNT_W-1:0] more_count,
    input  wire                      term_valid,
    input  wire [        SLOT_W-1:0] term_slot,
    input  wire [3*`RT_SHADE_W-1:0] term_colour,
    output wire                      out_valid,
    output wire [        SLOT_W-1:0] out_slot,
    output wire [3*`RT_SHADE_W-1:0] out_colour
);

    localparam W        = `RT_SHADE_W;
    localparam COLOUR_W = 3 * W;

    generate
        if (SLOTS < 2 || SLOTS != 1 << SLOT_W || COUNT_W < 1) begin : g_bad_slots
            accumulator_needs_SLOTS_that_are_a_power_of_two_and_a_COUNT_W error ();
        end
    endgenerate

    // After reset every slot is cleared; the top bit tells that all are.
    reg [SLOT_W:0] clear_reg;
    wire clearing = !clear_reg[SLOT_W];
    wire [SLOT_W-1:0] clear_slot = clear_reg[SLOT_W-1:0];

    always @(posedge clk) begin
        if (rst) clear_reg <= {SLOT_W + 1{1'b0}};
        else if (clearing) clear_reg <= clear_reg + 1'b1;
    end

    // Announced pieces of work, modulo 2^COUNT_W.
    reg [COUNT_W-1:0] announced[0:SLOTS-1];
    wire [SLOT_W-1:0] announced_slot = clearing ? clear_slot : more_slot;
    wire [COUNT_W-1:0] announced_next =
        clearing ? {COUNT_W{1'b0}} : announced[more_slot] + more_count;

    always @(posedge clk) if (clearing || more_valid) announced[announced_slot] <= announced_next;

    // Terms less completed pixels, modulo 2^COUNT_W.
    reg [COUNT_W-1:0] ended[0:SLOTS-1];
    wire [SLOT_W-1:0] ended_slot = clearing ? clear_slot : term_slot;
    wire [COUNT_W-1:0] ended_next = clearing ? {COUNT_W{1'b0}} : ended[term_slot] + 1'b1;
    wire complete = ended[term_slot] == announced[term_slot];

    always @(posedge clk) if (clearing || term_valid && !complete) ended[ended_slot] <= ended_next;

    // A term waits for the sum that is read.
    reg add_reg;
    reg last_reg;
    reg [SLOT_W-1:0] slot_reg;
    reg [COLOUR_W-1:0] term_reg;
    // The slot is that of the term before, whose sum is written as this one's is read.
    reg again_reg;

    always @(posedge clk) begin
        if (rst) add_reg <= 1'b0;
        else add_reg <= term_valid;
    end

    always @(posedge clk) begin
        last_reg  <= complete;
        slot_reg  <= term_slot;
        term_reg  <= term_colour;
        again_reg <= add_reg && slot_reg == term_slot;
    end

    // The sums: one memory, one write, one registered read.
    reg [COLOUR_W-1:0] sums[0:SLOTS-1];
    reg [COLOUR_W-1:0] read_reg;
    reg [COLOUR_W-1:0] sum_reg;
    reg valid_reg;
    reg [SLOT_W-1:0] out_slot_reg;

    wire [COLOUR_W-1:0] base = again_reg ? sum_reg & {COLOUR_W{!valid_reg}} : read_reg;
    wire [COLOUR_W-1:0] sum;
    wire [SLOT_W-1:0] sum_slot = clearing ? clear_slot : slot_reg;
    wire [COLOUR_W-1:0] sum_next = sum & {COLOUR_W{!clearing && !last_reg}};

    genvar lane;
    generate
        for (lane = 0; lane < 3; lane = lane + 1) begin : g_lane
            wire [W:0] wide = {1'b0, base[lane*W+:W]} + {1'b0, term_reg[lane*W+:W]};

            assign sum[lane*W+:W] = wide[W-1:0] | {W{wide[W]}};
        end
    endgenerate

    always @(posedge clk) begin
        if (clearing || add_reg) sums[sum_slot] <= sum_next;
        read_reg <= sums[term_slot];
    end

    always @(posedge clk) begin
        sum_reg      <= sum;
        out_slot_reg <= slot_reg;
    end

    always @(posedge clk) begin
        if (rst) valid_reg <= 1'b0;
        else valid_reg <= add_reg && last_reg;
    end

    assign ready      = !clearing;
    assign out_valid  = valid_reg;
    assign out_slot   = out_slot_reg;
    assign out_colour = sum_reg;

endmodule

`default_nettype wire
