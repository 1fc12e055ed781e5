// SPDX-License-Identifier: Apache-2.0
//
// scene_memory: the records of two frames, one that is drawn and one that is loaded meanwhile.
//
// A record is written whole, in the slots of 19 bits that the loader gathers it in.
//
// Parameters
//   LIGHTS, SPHERES, TRIANGLES  capacity of a frame, 1 to 256 each
//
// Ports
//   write_*       records of the frame that is loaded
//   swap          that frame becomes the one that is drawn, at the next clock
//   light_index, light      1 clock later the light of the frame drawn: position, intensity
//   sphere_index, sphere    1 clock later the sphere: material, center, radius (RT_SPHERE_SLOTS)
//   triangle_index, triangle
//                 1 clock later the triangle: material, three vertices (RT_RECORD_SLOTS)
//   camera        position, up, center of interest of the frame drawn
//   tail          ambient light, background

`default_nettype none
`include "raytracer.vh"

module scene_memory #(
    parameter LIGHTS           = 1,
    parameter SPHERES          = 1,
    parameter TRIANGLES        = 1,
    parameter LIGHT_INDEX_W    = LIGHTS > 1 ? $clog2(LIGHTS) : 1,
    parameter SPHERE_INDEX_W   = SPHERES > 1 ? $clog2(SPHERES) : 1,
    parameter TRIANGLE_INDEX_W = TRIANGLES > 1 ? $clog2(TRIANGLES) : 1
) (
    input  wire                                    clk,
    input  wire                                    rst,
    input  wire                                    write_valid,
    input  wire [                             2:0] write_kind,
    input  wire [                             7:0] write_index,
    input  wire [`RT_RECORD_SLOTS*`RT_COORD_W-1:0] write_record,
    input  wire                                    swap,
    input  wire [               LIGHT_INDEX_W-1:0] light_index,
    output wire [               6*`RT_COORD_W-1:0] light,
    input  wire [              SPHERE_INDEX_W-1:0] sphere_index,
    output wire [`RT_SPHERE_SLOTS*`RT_COORD_W-1:0] sphere,
    input  wire [            TRIANGLE_INDEX_W-1:0] triangle_index,
    output wire [`RT_RECORD_SLOTS*`RT_COORD_W-1:0] triangle,
    output wire [               9*`RT_COORD_W-1:0] camera,
    output wire [               6*`RT_COORD_W-1:0] tail
);

    localparam W = `RT_COORD_W;
    localparam SPHERE_W = `RT_SPHERE_SLOTS * W;

    localparam TRIANGLE_W = `RT_RECORD_SLOTS * W;

    generate
        if (LIGHTS < 1 || SPHERES < 1 || TRIANGLES < 1
            || LIGHTS > 256 || SPHERES > 256 || TRIANGLES > 256) begin : g_bad_capacity
            scene_memory_needs_LIGHTS_SPHERES_and_TRIANGLES_of_1_to_256 error ();
        end
    endgenerate

    wire unused_write = &{1'b0, write_index};

    // The bank that is drawn; the other one is loaded.
    reg bank_reg;

    always @(posedge clk) begin
        if (rst) bank_reg <= 1'b0;
        else if (swap) bank_reg <= !bank_reg;
    end

    reg [9*W-1:0] cameras[0:1];
    reg [6*W-1:0] tails[0:1];
    reg [6*W-1:0] lights[0:(2<<LIGHT_INDEX_W)-1];
    reg [SPHERE_W-1:0] spheres[0:(2<<SPHERE_INDEX_W)-1];
    reg [TRIANGLE_W-1:0] triangles[0:(2<<TRIANGLE_INDEX_W)-1];
    reg [6*W-1:0] light_reg;
    reg [SPHERE_W-1:0] sphere_reg;
    reg [TRIANGLE_W-1:0] triangle_reg;

    always @(posedge clk) begin
        if (write_valid && write_kind == `RT_RECORD_CAMERA)
            cameras[!bank_reg] <= write_record[9*W-1:0];
        if (write_valid && write_kind == `RT_RECORD_TAIL)
            tails[!bank_reg] <= write_record[6*W-1:0];
    end

    always @(posedge clk) begin
        if (write_valid && write_kind == `RT_RECORD_LIGHT)
            lights[{!bank_reg, write_index[LIGHT_INDEX_W-1:0]}] <= write_record[6*W-1:0];
        light_reg <= lights[{bank_reg, light_index}];
    end

    always @(posedge clk) begin
        if (write_valid && write_kind == `RT_RECORD_SPHERE)
            spheres[{!bank_reg, write_index[SPHERE_INDEX_W-1:0]}] <= write_record[SPHERE_W-1:0];
        sphere_reg <= spheres[{bank_reg, sphere_index}];
    end

    always @(posedge clk) begin
        if (write_valid && write_kind == `RT_RECORD_TRIANGLE)
            triangles[{!bank_reg, write_index[TRIANGLE_INDEX_W-1:0]}] <= write_record;
        triangle_reg <= triangles[{bank_reg, triangle_index}];
    end

    assign light    = light_reg;
    assign sphere   = sphere_reg;
    assign triangle = triangle_reg;
    assign camera   = cameras[bank_reg];
    assign tail     = tails[bank_reg];

endmodule

`default_nettype wire
