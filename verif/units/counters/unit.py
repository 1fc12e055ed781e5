"""The core's counters, for two trace units and for more."""

from verif.env.unit import Break, Unit

_FILE = "counters.v"

UNIT = Unit(
    name="counters",
    parameters={"UNITS": 2},
    sets={"five": {"UNITS": 5}},
    breaks=(
        Break(_FILE, "if (rst || frame_start) frame_reg", "if (frame_start) frame_reg"),
        Break(_FILE, "if (rst || frame_start) frame_reg", "if (rst) frame_reg"),
        Break(
            _FILE,
            "at_point_reg + {31'd0, at_point};",
            "(frame_start ? 0 : at_point_reg) + {31'd0, at_point};",
        ),
        Break(_FILE, "flat_reg     <= 32'd0;", "flat_reg     <= flat_reg;"),
        Break(_FILE, "number_of + {31'd0, bits[k]};", "number_of | {31'd0, bits[k]};"),
        Break(_FILE, "{31'd0, secondary}, {31'd0, shadow}", "{31'd0, shadow}, {31'd0, secondary}"),
        Break(_FILE, "flat_reg + {31'd0, flat};", "flat_reg + {31'd0, flat && busy};"),
        Break(
            _FILE,
            "for (k = 0; k < UNITS; k = k + 1) number_of",
            "for (k = 0; k < 2; k = k + 1) number_of",
            "five",
        ),
    ),
)
