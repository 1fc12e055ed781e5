// SPDX-License-Identifier: Apache-2.0
//
// steps: the steps in which a hit is shaded, one a light (book 8.2.3).
//
// A hit takes one step for each light of the frame, two at least where it may have a reflected and
// a transmitted ray, and one at least; a ray that missed takes one. Each step ends as a direct term
// or as a shadow ray. Which of them is not known before, so a step begins only where there is
// a place for either, and nothing behind it has to wait.
//
// Parameters
//   ITEM_W   bits of a hit, which pass unseen
//   LIGHT_W  bits of a number of lights
//   ROOM     places of direct terms, and of shadow rays, at least 2
//
// Ports
//   lights        of the frame
//   in_*          stream of hits and misses: `in_hit`; `in_branching`: there may be two children
//   direct_back, shadow_back   so many places, 0 to 2, are free again
//   out_valid     a step: its `out_item`, its number `out_step` from 0 on, and `out_more`, the number
//                 of its hit's last step
//
// Latency 1 from a hit to its first step, rate one step a clock.

`default_nettype none

module steps #(
    parameter ITEM_W  = 64,
    parameter LIGHT_W = 2,
    parameter ROOM    = 256
) (
    input  wire               clk,
    input  wire               rst,
    input  wire [LIGHT_W-1:0] lights,
    input  wire               in_valid,
    output wire               in_ready,
    input  wire [ ITEM_W-1:0] in_item,
    input  wire               in_hit,
    input  wire               in_branching,
    input  wire [        1:0] direct_back,
    input  wire [        1:0] shadow_back,
    output wire               out_valid,
    output wire [ ITEM_W-1:0] out_item,
    output wire [LIGHT_W-1:0] out_step,
    output wire [LIGHT_W-1:0] out_more
);

    localparam ROOM_W = $clog2(ROOM) + 1;
    localparam [ROOM_W-1:0] ALL = ROOM[ROOM_W-1:0];
    localparam [LIGHT_W-1:0] ONE = 1;

    generate
        if (LIGHT_W < 2) begin : g_bad_lights
            steps_needs_a_LIGHT_W_that_counts_to_two error ();
        end
        if (ROOM < 2) begin : g_bad_room
            steps_needs_a_ROOM_of_2_or_more error ();
        end
    endgenerate

    reg valid_reg;
    reg [ITEM_W-1:0] item_reg;
    reg [LIGHT_W-1:0] step_reg;
    reg [LIGHT_W-1:0] more_reg;
    reg [ROOM_W-1:0] direct_room_reg;
    reg [ROOM_W-1:0] shadow_room_reg;

    wire room = direct_room_reg != {ROOM_W{1'b0}} && shadow_room_reg != {ROOM_W{1'b0}};
    wire step = valid_reg && room;
    wire last = step_reg == more_reg;
    wire [LIGHT_W-1:0] for_lights = lights == {LIGHT_W{1'b0}} ? {LIGHT_W{1'b0}} : lights - ONE;
    wire [LIGHT_W-1:0] for_children = {{LIGHT_W - 1{1'b0}}, in_branching};
    wire [LIGHT_W-1:0] for_hit = for_lights > for_children ? for_lights : for_children;

    assign in_ready = !valid_reg || step && last;

    always @(posedge clk) begin
        if (rst) valid_reg <= 1'b0;
        else if (in_ready) valid_reg <= in_valid;
    end

    always @(posedge clk) begin
        if (in_ready) begin
            item_reg <= in_item;
            more_reg <= in_hit ? for_hit : {LIGHT_W{1'b0}};
        end
    end

    always @(posedge clk) begin
        if (in_ready) step_reg <= {LIGHT_W{1'b0}};
        else if (step) step_reg <= step_reg + ONE;
    end

    always @(posedge clk) begin
        if (rst) begin
            direct_room_reg <= ALL;
            shadow_room_reg <= ALL;
        end else begin
            direct_room_reg <= direct_room_reg + {{ROOM_W - 2{1'b0}}, direct_back}
                             - {{ROOM_W - 1{1'b0}}, step};
            shadow_room_reg <= shadow_room_reg + {{ROOM_W - 2{1'b0}}, shadow_back}
                             - {{ROOM_W - 1{1'b0}}, step};
        end
    end

    assign out_valid = step;
    assign out_item  = item_reg;
    assign out_step  = step_reg;
    assign out_more  = more_reg;

endmodule

`default_nettype wire
