// SPDX-License-Identifier: Apache-2.0
//
// valid_pipe: the valid bit and the tag that travel beside the data of a pipelined unit.
//
// Parameters
//   TAG_W    bits of the tag, the caller's sideband data
//   LATENCY  clocks from in_valid to out_valid; 0 is a wire
//
// Latency LATENCY, rate one a clock. Reset clears the valid bits, so nothing that was in flight
// comes out; tags are not reset and mean nothing where out_valid is 0.

`default_nettype none

module valid_pipe #(
    parameter TAG_W   = 1,
    parameter LATENCY = 1
) (
    input  wire             clk,
    input  wire             rst,
    input  wire             in_valid,
    input  wire [TAG_W-1:0] in_tag,
    output wire             out_valid,
    output wire [TAG_W-1:0] out_tag
);

    generate
        if (LATENCY == 0) begin : g_wire
            assign out_valid = in_valid;
        end else begin : g_shift
            reg  [LATENCY-1:0] valid_reg;
            wire [  LATENCY:0] valid_next = {valid_reg, in_valid};

            always @(posedge clk) begin
                if (rst) valid_reg <= {LATENCY{1'b0}};
                else valid_reg <= valid_next[LATENCY-1:0];
            end

            assign out_valid = valid_next[LATENCY];
        end
    endgenerate

    delay #(
        .WIDTH(TAG_W),
        .DEPTH(LATENCY)
    ) u_tag (
        .clk(clk),
        .rst(rst),
        .in (in_tag),
        .out(out_tag)
    );

endmodule

`default_nettype wire
