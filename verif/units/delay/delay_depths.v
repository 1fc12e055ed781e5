// SPDX-License-Identifier: Apache-2.0
//
// delay_depths: delay lines of every depth from 0 to DEPTHS - 1 on one input, for the bench.
//
// Parameters
//   WIDTH   bits of a line
//   DEPTHS  lines
//
// Ports     out: the line of depth 0 is in the least significant bits

`default_nettype none

module delay_depths #(
    parameter WIDTH  = 8,
    parameter DEPTHS = 12
) (
    input  wire                    clk,
    input  wire                    rst,
    input  wire [       WIDTH-1:0] in,
    output wire [DEPTHS*WIDTH-1:0] out
);

    genvar depth;
    generate
        for (depth = 0; depth < DEPTHS; depth = depth + 1) begin : g_depth
            delay #(
                .WIDTH(WIDTH),
                .DEPTH(depth)
            ) u_delay (
                .clk(clk),
                .rst(rst),
                .in (in),
                .out(out[depth*WIDTH+:WIDTH])
            );
        end
    endgenerate

endmodule

`default_nettype wire
