// SPDX-License-Identifier: Apache-2.0
//
// axil_registers: the core's registers behind an AXI4-Lite port. The map is models/registers.py;
// ../README.md has it as a table.
//
// A write takes effect, with its strobes, one clock after both its address and its data have been
// taken, in whatever order; its response stands in the clock after. A read looks at the registers in
// the clock after its address has been taken and answers in the next. One write and one read are
// under way at a time, independent of each other. SLVERR where there is no register, and for a write
// to a read-only one, which then changes nothing; the two lowest address bits are ignored.
//
// Parameters
//   UNITS                       trace units of the core, for the register UNITS
//   SIZE_W                      bits of width and height, 10 to 16; a larger number becomes 0
//   MAX_DEPTH                   largest depth, 1 to 7
//   LIGHTS, SPHERES, TRIANGLES  capacity of the core, up to 255 each
//
// Ports
//   s_axil_*      AXI4-Lite; ready and valid come from registers
//   width, height, tan_h, tan_v, depth    what the registers hold
//   go            the core may draw a frame: every one (auto), or a start waits
//   core_rst      high for RT_REG_RESET_CLOCKS clocks after a 1 in CONTROL.reset; not with `rst`
//   irq           level: an event that is enabled has not been cleared
//   frame_start   one clock: the core takes a frame to draw, which ends a start that waits
//   frame_done, frame_error, error_code    one clock: a frame has been drawn, refused and why.
//                 An event that comes in the clock of its clearing stays; a start that is written
//                 in the clock of frame_start is for the next frame
//   the others    read as they are
//
// Registers have initial values, so that a port that is used before `rst` shows no unknown ready.

`default_nettype none
`include "raytracer.vh"

module axil_registers #(
    parameter UNITS     = `RT_UNITS,
    parameter SIZE_W    = 12,
    parameter MAX_DEPTH = `RT_MAX_DEPTH,
    parameter LIGHTS    = 3,
    parameter SPHERES   = 3,
    parameter TRIANGLES = 15
) (
    input  wire                   clk,
    input  wire                   rst,
    input  wire [            7:0] s_axil_awaddr,
    input  wire [            2:0] s_axil_awprot,
    input  wire                   s_axil_awvalid,
    output wire                   s_axil_awready,
    input  wire [           31:0] s_axil_wdata,
    input  wire [            3:0] s_axil_wstrb,
    input  wire                   s_axil_wvalid,
    output wire                   s_axil_wready,
    output wire [            1:0] s_axil_bresp,
    output wire                   s_axil_bvalid,
    input  wire                   s_axil_bready,
    input  wire [            7:0] s_axil_araddr,
    input  wire [            2:0] s_axil_arprot,
    input  wire                   s_axil_arvalid,
    output wire                   s_axil_arready,
    output wire [           31:0] s_axil_rdata,
    output wire [            1:0] s_axil_rresp,
    output wire                   s_axil_rvalid,
    input  wire                   s_axil_rready,
    output wire [     SIZE_W-1:0] width,
    output wire [     SIZE_W-1:0] height,
    output wire [  `RT_TAN_W-1:0] tan_h,
    output wire [  `RT_TAN_W-1:0] tan_v,
    output wire [            2:0] depth,
    output wire                   go,
    output wire                   core_rst,
    output wire                   irq,
    input  wire                   busy,
    input  wire                   frame_start,
    input  wire                   frame_done,
    input  wire                   frame_error,
    input  wire [`RT_FAULT_W-1:0] error_code,
    input  wire [           31:0] lights_at_point,
    input  wire [           31:0] degenerate,
    input  wire [           31:0] cycles,
    input  wire [           31:0] primary_rays,
    input  wire [           31:0] shadow_rays,
    input  wire [           31:0] secondary_rays,
    input  wire [           31:0] tests
);

    localparam TAN_W = `RT_TAN_W;
    localparam [31:0] CONTROL_AT_RESET = `RT_REG_CONTROL_AT_RESET;
    localparam [31:0] ENABLE_AT_RESET = `RT_REG_INTERRUPT_ENABLE_AT_RESET;
    localparam [31:0] SIZE_AT_RESET = `RT_REG_SIZE_AT_RESET;
    localparam [31:0] TAN_H_AT_RESET = `RT_REG_TAN_H_AT_RESET;
    localparam [31:0] TAN_V_AT_RESET = `RT_REG_TAN_V_AT_RESET;
    localparam [63:0] WRITABLE = `RT_REG_WRITABLE;
    localparam [63:0] READABLE = `RT_REG_READABLE;
    localparam [31:0] DEEPEST = MAX_DEPTH;
    localparam [31:0] UNIT_COUNT = UNITS;
    localparam [31:0] CAPACITY =
        LIGHTS << `RT_REG_CAPACITY_LIGHTS_LOW |
        SPHERES << `RT_REG_CAPACITY_SPHERES_LOW |
        TRIANGLES << `RT_REG_CAPACITY_TRIANGLES_LOW;
    localparam RESET_CLOCKS = `RT_REG_RESET_CLOCKS;

    localparam W_LOW = `RT_REG_SIZE_WIDTH_LOW;
    localparam H_LOW = `RT_REG_SIZE_HEIGHT_LOW;
    localparam START = `RT_REG_CONTROL_START_LOW;
    localparam AUTO = `RT_REG_CONTROL_AUTO_LOW;
    localparam RESET = `RT_REG_CONTROL_RESET_LOW;
    localparam DONE = `RT_REG_INTERRUPT_DONE_LOW;
    localparam ERROR = `RT_REG_INTERRUPT_ERROR_LOW;
    localparam DONE_ENABLE = `RT_REG_INTERRUPT_ENABLE_DONE_LOW;
    localparam ERROR_ENABLE = `RT_REG_INTERRUPT_ENABLE_ERROR_LOW;

    generate
        if (SIZE_W < 10 || SIZE_W > 16) begin : g_bad_size
            axil_registers_needs_SIZE_W_from_10_to_16 error ();
        end
        if (MAX_DEPTH < 1 || MAX_DEPTH > 7) begin : g_bad_depth
            axil_registers_needs_MAX_DEPTH_from_1_to_7 error ();
        end
        if (LIGHTS > 255 || SPHERES > 255 || TRIANGLES > 255) begin : g_bad_capacity
            axil_registers_needs_a_capacity_of_at_most_255_each error ();
        end
    endgenerate

    // ---------------------------------------------------------------- the port
    // What has been taken is held until its response has been.
    reg aw_held_reg;
    reg w_held_reg;
    reg b_valid_reg;
    reg ar_held_reg;
    reg r_valid_reg;
    reg [5:0] write_word_reg;
    reg [5:0] read_word_reg;
    reg [31:0] write_data_reg;
    reg [3:0] write_strobe_reg;
    reg write_error_reg;
    reg read_error_reg;
    reg [31:0] read_data_reg;

    wire write_ends = b_valid_reg && s_axil_bready;
    wire read_ends = r_valid_reg && s_axil_rready;
    wire write = aw_held_reg && w_held_reg && !b_valid_reg;
    wire read = ar_held_reg && !r_valid_reg;

    initial begin
        aw_held_reg = 1'b0;
        w_held_reg = 1'b0;
        b_valid_reg = 1'b0;
        ar_held_reg = 1'b0;
        r_valid_reg = 1'b0;
        write_error_reg = 1'b0;
        read_error_reg = 1'b0;
        read_data_reg = 32'd0;
    end

    always @(posedge clk) begin
        if (rst || write_ends) aw_held_reg <= 1'b0;
        else if (s_axil_awvalid && s_axil_awready) aw_held_reg <= 1'b1;
    end

    always @(posedge clk) begin
        if (rst || write_ends) w_held_reg <= 1'b0;
        else if (s_axil_wvalid && s_axil_wready) w_held_reg <= 1'b1;
    end

    always @(posedge clk) begin
        if (rst || write_ends) b_valid_reg <= 1'b0;
        else if (write) b_valid_reg <= 1'b1;
    end

    always @(posedge clk) begin
        if (s_axil_awready) write_word_reg <= s_axil_awaddr[7:2];
        if (s_axil_wready) begin
            write_data_reg   <= s_axil_wdata;
            write_strobe_reg <= s_axil_wstrb;
        end
        if (write) write_error_reg <= !WRITABLE[write_word_reg];
    end

    always @(posedge clk) begin
        if (rst || read_ends) ar_held_reg <= 1'b0;
        else if (s_axil_arvalid && s_axil_arready) ar_held_reg <= 1'b1;
    end

    always @(posedge clk) begin
        if (rst || read_ends) r_valid_reg <= 1'b0;
        else if (read) r_valid_reg <= 1'b1;
    end

    assign s_axil_awready = !aw_held_reg;
    assign s_axil_wready  = !w_held_reg;
    assign s_axil_bvalid  = b_valid_reg;
    assign s_axil_bresp   = {write_error_reg, 1'b0};
    assign s_axil_arready = !ar_held_reg;
    assign s_axil_rvalid  = r_valid_reg;
    assign s_axil_rdata   = read_data_reg;
    assign s_axil_rresp   = {read_error_reg, 1'b0};

    wire unused_port = &{1'b0, s_axil_awprot, s_axil_arprot, s_axil_awaddr[1:0], s_axil_araddr[1:0]};

    // ---------------------------------------------------------------- writes
    wire [7:0] write_address = {write_word_reg, 2'b00};
    wire write_control = write && write_address == `RT_REG_CONTROL;
    wire write_interrupt = write && write_address == `RT_REG_INTERRUPT;
    wire write_enable = write && write_address == `RT_REG_INTERRUPT_ENABLE;
    wire write_size = write && write_address == `RT_REG_SIZE;
    wire write_tan_h = write && write_address == `RT_REG_TAN_H;
    wire write_tan_v = write && write_address == `RT_REG_TAN_V;
    wire write_depth = write && write_address == `RT_REG_DEPTH;

    wire [31:0] lanes = {
        {8{write_strobe_reg[3]}},
        {8{write_strobe_reg[2]}},
        {8{write_strobe_reg[1]}},
        {8{write_strobe_reg[0]}}
    };
    wire [31:0] ones = write_data_reg & lanes;

    reg auto_reg;
    reg start_reg;
    // A one for each clock that reset still lasts, the next one lowest.
    reg [RESET_CLOCKS-1:0] reset_reg;
    reg [1:0] enable_reg;
    reg [SIZE_W-1:0] width_reg;
    reg [SIZE_W-1:0] height_reg;
    reg [TAN_W-1:0] tan_h_reg;
    reg [TAN_W-1:0] tan_v_reg;
    reg [2:0] depth_reg;

    initial begin
        auto_reg = CONTROL_AT_RESET[AUTO];
        start_reg = 1'b0;
        reset_reg = {RESET_CLOCKS{1'b0}};
        enable_reg = {ENABLE_AT_RESET[ERROR_ENABLE], ENABLE_AT_RESET[DONE_ENABLE]};
        width_reg = SIZE_AT_RESET[W_LOW+:SIZE_W];
        height_reg = SIZE_AT_RESET[H_LOW+:SIZE_W];
        tan_h_reg = TAN_H_AT_RESET[TAN_W-1:0];
        tan_v_reg = TAN_V_AT_RESET[TAN_W-1:0];
        depth_reg = DEEPEST[2:0];
    end

    always @(posedge clk) begin
        if (rst) auto_reg <= CONTROL_AT_RESET[AUTO];
        else if (write_control && lanes[AUTO]) auto_reg <= write_data_reg[AUTO];
    end

    // Reset before start where one write asks for both.
    always @(posedge clk) begin
        if (rst) start_reg <= 1'b0;
        else if (write_control && ones[START]) start_reg <= 1'b1;
        else if (write_control && ones[RESET]) start_reg <= 1'b0;
        else if (frame_start) start_reg <= 1'b0;
    end

    always @(posedge clk) begin
        if (rst) reset_reg <= {RESET_CLOCKS{1'b0}};
        else if (write_control && ones[RESET]) reset_reg <= {RESET_CLOCKS{1'b1}};
        else reset_reg <= reset_reg >> 1;
    end

    always @(posedge clk) begin
        if (rst) enable_reg <= {ENABLE_AT_RESET[ERROR_ENABLE], ENABLE_AT_RESET[DONE_ENABLE]};
        else if (write_enable) begin
            if (lanes[DONE_ENABLE]) enable_reg[0] <= write_data_reg[DONE_ENABLE];
            if (lanes[ERROR_ENABLE]) enable_reg[1] <= write_data_reg[ERROR_ENABLE];
        end
    end

    // Numbers, with the bytes that are not written as they were; what does not fit is not cut.
    wire [31:0] size_word;
    assign size_word[W_LOW+:16] = {{16 - SIZE_W{1'b0}}, width_reg};
    assign size_word[H_LOW+:16] = {{16 - SIZE_W{1'b0}}, height_reg};
    wire [31:0] tan_h_word = {{32 - TAN_W{1'b0}}, tan_h_reg};
    wire [31:0] tan_v_word = {{32 - TAN_W{1'b0}}, tan_v_reg};
    wire [31:0] depth_word = {29'd0, depth_reg};
    wire [31:0] size_next = size_word & ~lanes | ones;
    wire [31:0] tan_h_next = tan_h_word & ~lanes | ones;
    wire [31:0] tan_v_next = tan_v_word & ~lanes | ones;
    wire [31:0] depth_next = depth_word & ~lanes | ones;
    wire [15:0] width_next = size_next[W_LOW+:16];
    wire [15:0] height_next = size_next[H_LOW+:16];
    wire width_fits = width_next >> SIZE_W == 16'd0;
    wire height_fits = height_next >> SIZE_W == 16'd0;

    always @(posedge clk) begin
        if (rst) begin
            width_reg  <= SIZE_AT_RESET[W_LOW+:SIZE_W];
            height_reg <= SIZE_AT_RESET[H_LOW+:SIZE_W];
        end else if (write_size) begin
            width_reg  <= width_fits ? width_next[SIZE_W-1:0] : {SIZE_W{1'b0}};
            height_reg <= height_fits ? height_next[SIZE_W-1:0] : {SIZE_W{1'b0}};
        end
    end

    always @(posedge clk) begin
        if (rst) tan_h_reg <= TAN_H_AT_RESET[TAN_W-1:0];
        else if (write_tan_h) tan_h_reg <= tan_h_next[TAN_W-1:0] | {TAN_W{|tan_h_next[31:TAN_W]}};
    end

    always @(posedge clk) begin
        if (rst) tan_v_reg <= TAN_V_AT_RESET[TAN_W-1:0];
        else if (write_tan_v) tan_v_reg <= tan_v_next[TAN_W-1:0] | {TAN_W{|tan_v_next[31:TAN_W]}};
    end

    always @(posedge clk) begin
        if (rst) depth_reg <= DEEPEST[2:0];
        else if (write_depth) begin
            if (depth_next > DEEPEST) depth_reg <= DEEPEST[2:0];
            else depth_reg <= depth_next == 32'd0 ? 3'd1 : depth_next[2:0];
        end
    end

    // ---------------------------------------------------------------- events
    reg done_reg;
    reg error_reg;
    reg [`RT_FAULT_W-1:0] code_reg;
    reg [31:0] frames_reg;

    initial begin
        done_reg = 1'b0;
        error_reg = 1'b0;
        code_reg = `RT_FAULT_NONE;
        frames_reg = 32'd0;
    end

    always @(posedge clk) begin
        if (rst) done_reg <= 1'b0;
        else if (frame_done) done_reg <= 1'b1;
        else if (write_interrupt && ones[DONE]) done_reg <= 1'b0;
    end

    always @(posedge clk) begin
        if (rst) error_reg <= 1'b0;
        else if (frame_error) error_reg <= 1'b1;
        else if (write_interrupt && ones[ERROR]) error_reg <= 1'b0;
    end

    // Where one is drawn and another refused in one clock, the refused one is the later.
    always @(posedge clk) begin
        if (rst) code_reg <= `RT_FAULT_NONE;
        else if (frame_error) code_reg <= error_code;
        else if (frame_done) code_reg <= `RT_FAULT_NONE;
    end

    always @(posedge clk) begin
        if (rst) frames_reg <= 32'd0;
        else if (frame_done) frames_reg <= frames_reg + 32'd1;
    end

    // ---------------------------------------------------------------- reads
    reg [31:0] found;

    always @* begin
        found = 32'd0;
        case ({read_word_reg, 2'b00})
            `RT_REG_ID: found = `RT_REG_ID_AT_RESET;
            `RT_REG_CONTROL: found[AUTO] = auto_reg;
            `RT_REG_STATUS: begin
                found[`RT_REG_STATUS_BUSY_LOW] = busy;
                found[`RT_REG_STATUS_START_LOW] = start_reg;
            end
            `RT_REG_INTERRUPT: begin
                found[DONE] = done_reg;
                found[ERROR] = error_reg;
            end
            `RT_REG_INTERRUPT_ENABLE: begin
                found[DONE_ENABLE] = enable_reg[0];
                found[ERROR_ENABLE] = enable_reg[1];
            end
            `RT_REG_ERROR: found[`RT_REG_ERROR_CODE_LOW+:`RT_FAULT_W] = code_reg;
            `RT_REG_SIZE: found = size_word;
            `RT_REG_TAN_H: found = tan_h_word;
            `RT_REG_TAN_V: found = tan_v_word;
            `RT_REG_DEPTH: found = depth_word;
            `RT_REG_LIGHTS_AT_POINT: found = lights_at_point;
            `RT_REG_DEGENERATE: found = degenerate;
            `RT_REG_CYCLES: found = cycles;
            `RT_REG_PRIMARY_RAYS: found = primary_rays;
            `RT_REG_SHADOW_RAYS: found = shadow_rays;
            `RT_REG_SECONDARY_RAYS: found = secondary_rays;
            `RT_REG_TESTS: found = tests;
            `RT_REG_UNITS: found = UNIT_COUNT;
            `RT_REG_FRAMES: found = frames_reg;
            `RT_REG_CAPACITY: found = CAPACITY;
            default: found = 32'd0;
        endcase
    end

    always @(posedge clk) begin
        if (s_axil_arready) read_word_reg <= s_axil_araddr[7:2];
        if (read) begin
            read_data_reg  <= found;
            read_error_reg <= !READABLE[read_word_reg];
        end
    end

    assign width    = width_reg;
    assign height   = height_reg;
    assign tan_h    = tan_h_reg;
    assign tan_v    = tan_v_reg;
    assign depth    = depth_reg;
    assign go       = auto_reg || start_reg;
    assign core_rst = reset_reg[0];
    assign irq      = done_reg && enable_reg[0] || error_reg && enable_reg[1];

endmodule

`default_nettype wire
