// SPDX-License-Identifier: Apache-2.0
//
// scan: which pixel of the picture belongs to a place on the screen.
//
// The picture is in the middle of the screen, each pixel of it FACTOR x FACTOR pixels large. Rows and
// columns are counted as the screen goes through them, so that nothing is divided; only the size is
// multiplied by the constant FACTOR.
//
// Parameters
//   H_ACTIVE, V_ACTIVE  the screen; X_W, Y_W: bits of a place
//   FACTOR              how often a pixel is repeated in either direction
//   WIDTH               addresses from one row to the next
//   SIZE_W, ADDRESS_W   bits of a size, and of an address
//
// Ports
//   x, y           place on the screen, see vga_timing
//   width, height  of the picture; FACTOR times each fits the screen. They change in vertical blank
//                  only, a line before its end at the latest
//   on_picture     the place shows a pixel of the picture, and
//   address        which one; both of the same clock as x and y

`default_nettype none

module scan #(
    parameter H_ACTIVE  = 640,
    parameter V_ACTIVE  = 480,
    parameter X_W       = 10,
    parameter Y_W       = 10,
    parameter FACTOR    = 2,
    parameter WIDTH     = 320,
    parameter SIZE_W    = 12,
    parameter ADDRESS_W = 17
) (
    input  wire                 clk,
    input  wire [      X_W-1:0] x,
    input  wire [      Y_W-1:0] y,
    input  wire [   SIZE_W-1:0] width,
    input  wire [   SIZE_W-1:0] height,
    output wire                 on_picture,
    output wire [ADDRESS_W-1:0] address
);

    localparam PHASE_W = FACTOR > 1 ? $clog2(FACTOR) : 1;
    localparam [PHASE_W-1:0] PHASE_LAST = FACTOR[PHASE_W-1:0] - 1'b1;
    localparam [X_W-1:0] H_END = H_ACTIVE[X_W-1:0];
    localparam [Y_W-1:0] V_END = V_ACTIVE[Y_W-1:0];
    localparam [ADDRESS_W-1:0] ROW = WIDTH[ADDRESS_W-1:0];
    localparam COLUMNS_W = SIZE_W > X_W ? SIZE_W : X_W;
    localparam ROWS_W = SIZE_W > Y_W ? SIZE_W : Y_W;

    // Where the picture is. It settles within three clocks. Both products fit the screen.
    wire [COLUMNS_W-1:0] columns = width * FACTOR[COLUMNS_W-1:0];
    wire [ROWS_W-1:0] rows = height * FACTOR[ROWS_W-1:0];
    wire unused_high = &{1'b0, columns, rows};
    reg [X_W-1:0] columns_reg;
    reg [Y_W-1:0] rows_reg;
    reg [X_W-1:0] left_reg;
    reg [Y_W-1:0] top_reg;
    reg [X_W-1:0] right_reg;
    reg [Y_W-1:0] bottom_reg;
    wire [X_W-1:0] beside = H_END - columns_reg;
    wire [Y_W-1:0] above = V_END - rows_reg;

    always @(posedge clk) begin
        columns_reg <= columns[X_W-1:0];
        rows_reg    <= rows[Y_W-1:0];
        left_reg    <= beside >> 1;
        top_reg     <= above >> 1;
        right_reg   <= left_reg + columns_reg;
        bottom_reg  <= top_reg + rows_reg;
    end

    wire in_columns = x >= left_reg && x < right_reg;
    wire in_rows = y >= top_reg && y < bottom_reg;

    // The first pixel of the row, stepped behind the active part of each line.
    reg [ADDRESS_W-1:0] row_reg;
    reg [PHASE_W-1:0] row_phase_reg;
    wire row_phase_end = row_phase_reg == PHASE_LAST;

    always @(posedge clk) begin
        if (x == H_END) begin
            if (!in_rows) begin
                row_reg       <= {ADDRESS_W{1'b0}};
                row_phase_reg <= {PHASE_W{1'b0}};
            end else begin
                if (row_phase_end) row_reg <= row_reg + ROW;
                row_phase_reg <= row_phase_end ? {PHASE_W{1'b0}} : row_phase_reg + 1'b1;
            end
        end
    end

    reg [ADDRESS_W-1:0] address_reg;
    reg [PHASE_W-1:0] phase_reg;
    wire phase_end = phase_reg == PHASE_LAST;

    always @(posedge clk) begin
        if (!in_columns) begin
            address_reg <= row_reg;
            phase_reg   <= {PHASE_W{1'b0}};
        end else begin
            if (phase_end) address_reg <= address_reg + 1'b1;
            phase_reg <= phase_end ? {PHASE_W{1'b0}} : phase_reg + 1'b1;
        end
    end

    assign on_picture = in_columns && in_rows;
    assign address = address_reg;

endmodule

`default_nettype wire
