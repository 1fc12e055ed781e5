"""The loader: the book's counters, the capacity of this slice of the core, and the widest counters."""

from verif.env.unit import Break, Unit

_KINDS = ("LIGHT", "SPHERE", "TRIANGLE")

UNIT = Unit(
    name="loader",
    parameters={
        "LIGHT_COUNT_W": 2,
        "SPHERE_COUNT_W": 2,
        "TRIANGLE_COUNT_W": 4,
        "MAX_LIGHTS": 3,
        "MAX_SPHERES": 3,
        "MAX_TRIANGLES": 15,
    },
    sets={
        "slice": {"MAX_LIGHTS": 1, "MAX_SPHERES": 1, "MAX_TRIANGLES": 0},
        "widest": {f"{kind}_COUNT_W": 8 for kind in _KINDS} | {f"MAX_{kind}S": 255 for kind in _KINDS},
    },
    breaks=(
        Break("scene/loader.v", "assign finish = busy_reg && (", "assign finish = ("),
        Break(
            "scene/loader.v",
            "wire too_long = section_reg == S_END && (!ended || surplus);",
            "wire too_long = section_reg == S_END && !ended;",
        ),
        Break(
            "scene/loader.v",
            "else if (section_reg == S_SPHERE && field_reg == 5'd20) width = `RT_RADIUS_W;",
            "else if (section_reg == S_SPHERE && field_reg == 5'd19) width = `RT_RADIUS_W;",
        ),
        Break("scene/loader.v", "if (field == {FIELD_W{1'b0}}) field_fault", "if (field == 1) field_fault"),
        Break(
            "scene/loader.v",
            "else if (!busy_reg) busy_reg <= next_ready;",
            "else if (!busy_reg) busy_reg <= 1'b1;",
        ),
    ),
)
