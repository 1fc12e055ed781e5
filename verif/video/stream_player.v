// SPDX-License-Identifier: Apache-2.0
//
// stream_player: the pixels of the file stream.bin as an AXI4-Stream, a pixel a clock.
//
// A word of the file is 32 bits, big-endian: {6 zeros, tuser, tlast, r, g, b}. Of its pictures as many
// are sent as `due` says, each behind the other.
//
// Ports
//   due   pictures that may be sent, since the simulation began
//   sent  pictures whose first pixel has been taken

`default_nettype none

module stream_player (
    input  wire        clk,
    input  wire        rst,
    input  wire [15:0] due,
    output reg  [15:0] sent,
    output wire        m_axis_video_tvalid,
    input  wire        m_axis_video_tready,
    output wire [23:0] m_axis_video_tdata,
    output wire        m_axis_video_tuser,
    output wire        m_axis_video_tlast
);

    integer file;
    integer got;
    reg [31:0] fresh;
    reg [31:0] word;
    reg present;
    reg opened;
    wire unused_zeros = &{1'b0, word[31:26]};

    initial begin
        opened  = 1'b0;
        present = 1'b0;
        sent    = 16'd0;
    end

    wire first = word[25];
    wire taken = m_axis_video_tvalid && m_axis_video_tready;

    assign m_axis_video_tvalid = present && !(first && sent == due);
    assign m_axis_video_tdata  = word[23:0];
    assign m_axis_video_tuser  = first;
    assign m_axis_video_tlast  = word[24];

    /* verilator lint_off BLKSEQ */
    always @(posedge clk) begin
        if (!rst) begin
            if (!opened) begin
                file = $fopen("stream.bin", "rb");
                opened <= 1'b1;
            end
            if (!opened || taken) begin
                got = $fread(fresh, file);
                word    <= fresh;
                present <= got == 4;
            end
            if (taken && first) sent <= sent + 16'd1;
        end
    end
    /* verilator lint_on BLKSEQ */

endmodule

`default_nettype wire
