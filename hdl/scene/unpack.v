// SPDX-License-Identifier: Apache-2.0
//
// unpack: fields of any width from a stream of 32-bit words, most significant bit first.
//
// Ports
//   in_*         AXI4-Stream of words; `in_last` marks the last word of a frame
//   field_width  bits of the field wanted, 1 to FIELD_W, may change at any clock
//   field_valid  so many bits are there: `field` has them, right-aligned
//   field_take   the field is consumed; only where field_valid is high
//   lacking      the frame has ended and the field will never be whole
//   flush        forgets what is left of this frame and starts the next one; raised where `ended`
//   ended        the last word of the frame has arrived
//   surplus      a whole word or more is left in the buffer
//
// Rate one field a clock where words come fast enough. A frame is padded to whole words; what the
// padding holds is not looked at.

`default_nettype none

module unpack #(
    parameter FIELD_W = 19,
    parameter WIDTH_W = $clog2(FIELD_W + 1)
) (
    input  wire               clk,
    input  wire               rst,
    input  wire               in_valid,
    output wire               in_ready,
    input  wire [       31:0] in_data,
    input  wire               in_last,
    input  wire [WIDTH_W-1:0] field_width,
    output wire               field_valid,
    output wire [FIELD_W-1:0] field,
    input  wire               field_take,
    output wire               lacking,
    input  wire               flush,
    output wire               ended,
    output wire               surplus
);

    generate
        if (FIELD_W < 1 || FIELD_W > 32) begin : g_bad_width
            unpack_needs_a_FIELD_W_of_1_to_32 error ();
        end
    endgenerate

    // Bits wait left-aligned; a word is appended where it fits behind them.
    reg [63:0] buffer_reg;
    reg [6:0] count_reg;
    reg ended_reg;

    wire [6:0] wanted = {{7 - WIDTH_W{1'b0}}, field_width};

    assign ended       = ended_reg;
    assign surplus     = count_reg >= 7'd32;
    assign field_valid = count_reg >= wanted;
    assign lacking     = ended_reg && !field_valid;

    wire [63:0] aligned = buffer_reg >> (7'd64 - wanted);
    wire unused_aligned = &{1'b0, aligned[63:FIELD_W]};
    assign field = aligned[FIELD_W-1:0];

    // A word fits where what is left beside the field that is taken leaves room for it.
    wire [6:0] taken = field_take ? wanted : 7'd0;
    wire [6:0] left = count_reg - taken;
    assign in_ready = !ended_reg && left <= 7'd32;

    wire push = in_valid && in_ready;
    wire [63:0] left_bits = buffer_reg << taken;
    wire [63:0] pushed_bits = {in_data, 32'b0} >> left;

    always @(posedge clk) begin
        if (rst || flush) begin
            count_reg <= 7'd0;
            ended_reg <= 1'b0;
        end else begin
            count_reg <= push ? left + 7'd32 : left;
            if (push && in_last) ended_reg <= 1'b1;
        end
    end

    // Bits behind the last one are zero, so that the next word can be added to them.
    always @(posedge clk) begin
        if (rst || flush) buffer_reg <= 64'b0;
        else buffer_reg <= left_bits | (push ? pushed_bits : 64'b0);
    end

endmodule

`default_nettype wire
