// SPDX-License-Identifier: Apache-2.0
//
// Formats, limits, faults and registers of the core. Written by `python -m models.header`; do not edit.
//
// RT_<NAME>_INT, _FRAC, _W: integer bits (sign included), fraction bits and width of a format.
// A build sets the guard bits, RT_UNIT_KNOB, RT_POINT_KNOB, RT_COLOUR_KNOB and RT_SCREEN_KNOB, by
// defining them before this file is read.
`ifndef RAYTRACER_VH
`define RAYTRACER_VH

`ifndef RT_UNIT_KNOB
`define RT_UNIT_KNOB 16
`endif
`ifndef RT_POINT_KNOB
`define RT_POINT_KNOB 15
`endif
`ifndef RT_COLOUR_KNOB
`define RT_COLOUR_KNOB 12
`endif
`ifndef RT_SCREEN_KNOB
`define RT_SCREEN_KNOB 18
`endif

// [9.10] scene coordinate
`define RT_COORD_INT 9
`define RT_COORD_FRAC 10
`define RT_COORD_W (9 + 10)

// u[9.10] scene colour, intensity, coefficient
`define RT_COEFF_INT 9
`define RT_COEFF_FRAC 10
`define RT_COEFF_W (9 + 10)

// u[2.3] scene radius
`define RT_RADIUS_INT 2
`define RT_RADIUS_FRAC 3
`define RT_RADIUS_W (2 + 3)

// u[4.6] radius squared, exact
`define RT_RADIUS_SQ_INT 4
`define RT_RADIUS_SQ_FRAC 6
`define RT_RADIUS_SQ_W (4 + 6)

// u[3.16] tangent of the half field of view (register)
`define RT_TAN_INT 3
`define RT_TAN_FRAC 16
`define RT_TAN_W (3 + 16)

// [2.unit] component of a unit vector
`define RT_UNIT_INT 2
`define RT_UNIT_FRAC `RT_UNIT_KNOB
`define RT_UNIT_W (2 + `RT_UNIT_KNOB)

// u[1.unit] cosine clamped to zero and above; highlight
`define RT_COSINE_INT 1
`define RT_COSINE_FRAC `RT_UNIT_KNOB
`define RT_COSINE_W (1 + `RT_UNIT_KNOB)

// u[4.unit] 1 / radius
`define RT_INV_RADIUS_INT 4
`define RT_INV_RADIUS_FRAC `RT_UNIT_KNOB
`define RT_INV_RADIUS_W (4 + `RT_UNIT_KNOB)

// [6.screen] component of a direction before it is normalised
`define RT_SCREEN_INT 6
`define RT_SCREEN_FRAC `RT_SCREEN_KNOB
`define RT_SCREEN_W (6 + `RT_SCREEN_KNOB)

// u[4.screen] magnitude of tangent * basis component
`define RT_SPAN_INT 4
`define RT_SPAN_FRAC `RT_SCREEN_KNOB
`define RT_SPAN_W (4 + `RT_SCREEN_KNOB)

// [10.point] position; distance along a ray
`define RT_POINT_INT 10
`define RT_POINT_FRAC `RT_POINT_KNOB
`define RT_POINT_W (10 + `RT_POINT_KNOB)

// [3.point] position relative to the center of a sphere that may be hit
`define RT_OFFSET_INT 3
`define RT_OFFSET_FRAC `RT_POINT_KNOB
`define RT_OFFSET_W (3 + `RT_POINT_KNOB)

// u[2.point] half of the chord that a sphere cuts from a ray
`define RT_HALF_CHORD_INT 2
`define RT_HALF_CHORD_FRAC `RT_POINT_KNOB
`define RT_HALF_CHORD_W (2 + `RT_POINT_KNOB)

// [11.point] light or corner minus a point; its length
`define RT_REACH_INT 11
`define RT_REACH_FRAC `RT_POINT_KNOB
`define RT_REACH_W (11 + `RT_POINT_KNOB)

// u[1.20] magnitude of a triangle's normal times a ray's direction
`define RT_FACING_INT 1
`define RT_FACING_FRAC 20
`define RT_FACING_W (1 + 20)

// u[10.20] distance of a triangle's plane from a point
`define RT_PLANE_INT 10
`define RT_PLANE_FRAC 20
`define RT_PLANE_W (10 + 20)

// u[2.16] ratio of refractive indices
`define RT_ETA_INT 2
`define RT_ETA_FRAC 16
`define RT_ETA_W (2 + 16)

// u[4.16] its square
`define RT_ETA_SQ_INT 4
`define RT_ETA_SQ_FRAC 16
`define RT_ETA_SQ_W (4 + 16)

// u[1.24] square of the sine of an angle of incidence
`define RT_SINE_SQ_INT 1
`define RT_SINE_SQ_FRAC 24
`define RT_SINE_SQ_W (1 + 24)

// [3.16] share of the normal in a transmitted direction
`define RT_GAIN_INT 3
`define RT_GAIN_FRAC 16
`define RT_GAIN_W (3 + 16)

// u[9.colour] colour, weight, attenuation inside the core
`define RT_SHADE_INT 9
`define RT_SHADE_FRAC `RT_COLOUR_KNOB
`define RT_SHADE_W (9 + `RT_COLOUR_KNOB)

// u[8.0] one channel of a pixel
`define RT_CHANNEL_INT 8
`define RT_CHANNEL_FRAC 0
`define RT_CHANNEL_W (8 + 0)

// Distances, with the fraction of RT_POINT.
`define RT_T_MIN (1 << (`RT_POINT_FRAC - 6))
`define RT_INFINITY (262143 << (`RT_POINT_FRAC - 10))

// Secondary rays: smallest weight, with the fraction of RT_SHADE; greatest depth.
`define RT_MIN_WEIGHT (1 << (`RT_SHADE_FRAC - 8))
`define RT_MAX_DEPTH 5

// Trace units of the default build.
`define RT_UNITS 2

// Fault codes.
`define RT_FAULT_NONE 0
`define RT_FAULT_FRAME_SHORT 1
`define RT_FAULT_FRAME_LONG 2
`define RT_FAULT_CAPACITY 3
`define RT_FAULT_KIND 4
`define RT_FAULT_RADIUS 5
`define RT_FAULT_CAMERA_POSITION 6
`define RT_FAULT_CAMERA_UP 7
`define RT_FAULT_SIZE 8
`define RT_FAULT_W 4

// Records of a frame, see scene/loader.v.
`define RT_RECORD_CAMERA 0
`define RT_RECORD_LIGHT 1
`define RT_RECORD_SPHERE 2
`define RT_RECORD_TRIANGLE 3
`define RT_RECORD_TAIL 4
`define RT_RECORD_SLOTS 26
`define RT_SPHERE_SLOTS 21

// Rows of the tables of the objects, see scene/object_setup.v.
`define RT_INDEX_W 4
`define RT_INDEX_ONE 8
`define RT_GEOMETRY_W (3 + 3 * `RT_UNIT_W + 9 * `RT_COORD_W + 3 * `RT_COEFF_W)
`define RT_SURFACE_W (1 + `RT_INDEX_W + 3 * `RT_UNIT_W + 3 * `RT_COORD_W)
`define RT_MATERIAL_W (3 * `RT_SHADE_W + 12 * `RT_COEFF_W)

// Registers, see bus/axil_registers.v.
`define RT_REG_ID 8'h00
`define RT_REG_ID_CORE_LOW 16
`define RT_REG_ID_MAJOR_LOW 8
`define RT_REG_ID_MINOR_LOW 0
`define RT_REG_ID_AT_RESET 32'h52540001
`define RT_REG_CONTROL 8'h04
`define RT_REG_CONTROL_START_LOW 0
`define RT_REG_CONTROL_AUTO_LOW 1
`define RT_REG_CONTROL_RESET_LOW 2
`define RT_REG_CONTROL_AT_RESET 32'h00000002
`define RT_REG_STATUS 8'h08
`define RT_REG_STATUS_BUSY_LOW 0
`define RT_REG_STATUS_START_LOW 1
`define RT_REG_INTERRUPT 8'h0c
`define RT_REG_INTERRUPT_DONE_LOW 0
`define RT_REG_INTERRUPT_ERROR_LOW 1
`define RT_REG_INTERRUPT_ENABLE 8'h10
`define RT_REG_INTERRUPT_ENABLE_DONE_LOW 0
`define RT_REG_INTERRUPT_ENABLE_ERROR_LOW 1
`define RT_REG_INTERRUPT_ENABLE_AT_RESET 32'h00000000
`define RT_REG_ERROR 8'h14
`define RT_REG_ERROR_CODE_LOW 0
`define RT_REG_SIZE 8'h18
`define RT_REG_SIZE_WIDTH_LOW 0
`define RT_REG_SIZE_HEIGHT_LOW 16
`define RT_REG_SIZE_AT_RESET 32'h02000200
`define RT_REG_TAN_H 8'h1c
`define RT_REG_TAN_H_AT_RESET 32'h000093cd
`define RT_REG_TAN_V 8'h20
`define RT_REG_TAN_V_AT_RESET 32'h000093cd
`define RT_REG_DEPTH 8'h24
`define RT_REG_LIGHTS_AT_POINT 8'h28
`define RT_REG_DEGENERATE 8'h2c
`define RT_REG_CYCLES 8'h30
`define RT_REG_PRIMARY_RAYS 8'h34
`define RT_REG_SHADOW_RAYS 8'h38
`define RT_REG_SECONDARY_RAYS 8'h3c
`define RT_REG_TESTS 8'h40
`define RT_REG_UNITS 8'h44
`define RT_REG_FRAMES 8'h48
`define RT_REG_CAPACITY 8'h4c
`define RT_REG_CAPACITY_LIGHTS_LOW 0
`define RT_REG_CAPACITY_SPHERES_LOW 8
`define RT_REG_CAPACITY_TRIANGLES_LOW 16
`define RT_REG_WRITABLE 64'h00000000000003da
`define RT_REG_READABLE 64'h00000000000fffff
`define RT_REG_RESET_CLOCKS 4

// Screen: 640 x 480 at 60 Hz, pixel clock 25.175 MHz; clocks, lines.
`define RT_VGA_H_ACTIVE 640
`define RT_VGA_H_FRONT 16
`define RT_VGA_H_SYNC 96
`define RT_VGA_H_BACK 48
`define RT_VGA_H_POSITIVE 0
`define RT_VGA_V_ACTIVE 480
`define RT_VGA_V_FRONT 10
`define RT_VGA_V_SYNC 2
`define RT_VGA_V_BACK 33
`define RT_VGA_V_POSITIVE 0

// Stored picture: size, bits of a pixel.
`define RT_VIDEO_WIDTH 320
`define RT_VIDEO_HEIGHT 240
`define RT_VIDEO_DEPTH 16

`endif
