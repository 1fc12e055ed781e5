// SPDX-License-Identifier: Apache-2.0
//
// loader: reads a packed frame (book 7.1.1 to 7.1.3) and hands on its records, or says what is wrong.
//
// Order of the bit string, most significant bit first:
//     camera position, up, center of interest        9 x 19 bits
//     number of lights, of spheres, of triangles     LIGHT_COUNT_W, SPHERE_COUNT_W, TRIANGLE_COUNT_W
//     lights:    position, intensity                 6 x 19
//     spheres:   0, material, center, radius         1 + 15 x 19 + 4 + 3 x 19 + 5
//     triangles: 1, material, three vertices         1 + 15 x 19 + 4 + 9 x 19
//     ambient light, background                      6 x 19
// and a material is ambient, diffuse, specular, reflection, transparency (3 x 19 each), index (4).
//
// Parameters
//   *_COUNT_W      bits of the three counters
//   MAX_*          capacity: a larger count is a fault
//
// Ports
//   in_*           AXI4-Stream of words, see unpack
//   record_valid   a record is whole: `record_kind` (RECORD_*), `record_index` among its kind, and
//                  its fields in `record`, a slot of 19 bits each, the last one in the low bits
//   done, fault    one clock at the end of each frame: `fault` is RT_FAULT_NONE, or the first fault
//                  in the order of the bit string; records of a faulty frame are to be forgotten
//   lights, spheres, triangles    counts of the frame, valid with `done`
//   next_ready     the frame's records may be overwritten: loading of a frame starts only then
//
// Rate one field a clock. A faulty frame is read to its last word.

`default_nettype none
`include "raytracer.vh"

module loader #(
    parameter LIGHT_COUNT_W    = 2,
    parameter SPHERE_COUNT_W   = 2,
    parameter TRIANGLE_COUNT_W = 4,
    parameter MAX_LIGHTS       = 3,
    parameter MAX_SPHERES      = 3,
    parameter MAX_TRIANGLES    = 15
) (
    input  wire                                     clk,
    input  wire                                     rst,
    input  wire                                     in_valid,
    output wire                                     in_ready,
    input  wire [                             31:0] in_data,
    input  wire                                     in_last,
    input  wire                                     next_ready,
    output wire                                     record_valid,
    output wire [                              2:0] record_kind,
    output wire [                              7:0] record_index,
    output wire [`RT_RECORD_SLOTS*`RT_COORD_W-1:0] record,
    output wire                                     done,
    output wire [                  `RT_FAULT_W-1:0] fault,
    output wire [                              7:0] lights,
    output wire [                              7:0] spheres,
    output wire [                              7:0] triangles
);

    localparam FIELD_W = `RT_COORD_W;
    localparam SLOTS = `RT_RECORD_SLOTS;
    localparam INDEX_W = 8;

    generate
        if (LIGHT_COUNT_W > INDEX_W || SPHERE_COUNT_W > INDEX_W || TRIANGLE_COUNT_W > INDEX_W)
        begin : g_bad_count
            loader_needs_counters_of_at_most_8_bits error ();
        end
        if (MAX_LIGHTS >= 1 << LIGHT_COUNT_W || MAX_SPHERES >= 1 << SPHERE_COUNT_W
            || MAX_TRIANGLES >= 1 << TRIANGLE_COUNT_W) begin : g_bad_capacity
            loader_needs_a_capacity_that_its_counters_hold error ();
        end
    endgenerate

    // Sections of the bit string; those with records carry the record's kind.
    localparam [2:0] S_CAMERA = `RT_RECORD_CAMERA;
    localparam [2:0] S_LIGHT = `RT_RECORD_LIGHT;
    localparam [2:0] S_SPHERE = `RT_RECORD_SPHERE;
    localparam [2:0] S_TRIANGLE = `RT_RECORD_TRIANGLE;
    localparam [2:0] S_TAIL = `RT_RECORD_TAIL;
    localparam [2:0] S_COUNTS = 3'd5;
    localparam [2:0] S_END = 3'd6;
    localparam [2:0] S_DRAIN = 3'd7;

    reg [2:0] section_reg;
    reg [4:0] field_reg;
    reg [INDEX_W-1:0] index_reg;
    reg [INDEX_W-1:0] lights_reg;
    reg [INDEX_W-1:0] spheres_reg;
    reg [INDEX_W-1:0] triangles_reg;
    reg busy_reg;
    reg drained_reg;

    wire object = section_reg == S_SPHERE || section_reg == S_TRIANGLE;

    // Width of the field wanted, and the last field of the section.
    reg [4:0] width;
    reg [4:0] last_field;

    always @* begin
        width = FIELD_W[4:0];
        case (section_reg)
            S_CAMERA: last_field = 5'd8;
            S_COUNTS: last_field = 5'd2;
            S_LIGHT: last_field = 5'd5;
            S_SPHERE: last_field = 5'd20;
            S_TRIANGLE: last_field = 5'd25;
            default: last_field = 5'd5;
        endcase
        if (section_reg == S_COUNTS) begin
            case (field_reg)
                5'd0: width = LIGHT_COUNT_W[4:0];
                5'd1: width = SPHERE_COUNT_W[4:0];
                default: width = TRIANGLE_COUNT_W[4:0];
            endcase
        end else if (object && field_reg == 5'd0) width = 5'd1;
        else if (object && field_reg == 5'd16) width = 5'd4;
        else if (section_reg == S_SPHERE && field_reg == 5'd20) width = `RT_RADIUS_W;
    end

    wire field_valid;
    wire [FIELD_W-1:0] field;
    wire lacking;
    wire ended;
    wire surplus;
    wire reading = busy_reg && section_reg != S_END && section_reg != S_DRAIN;
    wire take = reading && field_valid;
    wire finish;
    wire word_ready;

    // While a faulty frame is read to its end its words go past the buffer.
    wire drop = section_reg == S_DRAIN && !ended && !drained_reg;
    assign in_ready = reading && word_ready || drop;

    unpack #(
        .FIELD_W(FIELD_W)
    ) u_unpack (
        .clk        (clk),
        .rst        (rst),
        .in_valid   (in_valid && reading),
        .in_ready   (word_ready),
        .in_data    (in_data),
        .in_last    (in_last),
        .field_width(width),
        .field_valid(field_valid),
        .field      (field),
        .field_take (take),
        .lacking    (lacking),
        .flush      (finish),
        .ended      (ended),
        .surplus    (surplus)
    );

    wire last = field_reg == last_field;
    wire [INDEX_W-1:0] count = field[INDEX_W-1:0];

    // The fault that the field at hand shows, if any.
    reg [`RT_FAULT_W-1:0] field_fault;

    always @* begin
        field_fault = `RT_FAULT_NONE;
        if (section_reg == S_COUNTS) begin
            case (field_reg)
                5'd0: if ({1'b0, count} > MAX_LIGHTS[INDEX_W:0]) field_fault = `RT_FAULT_CAPACITY;
                5'd1: if ({1'b0, count} > MAX_SPHERES[INDEX_W:0]) field_fault = `RT_FAULT_CAPACITY;
                default: if ({1'b0, count} > MAX_TRIANGLES[INDEX_W:0]) field_fault = `RT_FAULT_CAPACITY;
            endcase
        end else if (object && field_reg == 5'd0) begin
            if (field[0] != (section_reg == S_TRIANGLE)) field_fault = `RT_FAULT_KIND;
        end else if (section_reg == S_SPHERE && last) begin
            if (field == {FIELD_W{1'b0}}) field_fault = `RT_FAULT_RADIUS;
        end
    end

    wire wrong = take && field_fault != `RT_FAULT_NONE;
    wire starved = reading && lacking;
    wire too_long = section_reg == S_END && (!ended || surplus);

    // The section behind this one that has anything in it.
    reg [2:0] next_section;
    wire more = section_reg == S_LIGHT && index_reg + 1'b1 != lights_reg
             || section_reg == S_SPHERE && index_reg + 1'b1 != spheres_reg
             || section_reg == S_TRIANGLE && index_reg + 1'b1 != triangles_reg;
    wire [INDEX_W-1:0] triangles_now = section_reg == S_COUNTS ? count : triangles_reg;

    always @* begin
        next_section = S_TAIL;
        case (section_reg)
            S_CAMERA: next_section = S_COUNTS;
            S_TAIL: next_section = S_END;
            default: begin
                if (triangles_now != 0 && section_reg != S_TRIANGLE) next_section = S_TRIANGLE;
                if (spheres_reg != 0 && (section_reg == S_COUNTS || section_reg == S_LIGHT))
                    next_section = S_SPHERE;
                if (lights_reg != 0 && section_reg == S_COUNTS) next_section = S_LIGHT;
            end
        endcase
        if (more) next_section = section_reg;
    end

    always @(posedge clk) begin
        if (rst || !busy_reg) section_reg <= S_CAMERA;
        else if (wrong || starved || too_long) section_reg <= S_DRAIN;
        else if (take && last) section_reg <= next_section;
    end

    always @(posedge clk) begin
        if (rst || !busy_reg) field_reg <= 5'd0;
        else if (take) field_reg <= last ? 5'd0 : field_reg + 1'b1;
    end

    always @(posedge clk) begin
        if (!busy_reg) index_reg <= {INDEX_W{1'b0}};
        else if (take && last) index_reg <= more ? index_reg + 1'b1 : {INDEX_W{1'b0}};
    end

    always @(posedge clk) begin
        if (take && section_reg == S_COUNTS) begin
            case (field_reg)
                5'd0: lights_reg <= count;
                5'd1: spheres_reg <= count;
                default: triangles_reg <= count;
            endcase
        end
    end

    // A frame ends where its last word has arrived and nothing is left to read.
    reg [`RT_FAULT_W-1:0] fault_reg;
    wire whole = section_reg == S_END && !too_long;
    assign finish = busy_reg && (whole || section_reg == S_DRAIN && drained_reg);

    always @(posedge clk) begin
        if (rst || finish) busy_reg <= 1'b0;
        else if (!busy_reg) busy_reg <= next_ready;
    end

    always @(posedge clk) begin
        if (!busy_reg) fault_reg <= `RT_FAULT_NONE;
        else if (wrong) fault_reg <= field_fault;
        else if (starved) fault_reg <= `RT_FAULT_FRAME_SHORT;
        else if (too_long) fault_reg <= `RT_FAULT_FRAME_LONG;
    end

    always @(posedge clk) begin
        if (!busy_reg) drained_reg <= 1'b0;
        else if (section_reg == S_DRAIN && (ended || in_valid && in_last)) drained_reg <= 1'b1;
    end

    // Fields gather in slots of equal width, so that the shift is constant.
    reg [SLOTS*FIELD_W-1:0] record_reg;
    reg record_valid_reg;
    reg [2:0] record_kind_reg;
    reg [INDEX_W-1:0] record_index_reg;

    always @(posedge clk) begin
        if (take && section_reg != S_COUNTS)
            record_reg <= {record_reg[(SLOTS-1)*FIELD_W-1:0], field};
    end

    always @(posedge clk) begin
        if (rst) record_valid_reg <= 1'b0;
        else record_valid_reg <= take && last && section_reg != S_COUNTS && !wrong;
    end

    always @(posedge clk) begin
        record_kind_reg  <= section_reg;
        record_index_reg <= index_reg;
    end

    assign record_valid = record_valid_reg;
    assign record_kind  = record_kind_reg;
    assign record_index = record_index_reg;
    assign record       = record_reg;
    assign done         = finish;
    assign fault        = fault_reg;
    assign lights       = lights_reg;
    assign spheres      = spheres_reg;
    assign triangles    = triangles_reg;

endmodule

`default_nettype wire
