// SPDX-License-Identifier: Apache-2.0
//
// block_shift: block floating point, one exponent for a whole vector.
//
// All components are shifted left by the largest `shift` that lets none of them overflow, which is
// the number of redundant sign bits of the largest one: the number of bits below the sign, from
// the top, that equal the sign in every component. It is at most IN_W - 1, which components that
// are all 0 or -1 give. Then the top OUT_W bits are kept (floor); where OUT_W > IN_W zeros are
// appended. So p = floor(a * 2^shift * 2^(OUT_W-IN_W)).
//
// Parameters
//   IN_W   bits of a component, signed, at least 2
//   OUT_W  bits of a component of the result, signed
//   LANES  components
//   TAG_W  bits of the caller's sideband data
//
// Ports     a: vector; p: vector; shift: unsigned
//
// Latency 2 (count, shift), rate one vector a clock.

`default_nettype none

module block_shift #(
    parameter IN_W  = 19,
    parameter OUT_W = 18,
    parameter LANES = 3,
    parameter TAG_W = 1
) (
    input  wire                    clk,
    input  wire                    rst,
    input  wire                    in_valid,
    input  wire [       TAG_W-1:0] in_tag,
    input  wire [  LANES*IN_W-1:0] a,
    output wire                    out_valid,
    output wire [       TAG_W-1:0] out_tag,
    output wire [ LANES*OUT_W-1:0] p,
    output wire [$clog2(IN_W)-1:0] shift
);

    localparam SHIFT_W = $clog2(IN_W);
    // The count works on a power of two of bits; the ones below the vector's bits end it.
    localparam SPAN = 1 << SHIFT_W;

    wire [IN_W-2:0] significant[0:LANES];
    reg [LANES*IN_W-1:0] a_reg;
    reg [SHIFT_W-1:0] count_reg;
    reg [LANES*OUT_W-1:0] p_reg;
    reg [SHIFT_W-1:0] shift_reg;
    wire [LANES*OUT_W-1:0] p_next;

    assign significant[0] = {IN_W - 1{1'b0}};

    genvar lane;
    generate
        if (IN_W < 2) begin : g_bad_width
            block_shift_needs_IN_W_of_2_or_more error ();
        end

        for (lane = 0; lane < LANES; lane = lane + 1) begin : g_lane
            // Bits that differ from the sign, of this lane and those before it.
            assign significant[lane+1] = significant[lane]
                | (a[lane*IN_W+:IN_W-1] ^ {IN_W - 1{a[lane*IN_W+IN_W-1]}});

            wire [IN_W-1:0] shifted = a_reg[lane*IN_W+:IN_W] << count_reg;

            if (OUT_W > IN_W) begin : g_append
                assign p_next[lane*OUT_W+:OUT_W] = {shifted, {OUT_W - IN_W{1'b0}}};
            end else begin : g_keep
                assign p_next[lane*OUT_W+:OUT_W] = shifted[IN_W-1:IN_W-OUT_W];
            end

            if (OUT_W < IN_W) begin : g_drop
                wire unused_low = &{1'b0, shifted[IN_W-OUT_W-1:0]};
            end
        end
    endgenerate

    // Leading zeros, by halves: where the upper half is zero, look at the lower one.
    function [SHIFT_W-1:0] leading_zeros;
        input [SPAN-1:0] bits;
        reg [SPAN-1:0] rest;
        integer i;
        begin
            rest = bits;
            for (i = SHIFT_W - 1; i >= 0; i = i - 1) begin
                leading_zeros[i] = (rest >> (SPAN - (1 << i))) == {SPAN{1'b0}};
                if (leading_zeros[i]) rest = rest << (1 << i);
            end
        end
    endfunction

    always @(posedge clk) begin
        a_reg <= a;
        count_reg <= leading_zeros({significant[LANES], {SPAN - IN_W + 1{1'b1}}});
    end

    always @(posedge clk) begin
        p_reg <= p_next;
        shift_reg <= count_reg;
    end

    assign p = p_reg;
    assign shift = shift_reg;

    valid_pipe #(
        .TAG_W  (TAG_W),
        .LATENCY(2)
    ) u_valid (
        .clk      (clk),
        .rst      (rst),
        .in_valid (in_valid),
        .in_tag   (in_tag),
        .out_valid(out_valid),
        .out_tag  (out_tag)
    );

endmodule

`default_nettype wire
