// SPDX-License-Identifier: Apache-2.0
//
// ray_store: the pending rays. Takes primary rays and children, sends the deepest first.
//
// Rays of each depth from 2 on have LEVEL_ROOM places of their own. A ray that may have children
// is sent only where the next depth has `branches` free places, which are reserved for them, so
// that a child never waits. A place of a child that does not come is given back by a settle.
//
// Neither overflow nor deadlock: children come only to reserved places. The deepest rays need no
// places, so they always leave; then rays one depth above find theirs free, and so on up to the
// primary rays. It holds for any LEVEL_ROOM that is not below `branches`, as long as rays that are
// sent are answered.
//
// Parameters
//   RAY_W       bits of a ray
//   MAX_DEPTH   deepest rays there are, 1 to 7
//   LEVEL_ROOM  rays stored of one depth, a power of two, at least 4
//   DEPTH_W     bits of a depth
//
// Ports
//   max_depth     of this frame, 1 to MAX_DEPTH
//   branches      most children of one ray of this frame, 0 to 2
//                 (both hold still while anything is stored, sent or reserved)
//   primary_*     stream of rays of depth 1; primary_ready does not depend on ray_ready
//   child_*       a ray of depth 2 to max_depth; one of those reserved, never waits
//   settle_*      so many places reserved at this depth stay empty; with a child or without
//   ray_*         stream of rays to trace and their depths. A ray of a depth below max_depth is
//                 followed by `branches` children and places settled in all, at depth + 1
//   idle          nothing stored, nothing at the output; what is reserved does not count
//
// Which goes first: in each clock that begins with less than two rays at the output, the deepest
// ray that may go; of one depth the oldest. Rays that have been chosen leave in the order of the
// choice. A place is free in the clock after its ray has been chosen.
//
// Latency 1 from a primary ray to ray_valid, 2 from a child; rate one ray a clock. A place is taken
// from the clock before the parent's ray_valid to the clock of the child or the settle, so primary
// rays come at full rate where LEVEL_ROOM is `branches` times these clocks, both included.

`default_nettype none

module ray_store #(
    parameter RAY_W      = 64,
    parameter MAX_DEPTH  = 5,
    parameter LEVEL_ROOM = 256,
    parameter DEPTH_W    = 3
) (
    input  wire               clk,
    input  wire               rst,
    input  wire [DEPTH_W-1:0] max_depth,
    input  wire [        1:0] branches,
    input  wire               primary_valid,
    output wire               primary_ready,
    input  wire [  RAY_W-1:0] primary,
    input  wire               child_valid,
    input  wire [DEPTH_W-1:0] child_depth,
    input  wire [  RAY_W-1:0] child,
    input  wire               settle_valid,
    input  wire [DEPTH_W-1:0] settle_depth,
    input  wire [        1:0] settle_count,
    output wire               ray_valid,
    input  wire               ray_ready,
    output wire [DEPTH_W-1:0] ray_depth,
    output wire [  RAY_W-1:0] ray,
    output wire               idle
);

    localparam PTR_W  = $clog2(LEVEL_ROOM);
    localparam FREE_W = PTR_W + 1;
    // Depths 2 to TOP have a level; one that is never used where all rays are primary.
    localparam TOP    = MAX_DEPTH > 1 ? MAX_DEPTH : 2;
    localparam LEVELS = TOP - 1;
    localparam ADDR_W = $clog2(LEVELS * LEVEL_ROOM);

    generate
        if (RAY_W < 1 || MAX_DEPTH < 1 || MAX_DEPTH > 7 || TOP >= 1 << DEPTH_W) begin : g_bad_depth
            ray_store_needs_a_MAX_DEPTH_of_1_to_7_that_DEPTH_W_holds error ();
        end
        if (LEVEL_ROOM < 4 || LEVEL_ROOM != 1 << PTR_W) begin : g_bad_room
            ray_store_needs_a_LEVEL_ROOM_of_4_or_more_that_is_a_power_of_two error ();
        end
    endgenerate

    reg read_valid_reg;
    reg skid_valid_reg;
    wire output_room = !skid_valid_reg;

    // By depth: a ray may go; a deeper one may; this one goes. Above TOP nothing may.
    wire [TOP+1:1] may;
    wire [TOP+1:1] deeper;
    wire [TOP:1] goes;
    // By depth: places enough for the children of a ray; something is stored. Below max_depth
    // nothing is ever reserved, so that the deepest rays find enough there without being asked.
    wire [TOP:2] enough;
    wire [TOP:2] holds;
    // Pointers of the depths up to this one that are concerned, others are zero.
    wire [TOP*PTR_W-1:0] heads;
    wire [TOP*PTR_W-1:0] tails;
    wire [TOP*DEPTH_W-1:0] depths;

    assign may[TOP+1]    = 1'b0;
    assign deeper[TOP+1] = 1'b0;
    assign may[1]        = primary_valid && enough[2];
    assign deeper[1]     = deeper[2] || may[2];
    assign goes[1]       = may[1] && !deeper[1] && output_room;

    assign primary_ready = enough[2] && !deeper[1] && output_room;

    assign heads[PTR_W-1:0]    = {PTR_W{1'b0}};
    assign tails[PTR_W-1:0]    = {PTR_W{1'b0}};
    assign depths[DEPTH_W-1:0] = {{DEPTH_W - 1{1'b0}}, goes[1]};

    genvar k;
    generate
        for (k = 2; k <= TOP; k = k + 1) begin : g_level
            localparam [DEPTH_W-1:0] DEPTH = k;

            reg [PTR_W:0] head_reg;
            reg [PTR_W:0] tail_reg;
            // Places that are neither stored in nor reserved.
            reg [FREE_W-1:0] free_reg;

            wire comes = child_valid && child_depth == DEPTH;
            wire settles = settle_valid && settle_depth == DEPTH;
            // A ray one depth above goes, and it may have children.
            wire reserves = goes[k-1] && max_depth >= DEPTH;

            assign holds[k]  = head_reg != tail_reg;
            assign enough[k] = free_reg >= {{FREE_W - 2{1'b0}}, branches};

            if (k == TOP) begin : g_top
                assign may[k] = holds[k];
            end else begin : g_below
                assign may[k] = holds[k] && enough[k+1];
            end
            assign deeper[k] = deeper[k+1] || may[k+1];
            assign goes[k]   = may[k] && !deeper[k] && output_room;

            always @(posedge clk) begin
                if (rst) begin
                    head_reg <= {PTR_W + 1{1'b0}};
                    tail_reg <= {PTR_W + 1{1'b0}};
                end else begin
                    if (goes[k]) head_reg <= head_reg + 1'b1;
                    if (comes) tail_reg <= tail_reg + 1'b1;
                end
            end

            always @(posedge clk) begin
                if (rst) free_reg <= {1'b1, {PTR_W{1'b0}}};
                else
                    free_reg <= free_reg + {{FREE_W - 1{1'b0}}, goes[k]}
                        + {{FREE_W - 2{1'b0}}, settles ? settle_count : 2'd0}
                        - {{FREE_W - 2{1'b0}}, reserves ? branches : 2'd0};
            end

            assign heads[(k-1)*PTR_W+:PTR_W] =
                heads[(k-2)*PTR_W+:PTR_W] | head_reg[PTR_W-1:0] & {PTR_W{goes[k]}};
            assign tails[(k-1)*PTR_W+:PTR_W] =
                tails[(k-2)*PTR_W+:PTR_W] | tail_reg[PTR_W-1:0] & {PTR_W{child_depth == DEPTH}};
            assign depths[(k-1)*DEPTH_W+:DEPTH_W] =
                depths[(k-2)*DEPTH_W+:DEPTH_W] | DEPTH & {DEPTH_W{goes[k]}};
        end
    endgenerate

    wire choose = goes != {TOP{1'b0}};
    wire [DEPTH_W-1:0] choice = depths[(TOP-1)*DEPTH_W+:DEPTH_W];

    // The rays: one memory, one write, one registered read. A level stands behind the other.
    wire [DEPTH_W-1:0] read_level = choice - 2'd2;
    wire [DEPTH_W-1:0] write_level = child_depth - 2'd2;
    wire [DEPTH_W+PTR_W-1:0] read_addr = {read_level, heads[(TOP-1)*PTR_W+:PTR_W]};
    wire [DEPTH_W+PTR_W-1:0] write_addr = {write_level, tails[(TOP-1)*PTR_W+:PTR_W]};

    reg [RAY_W-1:0] rays[0:LEVELS*LEVEL_ROOM-1];
    reg [RAY_W-1:0] read_reg;
    reg [RAY_W-1:0] primary_reg;
    reg [DEPTH_W-1:0] depth_reg;
    reg primary_chosen_reg;

    always @(posedge clk) begin
        if (child_valid) rays[write_addr[ADDR_W-1:0]] <= child;
        if (choose) read_reg <= rays[read_addr[ADDR_W-1:0]];
    end

    always @(posedge clk) begin
        if (choose) begin
            primary_reg        <= primary;
            depth_reg          <= choice;
            primary_chosen_reg <= goes[1];
        end
    end

    // A ray is chosen before it is known whether the one that was read before it leaves. The one
    // that does not goes to the skid register.
    wire [RAY_W-1:0] read_ray = primary_chosen_reg ? primary_reg : read_reg;

    reg [RAY_W-1:0] skid_reg;
    reg [DEPTH_W-1:0] skid_depth_reg;

    always @(posedge clk) begin
        if (rst) read_valid_reg <= 1'b0;
        else if (choose) read_valid_reg <= 1'b1;
        else if (ray_ready && !skid_valid_reg) read_valid_reg <= 1'b0;
    end

    always @(posedge clk) begin
        if (rst) skid_valid_reg <= 1'b0;
        else if (skid_valid_reg) skid_valid_reg <= !ray_ready;
        else skid_valid_reg <= choose && read_valid_reg && !ray_ready;
    end

    always @(posedge clk) begin
        if (!skid_valid_reg) begin
            skid_reg       <= read_ray;
            skid_depth_reg <= depth_reg;
        end
    end

    assign ray_valid = skid_valid_reg || read_valid_reg;
    assign ray       = skid_valid_reg ? skid_reg : read_ray;
    assign ray_depth = skid_valid_reg ? skid_depth_reg : depth_reg;
    assign idle      = !ray_valid && holds == {TOP - 1{1'b0}};

    wire unused_addr = &{1'b0, read_addr, write_addr};

endmodule

`default_nettype wire
