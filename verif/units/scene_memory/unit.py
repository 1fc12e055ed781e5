"""The scene memory: one object of each kind, two, and the book's capacity."""

from verif.env.unit import Break, Unit

UNIT = Unit(
    name="scene_memory",
    parameters={"LIGHTS": 1, "SPHERES": 1, "TRIANGLES": 1},
    sets={
        "pairs": {"LIGHTS": 2, "SPHERES": 2, "TRIANGLES": 2},
        "book": {"LIGHTS": 3, "SPHERES": 3, "TRIANGLES": 15},
    },
    breaks=(
        Break(
            "scene/scene_memory.v", "cameras[!bank_reg] <= write_record", "cameras[bank_reg] <= write_record"
        ),
        Break("scene/scene_memory.v", "lights[{bank_reg, light_index}]", "lights[{!bank_reg, light_index}]"),
        Break("scene/scene_memory.v", "if (rst) bank_reg <= 1'b0;", "if (1'b0) bank_reg <= 1'b0;"),
        Break(
            "scene/scene_memory.v",
            "spheres[{!bank_reg, write_index[SPHERE_INDEX_W-1:0]}]",
            "spheres[{!bank_reg, write_index[SPHERE_INDEX_W-1:0] & 1'b1}]",
            set="book",
        ),
        Break(
            "scene/scene_memory.v",
            "triangle_reg <= triangles[{bank_reg, triangle_index}];",
            "triangle_reg <= triangles[{bank_reg, sphere_index}];",
            set="book",
        ),
        Break(
            "scene/scene_memory.v",
            "write_kind == `RT_RECORD_TRIANGLE)",
            "write_kind >= `RT_RECORD_TRIANGLE)",
        ),
    ),
)
