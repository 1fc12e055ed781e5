// SPDX-License-Identifier: Apache-2.0
//
// Formats, limits and fault codes of the core. Written by `python -m models.header`; do not edit.
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

// [11.point] light minus hit point; its length
`define RT_REACH_INT 11
`define RT_REACH_FRAC `RT_POINT_KNOB
`define RT_REACH_W (11 + `RT_POINT_KNOB)

// u[9.colour] colour, weight, attenuation inside the core
`define RT_SHADE_INT 9
`define RT_SHADE_FRAC `RT_COLOUR_KNOB
`define RT_SHADE_W (9 + `RT_COLOUR_KNOB)

// u[8.0] one channel of a pixel
`define RT_CHANNEL_INT 8
`define RT_CHANNEL_FRAC 0
`define RT_CHANNEL_W (8 + 0)

// Capacity of a frame.
`define RT_MAX_LIGHTS 1
`define RT_MAX_SPHERES 1
`define RT_MAX_TRIANGLES 0

// Distances, with the fraction of RT_POINT.
`define RT_T_MIN (1 << (`RT_POINT_FRAC - 6))
`define RT_INFINITY (262143 << (`RT_POINT_FRAC - 10))

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
`define RT_GEOMETRY_W (3 + 3 * `RT_UNIT_W + 9 * `RT_COORD_W + 3 * `RT_COEFF_W)
`define RT_SURFACE_W (1 + `RT_INDEX_W + 3 * `RT_UNIT_W + 3 * `RT_COORD_W)
`define RT_MATERIAL_W (3 * `RT_SHADE_W + 12 * `RT_COEFF_W)

`endif
