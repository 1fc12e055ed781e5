// SPDX-License-Identifier: Apache-2.0
//
// merge: several valid/ready streams into one, fairly: those that wait are served in turn, by number.
// While a stream waits each of the others is served once at most.
//
// Parameters
//   PORTS  streams, at least 1
//   WIDTH  bits of an item
//
// Ports
//   in_*   the streams; stream k is bit k and bits k * WIDTH and up
//   out_*  items of all of them, each once, those of one stream in order
//
// Latency 1 where the output is free; rate one item a clock.

`default_nettype none

module merge #(
    parameter PORTS = 2,
    parameter WIDTH = 32
) (
    input  wire                   clk,
    input  wire                   rst,
    input  wire [      PORTS-1:0] in_valid,
    output wire [      PORTS-1:0] in_ready,
    input  wire [PORTS*WIDTH-1:0] in_data,
    output wire                   out_valid,
    input  wire                   out_ready,
    output wire [      WIDTH-1:0] out_data
);

    generate
        if (PORTS < 1) begin : g_bad_ports
            merge_needs_at_least_one_of_PORTS error ();
        end
    endgenerate

    // The stream that was served last, and those below it: the others come first.
    reg [PORTS-1:0] served_reg;
    reg valid_reg;
    reg [WIDTH-1:0] data_reg;

    wire [PORTS-1:0] fresh = in_valid & ~served_reg;
    wire [PORTS-1:0] asking = fresh != {PORTS{1'b0}} ? fresh : in_valid;
    // The lowest one that asks
    wire [PORTS-1:0] grant = asking & (~asking + 1'b1);
    wire free = !valid_reg || out_ready;
    wire any = in_valid != {PORTS{1'b0}};
    reg [WIDTH-1:0] chosen;

    integer k;
    always @* begin
        chosen = {WIDTH{1'b0}};
        for (k = 0; k < PORTS; k = k + 1)
            chosen = chosen | (in_data[k*WIDTH+:WIDTH] & {WIDTH{grant[k]}});
    end

    always @(posedge clk) begin
        if (rst) served_reg <= {PORTS{1'b0}};
        else if (free && any) served_reg <= grant | (grant - 1'b1);
    end

    always @(posedge clk) begin
        if (rst) valid_reg <= 1'b0;
        else if (free) valid_reg <= any;
    end

    always @(posedge clk) if (free) data_reg <= chosen;

    assign in_ready  = grant & {PORTS{free}};
    assign out_valid = valid_reg;
    assign out_data  = data_reg;

endmodule

`default_nettype wire
