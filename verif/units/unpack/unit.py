"""The unpacker: the loader's field width, and the widest."""

from verif.env.unit import Break, Unit

UNIT = Unit(
    name="unpack",
    parameters={"FIELD_W": 19},
    sets={"widest": {"FIELD_W": 32}},
    breaks=(
        Break("scene/unpack.v", "!ended_reg && left <= 7'd32;", "!ended_reg && count_reg <= 7'd32;"),
        Break(
            "scene/unpack.v",
            "wire [63:0] left_bits = buffer_reg << taken;",
            "wire [63:0] left_bits = buffer_reg << (taken & 7'h0f);",
        ),
        Break(
            "scene/unpack.v",
            "assign surplus     = count_reg >= 7'd32;",
            "assign surplus     = count_reg > 7'd32;",
        ),
    ),
)
