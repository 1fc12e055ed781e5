// SPDX-License-Identifier: Apache-2.0
//
// counters: what the core tells of its work.
//
// Parameters
//   UNITS  trace units
//
// Ports
//   frame_start, busy       a frame's work begins; goes on
//   primary, secondary, shadow   one clock each: a ray of this kind
//   tested                  a bit a trace unit: a test that counts
//   at_point, flat          one clock each: a light left out, a triangle without area
//   cycles, *_rays, tests   of the last frame, or of the one under way
//   lights_at_point, degenerate   since reset
//
// All counters have 32 bits and wrap. They show an event one clock later; what happens in the clock of
// frame_start belongs to no frame.

`default_nettype none

module counters #(
    parameter UNITS = 2
) (
    input  wire             clk,
    input  wire             rst,
    input  wire             frame_start,
    input  wire             busy,
    input  wire             primary,
    input  wire             secondary,
    input  wire             shadow,
    input  wire [UNITS-1:0] tested,
    input  wire             at_point,
    input  wire             flat,
    output wire [     31:0] cycles,
    output wire [     31:0] primary_rays,
    output wire [     31:0] secondary_rays,
    output wire [     31:0] shadow_rays,
    output wire [     31:0] tests,
    output wire [     31:0] lights_at_point,
    output wire [     31:0] degenerate
);

    localparam PER_FRAME = 5;

    function [31:0] number_of;
        input [UNITS-1:0] bits;
        integer k;
        begin
            number_of = 32'd0;
            for (k = 0; k < UNITS; k = k + 1) number_of = number_of + {31'd0, bits[k]};
        end
    endfunction

    wire [PER_FRAME*32-1:0] step = {
        {31'd0, busy}, {31'd0, primary}, {31'd0, secondary}, {31'd0, shadow}, number_of(tested)
    };
    reg [PER_FRAME*32-1:0] frame_reg;
    reg [31:0] at_point_reg;
    reg [31:0] flat_reg;

    genvar k;
    generate
        for (k = 0; k < PER_FRAME; k = k + 1) begin : g_counter
            always @(posedge clk) begin
                if (rst || frame_start) frame_reg[32*k+:32] <= 32'd0;
                else frame_reg[32*k+:32] <= frame_reg[32*k+:32] + step[32*k+:32];
            end
        end
    endgenerate

    always @(posedge clk) begin
        if (rst) begin
            at_point_reg <= 32'd0;
            flat_reg     <= 32'd0;
        end else begin
            at_point_reg <= at_point_reg + {31'd0, at_point};
            flat_reg     <= flat_reg + {31'd0, flat};
        end
    end

    assign {cycles, primary_rays, secondary_rays, shadow_rays, tests} = frame_reg;
    assign lights_at_point = at_point_reg;
    assign degenerate      = flat_reg;

endmodule

`default_nettype wire
