// SPDX-License-Identifier: Apache-2.0
//
// core_tb: the core with what its benches watch it through.
//
// The clock runs here and the pixels go into the file pixels.bin, two words of 32 bits each, the
// object and {0, r, g, b}, so that the simulator calls Python where something happens and not in
// every clock. `event_flip` flips when a frame is done or refused, or the probed pixel is complete; the
// other outputs then say which, and the files are up to date.
//
// Ports beside the core's
//   clk               the clock, 10 ns; an input where RT_CLOCK_FROM_OUTSIDE is defined, for benches
//                     that look at every clock: Verilator shows a clock of its own too late, when
//                     the registers have changed already
//   object            (in the file) number of the object that the pixel's primary ray hit, all ones
//                     for none; seen at the shader, kept by pixel slot
//   pixels            pixels in the file
//   unknown           a pixel since reset had an X or a Z in it
//   latency           clocks from the first word of the frame to its last pixel
//   control_state, load_section   where control and loader are, for benches that reset there
//   breaches, waits   see core_watch; waits: the ray store has no places for the children of a ray of
//                     depth 1, 2, ..., then no room for primary rays, steps, hits, terms, pixels
//   probe_x, probe_y  a pixel all of whose events are written to probe.txt, while probe_on is high;
//                     see probe.py for the lines. probe_done: the pixel is complete

`default_nettype none
`include "raytracer.vh"

module core_tb #(
    parameter UNITS            = `RT_UNITS,
    parameter PIXELS_IN_FLIGHT = 512,
    parameter LEVEL_ROOM       = 256,
    parameter SIZE_W           = 12,
    parameter LIGHT_COUNT_W    = 2,
    parameter SPHERE_COUNT_W   = 2,
    parameter TRIANGLE_COUNT_W = 4
) (
`ifdef RT_CLOCK_FROM_OUTSIDE
    input  wire                    clk,
`else
    output reg                     clk,
`endif
    input  wire                    rst,
    input  wire [      SIZE_W-1:0] width,
    input  wire [      SIZE_W-1:0] height,
    input  wire [   `RT_TAN_W-1:0] tan_h,
    input  wire [   `RT_TAN_W-1:0] tan_v,
    input  wire [             2:0] depth,
    input  wire                    go,
    input  wire                    s_axis_frame_tvalid,
    output wire                    s_axis_frame_tready,
    input  wire [            31:0] s_axis_frame_tdata,
    input  wire                    s_axis_frame_tlast,
    output wire                    m_axis_video_tvalid,
    input  wire                    m_axis_video_tready,
    output wire [            23:0] m_axis_video_tdata,
    output wire                    m_axis_video_tuser,
    output wire                    m_axis_video_tlast,
    output wire                    frame_start,
    output wire                    frame_done,
    output wire                    frame_error,
    output wire [ `RT_FAULT_W-1:0] error_code,
    output wire                    busy,
    output wire [            31:0] cycles,
    output wire [            31:0] primary_rays,
    output wire [            31:0] secondary_rays,
    output wire [            31:0] shadow_rays,
    output wire [            31:0] tests,
    output wire [            31:0] lights_at_point,
    output wire [            31:0] degenerate,
    output reg                     event_flip,
    output reg                     event_done,
    output reg                     event_error,
    output reg  [ `RT_FAULT_W-1:0] event_code,
    output reg  [            31:0] pixels,
    output reg                     unknown,
    output reg  [            31:0] latency,
    output wire [             3:0] control_state,
    output wire [             2:0] load_section,
    output wire [             3:0] breaches,
    output wire [             8:0] waits,
    input  wire                    probe_on,
    input  wire [      SIZE_W-1:0] probe_x,
    input  wire [      SIZE_W-1:0] probe_y,
    output wire                    probe_done
);

`ifndef RT_CLOCK_FROM_OUTSIDE
    initial clk = 1'b0;
    always #5 clk = !clk;
`endif

    localparam SLOT_W = $clog2(PIXELS_IN_FLIGHT);
    localparam OBJECT_W = $clog2((1 << SPHERE_COUNT_W) - 1 + (1 << TRIANGLE_COUNT_W) - 1);
    localparam [31:0] NO_OBJECT = 32'hffffffff;

    wire [SIZE_W-1:0] unused_width;
    wire [SIZE_W-1:0] unused_height;

    raytracer #(
        .UNITS           (UNITS),
        .PIXELS_IN_FLIGHT(PIXELS_IN_FLIGHT),
        .LEVEL_ROOM      (LEVEL_ROOM),
        .SIZE_W          (SIZE_W),
        .LIGHT_COUNT_W   (LIGHT_COUNT_W),
        .SPHERE_COUNT_W  (SPHERE_COUNT_W),
        .TRIANGLE_COUNT_W(TRIANGLE_COUNT_W)
    ) dut (
        .clk                (clk),
        .rst                (rst),
        .width              (width),
        .height             (height),
        .tan_h              (tan_h),
        .tan_v              (tan_v),
        .depth              (depth),
        .go                 (go),
        .s_axis_frame_tvalid(s_axis_frame_tvalid),
        .s_axis_frame_tready(s_axis_frame_tready),
        .s_axis_frame_tdata (s_axis_frame_tdata),
        .s_axis_frame_tlast (s_axis_frame_tlast),
        .m_axis_video_tvalid(m_axis_video_tvalid),
        .m_axis_video_tready(m_axis_video_tready),
        .m_axis_video_tdata (m_axis_video_tdata),
        .m_axis_video_tuser (m_axis_video_tuser),
        .m_axis_video_tlast (m_axis_video_tlast),
        .picture_width      (unused_width),
        .picture_height     (unused_height),
        .frame_start        (frame_start),
        .frame_done         (frame_done),
        .frame_error        (frame_error),
        .error_code         (error_code),
        .busy               (busy),
        .cycles             (cycles),
        .primary_rays       (primary_rays),
        .secondary_rays     (secondary_rays),
        .shadow_rays        (shadow_rays),
        .tests              (tests),
        .lights_at_point    (lights_at_point),
        .degenerate         (degenerate)
    );

    assign control_state = dut.u_control.state_reg;
    assign load_section  = dut.u_loader.section_reg;

    // ------------------------------------------------------------- pixels
    // Objects by slot; slots leave in the order 0, 1, 2, ... of each frame.
    reg [31:0] objects[0:PIXELS_IN_FLIGHT-1];
    reg [SLOT_W-1:0] out_slot;
    wire taken = m_axis_video_tvalid && m_axis_video_tready;

    always @(posedge clk) begin
        if (dut.u_shader.at_valid && dut.u_shader.at_depth == 3'd1)
            objects[dut.u_shader.at_slot] <=
                dut.u_shader.at_hit ? 32'd0 + dut.u_shader.at_own[OBJECT_W-1:0] : NO_OBJECT;
        if (dut.draw_start) out_slot <= {SLOT_W{1'b0}};
        else if (taken) out_slot <= out_slot + 1'b1;
    end

    integer file;
    integer log;
    reg probe_told;
    reg seen;

    initial begin
        file       = $fopen("pixels.bin", "wb");
        log        = $fopen("probe.txt", "w");
        event_flip = 1'b0;
        pixels     = 32'd0;
        unknown    = 1'b0;
    end

    wire [31:0] object = objects[out_slot];
    wire [31:0] entry = {8'd0, m_axis_video_tdata};
    wire told = frame_done || frame_error || probe_done && !probe_told;

    always @(posedge clk) begin
        if (!rst && taken) begin
            $fwrite(file, "%u%u", object, entry);
            pixels <= pixels + 32'd1;
            if (^entry === 1'bx || ^object === 1'bx) unknown <= 1'b1;
        end
        if (!rst && told) begin
            $fflush(file);
            $fflush(log);
        end
        if (rst) unknown <= 1'b0;
    end

    always @(posedge clk) begin
        probe_told <= probe_done && !rst;
        if (!rst && told) begin
            event_flip  <= !event_flip;
            event_done  <= frame_done;
            event_error <= frame_error;
            event_code  <= error_code;
        end
    end

    reg loading;
    reg drawing;

    always @(posedge clk) begin
        if (rst) begin
            loading <= 1'b0;
            drawing <= 1'b0;
        end else begin
            if (s_axis_frame_tvalid && s_axis_frame_tready) loading <= !s_axis_frame_tlast;
            if (s_axis_frame_tvalid && s_axis_frame_tready && !loading) drawing <= 1'b1;
            if (frame_done || frame_error) drawing <= 1'b0;
        end
    end

    always @(posedge clk) latency <= drawing ? latency + 32'd1 : 32'd1;

    // ------------------------------------------------------------- one pixel, event by event
    reg armed;
    reg [SLOT_W-1:0] slot;
    wire here = dut.u_rays.cast && dut.u_rays.x_reg == probe_x && dut.u_rays.y_reg == probe_y;
    wire watched = armed && !seen;
    wire at_ray = watched && dut.u_shader.at_valid && dut.u_shader.at_slot == slot
               && dut.u_shader.at_step == 0;
    wire at_child = watched && dut.child_valid && dut.more_slot == slot;
    wire at_light = watched && dut.u_shader.u_lighting.end_valid
                 && dut.u_shader.u_lighting.end_slot == slot;
    wire at_pixel = watched && dut.sum_valid && dut.sum_slot == slot;

    always @(posedge clk) begin
        if (rst || !probe_on) begin
            armed <= 1'b0;
            seen  <= 1'b0;
        end else begin
            if (here && !armed) begin
                armed <= 1'b1;
                slot  <= dut.slot;
            end
            if (at_pixel) seen <= 1'b1;
        end
    end

    always @(posedge clk) begin
        if (at_ray && dut.u_shader.at_hit)
            $fdisplay(log, "hit %0d %h", dut.u_shader.at_depth, {
                32'd0 + dut.u_shader.at_own[OBJECT_W-1:0], dut.u_shader.at_leaving,
                dut.u_shader.at_direction, dut.u_shader.at_point, dut.u_shader.at_normal});
        if (at_ray && !dut.u_shader.at_hit)
            $fdisplay(log, "miss %0d %h", dut.u_shader.at_depth, dut.u_shader.at_direction);
        if (at_child)
            $fdisplay(log, "child %0d %h", dut.child_depth, {
                dut.u_shader.u_children.weight_reg, dut.u_shader.u_children.direction_reg});
        if (at_light && dut.u_shader.u_lighting.end_first)
            $fdisplay(log, "local 0 %h", dut.u_shader.u_lighting.end_local);
        if (at_light && dut.u_shader.u_lighting.bright)
            $fdisplay(log, "light 0 %h", {
                dut.u_shader.u_lighting.end_light, dut.u_shader.u_lighting.end_direction,
                dut.u_shader.u_lighting.end_limit});
        if (at_pixel) $fdisplay(log, "pixel 0 %h", dut.sum);
    end

    genvar k;
    generate
        for (k = 0; k < UNITS; k = k + 1) begin : g_left
            always @(posedge clk)
                if (watched && dut.source_valid[k] && dut.source_ready[k]
                    && dut.g_unit[k].u_trace.term_slot == slot)
                    $fdisplay(log, "left 0 %h", dut.g_unit[k].u_trace.term_light);
        end
    endgenerate

    assign probe_done = seen;

    // ------------------------------------------------------------- room
    localparam LEVELS = `RT_MAX_DEPTH - 1;
    localparam QUEUES = 3 + 4 * UNITS;
    localparam WAITS = LEVELS + 5;
    wire [32*LEVELS-1:0] free;
    wire [32*LEVELS-1:0] stored;
    wire [2*LEVELS-1:0] child;
    wire [2*LEVELS-1:0] settled;
    wire [LEVELS-1:0] no_place;
    wire [QUEUES-1:0] lost;
    wire [QUEUES-1:0] empty;
    wire [UNITS-1:0] no_hit_room;
    wire [UNITS-1:0] no_term_room;

    generate
        for (k = 0; k < LEVELS; k = k + 1) begin : g_level
            wire [$clog2(LEVEL_ROOM):0] held =
                dut.u_store.g_level[k+2].tail_reg - dut.u_store.g_level[k+2].head_reg;

            assign free[32*k+:32]   = 32'd0 + dut.u_store.g_level[k+2].free_reg;
            assign stored[32*k+:32] = 32'd0 + held;
            assign child[2*k+:2]    = {1'b0, dut.child_valid && dut.child_depth == k + 2};
            assign settled[2*k+:2]  =
                dut.settle_valid && dut.settle_depth == k + 2 ? dut.settle_count : 2'd0;
            assign no_place[k]      = !dut.u_store.enough[k+2];
        end

        for (k = 0; k < UNITS; k = k + 1) begin : g_queue
            assign lost[4*k+:4] = {
                dut.g_unit[k].u_trace.u_hit_side.in_valid && !dut.g_unit[k].u_trace.u_hit_side.in_ready,
                dut.g_unit[k].u_trace.u_hit_found.in_valid && !dut.g_unit[k].u_trace.u_hit_found.in_ready,
                dut.g_unit[k].u_trace.u_term_side.in_valid && !dut.g_unit[k].u_trace.u_term_side.in_ready,
                dut.g_unit[k].u_trace.u_term_light.in_valid
                    && !dut.g_unit[k].u_trace.u_term_light.in_ready
            };
            assign empty[4*k+:4] = {
                dut.g_unit[k].u_trace.u_hit_side.room == dut.ROOM,
                dut.g_unit[k].u_trace.u_hit_found.room == dut.ROOM,
                dut.g_unit[k].u_trace.u_term_side.room == dut.ROOM,
                dut.g_unit[k].u_trace.u_term_light.room == dut.ROOM
            };
            assign no_hit_room[k]  = !dut.g_unit[k].u_trace.hit_side_ready;
            assign no_term_room[k] = !dut.g_unit[k].u_trace.term_side_ready;
        end
    endgenerate

    assign lost[QUEUES-1-:3] = {
        dut.u_primary.in_valid && !dut.u_primary.in_ready,
        dut.u_shader.u_shadows.in_valid && !dut.u_shader.u_shadows.in_ready,
        dut.u_shader.u_direct.in_valid && !dut.u_shader.u_direct.in_ready
    };
    assign empty[QUEUES-1-:3] = {
        dut.room_reg == dut.ROOM,
        dut.u_shader.u_steps.shadow_room_reg == dut.u_shader.ROOM,
        dut.u_shader.u_steps.direct_room_reg == dut.u_shader.ROOM
    };

    core_watch #(
        .LEVELS    (LEVELS),
        .LEVEL_ROOM(LEVEL_ROOM),
        .QUEUES    (QUEUES),
        .WAITS     (WAITS)
    ) u_watch (
        .clk       (clk),
        .rst       (rst),
        .done      (frame_done),
        .free      (free),
        .stored    (stored),
        .child     (child),
        .settled   (settled),
        .queue_lost(lost),
        .home      (&empty),
        .waiting   ({!dut.slot_valid, |no_term_room, |no_hit_room,
                     dut.u_shader.u_steps.valid_reg && !dut.u_shader.u_steps.room, !dut.room, no_place}),
        .breaches  (breaches),
        .waits     (waits)
    );

endmodule

`default_nettype wire
