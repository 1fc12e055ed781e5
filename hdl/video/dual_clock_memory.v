// SPDX-License-Identifier: Apache-2.0
//
// dual_clock_memory: written on one clock, read on another, as block memory does it.
//
// Parameters
//   WIDTH  bits of a word
//   WORDS  number of words, at least 2
//
// Latency 1 from read_address to read_data, rate one word a clock on either side. A word that is
// read while it is written is unknown: who uses this keeps the two apart.

`default_nettype none

module dual_clock_memory #(
    parameter WIDTH     = 16,
    parameter WORDS     = 1024,
    parameter ADDRESS_W = $clog2(WORDS)
) (
    input  wire                 write_clk,
    input  wire                 write_enable,
    input  wire [ADDRESS_W-1:0] write_address,
    input  wire [    WIDTH-1:0] write_data,
    input  wire                 read_clk,
    input  wire [ADDRESS_W-1:0] read_address,
    output wire [    WIDTH-1:0] read_data
);

    generate
        if (WORDS < 2) begin : g_bad_words
            dual_clock_memory_needs_WORDS_of_at_least_2 error ();
        end
    endgenerate

    reg [WIDTH-1:0] words[0:WORDS-1];
    reg [WIDTH-1:0] read_data_reg;

    always @(posedge write_clk) if (write_enable) words[write_address] <= write_data;

    always @(posedge read_clk) read_data_reg <= words[read_address];

    assign read_data = read_data_reg;

endmodule

`default_nettype wire
