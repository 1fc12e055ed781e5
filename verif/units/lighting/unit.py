"""The light of each step: the core's size, and few objects in the book's formats."""

from models.formats import BUILDS
from models.header import defines
from verif.env.unit import Break, Unit

_FILE = "shade/lighting.v"

UNIT = Unit(
    name="lighting",
    top="lighting_harness",
    parameters={"OBJECTS": 18, "OBJECT_W": 5, "SLOT_W": 9},
    sets={"small": {"OBJECTS": 3, "OBJECT_W": 2, "SLOT_W": 4, **defines(BUILDS["book"])}},
    breaks=(
        # The base: in every step, never the background, always the background.
        Break(_FILE, "end_first ? end_local : {3 * SHADE_W{1'b0}}", "end_local"),
        Break(_FILE, "phong_hit ? phong_ambient : background_shade", "phong_ambient"),
        Break(_FILE, "phong_hit ? phong_ambient : background_shade", "background_shade"),
        # The light: of a miss, where there is none, one channel of it, not weighed.
        Break(_FILE, "wire bright = end_hit &&", "wire bright ="),
        Break(_FILE, ".dark      (!row_lit),", ".dark      (1'b0),"),
        Break(_FILE, "end_light != {3 * SHADE_W{1'b0}}", "end_light[0+:SHADE_W] != {SHADE_W{1'b0}}"),
        Break(_FILE, "({2{phong_weight}})", "({{3 * SHADE_W{1'b1}}, phong_weight})"),
        # The row of another object; what is told of a light at the point.
        Break(_FILE, "row_reg <= rows[way_number];", "row_reg <= rows[in_own[OBJECT_W-1:0]];"),
        Break(_FILE, "end_valid && end_hit && end_lit && end_degenerate;", "end_valid && end_degenerate;"),
        Break(_FILE, "at_point_reg     <= end_valid &&", "at_point_reg     <= bright && end_valid &&"),
    ),
)
