// SPDX-License-Identifier: Apache-2.0
//
// delay: `out` is `in`, DEPTH clocks later.
//
// The data path of sideband signals (tags) beside a pipelined unit. A short delay is a chain of
// registers. From 4 clocks on it is a ring buffer: a memory of DEPTH - 1 words that is read and
// then overwritten at one pointer, and a register behind it. That is one memory instead of DEPTH
// registers, in the FPGA and in the simulator.
//
// Parameters
//   WIDTH  bits
//   DEPTH  clocks; 0 is a wire
//
// Latency DEPTH, rate one word a clock. Only the pointer of the ring is reset, the data are not:
// in the first DEPTH clocks after power-up `out` is unknown, so it wants a valid bit beside it
// (see valid_pipe).

`default_nettype none

module delay #(
    parameter WIDTH = 1,
    parameter DEPTH = 1
) (
    input  wire             clk,
    input  wire             rst,
    input  wire [WIDTH-1:0] in,
    output wire [WIDTH-1:0] out
);

    generate
        if (DEPTH < 0) begin : g_bad_depth
            delay_needs_a_DEPTH_of_0_or_more error ();
        end

        if (DEPTH == 0) begin : g_wire
            wire unused_controls = &{1'b0, clk, rst};
            assign out = in;
        end else if (DEPTH < 4) begin : g_chain
            wire unused_rst = rst;
            reg [DEPTH*WIDTH-1:0] chain_reg;
            wire [(DEPTH+1)*WIDTH-1:0] chain_next = {chain_reg, in};

            always @(posedge clk) chain_reg <= chain_next[DEPTH*WIDTH-1:0];

            assign out = chain_next[DEPTH*WIDTH+:WIDTH];
        end else begin : g_ring
            localparam WORDS = DEPTH - 1;
            localparam POINTER_W = $clog2(WORDS);
            localparam [POINTER_W-1:0] LAST = WORDS[POINTER_W-1:0] - 1'b1;

            reg [WIDTH-1:0] ring[0:WORDS-1];
            reg [WIDTH-1:0] out_reg;
            reg [POINTER_W-1:0] pointer_reg;

            always @(posedge clk) begin
                out_reg <= ring[pointer_reg];
                ring[pointer_reg] <= in;
            end

            always @(posedge clk) begin
                if (rst || pointer_reg == LAST) pointer_reg <= {POINTER_W{1'b0}};
                else pointer_reg <= pointer_reg + 1'b1;
            end

            assign out = out_reg;
        end
    endgenerate

endmodule

`default_nettype wire
