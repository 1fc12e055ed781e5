// SPDX-License-Identifier: Apache-2.0
//
// fifo: a queue between two valid/ready streams, in order.
//
// The memory has one write and one registered read, so that synthesis may take block RAM; up to 64
// places it is asked for distributed RAM. The register of the read is the output: the oldest item is
// fetched before it is asked for.
//
// Parameters
//   WIDTH  bits of an item
//   DEPTH  items held, the one at the output among them; a power of two, at least 2
//
// Ports
//   in_*   stream of items; in_ready does not depend on out_ready
//   out_*  the same items
//   room   items that may still be accepted; room and items held make DEPTH at every clock
//
// Latency 2 from an item in to out_valid where nothing is before it. Rate one item a clock where
// DEPTH is at least 4; of 2 places each is taken for two clocks, which gives two items in three.

`default_nettype none

module fifo #(
    parameter WIDTH = 32,
    parameter DEPTH = 16
) (
    input  wire                   clk,
    input  wire                   rst,
    input  wire                   in_valid,
    output wire                   in_ready,
    input  wire [      WIDTH-1:0] in_data,
    output wire                   out_valid,
    input  wire                   out_ready,
    output wire [      WIDTH-1:0] out_data,
    output wire [$clog2(DEPTH):0] room
);

    localparam ADDR_W = $clog2(DEPTH);

    generate
        if (WIDTH < 1 || DEPTH < 2 || DEPTH != 1 << ADDR_W) begin : g_bad_depth
            fifo_needs_a_WIDTH_and_a_DEPTH_of_2_or_more_that_is_a_power_of_two error ();
        end
    endgenerate

    reg [ADDR_W:0] room_reg;
    reg [ADDR_W-1:0] head_reg;
    reg [ADDR_W-1:0] tail_reg;
    // Items in the memory that are not fetched yet.
    reg [ADDR_W:0] stored_reg;
    reg valid_reg;

    wire push = in_valid && in_ready;
    wire pop = valid_reg && out_ready;
    wire fetch = stored_reg != {ADDR_W + 1{1'b0}} && (!valid_reg || out_ready);

    always @(posedge clk) begin
        if (rst) room_reg <= {1'b1, {ADDR_W{1'b0}}};
        else if (push && !pop) room_reg <= room_reg - 1'b1;
        else if (pop && !push) room_reg <= room_reg + 1'b1;
    end

    always @(posedge clk) begin
        if (rst) stored_reg <= {ADDR_W + 1{1'b0}};
        else if (push && !fetch) stored_reg <= stored_reg + 1'b1;
        else if (fetch && !push) stored_reg <= stored_reg - 1'b1;
    end

    always @(posedge clk) begin
        if (rst) begin
            head_reg <= {ADDR_W{1'b0}};
            tail_reg <= {ADDR_W{1'b0}};
        end else begin
            if (fetch) head_reg <= head_reg + 1'b1;
            if (push) tail_reg <= tail_reg + 1'b1;
        end
    end

    // The items: one memory, one write, one registered read. A short queue would fill a fraction of
    // its block RAMs, of which wide items take many.
    // verilator lint_off UNUSEDPARAM
    // (Only synthesis reads the attribute.)
    localparam STYLE = DEPTH <= 64 ? "distributed" : "auto";
    // verilator lint_on UNUSEDPARAM
    (* ram_style = STYLE *)
    reg [WIDTH-1:0] items[0:DEPTH-1];
    reg [WIDTH-1:0] data_reg;

    always @(posedge clk) begin
        if (push) items[tail_reg] <= in_data;
        if (fetch) data_reg <= items[head_reg];
    end

    always @(posedge clk) begin
        if (rst) valid_reg <= 1'b0;
        else if (fetch) valid_reg <= 1'b1;
        else if (out_ready) valid_reg <= 1'b0;
    end

    assign in_ready  = room_reg != {ADDR_W + 1{1'b0}};
    assign out_valid = valid_reg;
    assign out_data  = data_reg;
    assign room      = room_reg;

endmodule

`default_nettype wire
