// SPDX-License-Identifier: Apache-2.0
//
// control: the life of a frame: loaded, set up, drawn; the next one is loaded meanwhile (book 8.1).
//
// Ports
//   load_done, load_fault   a frame has been read, see loader
//   load_ready              the loader may read the next frame
//   go                      a frame that has been read may be set up; looked at between frames only
//   swap, frame_start       the frame just read becomes the one that is drawn
//   camera_start, camera_done, camera_fault    set-up of the screen
//   object_start, object_done                  set-up of the objects, behind that of the screen
//   draw_ready              the picture may be started; from then on it holds until draw_start
//   draw_start, draw_done   the picture
//   size_lock               one clock: width, height and tangents are taken (first frame after reset)
//   frame_done              one clock: a frame has been drawn
//   frame_error, error_code one clock: a frame has been refused, and why (RT_FAULT)
//   busy                    a frame is set up or drawn

`default_nettype none
`include "raytracer.vh"

module control (
    input  wire                     clk,
    input  wire                     rst,
    input  wire                     load_done,
    input  wire [  `RT_FAULT_W-1:0] load_fault,
    output wire                     load_ready,
    input  wire                     go,
    output wire                     swap,
    output wire                     frame_start,
    output wire                     camera_start,
    input  wire                     camera_done,
    input  wire [  `RT_FAULT_W-1:0] camera_fault,
    output wire                     object_start,
    input  wire                     object_done,
    input  wire                     draw_ready,
    output wire                     draw_start,
    input  wire                     draw_done,
    output wire                     size_lock,
    output wire                     frame_done,
    output wire                     frame_error,
    output wire [  `RT_FAULT_W-1:0] error_code,
    output wire                     busy
);

    localparam [3:0] S_IDLE = 4'd0;
    localparam [3:0] S_SWAP = 4'd1;
    localparam [3:0] S_READ = 4'd2;
    localparam [3:0] S_START_CAMERA = 4'd3;
    localparam [3:0] S_CAMERA = 4'd4;
    localparam [3:0] S_START_OBJECT = 4'd5;
    localparam [3:0] S_OBJECT = 4'd6;
    localparam [3:0] S_READY = 4'd7;
    localparam [3:0] S_START_DRAW = 4'd8;
    localparam [3:0] S_DRAW = 4'd9;

    reg [3:0] state_reg;
    reg [3:0] state_next;
    reg waiting_reg;
    reg locked_reg;

    wire load_good = load_done && load_fault == `RT_FAULT_NONE;
    wire camera_bad = state_reg == S_CAMERA && camera_done && camera_fault != `RT_FAULT_NONE;

    // A frame that has been read waits here until the one before it is drawn.
    always @(posedge clk) begin
        if (rst || swap) waiting_reg <= 1'b0;
        else if (load_good) waiting_reg <= 1'b1;
    end

    always @(posedge clk) begin
        if (rst) locked_reg <= 1'b0;
        else if (size_lock) locked_reg <= 1'b1;
    end

    always @* begin
        state_next = state_reg;
        case (state_reg)
            S_IDLE: if (waiting_reg && go) state_next = S_SWAP;
            S_SWAP: state_next = S_READ;
            S_READ: state_next = S_START_CAMERA;
            S_START_CAMERA: state_next = S_CAMERA;
            S_CAMERA: begin
                if (camera_bad) state_next = S_IDLE;
                else if (camera_done) state_next = S_START_OBJECT;
            end
            // The objects' set-up needs the normaliser that the camera had.
            S_START_OBJECT: state_next = S_OBJECT;
            S_OBJECT: if (object_done) state_next = S_READY;
            S_READY: if (draw_ready) state_next = S_START_DRAW;
            S_START_DRAW: state_next = S_DRAW;
            default: if (draw_done) state_next = S_IDLE;
        endcase
    end

    always @(posedge clk) begin
        if (rst) state_reg <= S_IDLE;
        else state_reg <= state_next;
    end

    // Not while a frame is set up: so no two frames are refused in one clock.
    assign load_ready   = !waiting_reg && (state_reg == S_IDLE || state_reg == S_DRAW);
    assign swap         = state_reg == S_SWAP;
    assign frame_start  = state_reg == S_SWAP;
    assign camera_start = state_reg == S_START_CAMERA;
    assign object_start = state_reg == S_START_OBJECT;
    assign draw_start   = state_reg == S_START_DRAW;
    assign size_lock    = state_reg == S_SWAP && !locked_reg;
    assign frame_done   = state_reg == S_DRAW && draw_done;
    assign frame_error  = load_done && load_fault != `RT_FAULT_NONE || camera_bad;
    assign error_code   = camera_bad ? camera_fault : load_fault;
    assign busy         = state_reg != S_IDLE;

endmodule

`default_nettype wire
