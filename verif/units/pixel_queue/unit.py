"""The queue of pixels: the core's size, and one that is full all the time."""

from verif.env.unit import Break, Unit

UNIT = Unit(
    name="pixel_queue",
    parameters={"SLOTS": 256, "SIZE_W": 12},
    sets={"small": {"SLOTS": 4}, "smallest": {"SLOTS": 2}},
    breaks=(
        Break(
            "pixel/pixel_queue.v",
            "wire fetch = present_reg[head] && (!valid_reg || out_ready);",
            "wire fetch = present_reg[head];",
        ),
        Break("pixel/pixel_queue.v", "assign slot_valid = !full;", "assign slot_valid = 1'b1;"),
        Break(
            "pixel/pixel_queue.v",
            "if (rst) present_reg <= {SLOTS{1'b0}};",
            "if (1'b0) present_reg <= {SLOTS{1'b0}};",
        ),
        Break(
            "pixel/pixel_queue.v",
            "assign done      = taken && line_end &&",
            "assign done      = valid_reg && line_end &&",
        ),
    ),
)
