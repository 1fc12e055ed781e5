// SPDX-License-Identifier: Apache-2.0
//
// dispatch: which trace unit takes which ray.
//
// In one clock one ray and one shadow ray may start, in different units. A shadow ray goes to the
// first unit that may take one, a ray to the last of the others. Where both want the only unit the
// shadow ray goes first: it makes room, a ray needs it.
//
// Parameters
//   UNITS  trace units, at least 1
//
// Ports
//   ray_valid, ray_ready, shadow_valid, shadow_ready    handshakes of both streams
//   ray_free, shadow_free     units that may take a ray, a shadow ray
//   ray_start, shadow_start   the unit that takes it in this clock; one bit each at most
//
// Combinational.

`default_nettype none

module dispatch #(
    parameter UNITS = 2
) (
    input  wire             ray_valid,
    output wire             ray_ready,
    input  wire             shadow_valid,
    output wire             shadow_ready,
    input  wire [UNITS-1:0] ray_free,
    input  wire [UNITS-1:0] shadow_free,
    output wire [UNITS-1:0] ray_start,
    output wire [UNITS-1:0] shadow_start
);

    wire [UNITS-1:0] first = shadow_free & (~shadow_free + 1'b1);
    wire [UNITS-1:0] left = ray_free & ~shadow_start;

    genvar unit;
    generate
        if (UNITS < 1) begin : g_bad_units
            dispatch_needs_at_least_one_of_UNITS error ();
        end

        for (unit = 0; unit < UNITS; unit = unit + 1) begin : g_last
            assign ray_start[unit] = ray_valid && left[unit] && (left >> unit) == 1;
        end
    endgenerate

    assign shadow_start = first & {UNITS{shadow_valid}};
    assign shadow_ready = shadow_free != {UNITS{1'b0}};
    assign ray_ready    = left != {UNITS{1'b0}};

endmodule

`default_nettype wire
