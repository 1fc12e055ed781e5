// SPDX-License-Identifier: Apache-2.0
//
// core_watch: holds the core to its promises about room, whatever it draws; part of core_tb.
//
// Parameters
//   LEVELS      depths of the ray store that have places of their own
//   LEVEL_ROOM  places of each
//   QUEUES      queues that must never be given more than they hold
//   WAITS       places where the core may have to wait
//
// Ports
//   done             one clock: a frame has been drawn
//   free, stored     by depth, 32 bits each: places that nothing is stored in nor reserved, rays stored
//   child, settled   by depth, 2 bits each: so many reserved places are used, or given back
//   queue_lost       a queue is given an item that it has no room for
//   home             every place that a ray, a step or a term takes is free
//   waiting          something waits here
//   breaches         since reset: {a place not given back at the end of a frame, queue_lost, more places
//                    used or given back than are reserved, more places than there are}
//   waits            since reset: something has waited here

`default_nettype none

module core_watch #(
    parameter LEVELS     = 4,
    parameter LEVEL_ROOM = 256,
    parameter QUEUES     = 4,
    parameter WAITS      = 4
) (
    input  wire                 clk,
    input  wire                 rst,
    input  wire                 done,
    input  wire [32*LEVELS-1:0] free,
    input  wire [32*LEVELS-1:0] stored,
    input  wire [ 2*LEVELS-1:0] child,
    input  wire [ 2*LEVELS-1:0] settled,
    input  wire [   QUEUES-1:0] queue_lost,
    input  wire                 home,
    input  wire [    WAITS-1:0] waiting,
    output wire [          3:0] breaches,
    output wire [    WAITS-1:0] waits
);

    wire [LEVELS-1:0] too_many;
    wire [LEVELS-1:0] unreserved;
    wire [LEVELS-1:0] all_free;

    genvar k;
    generate
        for (k = 0; k < LEVELS; k = k + 1) begin : g_level
            wire [31:0] taken = free[32*k+:32] + stored[32*k+:32];
            wire [31:0] reserved = LEVEL_ROOM - taken;
            wire [31:0] ends = {30'd0, child[2*k+:2]} + {30'd0, settled[2*k+:2]};

            // A number that has gone below zero is a large one.
            assign too_many[k]   = free[32*k+:32] > LEVEL_ROOM || stored[32*k+:32] > LEVEL_ROOM
                                || taken > LEVEL_ROOM;
            assign unreserved[k] = ends > reserved;
            assign all_free[k]   = free[32*k+:32] == LEVEL_ROOM;
        end
    endgenerate

    // What is not known, as before the first frame, is no breach and waits for nothing.
    wire [WAITS+3:0] now = {waiting, done && !(home && &all_free), |queue_lost, |unreserved, |too_many};
    reg [WAITS+3:0] seen_reg;

    generate
        for (k = 0; k < WAITS + 4; k = k + 1) begin : g_seen
            always @(posedge clk) begin
                if (rst) seen_reg[k] <= 1'b0;
                else if (now[k]) seen_reg[k] <= 1'b1;
            end
        end
    endgenerate

    assign {waits, breaches} = seen_reg;

endmodule

`default_nettype wire
