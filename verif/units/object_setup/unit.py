"""The objects' set-up: the book's counters, and indices, numbers and a normaliser of other widths."""

from verif.env.unit import Break, Unit

_FILE = "scene/object_setup.v"

UNIT = Unit(
    name="object_setup",
    parameters={"SPHERE_INDEX_W": 2, "TRIANGLE_INDEX_W": 4, "OBJECT_W": 5, "WIDE_W": 41},
    sets={"wide": {"SPHERE_INDEX_W": 8, "TRIANGLE_INDEX_W": 8, "OBJECT_W": 9, "WIDE_W": 50}},
    breaks=(
        Break(
            _FILE, "if (rst) state_reg <= S_IDLE;", "if (rst && state_reg != S_START) state_reg <= S_IDLE;"
        ),
        Break(_FILE, "<= radius * radius;", "<= radius * (radius - 1'b1);"),
        Break(_FILE, ".OUT_SIGNED(0)", ".OUT_SIGNED(1)"),
        Break(_FILE, "4'd3: {first, second} = {2'd2, 2'd0};", "4'd3: {first, second} = {2'd2, 2'd1};"),
        Break(
            _FILE,
            "wire dead = is_triangle_reg && cross_reg == {3 * WIDE_W{1'b0}};",
            "wire dead = is_triangle_reg && cross_reg[3*WIDE_W-1:1] == 0;",
        ),
        Break(
            _FILE,
            "difference = {minuend[W-1], minuend} - {subtrahend[W-1], subtrahend};",
            "difference = {minuend[W-1], minuend - subtrahend};",
        ),
        Break(_FILE, "reflects_reg  <= reflects_reg || mirror;", "reflects_reg  <= mirror;"),
        Break(
            _FILE,
            "wire glass = k_transparency != {3 * COEFF_W{1'b0}};",
            "wire glass = k_transparency[0+:COEFF_W] != 0;",
        ),
        Break(_FILE, "else done_reg <= frame_ends;", "else done_reg <= frame_ends && object_reg != 0;"),
        Break(_FILE, "state_reg == S_START && !is_triangle_reg", "state_reg == S_START"),
        Break(_FILE, "state_reg == S_IDLE && start;", "start;"),
        Break(_FILE, "if (rst) state_reg <= S_IDLE;", "if (1'b0) state_reg <= S_IDLE;"),
    ),
)
